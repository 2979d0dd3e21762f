// The text of a question about a face, and what of it the window changes.
import { type Change, type Value, remove, set } from "../../toml/edit";
import { type Path, at, parse, plain } from "../../toml/parse";
import { round360 } from "./shape";
import type { Hand } from "./state";

function applied(text: string, change: Change | null): string {
  return change ? text.slice(0, change.from) + change.insert + text.slice(change.to) : text;
}

export function given(text: string, path: Path, value: Value): string {
  return applied(text, set(text, path, value));
}

export function without(text: string, path: Path): string {
  return applied(text, remove(text, path));
}

export function valueOf(text: string, path: Path): unknown {
  return plain(at(parse(text), path));
}

/** Whether a text asks about one face. */
export function asksFace(text: string): boolean {
  return valueOf(text, ["operation", "type"]) === "face";
}

/** The drawing that a text names; null where it has loops of its own. */
export function outlineOf(text: string): string | null {
  const outline = valueOf(text, ["operation", "outline"]);
  return typeof outline === "string" ? outline : null;
}

/** Half of the sector of turns that is searched when the placement is given [deg]: its own certificate is not asked for. */
const SLIVER = 0.001;

/** The text with one straight pass at a place. */
export function placedAt(text: string, turn: number, offset: number): string {
  // All digits: searches compare values that differ by little.
  const path: Path = ["operation", "placement"];
  const bare = without(text, path);
  const made = set(bare, path, { angle: 0, offset: 0 });
  const placed = applied(bare, made && { ...made, insert: made.insert.replace("{ angle = 0, offset = 0 }", `{ angle = ${float(round360(turn))}, offset = ${float(offset)} }`) });
  return given(placed, ["operation", "passes"], "one");
}

/** The same, with only turns next to it searched, so that the answer is soon there. */
export function atPlace(text: string, by: number, offset: number): string {
  const turn = round360(by);
  return sector(placedAt(text, turn, offset), turn - SLIVER, turn + SLIVER);
}

function float(n: number): string {
  const text = String(n);
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/** The text with turns outside of a sector (0 to 360, its ends a little beyond) forbidden, beside those that it forbids itself. */
export function sector(text: string, from: number, to: number): string {
  const own = valueOf(text, ["operation", "forbidden"]);
  // The outside of the sector, in intervals that do not leave a turn.
  const outside = from < 0 ? [[to, from + 360]] : to > 360 ? [[to - 360, from]] : [[0, from], [to, 360]];
  const all = [...(Array.isArray(own) ? (own as number[][]) : []), ...outside.filter(([a, b]) => b > a)];
  return given(text, ["operation", "forbidden"], all);
}

/** The text with the placement of least burr, one straight pass where that is possible. */
export function forLeast(text: string): string {
  return without(without(text, ["operation", "placement"]), ["operation", "passes"]);
}

/** The placement that a text gives itself; `offset` null: the cutter over the middle. */
export function placementOf(text: string): { angle: number; offset: number | null } | null {
  const placement = valueOf(text, ["operation", "placement"]);
  if (placement === "as-drawn") return { angle: 0, offset: null };
  if (typeof placement !== "object" || placement === null) return null;
  const { angle, offset } = placement as { angle?: unknown; offset?: unknown };
  return typeof angle === "number" ? { angle, offset: typeof offset === "number" ? offset : null } : null;
}

/** The text with the placement under the hand, to the digits that are shown. */
export function used(text: string, hand: Hand, middle: number): string {
  const digits = (n: number) => Number(n.toFixed(4));
  return given(text, ["operation", "placement"], { angle: digits(hand.turn), offset: digits(middle + hand.beside) });
}

/** A question about a new drawing: a cutter and a depth to begin with. */
export function fresh(drawing: string, title: string): string {
  return `title = ${JSON.stringify(title)}

[tool]
number = 1
type = "face-mill"
diameter = 100
teeth = 7
flute_length = 8

[operation]
type = "face"
tool = 1
outline = ${JSON.stringify(drawing)}
depth = 0.5
cutting_speed = 250
feed_per_tooth = 0.12
guard = 0
`;
}
