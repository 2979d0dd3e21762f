// Planning and simulating a text after each change: the newest counts, the older is given up.
import { batch } from "@preact/signals";
import * as api from "../base/api";
import { later } from "../base/open";
import type { Document, Judged } from "./document";
import { guessOf } from "./guess";
import { keyedByText } from "./runs";
import { Shown } from "./shown";

/** A plan is asked for so long after a change [ms]: keys that come together are one change. */
const SOON = 12;
/** A simulation is begun when the text has rested for so long [ms]. */
const REST = 120;

/** All that is known of a text whose outcome is known. */
interface Kept {
  text: string;
  given: string;
  planned: api.Planned | null;
  simulated: api.Simulated;
  shown: Shown;
  judged: Judged;
}

export class Worker {
  /** The last outcome: who undoes a change has it at once. */
  private kept: Kept | null = null;
  private generation = 0;
  private changedAt = 0;
  /** Gives up what has not begun. */
  private forget = () => {};
  private control = new AbortController();

  constructor(private readonly doc: Document) {}

  /** Called on each change of the text, or of what is given beside it. */
  changed(): void {
    this.begin();
    if (this.restored()) return;
    this.later();
  }

  /** Called when a file may be another that the text names: what is known is old. */
  again(): void {
    this.kept = null;
    this.begin();
    this.later();
  }

  private later(): void {
    this.doc.planning.value = true;
    this.forget = later(SOON, () => this.run());
  }

  /** Whether the outcome of this very text is known. */
  private restored(): boolean {
    const { doc, kept, generation } = this;
    if (!kept || kept.text !== doc.text.value || kept.given !== JSON.stringify(doc.given.value)) return false;
    batch(() => {
      doc.planning.value = false;
      doc.refused.value = null;
      doc.wrong.value = null;
      doc.planned.value = kept.planned;
      doc.simulated.value = kept.simulated;
      doc.shown.value = kept.shown;
      doc.judged.value = kept.judged;
    });
    this.whenDrawn(generation);
    return true;
  }

  private begin(): void {
    this.generation++;
    this.changedAt = performance.now();
    this.control.abort();
    this.forget();
    batch(() => {
      this.doc.running.value = null;
      this.doc.stopped.value = false;
    });
  }

  /** Ends the simulation; the plan stays. */
  stop(): void {
    this.control.abort();
    batch(() => {
      this.doc.running.value = null;
      this.doc.stopped.value = true;
    });
  }

  close(): void {
    this.generation++;
    this.control.abort();
    this.forget();
  }

  /** A word of how far the simulation is. */
  progress(event: api.Events["progress"]): void {
    const { running } = this.doc;
    if (event.kind !== "simulate" || event.generation !== this.generation || !running.value) return;
    running.value = { ...running.value, share: event.of > 0 ? event.done / event.of : null };
  }

  private async run(): Promise<void> {
    const { doc } = this;
    const generation = this.generation;
    const control = (this.control = new AbortController());
    const text = doc.text.value;
    const question = { generation, file: doc.id, text, ...doc.given.value };
    const old = () => generation !== this.generation || control.signal.aborted;
    try {
      // While one types, the times of the programmed feeds do: those under the limits of the machine come with the simulation.
      const answer = await api.plan({ ...question, quick: true }, control.signal);
      if (old() || answer.state === "cancelled") return;
      const planned = answer.state === "done" ? keyedByText(answer, text) : answer;
      if (doc.kind === "program") void this.guess(question, control.signal);
      if (planned.state === "wrong" && doc.kind === "program") {
        // A simulation guesses the tools and the stock that nobody gives.
        await this.simulate(question, null, old, control.signal);
        return;
      }
      if (planned.state === "wrong") {
        batch(() => {
          doc.planning.value = false;
          doc.refused.value = null;
          doc.wrong.value = planned.error;
        });
        return;
      }
      const shown = await Shown.of(planned.scene, text, false);
      if (old()) return;
      batch(() => {
        doc.planning.value = false;
        doc.refused.value = null;
        doc.wrong.value = null;
        doc.simulated.value = null;
        doc.planned.value = planned;
        doc.shown.value = shown;
      });
      this.whenDrawn(generation);
      await new Promise((done) => setTimeout(done, REST));
      if (old()) return;
      await this.simulate(question, planned, old, control.signal);
    } catch (error) {
      if (old()) return;
      batch(() => {
        doc.planning.value = false;
        doc.running.value = null;
        doc.refused.value = error instanceof api.Refused ? error.message : error instanceof api.Gone ? null : String(error);
      });
    }
  }

  /** Asks what is guessed of a program that no job speaks of. */
  private async guess(question: api.Question, signal: AbortSignal): Promise<void> {
    const { doc } = this;
    if (doc.given.value.job !== undefined) {
      doc.guess.value = null;
      return;
    }
    try {
      const guess = await guessOf(question, signal);
      if (!signal.aborted) doc.guess.value = guess;
    } catch (error) {
      // The form goes without it; the plan tells what is wrong.
      if (!signal.aborted && !(error instanceof api.Refused || error instanceof api.Gone)) throw error;
    }
  }

  /** Tells when the new plan is on the screen. */
  private whenDrawn(generation: number): void {
    const from = this.changedAt;
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        if (generation !== this.generation) return;
        this.doc.drawnIn.value = performance.now() - from;
        const { dataset } = document.documentElement;
        dataset.drawn = String(generation);
        dataset.drawnMs = String(this.doc.drawnIn.value);
      }),
    );
  }

  private async simulate(question: api.Question, planned: api.Planned | null, old: () => boolean, signal: AbortSignal): Promise<void> {
    const { doc } = this;
    const steps: ("coarse" | "job")[] = planned && planned.coarse_step > planned.step ? ["coarse", "job"] : ["job"];
    for (const step of steps) {
      const coarse = step === "coarse";
      doc.running.value = { step: (coarse ? planned?.coarse_step : planned?.step) ?? null, coarse, share: null };
      const text = question.text ?? "";
      const answer = await api.simulate({ ...question, step }, signal);
      if (old() || answer.state === "cancelled") return;
      const simulated = answer.state === "done" ? keyedByText(answer, text) : answer;
      if (simulated.state === "wrong") {
        batch(() => {
          doc.running.value = null;
          doc.planning.value = false;
          doc.refused.value = null;
          doc.wrong.value = simulated.error;
        });
        return;
      }
      const shown = await Shown.of(simulated.scene, text, true);
      if (old()) return;
      batch(() => {
        doc.running.value = null;
        doc.planning.value = false;
        doc.refused.value = null;
        doc.wrong.value = null;
        doc.simulated.value = simulated;
        doc.shown.value = shown;
        if (coarse && steps.length > 1) return;
        const judged = { verdict: simulated.verdict, text, at: new Date(), step: simulated.step, result: simulated.result };
        doc.judged.value = judged;
        this.kept = { text, given: JSON.stringify(doc.given.value), planned, simulated, shown, judged };
      });
    }
  }
}
