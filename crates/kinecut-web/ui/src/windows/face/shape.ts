// The outline as it is drawn: turned, shifted, in parts of its edges. It says where things lie, never how teeth meet them.
import type { Edge, Outline } from "./answer";

export type Point = [number, number];

const RAD = Math.PI / 180;

export function turned([x, y]: Point, turn: number): Point {
  const [c, s] = [Math.cos(turn * RAD), Math.sin(turn * RAD)];
  return [c * x - s * y, s * x + c * y];
}

/** From 0 up to 360. */
export function round360(turn: number): number {
  return ((turn % 360) + 360) % 360;
}

/** The point of an edge at a share of its length. */
export function pointOn(edge: Edge, share: number): Point {
  const { start, end, centre, sweep } = edge;
  if (!centre || sweep === undefined) return [start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])];
  const [x, y] = turned([start[0] - centre[0], start[1] - centre[1]], sweep * share);
  return [centre[0] + x, centre[1] + y];
}

/** Least and greatest ordinate of the part turned by an angle. */
export function extent(outline: Outline, turn: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  const take = (p: Point) => {
    const y = turned(p, turn)[1];
    if (y < low) low = y;
    if (y > high) high = y;
  };
  for (const edge of outline.edges) {
    take(edge.start);
    take(edge.end);
    const { centre, radius, sweep, start } = edge;
    if (!centre || radius === undefined || sweep === undefined) continue;
    // The highest and the lowest point of the circle, where they are on the arc.
    const first = Math.atan2(start[1] - centre[1], start[0] - centre[0]) / RAD;
    for (const top of [90, 270]) {
      const at = top - turn;
      const gone = sweep > 0 ? round360(at - first) : round360(first - at);
      if (gone <= Math.abs(sweep)) take([centre[0] + radius * Math.cos(at * RAD), centre[1] + radius * Math.sin(at * RAD)]);
    }
  }
  return [low, high];
}

/** The middle of the part's width when it is turned: from there the window counts the offset. */
export function middle(outline: Outline, turn: number): number {
  const [low, high] = extent(outline, turn);
  return (low + high) / 2;
}

/** Length by which the part reaches beyond a reach to both sides of the centre line [mm]; below 0 it lies within. */
export function short(outline: Outline, turn: number, offset: number, reach: number): number {
  const [low, high] = extent(outline, turn);
  return Math.max(high - reach - offset, offset - low - reach);
}

/** Centre of the box of the part as drawn, and the radius of a circle about it that holds the part. */
export function round(outline: Outline): { centre: Point; radius: number } {
  const centre: Point = [(outline.min[0] + outline.max[0]) / 2, (outline.min[1] + outline.max[1]) / 2];
  let radius = 1e-6;
  for (const edge of outline.edges) {
    for (let i = 0; i <= 8; i++) {
      const p = pointOn(edge, i / 8);
      radius = Math.max(radius, Math.hypot(p[0] - centre[0], p[1] - centre[1]));
    }
  }
  return { centre, radius };
}

/** From the part to the screen. */
export type Frame = (p: Point) => Point;

const px = (n: number) => n.toFixed(2);

/** A part of an edge as a path of SVG; it begins with a move unless it goes on. */
export function strokeOf(edge: Edge, from: number, to: number, frame: Frame, scale: number, goesOn = false): string {
  const [a, b] = [frame(pointOn(edge, from)), frame(pointOn(edge, to))];
  const begin = goesOn ? "" : `M${px(a[0])} ${px(a[1])}`;
  const { radius, sweep } = edge;
  if (radius === undefined || sweep === undefined) return `${begin}L${px(b[0])} ${px(b[1])}`;
  const r = px(radius * scale);
  // Y of the screen goes down. In halves, so that a whole circle has no ends that fall together.
  const way = sweep > 0 ? 0 : 1;
  const m = frame(pointOn(edge, (from + to) / 2));
  return `${begin}A${r} ${r} 0 0 ${way} ${px(m[0])} ${px(m[1])}A${r} ${r} 0 0 ${way} ${px(b[0])} ${px(b[1])}`;
}

/** All loops as one path that can be filled. */
export function faceOf(outline: Outline, frame: Frame, scale: number): string {
  let path = "";
  for (const { first, count } of outline.loops) {
    for (let i = first; i < first + count; i++) path += strokeOf(outline.edges[i], 0, 1, frame, scale, i > first);
    path += "Z";
  }
  return path;
}
