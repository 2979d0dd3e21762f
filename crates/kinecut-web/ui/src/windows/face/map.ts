// The bad length over all placements, from the verb's numbers to cells of a few colours.
import type { MapAnswer } from "./answer";

export interface Cell {
  /** Ends in turn [deg] and beside the middle [mm]. */
  turn: [number, number];
  beside: [number, number];
}

export interface Map {
  /** Cells by the steps of the scale, from the least. */
  steps: Cell[][];
  /** The offsets reach so far to both sides [mm]. */
  half: number;
  /** Round numbers at the scale [mm], and the place of each on it, from 0 to 1. */
  ticks: { value: number; share: number }[];
}

/** Steps of the scale: the colours of the page's palette. */
const STEPS = 16;
/** Room beside the farthest offset. */
const ROOM = 1.08;

/** The cells of a map; null where no placement is allowed. */
export function cellsOf({ beside, rows, turns, values }: MapAnswer): Map | null {
  let [least, most, far] = [Infinity, -Infinity, 1e-3];
  beside.forEach((range, i) => {
    if (!range) return;
    far = Math.max(far, Math.abs(range[0]), Math.abs(range[1]));
    for (const v of values[i] ?? []) {
      if (v === null) continue;
      least = Math.min(least, v);
      most = Math.max(most, v);
    }
  });
  if (!Number.isFinite(least)) return null;
  if (most <= least) most = least + 1;
  const stepOf = (v: number | null | undefined) => (v === null || v === undefined ? -1 : Math.min(STEPS - 1, Math.floor(((v - least) / (most - least)) * STEPS)));
  const steps: Cell[][] = Array.from({ length: STEPS }, () => []);
  const wide = 360 / turns.length;
  turns.forEach((turn, i) => {
    const [range, column] = [beside[i], values[i]];
    if (!range || !column) return;
    // A value belongs to the middle of its cell; the cells at both ends are halves.
    const at = (j: number) => range[0] + Math.min(1, Math.max(0, (j - 0.5) / Math.max(1, rows - 1))) * (range[1] - range[0]);
    for (let j = 0; j < rows; ) {
      const [first, step] = [j, stepOf(column[j])];
      while (j < rows && stepOf(column[j]) === step) j++;
      if (step < 0) continue;
      steps[step].push({ turn: [turn - wide / 2, turn + wide / 2], beside: [at(first), at(j)] });
    }
  });
  return { steps, half: ROOM * far, ticks: round(least, most).map((value) => ({ value, share: (value - least) / (most - least) })) };
}

/** Some five round numbers of a range. */
function round(least: number, most: number): number[] {
  const raw = (most - least) / 5;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((n) => n * power).find((n) => n >= raw) ?? 10 * power;
  const first = Math.ceil(least / step - 1e-9);
  return Array.from({ length: Math.floor(most / step + 1e-9) - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}
