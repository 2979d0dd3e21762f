// Questions of one kind: the newest counts, and an older one is given up.
import { type Finding, Refused } from "../../base/api";
import { counted } from "../../base/open";

/** The verb's word for work that is no longer wanted. */
const CANCELLED = "KC0009";

/** Times that a question is asked again while the server is busy or has given it up, and the time between [ms]. */
const MOST = 50;
const PAUSE = 200;

/** Whether an answer is what is wrong with the question. */
export function isFinding(answer: unknown): answer is Finding {
  return typeof answer === "object" && answer !== null && "severity" in answer && "message" in answer;
}

export class Newest {
  private control: AbortController | null = null;
  private generation = 0;

  /** The answer; null where a newer question has been asked since. */
  async ask<T>(question: (signal: AbortSignal, generation: number) => Promise<T>): Promise<T | null> {
    this.control?.abort();
    const control = new AbortController();
    this.control = control;
    for (let again = 0; ; again++) {
      try {
        const answer = await question(control.signal, ++this.generation);
        if (control.signal.aborted) return null;
        // The server gives up what is older about the same thing, also where another part of the page has asked since: that is asked again.
        if (!(isFinding(answer) && answer.code === CANCELLED) || again === MOST) return answer;
      } catch (error) {
        if (control.signal.aborted) return null;
        // Drawings of a gallery may fill the server's queue; the newest question waits for its turn.
        if (!(error instanceof Refused && error.reason === "busy") || again === MOST) throw error;
      }
      await counted(new Promise((done) => setTimeout(done, PAUSE)));
      if (control.signal.aborted) return null;
    }
  }

  stop(): void {
    this.control?.abort();
  }
}
