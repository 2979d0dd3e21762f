// The plane of a picture: equal scale in x and y.
import type { Point } from "./model";

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

export class Plane {
  readonly scale: number;
  private readonly ox: number;
  private readonly oy: number;

  /** Fits a rectangle of the drawing (mm) into a box of the picture (px), in its middle. */
  constructor(
    readonly min: Point,
    readonly max: Point,
    readonly box: Box,
  ) {
    this.scale = Math.min(box.width / (max[0] - min[0]), box.height / (max[1] - min[1]));
    this.ox = box.left + box.width / 2 - (this.scale * (min[0] + max[0])) / 2;
    this.oy = box.top + box.height / 2 + (this.scale * (min[1] + max[1])) / 2;
  }

  x(x: number): number {
    return this.ox + this.scale * x;
  }

  y(y: number): number {
    return this.oy - this.scale * y;
  }

  at([x, y]: Point): Point {
    return [this.x(x), this.y(y)];
  }

  back([px, py]: Point): Point {
    return [(px - this.ox) / this.scale, (this.oy - py) / this.scale];
  }

  /** A curve as a path of straight pieces. */
  curve(f: (u: number) => Point, from: number, to: number, pieces: number): string {
    return this.line(Array.from({ length: pieces + 1 }, (_, i) => f(from + ((to - from) * i) / pieces)));
  }

  line(points: Point[], closed = false): string {
    const text = points.map((p, i) => `${i === 0 ? "M" : "L"}${this.x(p[0]).toFixed(2)} ${this.y(p[1]).toFixed(2)}`).join("");
    return closed ? `${text}Z` : text;
  }
}

export function polar(r: number, angle: number): Point {
  return [r * Math.cos(angle), r * Math.sin(angle)];
}

export function add(a: Point, b: Point, k = 1): Point {
  return [a[0] + k * b[0], a[1] + k * b[1]];
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/** The angle in [0, 2π). */
export function turned(angle: number): number {
  const whole = 2 * Math.PI;
  return ((angle % whole) + whole) % whole;
}

/** A round length that fits into some pixels. */
export function round(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return ([5, 2, 1].find((n) => n * power <= length) ?? 1) * power;
}

/** Round ticks between two bounds. */
export function ticks(from: number, to: number, about: number): number[] {
  const raw = (to - from) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find((n) => n * power >= raw) ?? 10) * power;
  const first = Math.ceil(from / step - 1e-9);
  return Array.from({ length: Math.floor(to / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
}
