// Planning a drilling after each change of its text: the newest counts, the older is given up. The page follows the numbers.
import { batch } from "@preact/signals";
import * as api from "../base/api";
import type { DrillSheet } from "../base/drillsheet";
import type { Document } from "./document";

/** A plan is asked for so long after a change [ms]: keys that come together are one change. */
const SOON = 12;
/** The page is asked for when the numbers have rested for so long [ms]. */
const REST = 200;
/** Code of a finding: a newer request came before the answer. */
const CANCELLED = "KC0009";

function isSheet(answer: DrillSheet | api.Finding): answer is DrillSheet {
  return "holes" in answer;
}

export class DrillWorker {
  private generation = 0;
  private changedAt = 0;
  private timer = 0;
  private control = new AbortController();

  constructor(private readonly doc: Document) {}

  /** Called on each change of the text. */
  changed(): void {
    this.generation++;
    this.changedAt = performance.now();
    this.control.abort();
    clearTimeout(this.timer);
    this.doc.planning.value = true;
    this.timer = window.setTimeout(() => void this.run(), SOON);
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
    clearTimeout(this.timer);
  }

  private async run(): Promise<void> {
    const { doc, generation } = this;
    const { signal } = (this.control = new AbortController());
    const text = doc.text.value;
    const question = { generation, text, ...(doc.isNew ? { new: doc.name } : { file: doc.id }) };
    const old = () => generation !== this.generation || signal.aborted;
    try {
      const answer = await api.verb<DrillSheet>("drill", { paper: true, ...question }, signal);
      if (old() || (!isSheet(answer) && answer.code === CANCELLED)) return;
      batch(() => {
        doc.planning.value = false;
        doc.refused.value = null;
        doc.wrong.value = isSheet(answer) ? null : answer;
        if (isSheet(answer)) doc.drilled.value = { sheet: answer, text, at: new Date(), page: null };
      });
      this.whenDrawn(generation);
      if (isSheet(answer)) await this.page(question, signal, old);
    } catch (error) {
      if (old()) return;
      batch(() => {
        doc.planning.value = false;
        doc.refused.value = error instanceof api.Refused ? error.message : error instanceof api.Gone ? null : String(error);
      });
    }
  }

  /** Asks for the page; the numbers hold without it. */
  private async page(question: api.VerbQuestion, signal: AbortSignal, old: () => boolean): Promise<void> {
    await new Promise((done) => setTimeout(done, REST));
    if (old()) return;
    const page = await api.verbPage("drill", { paper: true, ...question }, signal).catch((error: unknown) => {
      if (error instanceof api.Refused) return "";
      throw error;
    });
    const known = this.doc.drilled.value;
    if (!old() && known?.text === question.text && page.startsWith("<!DOCTYPE html>")) this.doc.drilled.value = { ...known, page };
  }

  /** Tells when the new plan is on the screen. */
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
