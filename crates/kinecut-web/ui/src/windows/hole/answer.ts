// The answer of `kinecut hole --json --samples`, as far as the window reads it.
import type { Finding } from "../../base/api";

export interface Entry {
  way: string;
  possible: boolean;
  core: number;
  reason: string;
  chosen: boolean;
}

/** A record of the paper's tables; mm, rad. */
export interface Curve {
  kind: "line" | "arc" | "involute" | "spiral";
  length: number;
  start: [number, number];
  start_angle: number;
  start_radius: number | null;
  end_radius: number | null;
  base_radius: number;
  base_centre: [number, number] | null;
}

export type Point = [number, number];

/** The involute of a pass with what the paper draws about it; mm, rad. */
export interface Figure {
  psi: number;
  base_radius: number;
  base_centre: Point;
  evolute: Point[];
  start: Point;
  touch: Point;
  unturned_start: Point;
  start_centre: Point;
  before: Point[];
  unturned: Point[];
  osculated: number[];
  visible_turns_formula: number;
}

export interface Joint {
  s: number;
  radius: number;
  contact: string;
  kink: number;
  steps: { velocity: number; acceleration: number | null; jerk: number | null };
}

/** Columns of samples; mm, s, rad. */
export interface Samples {
  s: number[];
  time: number[];
  speed: number[];
  along: number[];
  acceleration: number[];
  /** Null of a control without a limit of jerk. */
  jerk_along: (number | null)[];
  jerk: (number | null)[];
  curvature: (number | null)[];
  engagement: (number | null)[];
}

export interface Run {
  length: number;
  time: number;
  /** Null of a control with a planner of its own, which does not tell. */
  stops: number | null;
  smoothed: number | null;
  farthest: number;
  measured: [number, number] | null;
  engagement_places: number;
  /** The reason for which a load that is asked for is not measured. */
  unmeasured: Finding | null;
  peaks: {
    speed: number;
    along: number;
    acceleration: number;
    jerk_along: number | null;
    jerk: number | null;
    engagement: number | null;
    axis_acceleration: number;
    axis_jerk: number | null;
  };
  cycle: number;
  finest: number;
  /** The joint at which the circle at the wall begins. */
  closing: Joint | null;
  joint_count: number;
  joints: Joint[];
  way: { s: number[]; x: number[]; y: number[] };
  samples: Samples;
}

export interface Pass {
  pass: "rough" | "finish";
  path_radius: number;
  turns: number;
  whole_turns: number;
  step: number;
  entry_radius: number;
  engagement_deg: number | null;
  length: number;
  floors: number[];
  base_radius: number;
  roll: number;
  touch_angle_deg: number;
  start_curvature_radius: number;
  circle_length: number;
  curve_count: number;
  curves: Curve[];
  figure?: Figure;
  run?: Run;
}

export interface Plan {
  title: string;
  at: Point;
  diameter: number;
  cutter_diameter: number;
  strategy: string;
  clockwise: boolean;
  limits?: { rapid: number; acceleration: number; jerk: number };
  entries: Entry[];
  passes: Pass[];
  feed_length: number;
  entry_length: number;
  feed_time: number;
  control: string;
  program_lines: number;
  findings: Finding[];
}

/** The plan of an answer; null where it is a finding. */
export function planOf(answer: unknown): Plan | null {
  return typeof answer === "object" && answer !== null && "passes" in answer ? (answer as Plan) : null;
}
