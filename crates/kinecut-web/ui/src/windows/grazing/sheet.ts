// Answers of `kinecut grazing --json` and `kinecut envelope --json`, as far as the windows read them.
import type { Finding } from "../../base/api";

export type Vec = [number, number, number];
type Pair = [number, number];

export interface Piece {
  what: string;
  role: "cutting" | "shank" | "holder";
  fan: boolean;
  body: number;
  start: Pair;
  end: Pair;
  /** Of arcs. */
  centre?: Pair;
  /** Of arcs; below 0: hollow. */
  radius?: number;
  from: number;
  to: number;
  parameter: "mm" | "deg";
  area?: number;
  entering_area?: number;
  entering_share?: number;
  /** Form of the curve on it. */
  outcome?: string;
}

/** A band of the surface between two parallel circles: radius and height, normal, parameter of each; null: it leaves all round. */
export interface Band {
  piece: number;
  u: Pair;
  places: [Pair, Pair];
  normals: [Pair, Pair];
  enters: [Pair, Pair] | null;
}

export interface CurvePoint {
  point: Vec;
  normal: Vec;
  theta: number;
  u: number;
  piece: number;
  span: number;
  branch: 1 | -1;
}

export interface Loop {
  closed: boolean;
  length: number;
  winding: number;
  spans: Pair;
  points: CurvePoint[];
}

export const KINDS = ["generator", "cone-curve", "disc-chord", "sphere-arc", "torus-outer", "torus-inner", "edge-arc", "join"] as const;
export type Kind = (typeof KINDS)[number];

export interface Span {
  kind: Kind;
  piece: number;
  from: number;
  to: number;
  folds: [boolean, boolean];
  lengths: Pair;
  role: string;
}

export interface Fold {
  piece: number;
  span: number;
  theta: number;
  u: number;
  point: Vec;
}

export interface Sheet {
  title: string;
  motion: string;
  /** mm/min, degrees/min, in coordinates of the tool. */
  twist: { velocity: Vec; turn: Vec };
  /** Both ends of the axis, the tip first. */
  ends: [{ z: number; velocity: Vec }, { z: number; velocity: Vec }];
  pieces: Piece[];
  bands: Band[];
  spans: Span[];
  loops: Loop[];
  folds: Fold[];
  circles: { piece: number; at: number; radius: number; z: number }[];
  whole: number[];
  touching: number[];
  entering: { area: number; entering_area: number; gained: number; lost: number };
  tolerance: number;
  notes: string[];
  findings: Finding[];
}

export type Rows = [[number, number, number, number], [number, number, number, number], [number, number, number, number]];

/** A moment of a move; velocities by the whole move. */
export interface Moment {
  t: number;
  area: number;
  curves: number;
  volume_rate: number;
  paths: Vec[][];
  pose: Rows;
  triangles: number;
  turn: Vec;
  velocity: Vec;
}

/** A move at equal moments, as `--moments` prints it. */
export interface Growth {
  title: string;
  way: string;
  mode: string;
  length: number;
  turn: number;
  tolerance: number;
  until: number;
  moments: Moment[];
  pieces: Piece[];
  notes: string[];
  findings: Finding[];
  vertices: number;
  triangles: number;
  /** Triangles of the tool at the start, and at the end: from, before. */
  ends: [Pair, Pair];
  stream: string;
}

/** The sweep of a move. */
export interface Swept {
  title: string;
  length: number;
  turn: number;
  until: number;
  tolerance: number;
  tool_volume: number;
  exact_volume: number | null;
  mesh: { volume: number; volume_of_lines: number; step: number; triangles: number; bounds: [Vec, Vec]; deeper: number; looked_at: number };
  walls: { area: number; inside: number; of_hollow_edges: number };
  events: { after: number; before: number; between: Pair }[];
  cusps: { t: number; point: Vec }[];
  findings: Finding[];
}

/** The answers to the questions of a text, or the reason why one has no answer. */
export function answersOf<T>(told: unknown): (T | Finding)[] {
  const one = (answer: unknown): (T | Finding)[] => {
    const table = answer as { error?: Finding; moves?: T[] };
    return table.moves ?? [table.error ?? (answer as T | Finding)];
  };
  return Array.isArray(told) ? told.flatMap(one) : one(told);
}

export function isSheet(answer: Sheet | Finding | undefined): answer is Sheet {
  return answer !== undefined && "bands" in answer;
}

export function isGrowth(answer: Growth | Finding | undefined): answer is Growth {
  return answer !== undefined && "moments" in answer;
}

export function isSwept(answer: Swept | Finding | undefined): answer is Swept {
  return answer !== undefined && "walls" in answer;
}

/** Radius and height of a place of a piece. */
export function placeOf(piece: Pick<Piece, "start" | "end" | "centre" | "radius" | "from" | "to">, u: number): Pair {
  if (piece.centre) {
    const [phi, r] = [(u * Math.PI) / 180, piece.radius ?? 0];
    return [piece.centre[0] + r * Math.cos(phi), piece.centre[1] + r * Math.sin(phi)];
  }
  const part = (u - piece.from) / (piece.to - piece.from);
  return [piece.start[0] + part * (piece.end[0] - piece.start[0]), piece.start[1] + part * (piece.end[1] - piece.start[1])];
}

/** Whether the surface enters at a place: by the angles of its band. */
export function entersAt(sheet: Sheet, piece: number, u: number, theta: number): boolean {
  const band = sheet.bands.find((b) => b.piece === piece && (u - b.u[0]) * (u - b.u[1]) <= 0);
  if (!band?.enters) return false;
  const part = band.u[1] === band.u[0] ? 0 : (u - band.u[0]) / (band.u[1] - band.u[0]);
  const [from, to] = [0, 1].map((k) => (band.enters as [Pair, Pair])[0][k] * (1 - part) + (band.enters as [Pair, Pair])[1][k] * part);
  return (((theta - from) % 360) + 360) % 360 <= to - from;
}
