// What the verb `surface` prints, as far as the window reads it.
import type { Finding } from "../../base/api";
import type { P3 } from "./space";

export interface Known {
  code: string;
  name: string;
  title: string;
}

export interface SetUp {
  /** The way back: "+3". */
  motion: string;
  source: string;
  verdict: "free" | "tangent" | "sliding" | "blocked";
  /** Sine of the draft angle. */
  margin: number;
}

export interface Split {
  machine_code: string;
  tool_code: string;
  machine: string;
  tool: string;
  valid: boolean;
  tool_kind: string | null;
  forming: number[];
  setting: number[];
  links: { variable: string; motions: string; kind: string }[];
  built_in: string;
  setup_needed: boolean;
  setup: SetUp | null;
  candidates: SetUp[];
  methods: string | null;
  process: string;
  remarks: string[];
}

export interface MotionAt {
  digit: number;
  law: string;
  value: number;
  forming: boolean;
  matrix: number[][];
}

export interface Place {
  variables: [string, number][];
  point: P3;
  normal: P3 | null;
  motions: MotionAt[];
  lines: { variable: string; line: "directrix" | "generatrix" | "both"; points: P3[] }[];
}

export interface Arrow {
  name: string;
  role: "forming" | "linked" | "setting" | "set-up";
  direction: P3;
  axis_point: P3 | null;
}

export interface SplitPoints {
  machine_code: string;
  tool_code: string;
  tool: "none" | "point" | "edge" | "surface";
  points: P3[];
  motions: Arrow[];
}

export interface Sketch {
  at: [number[], number[]];
  mesh: P3[][];
  splits: SplitPoints[];
}

export interface Made {
  machine_code: string;
  tool_code: string;
  process: string;
  possible: boolean;
  laws: string[];
  residual: { least_um: number; greatest_um: number; rms_um: number } | null;
  coverage: { share: number } | null;
  obstacle: Finding | null;
  nearest: { layouts: number; classes: number; machines: { code: string; distance: number; changes: string[] }[] } | null;
}

export interface OnMachine {
  machine: string;
  code: string;
  splits: Made[];
  envelopes: { process: string; method: string; tool: string; possible: boolean; laws: string[]; residual: Made["residual"]; obstacle: Finding | null; unverified: Finding | null }[];
}

export interface Surface {
  name: string;
  title: string;
  parameters: Record<string, number>;
  variables: [string, number, number][];
  directrix: string;
  generatrix: string;
  chain: string;
  matrices: string[][];
  point: string;
  code: string;
  canonical: string;
  orders: number;
  layouts: number;
  form: string;
  slides: string[];
  splits: Split[];
  processes: { method: string; processes: [string, string][] }[];
  findings?: Finding[];
  place?: Place;
  sketch?: Sketch;
  on_machine?: OnMachine;
}

/** The elements of a chain as it is printed: `6(phi) 1(R - z*sin(alpha))`. */
export function elements(chain: string): string[] {
  const found: string[] = [];
  let depth = 0;
  let from = 0;
  for (let i = 0; i <= chain.length; i++) {
    const c = chain[i];
    if (c === "(") depth++;
    if (c === ")") depth--;
    if ((c === " " && depth === 0) || c === undefined) {
      const one = chain.slice(from, i).trim();
      if (one !== "" && one !== "-") found.push(one);
      from = i + 1;
    }
  }
  return found;
}

/** The code of a part; a dash where there is none. */
export function part(code: string): string {
  return code === "" ? "\u2013" : code;
}

const LETTERS = ["", "X", "Y", "Z", "A", "B", "C"];

/** The letter of ISO 841 of a motion; the digit of an inclined one. */
export function letter(digit: number | string): string {
  return LETTERS[Number(digit)] ?? String(digit);
}

const GREEK: Record<string, string> = { alpha: "\u03b1", beta: "\u03b2", gamma: "\u03b3", delta: "\u03b4", theta: "\u03b8", phi: "\u03c6", psi: "\u03c8", rho: "\u03c1", tau: "\u03c4", pi: "\u03c0", omega: "\u03c9" };

/** A law or name with Greek letters and a real minus, as formulas are printed. */
export function pretty(law: string): string {
  return law.replace(/[A-Za-z]+/g, (word) => GREEK[word] ?? word).replaceAll("-", "\u2212").replaceAll("*", "\u00b7");
}
