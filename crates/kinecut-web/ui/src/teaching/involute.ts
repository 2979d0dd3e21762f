// Curves of the paper on bores, in closed form. Lengths in mm, angles in rad, counter-clockwise positive; the centre of the bore is 0.
import type { Point } from "./model";

export const TURN = 2 * Math.PI;

/** The involute that begins in the centre (equation 2), turned by `psi` (equation 11). */
export function involute(r: number, psi = 0): (phi: number) => Point {
  return (phi) => {
    const t = phi + psi;
    return [r * (Math.cos(t) + phi * Math.sin(t) - Math.cos(psi)), r * (Math.sin(t) - phi * Math.cos(t) - Math.sin(psi))];
  };
}

/** φ − sin φ without cancellation near 0. */
function less(phi: number): number {
  if (Math.abs(phi) > 0.6) return phi - Math.sin(phi);
  let term = (phi * phi * phi) / 6;
  let sum = term;
  for (let k = 4; k < 24; k += 2) {
    term *= (-phi * phi) / (k * (k + 1));
    sum += term;
  }
  return sum;
}

/** Distance of a point of the involute from the centre, in base radii (equation 8). */
export function reach(phi: number): number {
  return Math.hypot(less(phi), 2 * Math.sin(phi / 2) ** 2);
}

/** The roll angle at a distance from the centre in base radii (equation 9): the only one in [0, turns]. */
export function rolled(distance: number, turns: number): number {
  let [low, high] = [0, TURN * turns];
  // The derivative vanishes at whole turns: halving reaches the last bit without it.
  for (let i = 0; i < 200 && high - low > 0; i++) {
    const middle = (low + high) / 2;
    if (middle === low || middle === high) break;
    if (reach(middle) < distance) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** The roll angle of the thread that points from the base circle to a place, next to one that is known. */
export function unrolled(r: number, place: Point, near: number): number {
  const angle = Math.atan2(place[1], place[0] + r);
  const of = (phi: number) => phi - Math.atan(phi);
  const want = angle + TURN * Math.round((of(near) - angle) / TURN);
  if (want <= 0) return 0;
  let phi = Math.max(near, 0.5);
  for (let i = 0; i < 60; i++) phi = Math.max(1e-6, phi - (of(phi) - want) / ((phi * phi) / (1 + phi * phi)));
  return phi;
}

export interface Start {
  r: number;
  rho: number;
  phi0: number;
  /** The point of the unturned curve at the same distance from the centre. */
  tp: Point;
  psi: number;
  /** The angle that the printed equation 10 gives: by its cosine alone. */
  psiPrinted: number;
  tangent: number;
  touch: Point;
  length: number;
  rn: number;
  visible: number;
  visiblePrinted: number;
}

/** The involute through a start, onto the circle of radius R (equations 5 and 7 to 13). */
export function through([x, y]: Point, R: number, n: number): Start {
  const r = R / (TURN * n);
  const rho = Math.hypot(x, y);
  const phi0 = rolled(rho / r, n);
  const tp = involute(r)(phi0);
  const psi = rho === 0 ? 0 : Math.atan2(tp[0] * y - tp[1] * x, tp[0] * x + tp[1] * y);
  const psiPrinted = rho === 0 ? NaN : Math.acos(Math.max(-1, Math.min(1, (x * tp[0] + y * tp[1]) / (rho * rho))));
  return {
    r,
    rho,
    phi0,
    tp,
    psi,
    psiPrinted,
    tangent: phi0 + psi,
    touch: [R * Math.sin(psi), -R * Math.cos(psi)],
    length: (r / 2) * ((TURN * n) ** 2 - phi0 * phi0),
    rn: r * phi0,
    visible: n - phi0 / TURN,
    visiblePrinted: (1 - rho / R) * n,
  };
}

/** Lens involutes of order j: the distance of the tangent from the centre, and the derivatives of it, in base radii. */
const LENS: ((t: number) => { q: number; dq: number; rho: number })[] = [
  (t) => ({ q: t - Math.sin(t), dq: 1 - Math.cos(t), rho: t }),
  (t) => ({ q: t - (4 / 3) * Math.sin(t) + Math.sin(2 * t) / 6, dq: (2 / 3) * (1 - Math.cos(t)) ** 2, rho: t - Math.sin(2 * t) / 2 }),
  (t) => ({
    q: t - (64 / 45) * Math.sin(t) + (2 / 9) * Math.sin(2 * t) - Math.sin(4 * t) / 180,
    dq: 1 - (64 / 45) * Math.cos(t) + (4 / 9) * Math.cos(2 * t) - Math.cos(4 * t) / 45,
    rho: t - (2 / 3) * Math.sin(2 * t) + Math.sin(4 * t) / 12,
  }),
];

/** A lens involute of order j by its tangent angle; order 0 is the involute of the circle. */
export function lens(order: number, r: number): (t: number) => Point {
  const of = LENS[order];
  return (t) => {
    const { q, dq } = of(t);
    return [r * (q * Math.sin(t) + dq * Math.cos(t)), r * (-q * Math.cos(t) + dq * Math.sin(t))];
  };
}

export function lensReach(order: number, t: number): number {
  const { q, dq } = LENS[order](t);
  return Math.hypot(q, dq);
}

/** The tangent angle at which a lens involute is so far from the centre (in base radii). */
export function lensAt(order: number, distance: number, turns: number): number {
  let [low, high] = [0, TURN * turns];
  for (let i = 0; i < 100; i++) {
    const middle = (low + high) / 2;
    if (lensReach(order, middle) < distance) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}

/** Length of a lens involute from 0 to a tangent angle, in base radii. */
export function lensLength(order: number, t: number): number {
  if (order === 0) return (t * t) / 2;
  if (order === 1) return (t * t - Math.sin(t) ** 2) / 2;
  return (t * t) / 2 - (1 - Math.cos(2 * t)) / 3 + (1 - Math.cos(4 * t)) / 48;
}

export function lensCurvatureRadius(order: number, t: number): number {
  return LENS[order](t).rho;
}

/**
 * The angle of the cutter's circumference that is in material [rad], on a path that began with a plunge at u = 0: of all earlier places,
 * the one that cleared the circumference nearest to the wall counts.
 */
export function engagement(path: (u: number) => Point, direction: (u: number) => number, u: number, cutter: number, back: number): number {
  const here = path(u);
  const out = direction(u) - Math.PI / 2;
  const covered = (w: number): number => {
    const [x, y] = path(w);
    const [dx, dy] = [here[0] - x, here[1] - y];
    const far = Math.hypot(dx, dy);
    if (far < 1e-12) return Math.PI;
    if (far >= 2 * cutter) return TURN;
    const half = Math.acos(-far / (2 * cutter));
    // Covered from this angle on, counted from the wall against the clock.
    return turnedTo(Math.atan2(dy, dx) - out + half);
  };
  const first = Math.max(0, u - back);
  const pieces = 160;
  let best = Math.PI;
  let at = u;
  for (let i = 0; i < pieces; i++) {
    const w = first + ((u - first) * i) / pieces;
    const angle = covered(w);
    if (angle < best) [best, at] = [angle, w];
  }
  const step = (u - first) / pieces;
  let [low, high] = [Math.max(first, at - step), Math.min(u, at + step)];
  for (let i = 0; i < 60; i++) {
    const [a, b] = [low + (high - low) / 3, high - (high - low) / 3];
    if (covered(a) < covered(b)) high = b;
    else low = a;
  }
  return Math.max(0, Math.min(best, covered((low + high) / 2)));
}

/** In (-ε, 2π): a little behind the wall is the wall. */
function turnedTo(angle: number): number {
  const whole = ((angle % TURN) + TURN) % TURN;
  return whole > TURN - 0.5 ? whole - TURN : whole;
}
