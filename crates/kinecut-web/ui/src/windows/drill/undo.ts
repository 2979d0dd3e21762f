// Undo of a text that no editor shows: each state of it that rested for a while.
import type { Document } from "../../store/document";

/** Changes that follow each other within so long are one [ms]. */
const ONE = 700;

export class Undo {
  private static readonly all = new WeakMap<Document, Undo>();

  static of(doc: Document): Undo {
    let known = Undo.all.get(doc);
    if (!known) Undo.all.set(doc, (known = new Undo(doc.text.peek())));
    return known;
  }

  private states: string[];
  private at = 0;
  private changed = 0;

  private constructor(text: string) {
    this.states = [text];
  }

  /** Called with the text after each change of it. */
  note(text: string): void {
    if (text === this.states[this.at]) return;
    const now = Date.now();
    const joins = now - this.changed < ONE && this.at > 0 && this.at + 1 === this.states.length;
    this.states = [...this.states.slice(0, joins ? this.at : this.at + 1), text];
    this.at = this.states.length - 1;
    this.changed = now;
  }

  /** The text before or after; null at either end. */
  go(by: -1 | 1): string | null {
    const text = this.states[this.at + by];
    if (text === undefined) return null;
    this.at += by;
    this.changed = 0;
    return text;
  }
}
