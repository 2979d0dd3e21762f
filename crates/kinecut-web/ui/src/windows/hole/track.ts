// Places along a pass: where the cutter is on a way, and what the samples say there.
import type { Run, Samples } from "./answer";

/** Index of the last of rising numbers that is not above a value. */
export function before(all: number[], value: number): number {
  let [low, high] = [0, all.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (all[middle] <= value) low = middle;
    else high = middle - 1;
  }
  return low;
}

function between(all: number[], value: number): { index: number; share: number } {
  const index = Math.min(before(all, value), Math.max(0, all.length - 2));
  const [a, b] = [all[index], all[index + 1] ?? all[index]];
  return { index, share: b > a ? Math.min(1, Math.max(0, (value - a) / (b - a))) : 0 };
}

function mix(all: (number | null)[], { index, share }: { index: number; share: number }): number | null {
  const [a, b] = [all[index], all[index + 1] ?? all[index]];
  if (a === null || a === undefined || b === null || b === undefined) return share < 0.5 ? (a ?? null) : (b ?? null);
  return a + (b - a) * share;
}

/** A column at a place of another, in proportion between two samples. */
export function mixed(along: number[], column: (number | null)[], value: number): number | null {
  return mix(column, between(along, value));
}

export interface Spot {
  x: number;
  y: number;
  /** Direction of the way [rad]. */
  heading: number;
}

/** The cutter's centre on a way [mm]. */
export function spotAt({ way }: Run, s: number): Spot {
  const at = between(way.s, s);
  const [i, j] = [at.index, Math.min(at.index + 1, way.s.length - 1)];
  let [a, b] = [i, j];
  while (b < way.s.length - 1 && Math.hypot(way.x[b] - way.x[a], way.y[b] - way.y[a]) < 1e-6) b++;
  while (a > 0 && Math.hypot(way.x[b] - way.x[a], way.y[b] - way.y[a]) < 1e-6) a--;
  const heading = Math.atan2(way.y[b] - way.y[a], way.x[b] - way.x[a]);
  return { x: mix(way.x, at) ?? 0, y: mix(way.y, at) ?? 0, heading };
}

export type Reading = { [K in keyof Samples]: number | null };

/** The samples at a place of the way, in proportion between two of them. */
export function readingAt({ samples }: Run, s: number): Reading {
  const at = between(samples.s, s);
  return Object.fromEntries(Object.entries(samples).map(([key, column]) => [key, mix(column as (number | null)[], at)])) as Reading;
}

/** The way at a time of the run, and back. */
export function wayAt({ samples }: Run, time: number): number {
  return mix(samples.s, between(samples.time, time)) ?? 0;
}

export function timeAt({ samples }: Run, s: number): number {
  return mix(samples.time, between(samples.s, s)) ?? 0;
}

/** The place of the way that is nearest to a point, and how far it is [mm]. */
export function nearest({ way }: Run, x: number, y: number): { s: number; off: number } {
  let [best, off] = [0, Infinity];
  for (let i = 0; i + 1 < way.s.length; i++) {
    const [dx, dy] = [way.x[i + 1] - way.x[i], way.y[i + 1] - way.y[i]];
    const square = dx * dx + dy * dy;
    const share = square > 0 ? Math.min(1, Math.max(0, ((x - way.x[i]) * dx + (y - way.y[i]) * dy) / square)) : 0;
    const far = Math.hypot(way.x[i] + share * dx - x, way.y[i] + share * dy - y);
    if (far < off) [best, off] = [way.s[i] + share * (way.s[i + 1] - way.s[i]), far];
  }
  return { s: best, off };
}
