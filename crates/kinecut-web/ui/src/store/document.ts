// A text that is open, what was planned and simulated of it, and what of that is older than the text.
import { computed, signal } from "@preact/signals";
import type { Cursor, Place } from "viewer/track";
import type { FileKind, Finding, Planned, Simulated, Verdict } from "../base/api";
import { type Path, type Table, at, parse, plain } from "../toml/parse";
import type { Guess } from "./guess";
import { type Answered, type QuestionKind, kindOf } from "./questions";
import type { Shown } from "./shown";

/** What is simulated now. */
export interface Running {
  /** [mm]; null where the program's own is not known yet. */
  step: number | null;
  coarse: boolean;
  /** From 0 to 1; null before the first word of it. */
  share: number | null;
}

/** An outcome, with the text it is of. */
export interface Judged {
  verdict: Verdict;
  text: string;
  at: Date;
  step: number;
  result: string;
}

/** What is said beside the text of a program of others. */
export interface Given {
  control?: string;
  stock?: number[];
  tool?: number;
  tolerant?: boolean;
  job?: string;
}

export class Document {
  readonly text = signal("");
  /** The text as it is on disk, as far as is known; sha256 null: not there. */
  readonly saved = signal<{ text: string; sha256: string | null }>({ text: "", sha256: null });
  /** Another text on disk than that which was read; to be decided. */
  readonly conflict = signal<{ text: string | null; sha256: string | null } | null>(null);

  readonly planned = signal<Planned | null>(null);
  readonly wrong = signal<Finding | null>(null);
  readonly simulated = signal<Simulated | null>(null);
  readonly judged = signal<Judged | null>(null);
  readonly running = signal<Running | null>(null);
  readonly planning = signal(false);
  readonly refused = signal<string | null>(null);
  readonly stopped = signal(false);
  /** From the keystroke to the drawn plan [ms]. */
  readonly drawnIn = signal<number | null>(null);
  readonly shown = signal<Shown | null>(null);
  readonly given = signal<Given>({});
  /** The answer to a question. */
  readonly answered = signal<Answered | null>(null);
  /** What is guessed of a program where no job says it. */
  readonly guess = signal<Guess | null>(null);

  /** The finding that was shown last. */
  readonly finding = signal<number | null>(null);
  /** The item of the form that is chosen. */
  readonly chosen = signal<Path>([]);
  /** Where its cursor stood when another was shown. */
  place: Place = { line: -1, piece: -1, part: 0 };

  readonly tree = computed<Table>(() => parse(this.kind === "program" ? "" : this.text.value));
  readonly values = computed(() => plain(this.tree.value) as Record<string, unknown>);
  readonly savedTree = computed<Table>(() => parse(this.kind === "program" ? "" : this.saved.value.text));
  readonly dirty = computed(() => this.text.value !== this.saved.value.text);
  /** The findings of the text as it is; those of an older one are not of it. */
  readonly findings = computed<Finding[]>(() => {
    const wrong = this.wrong.value;
    if (wrong) return [wrong];
    const judged = this.judged.value;
    if (judged && judged.text === this.text.value) return judged.verdict.found;
    const answered = this.answered.value;
    if (answered && this.question) return this.question.findings(answered.answer);
    return (this.simulated.value ?? this.planned.value)?.findings ?? [];
  });
  /** The last answer that has programs and operations. */
  readonly work = computed(() => this.simulated.value ?? this.planned.value);

  /** Whether times are those of the programmed feeds: before a simulation, and where a machine states no limits. */
  readonly atFeeds = computed(() => {
    const work = this.work.value;
    if (!work) return false;
    return ("quick" in work && work.quick) || work.plan.setups.some((setup) => setup.time_without_jerk_limit === undefined);
  });

  /** The tools that are known: those of the answer, or of the text. */
  readonly tools = computed<{ number: number; name: string }[]>(() => {
    const told = this.work.value?.tools;
    if (told) return told;
    const own = this.values.value.tool;
    return Array.isArray(own) ? own.map((tool: Record<string, unknown>) => ({ number: Number(tool.number), name: String(tool.name ?? tool.type ?? "") })) : [];
  });

  constructor(
    readonly id: string,
    readonly name: string,
    readonly kind: FileKind,
    /** Whether no file has been made of it yet. */
    readonly isNew = false,
  ) {}

  private asks: QuestionKind | null = null;

  /** Its kind, where it is a question of a verb that has a window; a text that has become unreadable stays in its window. */
  get question(): QuestionKind | null {
    if (this.kind !== "question") return null;
    return (this.asks = kindOf(this.values.value) ?? this.asks);
  }

  /** The value at a path of the text. */
  value(path: Path): unknown {
    return plain(at(this.tree.value, path));
  }

  leave(cursor: Cursor): void {
    this.place = cursor.place;
  }
}

/** A path as findings write it: `setup[0].operation[2].diameter`. */
export function keyOf(path: Path): string {
  return path.map((step, i) => (typeof step === "number" ? `[${step}]` : i > 0 ? `.${step}` : step)).join("");
}

export function pathOf(key: string): Path {
  return [...key.matchAll(/\[(\d+)\]|([^.[\]]+)/g)].map((m) => (m[1] !== undefined ? Number(m[1]) : m[2]));
}

/** UTF-16 index of a byte of a text. */
export function indexOfByte(text: string, byte: number): number {
  let bytes = 0;
  for (let i = 0; i < text.length; i++) {
    if (bytes >= byte) return i;
    const code = text.charCodeAt(i);
    bytes += code < 0x80 ? 1 : code < 0x800 ? 2 : code >= 0xd800 && code < 0xdc00 ? 4 : code >= 0xdc00 && code < 0xe000 ? 0 : 3;
  }
  return text.length;
}

/** Where in a text a finding is; null when it is of another file or of no place. */
export function rangeOf(finding: Finding, name: string, text: string, tree: Table): { from: number; to: number } | null {
  const { place, key } = finding;
  if (place && sameFile(place.file, name) && place.line > 0) {
    if (place.start !== undefined && place.end !== undefined) {
      const from = indexOfByte(text, place.start);
      return { from, to: Math.max(from, indexOfByte(text, place.end)) };
    }
    const lines = text.split("\n");
    const from = lines.slice(0, place.line - 1).reduce((n, line) => n + line.length + 1, 0);
    return { from, to: from + (lines[place.line - 1]?.length ?? 0) };
  }
  if (!key || (place && place.line > 0)) return null;
  const path = pathOf(key);
  const node = at(tree, path);
  if (!node) return null;
  if (node.kind === "table" && (node.form === "header" || node.form === "root")) {
    const end = text.indexOf("\n", node.from);
    return { from: node.from, to: end < 0 ? text.length : end };
  }
  return { from: node.from, to: node.to };
}

/** Findings may name a file by its path. */
export function sameFile(a: string, b: string): boolean {
  return a === b || a.endsWith(`/${b}`) || b.endsWith(`/${a}`);
}

export interface Difference {
  key: string;
  before: unknown;
  now: unknown;
}

/** The values that differ between two texts, by their keys. */
export function differences(before: unknown, now: unknown, path: Path = []): Difference[] {
  const isTable = (v: unknown): v is Record<string, unknown> => typeof v === "object" && v !== null && !Array.isArray(v);
  if (isTable(before) && isTable(now)) {
    const keys = new Set([...Object.keys(before), ...Object.keys(now)]);
    return [...keys].flatMap((key) => differences(before[key], now[key], [...path, key]));
  }
  if (Array.isArray(before) && Array.isArray(now)) {
    const count = Math.max(before.length, now.length);
    return Array.from({ length: count }).flatMap((_, i) => differences(before[i], now[i], [...path, i]));
  }
  return before === now ? [] : [{ key: keyOf(path), before, now }];
}
