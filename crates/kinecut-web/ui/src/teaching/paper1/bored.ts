// A bore as a question for `kinecut hole`, and what figures keep of the way that clears it.
import { Told, type Question, short } from "../asked";
import { type Point, type Values, tomlNumber } from "../model";

const n = (x: number) => tomlNumber(x, 4);

export const STRATEGIES = ["involute", "lens-1", "archimedean", "constant-engagement"] as const;
export const ENTRIES = ['"plunge"', "{ helix = { radius = 10, pitch = 2 } }"] as const;

/** The worked example of the paper with other numbers. */
export function boreToml(v: Values): string {
  return `tool = { number = 1, name = "Cutter D${n(v.d)}", type = "end-mill", diameter = ${n(v.d)}, flute_length = ${n(v.depth + 15)}, teeth = 4, centre_cutting = true, max_ramp_angle = 5 }
dynamics = { rapid = 60000, acceleration = 5, jerk = 100 }
post = { control = "sinumerik-840d", decimals = 4 }

[operation]
type = "bore"
tool = 1
at = [0, 0]
diameter = ${n(v.D)}
depth = ${n(v.depth)}
strategy = "${STRATEGIES[v.strategy]}"
entry = ${ENTRIES[v.entry]}
speed = 2400
rough = { stepover = ${n(v.H)}, allowance = ${n(v.delta)}, feed = 6000, engagement = ${n(v.limit)} }
finish = { turns = 2, feed = 3000 }
`;
}

interface Pass {
  pass: string;
  path_radius: number;
  turns: number;
  step: number;
  entry_radius: number;
  length: number;
  floors: number[];
  run?: {
    length: number;
    time: number;
    peaks: { engagement: number | null };
    way: { s: number[]; x: number[]; y: number[] };
    samples: { s: number[]; time: number[]; speed: number[]; engagement: (number | null)[] };
  };
}

interface Answer {
  clockwise: boolean;
  passes: Pass[];
  feed_time: number;
}

/** The way of the cutter, thinned to what is drawn, and the load along it. */
export interface Way {
  clockwise: boolean;
  radius: number;
  turns: number;
  step: number;
  entry: number;
  spiral: number;
  floors: number[];
  length: number;
  time: number;
  peak: number | null;
  way: [s: number, x: number, y: number][];
  samples: [s: number, time: number, speed: number, engagement: number | null][];
}

/** Way between two places that are kept [mm], far from and near the middle of the bore. */
const APART = [6, 0.3];

function keepWay(answer: Answer): Way {
  const pass = answer.passes?.[0];
  if (!pass?.run) throw new Told(JSON.stringify(answer));
  const { run } = pass;
  const way: Way["way"] = [];
  run.way.s.forEach((s, i) => {
    const [x, y] = [run.way.x[i], run.way.y[i]];
    const last = way[way.length - 1];
    const apart = Math.min(APART[0], Math.max(APART[1], 0.12 * Math.hypot(x, y)));
    if (!last || s - last[0] >= apart || i === run.way.s.length - 1) way.push([short(s, 4), short(x), short(y)]);
  });
  return {
    clockwise: answer.clockwise,
    radius: pass.path_radius,
    turns: pass.turns,
    step: pass.step,
    entry: pass.entry_radius,
    spiral: pass.length,
    floors: pass.floors,
    length: run.length,
    time: run.time,
    peak: run.peaks.engagement,
    way,
    samples: run.samples.s.map((s, i) => [s, run.samples.time[i], run.samples.speed[i], run.samples.engagement[i]]),
  };
}

export function askWay(v: Values): Question {
  return { verb: "hole", flags: { samples: "rough" }, text: boreToml(v), as: "way", keep: keepWay };
}

function between(all: readonly (readonly (number | null)[])[], s: number, column: number): number | null {
  const i = all.findIndex((row) => (row[0] as number) >= s);
  if (i === 0) return all[0][column];
  if (i < 0) return all[all.length - 1]?.[column] ?? null;
  const [a, b] = [all[i - 1], all[i]];
  const [low, high] = [a[column], b[column]];
  if (low === null || high === null) return null;
  const gap = (b[0] as number) - (a[0] as number);
  return gap > 0 ? low + ((high - low) * (s - (a[0] as number))) / gap : high;
}

/** Place of the cutter's centre after a way, and its direction. */
export function placeAt({ way }: Way, s: number): { at: Point; along: Point } {
  const [x, y] = [between(way, s, 1) ?? 0, between(way, s, 2) ?? 0];
  const i = Math.max(1, way.findIndex((row) => row[0] > s));
  const [a, b] = [way[i - 1], way[Math.min(way.length - 1, i)]];
  const length = Math.hypot(b[1] - a[1], b[2] - a[2]) || 1;
  return { at: [x, y], along: [(b[1] - a[1]) / length, (b[2] - a[2]) / length] };
}

/** Time, speed and engagement after a way, evenly between two samples of the answer; an engagement that was not measured is null. */
export function loadAt({ samples }: Way, s: number): { time: number; speed: number; engagement: number | null } {
  return { time: between(samples, s, 1) ?? 0, speed: between(samples, s, 2) ?? 0, engagement: between(samples, s, 3) };
}
