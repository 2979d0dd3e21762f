// Asking a verb after each change of a text: the newest counts, the older is given up. A page follows the numbers.
import { batch } from "@preact/signals";
import * as api from "../base/api";
import { later } from "../base/open";
import type { Document } from "./document";
import type { QuestionKind } from "./questions";

/** An answer is asked for so long after a change [ms]: keys that come together are one change. */
const SOON = 12;
/** The page is asked for when the numbers have rested for so long [ms]. */
const REST = 200;
/** Code of a finding: a newer request came before the answer. */
const CANCELLED = "KC0009";

export class Asker {
  private generation = 0;
  private changedAt = 0;
  /** Gives up what has not begun. */
  private forget = () => {};
  private control = new AbortController();

  constructor(private readonly doc: Document) {}

  /** Called on each change of the text. */
  changed(): void {
    this.generation++;
    this.changedAt = performance.now();
    this.control.abort();
    this.forget();
    this.doc.planning.value = true;
    this.forget = later(SOON, () => this.run());
  }

  /** Called when a file may be another that the text names. */
  again(): void {
    this.changed();
  }

  /** Nothing of it runs for long. */
  stop(): void {
    this.control.abort();
  }

  /** Nothing of it tells how far it is. */
  progress(): void {}

  close(): void {
    this.generation++;
    this.control.abort();
    this.forget();
  }

  private async run(): Promise<void> {
    const { doc, generation } = this;
    const kind = doc.question;
    if (!kind) return;
    const { signal } = (this.control = new AbortController());
    const text = doc.text.value;
    const question = { generation, text, ...(doc.isNew ? { new: doc.name } : { file: doc.id }) };
    const old = () => generation !== this.generation || signal.aborted;
    try {
      const told = await kind.ask(question, signal);
      if (old()) return;
      if ("wrong" in told && told.wrong.code === CANCELLED) {
        // Given up by the server, and nothing newer is asked by this text.
        this.forget = later(REST, () => this.run());
        return;
      }
      batch(() => {
        doc.planning.value = false;
        doc.refused.value = null;
        doc.wrong.value = "wrong" in told ? told.wrong : null;
        if ("answer" in told) doc.answered.value = { answer: told.answer, text, at: new Date(), page: null };
      });
      this.whenDrawn(generation);
      if ("answer" in told) await this.page(kind, question, signal, old);
    } catch (error) {
      if (old()) return;
      batch(() => {
        doc.planning.value = false;
        doc.refused.value = error instanceof api.Refused ? error.message : error instanceof api.Gone ? null : String(error);
      });
    }
  }

  /** Asks for the page; the numbers hold without it. */
  private async page(kind: QuestionKind, question: api.VerbQuestion, signal: AbortSignal, old: () => boolean): Promise<void> {
    if (!kind.page) return;
    await new Promise((done) => setTimeout(done, REST));
    if (old()) return;
    const page = await kind.page(question, signal).catch((error: unknown) => {
      if (error instanceof api.Refused) return "";
      throw error;
    });
    const known = this.doc.answered.value;
    if (!old() && known?.text === question.text && page.startsWith("<!DOCTYPE html>")) this.doc.answered.value = { ...known, page };
  }

  /** Tells when the new answer is on the screen. */
  private whenDrawn(generation: number): void {
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        if (generation !== this.generation) return;
        this.doc.drawnIn.value = performance.now() - this.changedAt;
        const { dataset } = document.documentElement;
        dataset.drawn = String(Number(dataset.drawn ?? 0) + 1);
        dataset.drawnMs = String(this.doc.drawnIn.value);
      }),
    );
  }
}
