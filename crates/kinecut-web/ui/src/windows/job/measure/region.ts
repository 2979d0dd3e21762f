// Regions of a mesh: the triangles that hang together with one, their corners, normals and areas.
import type { PartData } from "viewer/decode";
import type { Point } from "viewer/scene";

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

export const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function cornersOf({ positions, indices }: PartData, triangle: number): [Point, Point, Point] {
  const one = (k: number): Point => {
    const v = 3 * indices[3 * triangle + k];
    return [positions[v], positions[v + 1], positions[v + 2]];
  };
  return [one(0), one(1), one(2)];
}

/** Unit normal and area; null for a triangle without one. */
export function normalOf(data: PartData, triangle: number): { normal: Point; area: number } | null {
  const [a, b, c] = cornersOf(data, triangle);
  const [ux, uy, uz] = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
  const [vx, vy, vz] = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
  const n: Point = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  const size = Math.hypot(...n);
  return size > 0 ? { normal: [n[0] / size, n[1] / size, n[2] / size], area: size / 2 } : null;
}

/** The triangles that hang together with one by `joins`, which is told a triangle and its neighbour; about as many as `most`. */
export function flood(data: PartData, seed: number, joins: (from: Point, to: Point, triangle: number) => boolean, most = Infinity): number[] {
  const { start, triangles } = around(data);
  const first = normalOf(data, seed);
  if (!first) return [];
  const seen = new Set([seed]);
  const found: [number, Point][] = [[seed, first.normal]];
  for (let i = 0; i < found.length && found.length < most; i++) {
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

export function corners(data: PartData, triangles: number[]): Point[] {
  const all = new Set(triangles.flatMap((t) => [0, 1, 2].map((k) => data.indices[3 * t + k])));
  return [...all].map((v) => [data.positions[3 * v], data.positions[3 * v + 1], data.positions[3 * v + 2]]);
}

/** Mean normal and centre by area. */
export function mean(data: PartData, triangles: number[]): { normal: Point; point: Point; area: number } {
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
