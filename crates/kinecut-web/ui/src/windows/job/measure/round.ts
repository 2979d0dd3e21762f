// A round wall at a triangle of a mesh. Its axis is where the normals are square to; it is then moved until the corners are nearest to a
// cylinder. An axis along X, Y or Z to within the corners is taken as exactly that.
import type { PartData } from "viewer/decode";
import type { Point } from "viewer/scene";
import { corners, cornersOf, dot, flood, normalOf } from "./region";
import { eigen, solved } from "./small";

export interface RoundFace {
  kind: "round";
  /** Unit vector along the axis; its greatest part is positive. */
  axis: Point;
  /** The place of the axis that is nearest to zero [mm]. */
  centre: Point;
  radius: number;
  /** Least and greatest place along the axis [mm], from the centre. */
  bottom: number;
  top: number;
  /** Whether the material is around it: the wall of a hole. */
  hollow: boolean;
  /** Greatest distance of a corner from the cylinder [mm]. */
  off: number;
}

/** Neighbours whose normals are nearer than this are of one bent face. */
const SMOOTH = Math.cos((25 * Math.PI) / 180);
/** Greatest share of the axis in the normal of a wall; while the axis is looked for, more. */
const UPRIGHT = 0.05;
const LOOSE = [0.15, 0.08, UPRIGHT];
/** Parts of a turn, and so many of them that a round wall has at least. */
const PARTS = 36;
const LEAST_PARTS = 6;
/** Triangles about the seed from which the axis is first taken, and how many times more where those are not bent enough. */
const PATCH = 200;
const MORE = 8;
/** Least spread of the normals across the axis, of the squares of their sines, and how much larger it is than that along the axis. */
const BENT = 0.002;
const CLEAR = 6;
/** Least height of a wall, in radii, whose axis is moved by its corners: below, the normals alone tell it. */
const TALL = 0.2;
/** An axis nearer to one of the coordinates is tried as that one. */
const NEAR = Math.cos((0.4 * Math.PI) / 180);
/** Greatest change of the normals along the axis, in turns about a sphere of the same radius: a ball is no wall. */
const BULGE = 0.3;

const COORDINATES: Point[] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

interface Cylinder {
  axis: Point;
  /** Any place of the axis. */
  place: Point;
  radius: number;
}

const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const plus = (a: Point, b: Point, by: number): Point => [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]];
const unit = (a: Point): Point => plus([0, 0, 0], a, 1 / (Math.hypot(...a) || 1));

/** Two unit vectors square to an axis and to each other. */
function across(axis: Point): [Point, Point] {
  const other: Point = Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const u = unit(plus(other, axis, -dot(other, axis)));
  return [u, [axis[1] * u[2] - axis[2] * u[1], axis[2] * u[0] - axis[0] * u[2], axis[0] * u[1] - axis[1] * u[0]]];
}

/** Distance of a place from the surface of a cylinder [mm]. */
function offOf({ axis, place, radius }: Cylinder, p: Point): number {
  const from = minus(p, place);
  return Math.abs(Math.hypot(...plus(from, axis, -dot(from, axis))) - radius);
}

/** The circle with the least squares of its equation; null where there is none. */
function circle(points: [number, number][]): { x: number; y: number; radius: number } | null {
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

/** The cylinder about an axis of a direction. */
function about(axis: Point, points: Point[]): Cylinder | null {
  if (points.length < 6) return null;
  const [u, v] = across(axis);
  const found = circle(points.map((p) => [dot(p, u), dot(p, v)]));
  return found && { axis, place: plus(plus([0, 0, 0], u, found.x), v, found.y), radius: found.radius };
}

/** The cylinder moved and turned by what makes the sum of squares of the corners' distances least, to first order. */
function moved(from: Cylinder, points: Point[]): Cylinder {
  const [u, v] = across(from.axis);
  const middle = points.reduce((sum, p) => sum + dot(minus(p, from.place), from.axis), 0) / points.length;
  const place = plus(from.place, from.axis, middle);
  const matrix = Array.from({ length: 5 }, () => new Array<number>(6).fill(0));
  for (const p of points) {
    const way = minus(p, place);
    const s = dot(way, from.axis);
    const radial = plus(way, from.axis, -s);
    const far = Math.hypot(...radial) || 1;
    const [eu, ev] = [dot(radial, u) / far, dot(radial, v) / far];
    // What the distance changes by: shift along u and v, tilt towards them, radius.
    const row = [eu, ev, s * eu, s * ev, 1];
    for (let i = 0; i < 5; i++) {
      for (let j = 0; j < 5; j++) matrix[i][j] += row[i] * row[j];
      matrix[i][5] += row[i] * (far - from.radius);
    }
  }
  const by = solved(matrix);
  if (!by) return from;
  return { axis: unit(plus(plus(from.axis, u, by[2]), v, by[3])), place: plus(plus(place, u, by[0]), v, by[1]), radius: from.radius + by[4] };
}

/** The direction to which the normals of triangles are most nearly square; null where they are not bent about one. */
function axisOf(data: PartData, triangles: number[]): Point | null {
  const spread = [0, 1, 2].map(() => [0, 0, 0]);
  let all = 0;
  for (const t of triangles) {
    const own = normalOf(data, t);
    if (!own) continue;
    all += own.area;
    for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) spread[i][j] += own.area * own.normal[i] * own.normal[j];
  }
  const { values, vectors } = eigen(spread);
  if (!(values[1] > BENT * all) || !(values[1] > CLEAR * Math.max(0, values[0]))) return null;
  return vectors[0];
}

/** The triangles of a wall about an axis that hang together with one. */
function wall(data: PartData, seed: number, axis: Point, share: number): number[] {
  return flood(data, seed, (from, to) => Math.abs(dot(to, axis)) < share && dot(from, to) > SMOOTH);
}

/** The axis of the bent face at a triangle. */
function directionAt(data: PartData, seed: number): Point | null {
  let axis: Point | null = null;
  for (let most = PATCH, before = 0; !axis; most *= MORE) {
    const patch = flood(data, seed, (from, to) => dot(from, to) > SMOOTH, most);
    if (patch.length === before) return null;
    before = patch.length;
    axis = axisOf(data, patch);
    if (patch.length < most) break;
  }
  for (const share of LOOSE) axis = axis && axisOf(data, wall(data, seed, axis, share));
  return axis;
}

/** Fits a cylinder to corners, those at rims that are shared with other faces left out; `free`: its axis may turn. */
function fitted(first: Cylinder, points: Point[], within: number, free: boolean): Cylinder | null {
  let now: Cylinder | null = first;
  let kept = points;
  for (let round = 0; round < (free ? 6 : 3) && now; round++) {
    const known: Cylinder = now;
    const sorted = kept.map((p) => offOf(known, p)).sort((a, b) => a - b);
    const limit = Math.max(within, 3 * sorted[sorted.length >> 1]);
    kept = kept.filter((p) => offOf(known, p) <= limit);
    now = kept.length < 6 ? null : free ? moved(known, kept) : about(known.axis, kept);
  }
  return now;
}

/** The wall of a direction at a triangle; null where the corners are not those of a cylinder. */
function wallAt(data: PartData, seed: number, direction: Point, step: number, mayTurn: boolean): RoundFace | null {
  const within = Math.max(0.02, 0.1 * step);
  const smooth = wall(data, seed, direction, mayTurn ? LOOSE[1] : UPRIGHT);
  const points = corners(data, smooth);
  const first = about(direction, points);
  if (!first) return null;
  const places = points.map((p) => dot(p, direction));
  const height = places.reduce((m, s) => Math.max(m, s), -Infinity) - places.reduce((m, s) => Math.min(m, s), Infinity);
  const found = fitted(first, points, within, mayTurn && height > TALL * first.radius);
  if (!found) return null;
  const own = smooth.filter((t) => cornersOf(data, t).every((p) => offOf(found, p) <= within));
  if (!own.includes(seed) || own.length < 0.8 * smooth.length) return null;
  const all = corners(data, own);
  const [u, v] = across(found.axis);
  const parts = new Set<number>();
  for (const p of all) {
    const from = minus(p, found.place);
    parts.add(Math.floor(((Math.atan2(dot(from, v), dot(from, u)) + Math.PI) / (2 * Math.PI)) * PARTS) % PARTS);
  }
  if (parts.size < LEAST_PARTS || bulges(data, own, found)) return null;
  return described(data, seed, found, all);
}

/** Whether the normals turn along the axis, as those of a ball do. */
function bulges(data: PartData, triangles: number[], { axis, radius }: Cylinder): boolean {
  const all = triangles.flatMap((t) => {
    const own = normalOf(data, t);
    return own ? [{ at: dot(cornersOf(data, t)[0], axis), share: dot(own.normal, axis), area: own.area }] : [];
  });
  const area = all.reduce((sum, { area: a }) => sum + a, 0);
  const mean = (of: (one: (typeof all)[number]) => number) => all.reduce((sum, one) => sum + one.area * of(one), 0) / area;
  const [at, share] = [mean((one) => one.at), mean((one) => one.share)];
  const spread = mean((one) => (one.at - at) ** 2);
  const slope = mean((one) => (one.at - at) * (one.share - share)) / (spread || 1);
  return Math.abs(slope) * radius > BULGE;
}

function described(data: PartData, seed: number, found: Cylinder, all: Point[]): RoundFace {
  const largest = found.axis.reduce((most, n, k) => (Math.abs(n) > Math.abs(found.axis[most]) + 1e-9 ? k : most), 0);
  const axis = found.axis[largest] < 0 ? (found.axis.map((n) => -n) as Point) : found.axis;
  const centre = plus(found.place, axis, -dot(found.place, axis));
  const [a] = cornersOf(data, seed);
  const from = minus(a, centre);
  const outward = dot(normalOf(data, seed)?.normal ?? [0, 0, 0], plus(from, axis, -dot(from, axis)));
  const places = all.map((p) => dot(p, axis));
  return {
    kind: "round",
    axis,
    centre,
    radius: found.radius,
    bottom: places.reduce((m, s) => Math.min(m, s), Infinity),
    top: places.reduce((m, s) => Math.max(m, s), -Infinity),
    hollow: outward < 0,
    off: all.reduce((m, p) => Math.max(m, offOf(found, p)), 0),
  };
}

/** The round wall at a triangle of a part that was simulated with lines at a distance of `step` [mm]; null where there is none. */
export function roundAt(data: PartData, seed: number, step: number): RoundFace | null {
  const first = normalOf(data, seed);
  if (!first) return null;
  const upright = COORDINATES[2];
  const along = Math.abs(first.normal[2]) < UPRIGHT ? wallAt(data, seed, upright, step, false) : null;
  if (along) return along;
  const direction = directionAt(data, seed);
  if (!direction) return null;
  const free = wallAt(data, seed, direction, step, true);
  const near = COORDINATES.find((c) => Math.abs(dot(c, free?.axis ?? direction)) > NEAR);
  return (near && wallAt(data, seed, near, step, false)) ?? free;
}
