// The cover as a question for `kinecut face`, one straight pass at a place, and what of the answer is drawn.
import { Told, type Question, short } from "../asked";
import { tomlNumber } from "../model";
import { COVER, type Edge } from "./part";

const n = (x: number) => String(Number(x.toPrecision(17)));

function bulge({ sweep }: Edge): string {
  return sweep === undefined ? "" : `, bulge = ${n(Math.tan(sweep / 4))}`;
}

const loop = (edges: Edge[]) => `[${edges.map((e) => `{ x = ${n(e.start[0])}, y = ${n(e.start[1])}${bulge(e)} }`).join(", ")}]`;

/** The face of examples/04_gear_pump_cover with its outline in the text. */
const FACE = `[tool]
number = 1
type = "face-mill"
diameter = 100
teeth = 7
flute_length = 8

[operation]
type = "face"
tool = 1
depth = 0.5
cutting_speed = 250
feed_per_tooth = 0.12
guard = 0
outline = { loops = [
  ${loop(COVER.slice(0, 4))},
  ${loop(COVER.slice(4, 6))},
${COVER.slice(6).map((e) => `  { centre = [${n(e.centre?.[0] ?? 0)}, ${n(e.centre?.[1] ?? 0)}], radius = ${n(e.start[0] - (e.centre?.[0] ?? 0))} }`).join(",\n")},
] }
`;

export interface Placed {
  bad: number;
  exits: number;
  entries: number;
  edges: Edge[];
  /** Edge, from, to (shares of its length), met, exit angle at both ends, weight. */
  stretches: [number, number, number, Met, number, number, number][];
}

const METS = ["exit", "entry", "lowered", "never"] as const;
type Met = 0 | 1 | 2 | 3;

interface Answer {
  ways: { bad: number; exits: number; entries: number }[];
  outline: { edges: (Edge & { radius?: number })[] };
  stretches: { edge: number; from: number; to: number; met: (typeof METS)[number]; exit_angles?: [number, number]; weight?: number }[];
  optimum: { placement: { turn: number; offset: number }; value: number; lower_bound: number };
  events: { tooth: number; front: boolean; exit: boolean; exit_angle: number; spindle_turned: number; point: [number, number] }[];
  cutter: { feed_per_revolution: number };
}

function keepPlaced(answer: Answer): Placed {
  if (!("ways" in answer)) throw new Told(JSON.stringify(answer));
  const [way] = answer.ways;
  return {
    bad: way.bad,
    exits: way.exits,
    entries: way.entries,
    edges: answer.outline.edges.map(({ start, end, centre, sweep }) => ({ start, end, centre, sweep: sweep === undefined ? undefined : (sweep * Math.PI) / 180 })),
    stretches: answer.stretches.map((s) => [s.edge, short(s.from, 6), short(s.to, 6), METS.indexOf(s.met) as Met, short(s.exit_angles?.[0] ?? 0, 4), short(s.exit_angles?.[1] ?? 0, 4), s.weight ?? 0]),
  };
}

/** Half of the sector of turns that is searched beside a place: its own certificate is not asked for [deg]. */
const SLIVER = 0.001;

export function placementToml(turn: number, offset: number): string {
  return `placement = { angle = ${tomlNumber(turn)}, offset = ${tomlNumber(offset)} }\npasses = "one"\n`;
}

function placed(turn: number, offset: number): string {
  const [from, to] = [turn - SLIVER, turn + SLIVER];
  const outside = from < 0 ? [[to, from + 360]] : to > 360 ? [[to - 360, from]] : [[0, from], [to, 360]];
  return `${FACE}${placementToml(turn, offset)}forbidden = [${outside.map(([a, b]) => `[${tomlNumber(a)}, ${tomlNumber(b)}]`).join(", ")}]\n`;
}

/** Lengths of edges at a placement; null where the part is too wide for the cutter. */
export function askPlaced(turn: number, offset: number): Question {
  return { verb: "face", text: placed(turn, offset), as: "placed", keep: keepPlaced, refused: () => null };
}

export interface Least {
  turn: number;
  offset: number;
  value: number;
  bound: number;
}

export const ASK_LEAST: Question = {
  verb: "face",
  text: FACE,
  as: "least",
  keep: ({ optimum }: Answer): Least => ({ turn: optimum.placement.turn, offset: optimum.placement.offset, value: optimum.value, bound: optimum.lower_bound }),
};

/** One revolution of a tooth: its number, and what it meets. */
export interface Revolution {
  m: number;
  feed: number;
  events: { at: [number, number]; exit: boolean; angle: number }[];
}

/** Revolutions that are shown of the way over the part. */
const SHOWN = 6;

function keepWay({ events, cutter }: Answer): Revolution[] {
  const front = events.filter((e) => e.tooth === 0 && e.front);
  const turns = [...new Set(front.map((e) => Math.floor(e.spindle_turned / 360)))].sort((a, b) => a - b);
  return Array.from({ length: SHOWN }, (_, i) => turns[Math.round(((i + 0.5) / SHOWN) * (turns.length - 1))]).map((m) => ({
    m,
    feed: cutter.feed_per_revolution,
    events: front.filter((e) => Math.floor(e.spindle_turned / 360) === m).map((e) => ({ at: e.point, exit: e.exit, angle: e.exit_angle })),
  }));
}

/** Six revolutions of one tooth over the part at a placement. */
export function askWay(turn: number, offset: number): Question {
  return { verb: "face", flags: { events: true }, text: placed(turn, offset), as: "way", keep: keepWay, refused: () => [], later: true };
}
