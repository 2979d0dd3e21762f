// The text of a hole as the window reads and changes it.
import { batch } from "@preact/signals";
import type { Document } from "../../store/document";
import { edited } from "../../store/session";
import { type Change, type Value, remove, set } from "../../toml/edit";
import { type Path, parse, plain } from "../../toml/parse";
import type { Figure, Plan, Point } from "./answer";

export type Table = Record<string, unknown>;

export function table(value: unknown): Table {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? (value as Table) : {};
}

/** Whether values are the question of a milled hole. */
export function isHole(values: Table): boolean {
  return table(values.operation).type === "bore";
}

export function numberOf(value: unknown): number | null {
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}

export function pointOf(value: unknown): Point | null {
  return Array.isArray(value) && value.length === 2 && value.every((n) => numberOf(n) !== null) ? (value as Point) : null;
}

/** The strategies that clear a level in its plane, in the order of the comparison, and what they are compared by. */
export const STRATEGIES = [
  "involute",
  "lens-1",
  "lens-2",
  "constant-engagement",
  "constant-engagement-free",
  "archimedean",
  "arcs-2",
  "arcs-4",
  "rings",
  "rings-tangent",
  "trochoidal",
] as const;
export type Strategy = (typeof STRATEGIES)[number];

/** Contacts of the lead-in with the wall. */
export const CONTACTS = ["g2", "g4", "g6"] as const;

type Step = (text: string) => Change | null;

function made(text: string, steps: Step[]): string {
  for (const step of steps) {
    const change = step(text);
    if (change) text = text.slice(0, change.from) + change.insert + text.slice(change.to);
  }
  return text;
}

const give = (path: Path, value: Value): Step => (text) => set(text, path, value);
const take = (path: Path): Step => (text) => remove(text, path);

/** Engagement that is kept where none is given [deg], as `--compare` has it. */
const USUAL_ENGAGEMENT = 60;

/** The same hole cleared by another strategy. */
export function withStrategy(text: string, strategy: Strategy): string {
  const rough = table(table(plain(parse(text)) as Table).operation).rough;
  const free = strategy === "constant-engagement-free";
  const steps: Step[] = [give(["operation", "strategy"], free ? "constant-engagement" : strategy)];
  // Only an involute starts in a point off the centre.
  if (strategy !== "involute") steps.push(take(["operation", "rough", "start"]));
  if (strategy.startsWith("constant") && table(rough).engagement === undefined) steps.push(give(["operation", "rough", "engagement"], USUAL_ENGAGEMENT));
  if (free) steps.push(take(["operation", "rough", "stepover"]));
  return made(text, steps);
}

/** The same hole with another contact of its lead-in. */
export function withContact(text: string, contact: (typeof CONTACTS)[number]): string {
  return made(text, [give(["operation", "finish", "contact"], contact)]);
}

function edit(doc: Document, ...steps: Step[]): void {
  batch(() => edited(doc, made(doc.text.peek(), steps)));
}

/** Keys of the start of the lead-in, of which one may be given. */
const STARTS = ["start_radius", "start_length", "start_curvature_radius", "touch_angle"];

/** A length as it is written [mm]. */
const neat = (mm: number) => Number(mm.toFixed(3));

/** Starts the lead-in in a point, from the bore's centre. */
export function startIn(doc: Document, plan: Plan, [x, y]: Point): void {
  const point: Value = [neat(plan.at[0] + x), neat(plan.at[1] + y)];
  const known = table(table(doc.values.peek().operation).finish);
  const old = STARTS.filter((key) => known[key] !== undefined).map((key) => take(["operation", "finish", key]));
  edit(doc, ...old, give(["operation", "finish", "start"], point));
}

/**
 * Turns the lead-in so that it touches the wall in a direction from the centre [deg]. Through a point off the centre there is one lead-in
 * only: the point is turned with it.
 */
export function touchIn(doc: Document, plan: Plan, figure: Figure, degrees: number): void {
  const known = table(table(doc.values.peek().operation).finish);
  if (known.start === undefined) {
    edit(doc, give(["operation", "finish", "touch_angle"], Number(degrees.toFixed(2))));
    return;
  }
  const [x, y] = figure.start;
  const by = (degrees * Math.PI) / 180 - Math.atan2(figure.touch[1], figure.touch[0]);
  startIn(doc, plan, [x * Math.cos(by) - y * Math.sin(by), x * Math.sin(by) + y * Math.cos(by)]);
}
