// Edge lengths by the angle at which teeth meet them, for a feed that is small against the cutter: each place of the outline is met by the
// front arc where its distance from the centre line says, and the angle is that of the arc less that of the outward normal.
import type { Point, Values } from "../model";
import { COVER, CUTTER, type Edge, MARGIN, along, direction, turnedEdge } from "./part";

const BINS = 18;

export interface Lengths {
  bad: number;
  exits: number;
  entries: number;
  /** Lengths of the exits by ten degrees. */
  bins: number[];
  /** Farthest place from the centre line. */
  reach: number;
  largest: number;
}

/** The exit angle at a place of an edge [°], in [-180, 180); negative where teeth enter. */
export function angleAt(edge: Edge, at: Point, c: number): number {
  const eta = Math.max(-1, Math.min(1, (at[1] - c) / CUTTER));
  const e = direction(edge, at);
  const [vx, vy] = [eta, -Math.sqrt(1 - eta * eta)];
  return (Math.atan2(e[0] * vy - e[1] * vx, e[0] * vx + e[1] * vy) * 180) / Math.PI;
}

function length(edge: Edge): number {
  const [dx, dy] = [edge.end[0] - edge.start[0], edge.end[1] - edge.start[1]];
  return edge.centre && edge.sweep !== undefined ? Math.abs(edge.sweep) * Math.hypot(edge.start[0] - edge.centre[0], edge.start[1] - edge.centre[1]) : Math.hypot(dx, dy);
}

/** Sums over the outline; between two samples the angle is taken to grow evenly. */
export function lengths(gamma: number, c: number, psi0: number, samples: number): Lengths {
  const all: Lengths = { bad: 0, exits: 0, entries: 0, bins: Array<number>(BINS).fill(0), reach: 0, largest: 0 };
  for (const raw of COVER) {
    const edge = turnedEdge(raw, (gamma * Math.PI) / 180);
    const pieces = edge.centre ? samples : samples / 2;
    const piece = length(edge) / pieces;
    let before = NaN;
    for (let i = 0; i <= pieces; i++) {
      const at = along(edge, i / pieces);
      all.reach = Math.max(all.reach, Math.abs(at[1] - c));
      if (Math.abs(at[1] - c) > CUTTER) {
        // No tooth comes there.
        before = NaN;
        continue;
      }
      let now = angleAt(edge, at, c);
      if (!Number.isNaN(before)) {
        // Angles of neighbours are near each other round the circle.
        if (now - before > 180) now -= 360;
        if (now - before < -180) now += 360;
        const [low, high] = now < before ? [now, before] : [before, now];
        const part = (from: number, to: number): number => {
          if (high - low < 1e-12) return low > from && low < to ? piece : 0;
          return (piece * Math.max(0, Math.min(high, to) - Math.max(low, from))) / (high - low);
        };
        for (const turn of low < -180 || high > 180 ? [-360, 0, 360] : [0]) {
          all.bad += part(turn, turn + psi0);
          all.exits += part(turn, turn + 180);
          all.entries += part(turn - 180, turn);
          const first = Math.max(0, Math.floor((low - turn) / 10));
          for (let b = first; b < BINS && turn + 10 * b < high; b++) all.bins[b] += part(turn + 10 * b, turn + 10 * (b + 1));
        }
        if (high > 0) all.largest = Math.max(all.largest, Math.min(180, high));
      }
      before = now > 180 ? now - 360 : now < -180 ? now + 360 : now;
    }
  }
  return all;
}

/** Whether the cutter, with its margin, does not reach the whole part. */
export function isWide(reach: number): boolean {
  return reach > CUTTER - MARGIN + 1e-9;
}

const surveys = new Map<string, { gamma: number; bad: number; largest: number; wide: boolean }[]>();

/** Each degree of turn, at one offset. */
export function survey({ c, psi0 }: Values) {
  const key = `${c} ${psi0}`;
  let found = surveys.get(key);
  if (!found) {
    found = Array.from({ length: 361 }, (_, gamma) => {
      const { bad, largest, reach } = lengths(gamma, c, psi0, 72);
      return { gamma, bad, largest, wide: isWide(reach) };
    });
    if (surveys.size > 20) surveys.clear();
    surveys.set(key, found);
  }
  return found;
}
