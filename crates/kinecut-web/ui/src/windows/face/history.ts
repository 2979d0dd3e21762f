// Undo of a face: its text with the placement under the hand, each state as it rested for a while.
import { computed, signal } from "@preact/signals";
import type { Hand } from "./state";

export interface Moment {
  text: string;
  hand: Hand;
}

/** Changes of one kind that follow each other within so long are one [ms]. */
const ONE = 700;
/** States that are kept. */
const MOST = 500;

type Kind = "text" | "turn" | "beside" | "both";

function same(a: Moment | undefined, b: Moment): boolean {
  return a !== undefined && a.text === b.text && a.hand.turn === b.hand.turn && a.hand.beside === b.hand.beside;
}

function kindOf(before: Moment, now: Moment): Kind {
  if (before.text !== now.text) return "text";
  if (before.hand.turn === now.hand.turn) return "beside";
  return before.hand.beside === now.hand.beside ? "turn" : "both";
}

export class History {
  private readonly moments = signal<Moment[]>([]);
  private readonly at = signal(-1);
  readonly hasBefore = computed(() => this.at.value > 0);
  readonly hasAfter = computed(() => this.at.value + 1 < this.moments.value.length);

  private kind: Kind | null = null;
  private changed = 0;
  private held = false;

  /** While the hand holds the part all is one change, however long it takes. */
  hold(on: boolean): void {
    this.held = on;
    this.rest();
  }

  /** The next change is one of its own. */
  rest(): void {
    this.kind = null;
  }

  /** Called with each new state. */
  note(now: Moment): void {
    const all = this.moments.peek();
    const at = this.at.peek();
    const before = all[at];
    if (same(before, now)) return;
    const kind = before ? kindOf(before, now) : "both";
    const joins = at > 0 && at + 1 === all.length && this.kind !== null && (this.held || (kind === this.kind && Date.now() - this.changed < ONE));
    const kept = all.slice(joins ? Math.max(0, at - MOST) : Math.max(0, at + 1 - MOST), joins ? at : at + 1);
    // Back where it was picked up, nothing has changed.
    this.moments.value = joins && same(kept[kept.length - 1], now) ? kept : [...kept, now];
    this.at.value = this.moments.value.length - 1;
    this.kind = kept.length === this.moments.value.length ? null : kind;
    this.changed = Date.now();
  }

  /** The state before or after; null at either end. */
  go(by: -1 | 1): Moment | null {
    const moment = this.moments.peek()[this.at.peek() + by];
    if (!moment) return null;
    this.at.value += by;
    this.rest();
    return moment;
  }
}
