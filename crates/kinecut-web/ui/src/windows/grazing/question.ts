// The texts of both windows: which questions they hold, the motion, and what is written when a handle is dragged.
import { type Change, type Value, remove, set } from "../../toml/edit";
import { type Path, at, parse, plain } from "../../toml/parse";
import type { Piece, Vec } from "./sheet";

type Table = Record<string, unknown>;
export type Verb = "grazing" | "envelope";

const isTable = (v: unknown): v is Table => typeof v === "object" && v !== null && !Array.isArray(v);

/** Words that only one of the verbs knows. */
const WORDS: Record<Verb, string[]> = { grazing: ["twist", "pose", "moment"], envelope: ["move", "joints", "screw", "of"] };

function asks(verb: Verb, table: unknown): boolean {
  return isTable(table) && !("operation" in table) && WORDS[verb].some((word) => word in table);
}

/** Whether a text is a question of a verb. */
export function isOf(verb: Verb, values: Table): boolean {
  const list = values[verb];
  return Array.isArray(list) ? list.some((one) => asks(verb, one)) : asks(verb, values);
}

/** The way to each question of a text. */
export function itemsOf(verb: Verb, values: Table): Path[] {
  const list = values[verb];
  return Array.isArray(list) ? list.map((_, i) => [verb, i]) : [[]];
}

function applied(text: string, change: Change | null): string {
  return change ? text.slice(0, change.from) + change.insert + text.slice(change.to) : text;
}

export const given = (text: string, path: Path, value: Value): string => applied(text, set(text, path, value));
export const without = (text: string, path: Path): string => applied(text, remove(text, path));
export const valueOf = (text: string, path: Path): unknown => plain(at(parse(text), path));

export interface Twist {
  velocity: Vec;
  turn: Vec;
}

const DEGREES = 180 / Math.PI;

/** The twist of a tool whose axis has these velocities at two heights; the axial part is that of `lead`, for both ends of a rigid axis have it. */
export function twistOf(tip: Vec, top: Vec, heights: [number, number], spin: number, lead: "tip" | "top"): Twist {
  const [low, high] = heights;
  const x = -(top[1] - tip[1]) / (high - low);
  const y = (top[0] - tip[0]) / (high - low);
  const along = lead === "tip" ? tip[2] : top[2];
  return { velocity: [tip[0] - y * low, tip[1] + x * low, along], turn: [x * DEGREES, y * DEGREES, spin] };
}

/** Numbers to about a thousandth of the greatest. */
export function rounded(v: Vec): Vec {
  const most = Math.max(...v.map(Math.abs));
  if (!(most > 0)) return [0, 0, 0];
  const step = 10 ** Math.max(-6, Math.floor(Math.log10(most)) - 3);
  return v.map((c) => Number((Math.round(c / step) * step).toPrecision(8)) + 0) as Vec;
}

/** The text with another twist; a pose or a moment of a program makes place for it. */
export function withTwist(text: string, item: Path, twist: Partial<Twist>): string {
  let made = text;
  for (const key of ["pose", "rate", "moment"]) made = without(made, [...item, key]);
  const known = valueOf(made, [...item, "twist"]);
  if (!isTable(known)) return given(made, [...item, "twist"], { velocity: twist.velocity ?? [0, 0, 0], turn: twist.turn ?? [0, 0, 0] });
  made = without(made, [...item, "twist", "at"]);
  for (const key of ["velocity", "turn"] as const) if (twist[key]) made = given(made, [...item, "twist", key], twist[key]);
  return made;
}

/** A tool as a contour, from the pieces of an answer. */
export function contourOf(pieces: Piece[]): Value {
  const elements = pieces
    .filter((piece) => !piece.fan)
    .map((piece): Value => {
      const more: Record<string, Value> = {};
      if (piece.centre) Object.assign(more, { centre: piece.centre, convex: (piece.radius ?? 0) > 0 });
      if (piece.role !== "cutting") more.role = piece.role;
      if (piece.body > 0) more.body = piece.body;
      return { to: piece.end, ...more };
    });
  const bottom = pieces.find((piece) => !piece.fan)?.start[1] ?? 0;
  return { shape: { contour: bottom === 0 ? { elements } : { bottom, elements } } };
}

/** The text with another tool in place of its own. */
export function withTool(text: string, item: Path, tool: Value): string {
  let made = without(text, [...item, "tool_file"]);
  // A table under a header of its own is taken away whole: its successor has one line.
  while (valueOf(made, [...item, "tool"]) !== undefined) {
    const next = without(made, [...item, "tool"]);
    if (next === made) break;
    made = next;
  }
  return given(made, [...item, "tool"], tool);
}

/** The words of the motion that a question gives. */
export function motionOf(values: unknown): "twist" | "pose" | "moment" | null {
  if (!isTable(values)) return null;
  return (["twist", "pose", "moment"] as const).find((key) => key in values) ?? null;
}

export const BEGIN: Record<Verb, string> = {
  grazing: `# A tool and its motion at one moment: drag the arrows, or change the numbers.
title = "Bull-nose end mill in motion"

[tool]
shape.bull-nose = { diameter = 20, corner_radius = 5, flute_length = 24 }
shank_diameter = 16
stickout = 42

[twist]                                  # in coordinates of the tool: origin at the tip, Z to the holder
velocity = [1200, 150, -220]             # of the tip, mm/min
turn = [180, 1100, 0]                    # degrees/min
`,
  envelope: `# A tool and its move: scrub the time, and see what it sweeps.
title = "Bull-nose end mill, leaning over along a line"
tolerance = 0.05                         # of the mesh, mm

[tool]
shape.bull-nose = { diameter = 20, corner_radius = 5, flute_length = 24 }
shank_diameter = 16
stickout = 42

[move]
from = [0, 0, 0]
to = [60, 10, -8]
axis = [0, 0, 1]                         # from the tip to the holder, at the start
axis_to = [0.5, 0.35, 0.8]               # and at the end
`,
};
