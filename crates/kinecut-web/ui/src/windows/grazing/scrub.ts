// The moment of a move that is looked at: its curve, and what is swept in the whole move and up to it. Every number is the verbs'.
import { batch, computed, effect, signal } from "@preact/signals";
import * as api from "../../base/api";
import { later } from "../../base/open";
import type { Document } from "../../store/document";
import type { Value } from "../../toml/edit";
import { contourOf } from "./question";
import { type Growth, type Sheet, type Swept, answersOf, isSheet, isSwept } from "./sheet";
import { Looked } from "./state";

/** Intervals of a move. */
export const INTERVALS = 48;
/** Work that takes longer than a moment is asked for when all has rested for so long [ms]. */
const REST = 350;
/** A curve that is older than this is said to be [ms]. */
const LATE = 100;

/** Questions of one kind: one at a time, the newest next. */
class Line<T> {
  private generation = 0;
  private control: AbortController | null = null;

  constructor(
    private readonly name: string,
    private readonly doc: Document,
    private readonly verb: string,
  ) {}

  async ask(question: Value): Promise<(T | api.Finding)[] | null> {
    this.stop();
    const { signal } = (this.control = new AbortController());
    const beside = this.doc.isNew ? {} : { beside: this.doc.id };
    const told = await api.verb<unknown>(this.verb, { generation: ++this.generation, new: `${this.doc.name.replaceAll("/", "-")}-${this.name}.json`, ...beside, text: JSON.stringify(question) }, signal);
    const all = answersOf<T>(told);
    return signal.aborted || all.some((one) => (one as api.Finding).code === "KC0009") ? null : all;
  }

  stop(): void {
    this.control?.abort();
  }
}

/** The sweep up to a moment. */
export interface Part {
  text: string;
  t: number;
  swept: Swept;
}

export class Scrub {
  private static readonly all = new WeakMap<Document, Scrub>();

  static of(doc: Document): Scrub {
    let known = Scrub.all.get(doc);
    if (!known) Scrub.all.set(doc, (known = new Scrub(doc, Looked.of(doc, "envelope"))));
    return known;
  }

  /** Number of the moment. */
  readonly at = signal(INTERVALS);
  readonly playing = signal(false);
  readonly late = signal(false);
  /** From the move of the slider to the curve on the screen [ms]. */
  readonly drawnIn = signal<number | null>(null);
  readonly whole = signal<Part | null>(null);
  readonly part = signal<Part | null>(null);
  readonly wrong = signal<api.Finding | null>(null);
  readonly sweeping = signal(false);
  readonly refused = signal<string | null>(null);
  /** The question by itself. */
  private readonly question = computed(() => {
    let value: unknown = this.doc.values.value;
    for (const step of this.looked.item.value) value = (value as Record<string | number, unknown> | undefined)?.[step];
    return (value ?? {}) as { [key: string]: Value };
  });
  private readonly curve: Line<Sheet>;
  private readonly sweep: Line<Swept>;
  private asking = false;
  private shown: { growth: Growth; at: number } | null = null;
  /** Gives up what has not begun. */
  private forget = () => {};
  private lateTimer = 0;
  private movedAt = 0;

  private constructor(
    readonly doc: Document,
    readonly looked: Looked,
  ) {
    this.curve = new Line("moment", doc, "grazing");
    this.sweep = new Line("swept", doc, "envelope");
    effect(() => {
      void this.looked.growth.value;
      void this.at.value;
      this.movedAt = performance.now();
      void this.pump();
      this.later();
    });
    effect(() => {
      void this.doc.text.value;
      // Where play was halted the volume is asked for.
      void this.playing.value;
      this.later();
    });
  }

  get moment() {
    return this.looked.growth.value?.moments[this.at.value] ?? null;
  }

  go(at: number): void {
    this.at.value = Math.min(INTERVALS, Math.max(0, Math.round(at)));
  }

  /** Asks for the curve of the newest moment, one question at a time. */
  private async pump(): Promise<void> {
    if (this.asking) return;
    for (;;) {
      const growth = this.looked.growth.peek();
      const at = this.at.peek();
      const moment = growth?.moments[at];
      if (!growth || !moment || (this.shown?.growth === growth && this.shown.at === at)) break;
      this.asking = true;
      const moved = this.movedAt;
      this.lateTimer ||= window.setTimeout(() => (this.late.value = true), LATE);
      try {
        const told = await this.curve.ask({ tool: contourOf(growth.pieces), tolerance: growth.tolerance, twist: { velocity: moment.velocity, turn: moment.turn } });
        if (told === null) continue;
        const [answer] = told;
        this.shown = { growth, at };
        batch(() => {
          this.refused.value = null;
          // A tool that does not move has no curve.
          this.looked.moment.value = isSheet(answer) ? answer : null;
          this.late.value = false;
          clearTimeout(this.lateTimer);
          this.lateTimer = 0;
        });
        requestAnimationFrame(() =>
          requestAnimationFrame(() => {
            this.drawnIn.value = performance.now() - moved;
            const { dataset } = document.documentElement;
            dataset.moment = String(at);
            dataset.momentMs = String(this.drawnIn.value);
          }),
        );
      } catch (error) {
        this.failed(error);
        break;
      } finally {
        this.asking = false;
      }
    }
  }

  private later(): void {
    this.forget();
    this.forget = later(REST, () => this.swept());
  }

  /** Asks what is swept: in the whole move first, then up to the moment. */
  private async swept(): Promise<void> {
    const { doc } = this;
    const growth = this.looked.growth.peek();
    if (doc.planning.peek() || doc.wrong.peek() || !growth || this.playing.peek()) return;
    const text = doc.answered.peek()?.text ?? "";
    const item = JSON.stringify(this.looked.item.peek());
    const key = `${item}${text}`;
    const t = growth.moments[this.at.peek()]?.t ?? 1;
    const question = this.question.peek();
    const until = typeof question.until === "number" ? question.until : 1;
    this.sweeping.value = true;
    try {
      if (this.whole.peek()?.text !== key) {
        const told = await this.sweep.ask({ ...question, points: 0 });
        if (told === null) return;
        const [answer] = told;
        batch(() => {
          this.wrong.value = isSwept(answer) ? null : answer;
          this.whole.value = isSwept(answer) ? { text: key, t: 1, swept: answer } : null;
        });
        if (!isSwept(answer)) return;
      }
      const known = this.part.peek();
      if (t > 0 && t < 1 && (known?.text !== key || known.t !== t)) {
        const told = await this.sweep.ask({ ...question, points: 0, until: until * t });
        if (told === null) return;
        const [answer] = told;
        if (isSwept(answer)) this.part.value = { text: key, t, swept: answer };
      }
      this.sweeping.value = false;
    } catch (error) {
      this.failed(error);
    }
  }

  /** The result for the text as it is; what is older is not of it. */
  current(part: Part | null): Swept | null {
    const answered = this.doc.answered.value;
    return part && answered && answered.text === this.doc.text.value && part.text === `${JSON.stringify(this.looked.item.value)}${answered.text}` ? part.swept : null;
  }

  private failed(error: unknown): void {
    if (error instanceof DOMException && error.name === "AbortError") return;
    batch(() => {
      this.sweeping.value = false;
      this.refused.value = error instanceof Error ? error.message : String(error);
    });
  }
}
