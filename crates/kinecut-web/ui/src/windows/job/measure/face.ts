// The face of the part at one of its triangles: a plane, or a round wall along Z. It is fitted to the corners of the simulated part, and
// says how far these are from it.
import type { PartData } from "viewer/decode";
import type { Point } from "viewer/scene";

export interface PlaneFace {
  kind: "plane";
  /** Out of the material. */
  normal: Point;
  point: Point;
  /** Greatest distance of a corner from the plane [mm]. */
  off: number;
}

export interface RoundFace {
  kind: "round";
  centre: [number, number];
  radius: number;
  /** Least and greatest Z [mm]. */
  bottom: number;
  top: number;
  /** Whether the material is around it: the wall of a hole. */
  hollow: boolean;
  /** Greatest distance of a corner from the cylinder [mm]. */
  off: number;
}

export type Face = PlaneFace | RoundFace;

/** Normals nearer than this are of one plane; neighbours nearer than that are of one bent face. */
const FLAT = Math.cos((8 * Math.PI) / 180);
const SMOOTH = Math.cos((25 * Math.PI) / 180);
/** Greatest share of Z in the normal of a wall. */
const UPRIGHT = 0.05;
/** Parts of a turn, and so many of them that a round wall has at least. */
const PARTS = 36;
const LEAST_PARTS = 6;

/** Triangles about each corner, by counting. */
interface Around {
  start: Uint32Array;
  triangles: Uint32Array;
}

const known = new WeakMap<PartData, Around>();

function around(data: PartData): Around {
  let all = known.get(data);
  if (!all) {
    const start = new Uint32Array(data.positions.length / 3 + 1);
    for (const v of data.indices) start[v + 1]++;
    for (let v = 1; v < start.length; v++) start[v] += start[v - 1];
    const fill = start.slice();
    const triangles = new Uint32Array(data.indices.length);
    for (let i = 0; i < data.indices.length; i++) triangles[fill[data.indices[i]]++] = Math.floor(i / 3);
    known.set(data, (all = { start, triangles }));
  }
  return all;
}

const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function cornersOf({ positions, indices }: PartData, triangle: number): [Point, Point, Point] {
  const one = (k: number): Point => {
    const v = 3 * indices[3 * triangle + k];
    return [positions[v], positions[v + 1], positions[v + 2]];
  };
  return [one(0), one(1), one(2)];
}

/** Unit normal and area; null for a triangle without one. */
function normalOf(data: PartData, triangle: number): { normal: Point; area: number } | null {
  const [a, b, c] = cornersOf(data, triangle);
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  const n: Point = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  const size = Math.hypot(...n);
  return size > 0 ? { normal: [n[0] / size, n[1] / size, n[2] / size], area: size / 2 } : null;
}

/** The triangles that hang together with one by `joins`, which is told a triangle and its neighbour. */
function flood(data: PartData, seed: number, joins: (from: Point, to: Point, triangle: number) => boolean): number[] {
  const { start, triangles } = around(data);
  const first = normalOf(data, seed);
  if (!first) return [];
  const seen = new Set([seed]);
  const found: [number, Point][] = [[seed, first.normal]];
  for (let i = 0; i < found.length; i++) {
    const [triangle, normal] = found[i];
    for (let k = 0; k < 3; k++) {
      const v = data.indices[3 * triangle + k];
      for (let j = start[v]; j < start[v + 1]; j++) {
        const next = triangles[j];
        if (seen.has(next)) continue;
        const own = normalOf(data, next);
        // A triangle without a normal says nothing: its neighbours are reached by others.
        if (!own || !joins(normal, own.normal, next)) continue;
        seen.add(next);
        found.push([next, own.normal]);
      }
    }
  }
  return found.map(([triangle]) => triangle);
}

function corners(data: PartData, triangles: number[]): Point[] {
  const all = new Set(triangles.flatMap((t) => [0, 1, 2].map((k) => data.indices[3 * t + k])));
  return [...all].map((v) => [data.positions[3 * v], data.positions[3 * v + 1], data.positions[3 * v + 2]]);
}

/** Mean normal and centre by area. */
function mean(data: PartData, triangles: number[]): { normal: Point; point: Point; area: number } {
  const [n, p]: [Point, Point] = [[0, 0, 0], [0, 0, 0]];
  let all = 0;
  for (const t of triangles) {
    const own = normalOf(data, t);
    if (!own) continue;
    all += own.area;
    const c = cornersOf(data, t);
    for (let k = 0; k < 3; k++) {
      n[k] += own.normal[k] * own.area;
      p[k] += ((c[0][k] + c[1][k] + c[2][k]) / 3) * own.area;
    }
  }
  const size = Math.hypot(...n) || 1;
  return { normal: [n[0] / size, n[1] / size, n[2] / size], point: [p[0] / all, p[1] / all, p[2] / all], area: all };
}

function planeAt(data: PartData, seed: number, step: number): PlaneFace | null {
  const within = Math.max(0.01, 0.05 * step);
  const first = normalOf(data, seed);
  if (!first) return null;
  let plane = { normal: first.normal, point: cornersOf(data, seed)[0], area: 0 };
  let own: number[] = [];
  // The plane of one triangle is rough: that of all that lie in it is taken in its place.
  for (let round = 0; round < 3; round++) {
    const { normal, point } = plane;
    const height = (p: Point) => Math.abs(dot(normal, p) - dot(normal, point));
    own = flood(data, seed, (_, to, t) => dot(to, normal) > FLAT && cornersOf(data, t).every((p) => height(p) <= within));
    if (own.length === 0) return null;
    plane = mean(data, own);
  }
  const { normal, point, area } = plane;
  // A few triangles of a bent surface are no plane.
  if (area < (4 * step) ** 2) return null;
  const off = corners(data, own).reduce((most, p) => Math.max(most, Math.abs(dot(normal, p) - dot(normal, point))), 0);
  return { kind: "plane", normal, point, off };
}

/** The circle with the least squares of its equation; null where there is none. */
function circle(points: Point[]): { x: number; y: number; radius: number } | null {
  const n = points.length;
  const [mx, my] = [0, 1].map((k) => points.reduce((sum, p) => sum + p[k], 0) / n);
  let [xx, xy, yy, xr, yr, rr] = [0, 0, 0, 0, 0, 0];
  for (const [px, py] of points) {
    const [x, y] = [px - mx, py - my];
    const r = x * x + y * y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xr += x * r;
    yr += y * r;
    rr += r;
  }
  const whole = 2 * (xx * yy - xy * xy);
  if (!(Math.abs(whole) > 1e-9 * xx * xx)) return null;
  const [a, b] = [(xr * yy - yr * xy) / whole, (yr * xx - xr * xy) / whole];
  return { x: mx + a, y: my + b, radius: Math.sqrt(rr / n + a * a + b * b) };
}

function roundAt(data: PartData, seed: number, step: number): RoundFace | null {
  const within = Math.max(0.02, 0.1 * step);
  const upright = (n: Point) => Math.abs(n[2]) < UPRIGHT;
  const first = normalOf(data, seed);
  if (!first || !upright(first.normal)) return null;
  const smooth = flood(data, seed, (from, to) => upright(to) && dot(from, to) > SMOOTH);
  let points = corners(data, smooth);
  let found = points.length >= 6 ? circle(points) : null;
  const off = (p: Point) => (found ? Math.abs(Math.hypot(p[0] - found.x, p[1] - found.y) - found.radius) : Infinity);
  // Corners at the rims are shared with other faces: those that are far off do not count.
  for (let round = 0; round < 3 && found; round++) {
    const sorted = points.map(off).sort((a, b) => a - b);
    const limit = Math.max(within, 3 * sorted[sorted.length >> 1]);
    points = points.filter((p) => off(p) <= limit);
    found = points.length >= 6 ? circle(points) : null;
  }
  if (!found) return null;
  const { x, y, radius } = found;
  const own = smooth.filter((t) => cornersOf(data, t).every((p) => off(p) <= within));
  const all = corners(data, own);
  const parts = new Set<number>();
  for (const [px, py] of all) parts.add(Math.floor(((Math.atan2(py - y, px - x) + Math.PI) / (2 * Math.PI)) * PARTS) % PARTS);
  if (!own.includes(seed) || parts.size < LEAST_PARTS || own.length < 0.8 * smooth.length) return null;
  const [a] = cornersOf(data, seed);
  const outward = first.normal[0] * (a[0] - x) + first.normal[1] * (a[1] - y);
  const heights = all.map((p) => p[2]);
  return {
    kind: "round",
    centre: [x, y],
    radius,
    bottom: heights.reduce((m, z) => Math.min(m, z), Infinity),
    top: heights.reduce((m, z) => Math.max(m, z), -Infinity),
    hollow: outward < 0,
    off: all.reduce((m, p) => Math.max(m, off(p)), 0),
  };
}

/** The face at a triangle of a part that was simulated with lines at a distance of `step` [mm]; null where it is of neither kind. */
export function faceAt(data: PartData, triangle: number, step: number): Face | null {
  return roundAt(data, triangle, step) ?? planeAt(data, triangle, step);
}

/** Whether two planes are parallel. */
export function parallel(a: PlaneFace, b: PlaneFace): boolean {
  return Math.abs(dot(a.normal, b.normal)) > 1 - 1e-5;
}

/** Distance of two parallel planes [mm]. */
export function between(a: PlaneFace, b: PlaneFace): number {
  return Math.abs(dot(a.normal, b.point) - dot(a.normal, a.point));
}
