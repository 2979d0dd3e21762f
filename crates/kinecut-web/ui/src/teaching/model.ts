// A figure of a paper: a function of numbers to a picture, with what can be changed and what comes out.
import type { VNode } from "preact";
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
  /** For names of elements that must differ between figures. */
  id: string;
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
  /** Whether it is a table in the paper. */
  table?: boolean;
  /** Whether the paper is wrong here, and both can be seen. */
  mistake?: boolean;
  rows: (v: Values) => Row[];
  /** A sentence in place of results that do not exist. */
  wrong?: (v: Values) => Key | null;
  draw: (c: Drawing) => { height: number; children: VNode };
  toml: (v: Values) => string;
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

/** A number of TOML: digits without an end of zeros, and a point where it must be a float. */
export function tomlNumber(n: number, digits = 6): string {
  return String(Number(n.toFixed(digits)));
}
