// The cover of a gear pump, and the crossings of its outline with a tooth's path. Its numbers are those that `kinecut face --json` prints of
// examples/04_gear_pump_cover/face.toml: test/teaching.py compares cover.json with the program.
import type { Point } from "../model";
import cover from "./cover.json";

export interface Edge {
  start: Point;
  end: Point;
  centre?: Point;
  /** Of an arc [rad]; against the clock positive. */
  sweep?: number;
}

/** The cover as it is drawn in DXF, material on the right. */
export const COVER: Edge[] = cover.outline.edges.map((edge) => ({
  start: edge.start as Point,
  end: edge.end as Point,
  ...(edge.centre && edge.sweep !== undefined ? { centre: edge.centre as Point, sweep: (edge.sweep * Math.PI) / 180 } : {}),
}));

/** First edge of each closed line and the number of its edges. */
export const LOOPS = cover.outline.loops;

/** Radius of the cutter, its feed in a turn, and how far it has to reach beyond the part [mm]. */
export const CUTTER = cover.cutter.radius;
export const FEED = cover.cutter.feed_per_revolution;
export const MARGIN = cover.margin;

/** The least burr length at a threshold of 90°, its placement, and the bound below which no placement is. */
export const LEAST = cover.optimum;

export function turnedPoint([x, y]: Point, angle: number): Point {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * x - s * y, s * x + c * y];
}

export function turnedEdge(edge: Edge, angle: number): Edge {
  return { ...edge, start: turnedPoint(edge.start, angle), end: turnedPoint(edge.end, angle), centre: edge.centre && turnedPoint(edge.centre, angle) };
}

/** Points along an edge. */
export function along(edge: Edge, share: number): Point {
  if (!edge.centre || edge.sweep === undefined) return [edge.start[0] + share * (edge.end[0] - edge.start[0]), edge.start[1] + share * (edge.end[1] - edge.start[1])];
  const [x, y] = turnedPoint([edge.start[0] - edge.centre[0], edge.start[1] - edge.centre[1]], share * edge.sweep);
  return [edge.centre[0] + x, edge.centre[1] + y];
}

/** Direction of an edge at a place on it. */
export function direction(edge: Edge, at: Point): Point {
  const d: Point = edge.centre ? [-(at[1] - edge.centre[1]) * Math.sign(edge.sweep ?? 1), (at[0] - edge.centre[0]) * Math.sign(edge.sweep ?? 1)] : [edge.end[0] - edge.start[0], edge.end[1] - edge.start[1]];
  const length = Math.hypot(...d);
  return [d[0] / length, d[1] / length];
}

/** Whether a place on the line or circle of an edge is of the edge. */
function within(edge: Edge, at: Point): boolean {
  if (!edge.centre || edge.sweep === undefined) {
    const [dx, dy] = [edge.end[0] - edge.start[0], edge.end[1] - edge.start[1]];
    const share = ((at[0] - edge.start[0]) * dx + (at[1] - edge.start[1]) * dy) / (dx * dx + dy * dy);
    return share >= 0 && share < 1;
  }
  const from = Math.atan2(edge.start[1] - edge.centre[1], edge.start[0] - edge.centre[0]);
  const angle = Math.atan2(at[1] - edge.centre[1], at[0] - edge.centre[0]);
  const gone = Math.sign(edge.sweep) * (angle - from);
  return gone - 2 * Math.PI * Math.floor(gone / (2 * Math.PI)) < Math.abs(edge.sweep);
}

/** Roots of a smooth function; between two samples of one sign its nearest approach to zero is looked at too. */
export function roots(f: (t: number) => number, from: number, to: number, samples: number): number[] {
  const found: number[] = [];
  const bisect = (a: number, b: number): number => {
    const sign = Math.sign(f(a));
    for (let i = 0; i < 60; i++) {
      const middle = (a + b) / 2;
      if (Math.sign(f(middle)) === sign) a = middle;
      else b = middle;
    }
    return (a + b) / 2;
  };
  const step = (to - from) / samples;
  const values = Array.from({ length: samples + 1 }, (_, i) => f(from + i * step));
  for (let i = 0; i < samples; i++) {
    const [a, b] = [from + i * step, from + (i + 1) * step];
    if (values[i] < 0 !== values[i + 1] < 0) found.push(bisect(a, b));
    else if (i > 0 && values[i - 1] < 0 === values[i] < 0 && Math.abs(values[i]) <= Math.abs(values[i - 1]) && Math.abs(values[i]) <= Math.abs(values[i + 1])) {
      let [low, high] = [a - step, b];
      for (let k = 0; k < 60; k++) {
        const [p, q] = [low + (high - low) / 3, high - (high - low) / 3];
        if (Math.abs(f(p)) < Math.abs(f(q))) high = q;
        else low = p;
      }
      const nearest = (low + high) / 2;
      if (f(nearest) < 0 !== values[i] < 0) found.push(bisect(a - step, nearest), bisect(nearest, b));
    }
  }
  return [...new Set(found)].sort((a, b) => a - b);
}

export interface Crossing {
  edge: number;
  t: number;
  at: Point;
  /** Directions of the edge and of the tooth. */
  e: Point;
  v: Point;
  /** Angle from the edge to the tooth's way [rad]; positive where the tooth leaves. */
  psi: number;
  front: boolean;
}

/** All crossings of one turn of a tooth with the part; the path is x = r t − R sin t, y = c − R cos t. */
export function crossings(edges: Edge[], r: number, R: number, c: number, turn: number): Crossing[] {
  const place = (t: number): Point => [r * t - R * Math.sin(t), c - R * Math.cos(t)];
  const all: Crossing[] = [];
  edges.forEach((edge, i) => {
    const { start, end, centre } = edge;
    const side = centre
      ? (t: number) => Math.hypot(place(t)[0] - centre[0], place(t)[1] - centre[1]) - Math.hypot(start[0] - centre[0], start[1] - centre[1])
      : (t: number) => (end[0] - start[0]) * (place(t)[1] - start[1]) - (end[1] - start[1]) * (place(t)[0] - start[0]);
    for (const t of roots(side, 2 * Math.PI * turn, 2 * Math.PI * (turn + 1), 720)) {
      const at = place(t);
      if (!within(edge, at)) continue;
      const e = direction(edge, at);
      const w: Point = [r - R * Math.cos(t), R * Math.sin(t)];
      const length = Math.hypot(...w);
      const v: Point = [w[0] / length, w[1] / length];
      all.push({ edge: i, t, at, e, v, psi: Math.atan2(e[0] * v[1] - e[1] * v[0], e[0] * v[0] + e[1] * v[1]), front: Math.sin(t) < 0 });
    }
  });
  return all.sort((a, b) => a.t - b.t);
}
