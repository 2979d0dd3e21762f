// The answer of `kinecut face --json`, as far as the window shows it: mm, degrees, s.
import type { Finding } from "../../base/api";

export interface Placement {
  /** Ordinate of the line of the cutter's centre over the turned part. */
  offset: number;
  /** The part is turned by this, counter-clockwise about its zero. */
  turn: number;
}

export interface Edge {
  start: [number, number];
  end: [number, number];
  /** Of an arc alone. */
  centre?: [number, number];
  radius?: number;
  /** Positive: counter-clockwise. */
  sweep?: number;
  length: number;
  label: string | null;
  weight: number;
}

export interface Outline {
  edges: Edge[];
  loops: { count: number; first: number; outer: boolean }[];
  min: [number, number];
  max: [number, number];
  perimeter: number;
  notes: string[];
}

/** A part of an edge, from one share of its length to another, and how teeth meet it. */
export interface Stretch {
  edge: number;
  from: number;
  to: number;
  met: "exit" | "entry" | "lowered" | "never";
  exit_angles?: [number, number];
  /** Of the exit angle; above 0 where it is a bad one. */
  weight?: number;
}

export interface Way {
  name: string;
  bad: number;
  guarded: number;
  entries: number;
  exits: number;
  feed_length: number;
  time: number;
  offset: number | null;
  turn: number | null;
  unbeaten: boolean;
  unreached: [number, number] | null;
}

export interface Optimum {
  alternatives: { placement: Placement; value: number }[];
  complete: boolean;
  gap: number;
  lower_bound: number;
  nodes: number;
  placement: Placement;
  value: number;
  irreducible: { length: number; loop: number; share: number }[];
}

export interface Descent {
  start: Placement;
  end: Placement;
  value: number;
  evaluations: number;
}

/** A triangle of Nelder and Mead's method, its best corner first, and the evaluations so far. */
export interface Step {
  corners: (Placement & { value: number })[];
  evaluations: number;
}

/** A way of the paper's method. */
export interface WalkAnswer extends Descent {
  steps: Step[];
}

/** The bad length with the guard [mm] over turns [deg] and offsets from the middle of the turned part's width [mm], evenly from the least to the greatest. */
export interface MapAnswer {
  beside: ([number, number] | null)[];
  rows: number;
  turns: number[];
  values: ((number | null)[] | null)[];
}

export interface Paper {
  descent_from_as_drawn: Descent | null;
  descents: Descent[];
  statistics: { best: number; median: number; worst: number; within_one_percent: number; evaluations: number } | null;
  survey: { placement: Placement; covered: boolean; largest_exit_angle: number; bad: number }[];
}

export interface FaceAnswer {
  title: string;
  as_drawn: { bad: number; guarded: number; placement: Placement } | null;
  bad_exit_angles: { from: number; to: number; weight: number }[];
  chosen: number;
  cutter: { feed: number; left_hand: boolean; radius: number; spindle_speed: number; teeth: { phase: number; radius: number }[] };
  guard: number;
  margin: number;
  optimum: Optimum | { error: Finding };
  outline: Outline;
  rule: string;
  stretches: Stretch[];
  ways: Way[];
  findings: Finding[];
  map?: MapAnswer;
  paper?: Paper;
  walk?: WalkAnswer;
}

export function isOptimum(o: FaceAnswer["optimum"]): o is Optimum {
  return !("error" in o);
}
