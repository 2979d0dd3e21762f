// Questions of one kind: the newest counts, and an older one is given up.
import type { Finding } from "../../base/api";

/** The verb's word for work that is no longer wanted. */
const CANCELLED = "KC0009";

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
    try {
      const answer = await question(control.signal, ++this.generation);
      return control.signal.aborted || (isFinding(answer) && answer.code === CANCELLED) ? null : answer;
    } catch (error) {
      if (control.signal.aborted) return null;
      throw error;
    }
  }

  stop(): void {
    this.control?.abort();
  }
}
