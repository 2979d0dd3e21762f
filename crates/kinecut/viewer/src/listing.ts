// The text of the programs: as it stands in the page, or put together from patterns and numbers when a line is looked at
// (src/job/report/encode/listing.rs of the crate).
import { type Head, Stream, taken } from "./decode";

/** One of the programs: its file and the lines of it among those of all. */
export interface Part {
  file: string;
  from: number;
  to: number;
}

export interface Listing {
  parts: Part[];
  count: number;
  line(index: number): string;
}

export function listing(head: Head): Listing {
  return head.listing.length > 0 ? new Packed(head) : plain();
}

/** Each line of the text begins with its number, for paper and for pages without script. */
function plain(): Listing {
  const parts: Part[] = [];
  const text: string[] = [];
  for (const pre of document.querySelectorAll<HTMLElement>("pre.kc-program")) {
    const prefix = Number(pre.dataset.prefix);
    const lines = (pre.textContent ?? "").split("\n").map((line) => line.slice(prefix));
    parts.push({ file: pre.dataset.file ?? "", from: text.length, to: text.length + lines.length });
    for (const line of lines) text.push(line);
  }
  return { parts, count: text.length, line: (index) => text[index] ?? "" };
}

/** Marks of a number without a dot, and of one with a dot and no decimals; those of one, two decimals follow. */
const WHOLE = 0x0e;
const DOTTED = 0x0f;
const DECIMALS = 8;

/** A number in a pattern: the text before it, its column, its decimals; fewer than none without a dot. */
interface Slot {
  before: string;
  column: string;
  decimals: number;
}

interface Pattern {
  slots: Slot[];
  rest: string;
}

function pattern(text: string): Pattern {
  const slots: Slot[] = [];
  let [begin, letter] = [0, ""];
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    if (/[A-Za-z]/.test(text[i])) letter = text[i];
    if (code < WHOLE || code > DOTTED + DECIMALS) continue;
    slots.push({ before: text.slice(begin, i), column: letter + (code === WHOLE ? "" : "."), decimals: code - DOTTED });
    begin = i + 1;
  }
  return { slots, rest: text.slice(begin) };
}

class Packed implements Listing {
  readonly parts: Part[];
  readonly count: number;
  private readonly patterns: Pattern[];
  private readonly ids: Float64Array;
  /** First number of each line, and all numbers, each in steps of its last decimal. */
  private readonly first: Uint32Array;
  private readonly numbers: Float64Array;

  constructor(head: Head) {
    this.parts = head.listing.map(([file, from, to]) => ({ file, from, to }));
    this.count = head.lines;
    this.patterns = new TextDecoder().decode(taken("kc-patterns")).split("\n").map(pattern);
    const stream = new Stream("kc-numbers");
    this.ids = stream.column(this.count);
    const uses = new Uint32Array(this.patterns.length);
    for (const id of this.ids) uses[id]++;
    const counts = new Map<string, number>();
    this.patterns.forEach(({ slots }, i) => {
      for (const { column } of slots) counts.set(column, (counts.get(column) ?? 0) + uses[i]);
    });
    const columns = new Map<string, { finest: number; values: Float64Array; at: number }>();
    // No letter, A to Z, a to z, each without a dot and with one.
    for (const column of [...counts.keys()].sort()) {
      const finest = stream.unsigned();
      columns.set(column, { finest, values: stream.column(counts.get(column) ?? 0), at: 0 });
    }
    this.first = new Uint32Array(this.count + 1);
    for (let l = 0; l < this.count; l++) this.first[l + 1] = this.first[l] + this.patterns[this.ids[l]].slots.length;
    this.numbers = new Float64Array(this.first[this.count]);
    const sources = this.patterns.map(({ slots }) =>
      slots.map(({ column, decimals }) => {
        const source = columns.get(column) as { finest: number; values: Float64Array; at: number };
        return { source, by: 10 ** (source.finest - Math.max(0, decimals)) };
      }),
    );
    let n = 0;
    for (const id of this.ids) for (const { source, by } of sources[id]) this.numbers[n++] = source.values[source.at++] / by;
  }

  line(index: number): string {
    if (!(index >= 0 && index < this.count)) return "";
    const { slots, rest } = this.patterns[this.ids[index]];
    let text = "";
    slots.forEach(({ before, decimals }, i) => {
      const n = this.numbers[this.first[index] + i];
      const digits = String(Math.abs(n)).padStart(decimals + 1, "0");
      text += before + (n < 0 ? "-" : "");
      text += decimals < 0 ? digits : `${digits.slice(0, digits.length - decimals)}.${digits.slice(digits.length - decimals)}`;
    });
    return text + rest;
  }
}
