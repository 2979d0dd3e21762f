// The sheet of `kinecut drill --json`: lengths in mm, Z in the frame of the entry, speeds in rev/min, feeds in mm/rev, times in s.
import type { Finding } from "./api";

export type Stage = "entry" | "steady" | "partial" | "exit" | "mixed" | "air";

export interface Zone {
  stage: Stage;
  from: number;
  to: number;
  from_exit_frame: number;
  to_exit_frame: number;
  feed: number;
  feed_from: string;
  revolutions: number;
  time: number;
}

export interface Lengths {
  L_vr1: number;
  L_vr2: number;
  L_vyh1: number;
  L_vyh2: number | null;
  L_nvr: number;
  L_kvyh: number | null;
  L_vr: number;
  L_ust: number;
  L_vyh: number | null;
  L_rx: number;
}

export interface Coordinates {
  Z_nvr1: number;
  Z_nvr2: number;
  Z_kvyh1: number | null;
  Z_kvyh2: number | null;
  Z_nvyh1: number | null;
  Z_nvyh2: number | null;
  Z_end: number;
  best_zero_h: number | null;
  best_zero_k: number | null;
}

/** Results of the formulas of Belyakov and Seleznev 2023, and the printout of their program. */
export interface Paper {
  lengths: Lengths;
  coordinates: Coordinates;
  times: [number, number, number];
  L_vr1_as_printed: number | null;
  printed_lengths: Record<string, number>;
  printed_times: [number, number, number, number];
}

/** The share of the point in material along the way from the start [mm]; `complete`: computed everywhere, not only where surfaces begin and end. */
export interface Load {
  complete: boolean;
  way: number[];
  share: number[];
}

/** A hole that is planned. */
export interface Hole {
  number: number;
  at: [number, number];
  zero: number;
  lengths: Lengths;
  coordinates: Coordinates;
  zones: Zone[];
  spindle_speed: number;
  time: number;
  constant_feed: number;
  constant_feed_time: number;
  saved_time: number;
  first_contact_radius: number;
  last_contact_radius: number;
  lip_eccentricity: number | null;
  lip_difference: number;
  findings: Finding[];
  load?: Load;
  paper?: Paper;
}

/** A hole that cannot be drilled. */
export interface RefusedHole {
  number: number;
  at: [number, number];
  error: Finding;
}

export interface DrillSheet {
  title: string;
  name: string;
  point: string;
  diameter: number;
  control: string;
  holes: (Hole | RefusedHole)[];
  program: string;
}

export function isHole(hole: Hole | RefusedHole): hole is Hole {
  return !("error" in hole);
}
