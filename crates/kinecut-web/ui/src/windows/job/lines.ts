// The lines of all programs of a text, one after another.
import type { Work } from "../../base/api";

const known = new WeakMap<Work, string[]>();

export function linesOf(work: Work | null): string[] {
  if (!work) return [];
  let lines = known.get(work);
  if (!lines) {
    lines = [];
    for (const program of work.programs) {
      const own = program.text.replace(/\r/g, "").split("\n");
      for (let i = 0; i < program.lines; i++) lines[program.first + i] = own[i] ?? "";
    }
    known.set(work, lines);
  }
  return lines;
}

/** Lines looked back for a word that holds on. */
const BACK = 4000;

/** The last value of a word of one letter up to a line; null where there is none near. */
export function wordBefore(lines: string[], line: number, letter: "F" | "S"): string | null {
  const pattern = new RegExp(`(?:^|[^A-Z])${letter}=?(\\d+\\.?\\d*|\\.\\d+)`);
  for (let l = line; l >= Math.max(0, line - BACK); l--) {
    const text = (lines[l] ?? "").replace(/\([^)]*\)|;.*$/g, "");
    const found = pattern.exec(text)?.[1];
    if (found) return found.replace(/\.$/, "");
  }
  return null;
}
