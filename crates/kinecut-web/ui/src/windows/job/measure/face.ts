// The face of the part at one of its triangles: a plane, or a round wall about any axis. It is fitted to the corners of the simulated part,
// and says how far these are from it.
import type { PartData } from "viewer/decode";
import type { Point } from "viewer/scene";
import { corners, cornersOf, dot, flood, mean, normalOf } from "./region";
import { type RoundFace, roundAt } from "./round";

export interface PlaneFace {
  kind: "plane";
  /** Out of the material. */
  normal: Point;
  point: Point;
  /** Greatest distance of a corner from the plane [mm]. */
  off: number;
}

export type Face = PlaneFace | RoundFace;

/** Normals nearer than this are of one plane. */
const FLAT = Math.cos((8 * Math.PI) / 180);

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

/** Shortest distance of the axes of two round walls [mm]. */
export function betweenAxes(a: RoundFace, b: RoundFace): number {
  const way: Point = [0, 1, 2].map((k) => b.centre[k] - a.centre[k]) as Point;
  const square: Point = [a.axis[1] * b.axis[2] - a.axis[2] * b.axis[1], a.axis[2] * b.axis[0] - a.axis[0] * b.axis[2], a.axis[0] * b.axis[1] - a.axis[1] * b.axis[0]];
  const size = Math.hypot(...square);
  if (size > 1e-4) return Math.abs(dot(way, square)) / size;
  const along = dot(way, a.axis);
  return Math.sqrt(Math.max(0, dot(way, way) - along * along));
}
