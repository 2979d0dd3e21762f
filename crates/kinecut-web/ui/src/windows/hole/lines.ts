// Lines of the plan as SVG paths, in mm.
import type { Point, Run } from "./answer";
import { before, spotAt } from "./track";

const n = (v: number) => v.toFixed(3);

export function lineOf(points: Point[]): string {
  return points.map(([x, y], i) => `${i ? "L" : "M"}${n(x)} ${n(y)}`).join("");
}

/** A stretch of a way. */
export function stretch(run: Run, from: number, to: number): string {
  if (!(to > from)) return "";
  const { way } = run;
  const points: Point[] = [from, to].map((s) => {
    const { x, y } = spotAt(run, s);
    return [x, y];
  });
  const inner: Point[] = [];
  for (let i = before(way.s, from) + 1; i < way.s.length && way.s[i] < to; i++) inner.push([way.x[i], way.y[i]]);
  return lineOf([points[0], ...inner, points[1]]);
}

/** A sector about a point, between two directions [rad]. */
export function sector([x, y]: Point, radius: number, from: number, sweep: number): string {
  if (sweep === 0) return "";
  const at = (angle: number) => `${n(x + radius * Math.cos(angle))} ${n(y + radius * Math.sin(angle))}`;
  const large = Math.abs(sweep) > Math.PI ? 1 : 0;
  return `M${n(x)} ${n(y)}L${at(from)}A${n(radius)} ${n(radius)} 0 ${large} ${sweep > 0 ? 1 : 0} ${at(from + sweep)}Z`;
}

export function ring(radius: number): string {
  return `M${n(radius)} 0A${n(radius)} ${n(radius)} 0 1 1 ${n(-radius)} 0A${n(radius)} ${n(radius)} 0 1 1 ${n(radius)} 0Z`;
}
