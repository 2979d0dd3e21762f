// The text of a drilling as the window reads and changes it: surfaces, point, places.
import { batch } from "@preact/signals";
import type { Document } from "../../store/document";
import { edited } from "../../store/session";
import { type Change, type Value, remove, set } from "../../toml/edit";
import { type Path, at, parse } from "../../toml/parse";
import { type Face, type Kind, across, faceOf, kindOf } from "./faces";
import { type Point, type PointKind, begin, pointOf } from "./points";

type Table = Record<string, unknown>;

/** All of a text that the window draws. */
export interface Question {
  diameter: number;
  point: Point | null;
  entry: Face | undefined;
  /** "same": the other side of the same body. */
  exit: Face | "same" | undefined;
  /** Distance of the exit's frame below that of the entry. */
  length: number;
  approach: number;
  overrun: number | null;
  /** Cutting speed [m/min], where it is given. */
  speed: number | undefined;
  /** Whether the surfaces run in different directions. */
  isTurned: boolean;
  /** Whether the surfaces are those of a mesh. */
  ofMesh: boolean;
  /** Whether a hole is there, or others are crossed, which the drawing has not. */
  hasMore: boolean;
}

function table(value: unknown): Table {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? (value as Table) : {};
}

const number = (value: unknown, standard: number) => (typeof value === "number" && Number.isFinite(value) ? value : standard);

export function questionOf(values: Record<string, unknown>): Question {
  const tool = table(values.tool);
  const operation = table(values.operation);
  const ofMesh = (values.part !== undefined || operation.body !== undefined) && operation.entry === undefined;
  const face = (value: unknown) => (value === undefined ? undefined : (table(value) as Face));
  const isTurned = (a: Face | undefined, b: Face | undefined) => {
    const turns = [a, b].map((f) => (f && (f.surface !== "plane" || f.inclination) ? across(f) : null));
    const [first, second] = turns;
    return first !== null && second !== null && Math.abs(Math.sin(((first - second) * Math.PI) / 180)) > 1e-9;
  };
  return {
    speed: typeof operation.cutting_speed === "number" ? operation.cutting_speed : undefined,
    isTurned: isTurned(face(operation.entry), operation.exit === "same" ? undefined : face(operation.exit)),
    diameter: number(tool.diameter, NaN),
    point: pointOf(tool),
    entry: operation.entry === undefined && !ofMesh ? { surface: "plane" } : face(operation.entry),
    exit: operation.exit === "same" ? "same" : face(operation.exit),
    length: number(operation.length, 0),
    approach: number(operation.approach, 2),
    overrun: typeof operation.overrun === "number" ? operation.overrun : operation.method === "reaming" ? null : 2,
    ofMesh,
    hasMore: operation.pre_hole !== undefined || operation.cross_bore !== undefined,
  };
}

/** The surface that the drill leaves, with "same" as that of the entry. */
export function exitFace({ entry, exit }: Question): Face | undefined {
  return exit === "same" ? entry : exit;
}

export function kinds(question: Question, place: [number, number]): { entry: Kind | null; exit: Kind | "blind" | null } {
  const entry = kindOf(question.entry, place);
  if (question.exit === undefined) return { entry, exit: question.ofMesh ? null : "blind" };
  return { entry, exit: kindOf(exitFace(question), place) };
}

type Step = (text: string) => Change | null;

/** Makes changes one after the other, as one change. */
function edit(doc: Document, ...steps: Step[]): void {
  let text = doc.text.peek();
  for (const step of steps) {
    const made = step(text);
    if (made) text = text.slice(0, made.from) + made.insert + text.slice(made.to);
  }
  batch(() => edited(doc, text));
}

const give = (path: Path, value: Value): Step => (text) => set(text, path, value);
/** Gives a table its value, also where it is a section of its own so far. */
const replace = (path: Path, value: Value): Step[] => [
  (text) => {
    const node = at(parse(text), path);
    return node?.kind === "table" && node.form !== "inline" ? remove(text, path) : null;
  },
  give(path, value),
];
const take = (path: Path): Step => (text) => remove(text, path);

/** Length and depth to begin with, in diameters. */
const [LENGTH, DEPTH] = [4, 2];

/** The exit of a hole before it became blind: it is there again when one goes back. */
const left = new WeakMap<Document, Pick<Question, "length" | "exit">>();

/** Chooses the kinds of both surfaces; a blind hole has no exit, and a depth in place of the length. */
export function choose(doc: Document, entry: Kind, exit: Kind | "blind", place: [number, number]): void {
  const question = questionOf(doc.values.peek());
  const known = kinds(question, place);
  const { diameter } = question;
  const size = Number.isFinite(diameter) ? diameter : 10;
  const steps: Step[] = [];
  const out = exitFace(question);
  if (known.entry !== entry) {
    steps.push(...replace(["operation", "entry"], faceOf(entry, question.entry, out, size)));
    // The exit was that of the entry before.
    if (question.exit === "same" && exit !== "blind") steps.push(...replace(["operation", "exit"], faceOf(exit, question.entry, question.entry, size)));
  }
  if (exit === "blind" && question.exit !== undefined) {
    const depth = number(table(doc.values.peek().operation).depth, Number((DEPTH * size).toPrecision(3)));
    left.set(doc, { length: question.length, exit: question.exit });
    steps.push(take(["operation", "exit"]), take(["operation", "length"]), take(["operation", "overrun"]), give(["operation", "depth"], depth));
  } else if (exit !== "blind" && known.exit !== exit) {
    if (question.exit === undefined) steps.push(...["depth", "tip", "reach_diameter"].map((key) => take(["operation", key])));
    const before = left.get(doc);
    if (question.exit === undefined) steps.push(give(["operation", "length"], before?.length ?? Number((LENGTH * size).toPrecision(3))));
    const face = out ?? (before?.exit === "same" ? question.entry : before?.exit);
    steps.push(...replace(["operation", "exit"], faceOf(exit, face, question.entry, size)));
  }
  if (steps.length > 0) edit(doc, ...steps);
}

export function choosePoint(doc: Document, kind: PointKind): void {
  const { diameter, point } = questionOf(doc.values.peek());
  if (point?.kind === kind) return;
  const size = Number.isFinite(diameter) ? diameter : 10;
  edit(doc, take(["tool", "point_angle"]), ...replace(["tool", "point"], begin(kind, size, point?.numbers ?? {})));
}
