// A figure of a paper: a function of numbers to a picture, with what can be changed and what comes out.
import type { VNode } from "preact";
import type { Question } from "./asked";
import { type Key, num, scientific } from "./language";

export type Values = Record<string, number>;
export type Point = [number, number];

/** An input: what can be typed, and moved by a handle. */
export interface Field {
  key: string;
  /** Keys of its symbol, its name and its unit in the catalogue. */
  symbol: Key;
  name: Key;
  unit?: Key;
  min: number;
  max: number;
  step: number;
  digits: number;
  /** Names of its values where it is a choice; the value is the place in this list. */
  options?: Key[];
  /** Whether it counts with the other inputs as they are; else it is not shown. */
  counts?: (v: Values) => boolean;
  /** Of a figure that asks: no part of its questions, so that it changes nothing of the answers. */
  free?: boolean;
  /** Of a figure that asks: values whose answers a saved page holds. */
  saved?: number[];
}

/** A number that comes out: in the table, in the picture and in the file of numbers to the same digit. */
export interface Row {
  key: string;
  symbol: Key;
  name: Key;
  unit?: Key;
  value: number;
  digits: number;
  /** Leaves zeros at its end out. */
  trim?: boolean;
  /** As a mantissa and a power of ten. */
  power?: boolean;
  /** The value of the paper where it is another one. */
  printed?: number;
}

export function shown(row: Row, value = row.value): string {
  return row.power ? scientific(value, row.digits) : num(value, row.digits, row.trim);
}

/** What a picture is drawn from. */
export interface Drawing {
  v: Values;
  /** Width of the picture [px]; it is laid out again for each. */
  width: number;
  printed: boolean;
  rows: Map<string, Row>;
  /** The number of a row as it is shown. */
  text: (row: string) => string;
  /** Changes inputs; they are brought into their bounds and to their digits. */
  set: (values: Values) => void;
  /** The inputs as they are wanted now: a figure that asks may still draw those before. */
  now: () => Values;
  /** For names of elements that must differ between figures. */
  id: string;
  /** What is kept of the answers, of a figure that asks. */
  data: unknown[];
}

export interface Figure {
  /** As the paper numbers it, `1.5` the fifth of the first paper. */
  id: string;
  /** Beginning of its keys in the catalogue: `.title .caption .says .ask .answer .p1 …`. */
  words: string;
  /** The number of the paper's figure, as it is printed. */
  after: string;
  fields: Field[];
  start: Values;
  /** A sentence of its own about its origin, where the paper at hand has no picture. */
  drawn?: Key;
  /** Whether it is a table in the paper. */
  table?: boolean;
  /** Whether the paper is wrong here, and both can be seen. */
  mistake?: boolean;
  /** Questions for kinecut, whose answers are all that the figure shows; without them it is a closed form. */
  asks?: (v: Values) => Question[];
  /** More inputs whose answers a saved page holds, beside those of the fields one by one. */
  series?: (base: Values) => Values[];
  /** What follows the explanation. */
  below?: (data: unknown[]) => VNode;
  rows: (v: Values, data: unknown[]) => Row[];
  /** Words for its sentences, beside its numbers. */
  more?: (v: Values, data: unknown[]) => Record<string, string>;
  /** A sentence in place of results that do not exist. */
  wrong?: (v: Values, data: unknown[]) => Key | null;
  /** A sentence beside results that do not hold for the whole. */
  warns?: (v: Values, data: unknown[]) => Key | null;
  draw: (c: Drawing) => { height: number; children: VNode };
  toml: (v: Values, data: unknown[]) => string;
}

/** Values within the bounds of their fields and with no more digits than those. */
export function bounded(fields: Field[], values: Values): Values {
  return Object.fromEntries(
    Object.entries(values).map(([key, value]) => {
      const field = fields.find((f) => f.key === key);
      if (!field) return [key, value];
      const power = 10 ** field.digits;
      return [key, Math.round(Math.min(field.max, Math.max(field.min, value)) * power) / power];
    }),
  );
}

/** A number of TOML: digits without an end of zeros. */
export function tomlNumber(n: number, digits = 6): string {
  return String(Number(n.toFixed(digits)));
}

/** A length of which a whole number of parts is to fill another: rounded up, so that there is no part more. */
export function tomlAbove(n: number, digits = 6): string {
  const power = 10 ** digits;
  return String(Number((Math.ceil(n * power - 1e-6) / power).toFixed(digits)));
}
