// Inputs that several figures of this paper have.
import type { Field } from "../model";

export const RADIUS: Field = { key: "R", symbol: "s.R", name: "q.R", unit: "u.mm", min: 1, max: 500, step: 1, digits: 3 };
export const TURNS: Field = { key: "n", symbol: "s.n", name: "q.n", min: 1, max: 40, step: 1, digits: 0 };
export const X0: Field = { key: "x0", symbol: "s.x0", name: "q.x0", unit: "u.mm", min: -500, max: 500, step: 1, digits: 2 };
export const Y0: Field = { key: "y0", symbol: "s.y0", name: "q.y0", unit: "u.mm", min: -500, max: 500, step: 1, digits: 2 };

/** Most pieces of a drawn spiral. */
export function pieces(turns: number): number {
  return Math.min(6000, Math.max(64, Math.ceil(turns * 72)));
}
