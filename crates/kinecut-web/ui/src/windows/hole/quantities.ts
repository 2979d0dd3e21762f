// What the charts show: the columns of the samples in units of the shop, with the limits that the run keeps.
import type { Plan, Samples } from "./answer";
import { numberOf, table } from "./question";
import type { State } from "./state";

export interface Quantity {
  name: "speed" | "acceleration" | "jerk" | "engagement" | "curvature";
  unit: string;
  column: keyof Samples;
  /** That along the path alone. */
  along?: keyof Samples;
  /** From the unit of the samples. */
  factor: number;
  decimals: number;
}

export const QUANTITIES: Quantity[] = [
  { name: "speed", unit: "m/min", column: "speed", factor: 0.06, decimals: 3 },
  { name: "acceleration", unit: "m/s²", column: "acceleration", along: "along", factor: 1e-3, decimals: 4 },
  { name: "jerk", unit: "m/s³", column: "jerk", along: "jerk_along", factor: 1e-3, decimals: 4 },
  { name: "engagement", unit: "°", column: "engagement", factor: 180 / Math.PI, decimals: 2 },
  { name: "curvature", unit: "1/m", column: "curvature", factor: 1e3, decimals: 3 },
];

/** The limit of a quantity: of an axis, of the feed, of the engagement that is kept. */
export function limitOf(state: State, plan: Plan, name: Quantity["name"]): number | null {
  const { limits } = plan;
  const pass = state.pass.value;
  if (name === "acceleration") return limits?.acceleration ?? null;
  if (name === "jerk") return limits?.jerk ?? null;
  if (name === "engagement") return pass?.engagement_deg ?? null;
  if (name === "speed" && pass) {
    const feed = numberOf(table(table(state.doc.values.value.operation)[pass.pass]).feed);
    return feed === null ? null : feed / 1000;
  }
  return null;
}

/**
 * The range of a chart, by values evenly along its axis: without a spike that would make all else a flat line. `most` and `least` are the
 * largest and least of all samples.
 */
export function rangeOf(values: number[], most: number, least: number, limit: number | null): { low: number; high: number; above: boolean; below: boolean } {
  if (values.length === 0) return { low: 0, high: 1, above: false, below: false };
  const sizes = values.map(Math.abs).sort((a, b) => a - b);
  const usual = sizes[Math.min(sizes.length - 1, Math.floor(USUAL * sizes.length))];
  const bound = (end: number) => (usual > 0 && Math.abs(end) > SPIKE * usual ? Math.sign(end) * ROOM * usual : end);
  let high = Math.max(0, bound(most));
  let low = Math.min(0, bound(least));
  // A limit that is near is seen.
  if (limit !== null && limit > high && limit < 1.7 * high) high = 1.04 * limit;
  if (high === low) high = low + 1;
  const room = 0.06 * (high - low);
  [high, low] = [high + room, low < 0 ? low - room : low];
  return { low, high, above: most > high, below: least < low };
}

/** Share of the values that a chart has to show, and how much larger the largest may be. */
const [USUAL, SPIKE, ROOM] = [0.95, 4, 1.6];
