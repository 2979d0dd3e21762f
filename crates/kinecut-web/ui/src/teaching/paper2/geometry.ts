// Drill points and surfaces of the paper on drilling, in closed form: Z of the first contact and of the last. Tip at 0, Z up.
import type { Point, Values } from "../model";

const rad = (degrees: number) => (degrees * Math.PI) / 180;

/** Single angle, double angle, Zhirov's for cast iron. */
export const POINTS = ["twist", "double-ground", "cast-iron"] as const;

/** Profile of a point: radius and height of its corners, from the axis out. */
export function profile(v: Values): Point[] {
  const R = v.D / 2;
  const phi = rad(v.point / 2);
  const [first, second] = [rad((v.second ?? 70) / 2), rad((v.third ?? 55) / 2)];
  if (v.form === 1) {
    const b = 0.2 * v.D;
    const r1 = R - b * Math.sin(first);
    return [
      [0, 0],
      [r1, r1 / Math.tan(phi)],
      [R, r1 / Math.tan(phi) + b * Math.cos(first)],
    ];
  }
  if (v.form === 2) {
    const [b1, b2] = [0.2 * v.D, 0.15 * v.D];
    const r2 = R - b2 * Math.sin(second);
    const r1 = r2 - b1 * Math.sin(first);
    const z1 = r1 / Math.tan(phi);
    return [
      [0, 0],
      [r1, z1],
      [r2, z1 + b1 * Math.cos(first)],
      [R, z1 + b1 * Math.cos(first) + b2 * Math.cos(second)],
    ];
  }
  return [
    [0, 0],
    [R, R / Math.tan(phi)],
  ];
}

export function pointLength(v: Values): number {
  const all = profile(v);
  return all[all.length - 1][1];
}

/** A surface over the drill: a plane by its slope, the top (ridge) or the bottom (valley) of a cylinder; `x` is the offset of the axis. */
export type Surface = { kind: "plane"; slope: number; x: number } | { kind: "ridge" | "valley"; radius: number; x: number };

/** Height of the surface in the section through the drill's axis, `u` from that axis. */
export function height(s: Surface, u: number): number {
  if (s.kind === "plane") return (s.x + u) * s.slope;
  const F = Math.sqrt(Math.max(0, s.radius * s.radius - (s.x + u) ** 2));
  return s.kind === "ridge" ? F : -F;
}

/** Extremes of the surface on the circle of a radius about the drill's axis. */
function onCircle(s: Surface, r: number): { high: number; low: number } {
  if (s.kind === "plane") return { high: s.x * s.slope + r * Math.abs(s.slope), low: s.x * s.slope - r * Math.abs(s.slope) };
  const X = Math.abs(s.x);
  const F = (u: number) => Math.sqrt(Math.max(0, s.radius * s.radius - u * u));
  const [near, far] = [F(Math.max(0, X - r)), F(X + r)];
  return s.kind === "ridge" ? { high: near, low: far } : { high: -far, low: -near };
}

export interface Contact {
  first: number;
  last: number;
  /** Radius of the first contact. */
  radius: number;
}

/** First and last contact: extremes over the profile, at its corners and where its slope is that of the surface. */
export function contact(s: Surface, corners: Point[]): Contact {
  let [first, last, radius] = [-Infinity, Infinity, 0];
  for (let i = 1; i < corners.length; i++) {
    const [[ra, za], [rb, zb]] = [corners[i - 1], corners[i]];
    const k = (zb - za) / (rb - ra);
    const at = [ra, rb];
    if (s.kind !== "plane") {
      const X = Math.abs(s.x);
      const q = (s.radius * k) / Math.hypot(1, k);
      at.push(X, X - q, X + q, q - X, -q - X);
    }
    for (const r of at) {
      if (r < ra || r > rb) continue;
      const z = za + k * (r - ra);
      const { high, low } = onCircle(s, r);
      if (high - z > first + 1e-12) [first, radius] = [high - z, r];
      last = Math.min(last, low - z);
    }
  }
  return { first, last, radius };
}

/** The paper's coordinates of first and last contact, from its section alone. */
export function printed(s: Surface, corners: Point[]): Contact & { added: number } {
  const R = corners[corners.length - 1][0];
  const L1 = corners[corners.length - 1][1];
  const first = height(s, 0);
  const X = Math.abs(s.x);
  const F = (u: number) => Math.sqrt(Math.max(0, (s as { radius: number }).radius ** 2 - u * u));
  const added = s.kind === "plane" ? R * Math.abs(s.slope) : s.kind === "ridge" ? F(X) - F(R + X) : -(F(X) - F(R - X));
  return { first, last: first - added - L1, radius: 0, added };
}

/** Outline of the drill with its tip at a place, as a closed line; `top` is where it is cut off. */
export function outline(corners: Point[], x: number, tip: number, top: number): Point[] {
  const right = corners.map(([r, z]): Point => [x + r, tip + z]);
  const left = corners.map(([r, z]): Point => [x - r, tip + z]).reverse();
  const R = corners[corners.length - 1][0];
  return [...left.slice(0, -1), ...right, [x + R, top], [x - R, top]];
}
