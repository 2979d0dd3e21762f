// The paper's method step by step: Nelder and Mead's simplex in turn and offset, as the library has it. It walks here so that one can look on; every value it
// compares is an answer of the verb, and where it begins at the part as drawn its end is held against the verb's own run.
import type { FaceAnswer } from "./answer";
import { short } from "./shape";

/** A corner of the triangle: turn [rad], absolute offset [mm], bad length with the guard [mm]. */
export interface Corner {
  x: [number, number];
  value: number;
}

export type Triangle = [Corner, Corner, Corner];

/** First steps [rad, radii of the cutter], the ends of the walk [rad and mm, mm], and its most steps: those of the library. */
const STEP = [Math.PI / 18, 0.1];
const NEAR = 1e-7;
const SAME = 1e-9;
const MOST = 400;
/** Rounding of a point at the bound [mm]. */
const ROUNDING = 1e-9;

const RAD = Math.PI / 180;

export interface Walker {
  /** The verb's value at a turn [deg] and an offset [mm]; null: the walk is no longer wanted. */
  ask: (turn: number, offset: number) => Promise<number | null>;
  /** Told of each triangle. */
  step: (triangle: Triangle, evaluations: number) => void;
}

/** Walks from a placement until the triangle is a point; null when it was stopped. */
export async function walk(answer: FaceAnswer, start: { turn: number; offset: number }, { ask, step }: Walker): Promise<{ best: Corner; evaluations: number } | null> {
  const { outline, cutter, margin } = answer;
  const weights = answer.bad_exit_angles.map((b) => b.weight);
  const worst = outline.edges.reduce((sum, e) => sum + e.length * e.weight, 0) * Math.max(0, ...weights) + 1;
  const reach = cutter.radius - margin;
  let evaluations = 0;
  const stopped = Symbol();
  const at = async (x: [number, number]): Promise<Corner> => {
    evaluations++;
    const beyond = short(outline, x[0] / RAD, x[1], reach);
    // Points that do not cover the part are worse than any that do, the more the farther.
    if (beyond > ROUNDING) return { x, value: worst + beyond };
    const value = await ask(x[0] / RAD, x[1]);
    if (value === null) throw stopped;
    return { x, value };
  };
  const sorted = (all: Corner[]) => [...all].sort((a, b) => a.value - b.value) as Triangle;
  try {
    const x: [number, number] = [start.turn * RAD, start.offset];
    let simplex = sorted([await at(x), await at([x[0] + STEP[0], x[1]]), await at([x[0], x[1] + STEP[1] * cutter.radius])]);
    for (let i = 0; i < MOST; i++) {
      step(simplex, evaluations);
      const [best, middle, last] = simplex;
      const far = [middle, last].some((v) => [0, 1].some((k) => Math.abs(v.x[k] - best.x[k]) > NEAR) || Math.abs(v.value - best.value) > SAME);
      if (!far) break;
      const centre = [0, 1].map((k) => 0.5 * (best.x[k] + middle.x[k]));
      const away = (share: number) => [0, 1].map((k) => centre[k] + share * (centre[k] - last.x[k])) as [number, number];
      const taken = await next(at, away, [best, middle, last]);
      if (taken) {
        simplex = sorted([best, middle, taken]);
      } else {
        const half = (v: Corner) => [0, 1].map((k) => best.x[k] + 0.5 * (v.x[k] - best.x[k])) as [number, number];
        simplex = sorted([best, await at(half(middle)), await at(half(last))]);
      }
    }
    return { best: simplex[0], evaluations };
  } catch (reason) {
    if (reason === stopped) return null;
    throw reason;
  }
}

/** The corner that replaces the worst: mirrored, stretched, or drawn in; null: the triangle shrinks. */
async function next(at: (x: [number, number]) => Promise<Corner>, away: (share: number) => [number, number], [best, middle, last]: Triangle): Promise<Corner | null> {
  const mirrored = await at(away(1));
  if (mirrored.value < best.value) {
    const stretched = await at(away(2));
    return stretched.value < mirrored.value ? stretched : mirrored;
  }
  if (mirrored.value < middle.value) return mirrored;
  if (mirrored.value < last.value) {
    const drawn = await at(away(0.5));
    return drawn.value <= mirrored.value ? drawn : null;
  }
  const drawn = await at(away(-0.5));
  return drawn.value < last.value ? drawn : null;
}
