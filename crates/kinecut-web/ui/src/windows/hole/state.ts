// What a person has chosen in the window of a hole: pass, place of the cutter, axis of the charts, what is laid over.
import { type Signal, computed, signal } from "@preact/signals";
import type { Document } from "../../store/document";
import { worker } from "../../store/session";
import { parse, plain } from "../../toml/parse";
import { type Pass, type Plan, planOf } from "./answer";
import { Others } from "./others";
import { CONTACTS, type Table, table } from "./question";
import { timeAt, wayAt } from "./track";

export type PassName = Pass["pass"];
export type Axis = "way" | "time";

/** A part of the plan that is seen: its middle [mm], and how much larger than as a whole. */
export interface View {
  x: number;
  y: number;
  zoom: number;
}

const WHOLE: View = { x: 0, y: 0, zoom: 1 };
/** Most and least enlargement. */
const [LEAST, MOST] = [0.6, 60];

/** The passes that are looked at, by the names under which texts are asked about. */
const looked = new Map<string, Signal<PassName>>();

/** What was chosen last about a text of a name. */
const named = new Map<string, State>();

/** The pass of a text whose run is asked for. */
export function lookedAt(name: string, operation: Record<string, unknown>): PassName {
  const wished = looked.get(name)?.peek() ?? "finish";
  const other = wished === "finish" ? "rough" : "finish";
  return operation[wished] === undefined && operation[other] !== undefined ? other : wished;
}

export class State {
  private static readonly all = new WeakMap<Document, State>();

  static of(doc: Document): State {
    let known = State.all.get(doc);
    if (!known) State.all.set(doc, (known = new State(doc)));
    return known;
  }

  readonly plan = computed<Plan | null>(() => planOf(this.doc.answered.value?.answer));
  readonly wished = signal<PassName>("finish");
  /** The pass that is wished, or before its run has come the one that was seen. */
  readonly pass = computed<Pass | null>(() => {
    const all = this.plan.value?.passes ?? [];
    return all.find((p) => p.pass === this.wished.value && p.run) ?? all.find((p) => p.run) ?? all[0] ?? null;
  });
  /** Contact of the lead-in with the wall, as the text of the answer has it. */
  readonly contact = computed<string>(() => {
    const text = this.doc.answered.value?.text;
    const finish = text === undefined ? {} : table(table((plain(parse(text)) as Table).operation).finish);
    return typeof finish.contact === "string" ? finish.contact : CONTACTS[0];
  });
  /** Place of the cutter as a share of the way of its pass. */
  readonly share = signal(0.5);
  readonly axis = signal<Axis>("way");
  /** Stretch of the axis that is seen, as shares of it. */
  readonly window = signal<[number, number]>([0, 1]);
  readonly view = signal<View>(WHOLE);
  readonly construction = signal(true);
  readonly others: Others;

  /** Way of the cutter [mm]. */
  readonly s = computed(() => this.share.value * (this.pass.value?.run?.length ?? 0));

  private constructor(readonly doc: Document) {
    this.others = new Others(this);
    // A text that has become a file is looked at as before.
    const before = named.get(doc.name);
    if (before) {
      for (const key of ["wished", "share", "axis", "window", "view", "construction"] as const) (this[key] as Signal<unknown>).value = before[key].peek();
      this.others.shown.value = before.others.shown.peek();
    }
    named.set(doc.name, this);
    for (const name of [doc.id, doc.name]) looked.set(name, this.wished);
  }

  /** Brings the cutter to a place of the way [mm]. */
  go(s: number): void {
    const length = this.pass.value?.run?.length ?? 0;
    if (length > 0) this.share.value = Math.min(1, Math.max(0, s / length));
  }

  /** Brings the cutter to a place of the axis of the charts. */
  goAlong(value: number): void {
    const run = this.pass.value?.run;
    if (run) this.go(this.axis.value === "way" ? value : wayAt(run, value));
  }

  /** The cutter's place on the axis of the charts. */
  readonly along: Signal<number> = computed(() => {
    const run = this.pass.value?.run;
    if (!run) return 0;
    return this.axis.value === "way" ? this.s.value : timeAt(run, this.s.value);
  });

  choose(pass: PassName): void {
    this.wished.value = pass;
    this.window.value = [0, 1];
    // An answer has the run of one pass.
    if (!this.plan.peek()?.passes.some((p) => p.pass === pass && p.run)) worker(this.doc).again();
  }

  /** Enlarges the plan about a place of it [mm]. */
  zoom(by: number, x = this.view.value.x, y = this.view.value.y): void {
    const { x: cx, y: cy, zoom } = this.view.value;
    const next = Math.min(MOST, Math.max(LEAST, zoom * by));
    const keeps = zoom / next;
    this.view.value = { x: x + (cx - x) * keeps, y: y + (cy - y) * keeps, zoom: next };
  }

  fit(): void {
    this.view.value = WHOLE;
  }
}
