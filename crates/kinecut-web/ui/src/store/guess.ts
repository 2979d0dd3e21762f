// What is guessed of a program that comes alone, as values: its stock and its tools.
import * as api from "../base/api";
import { parse, plain } from "../toml/parse";

export interface GuessedTool {
  number: number;
  type: string;
  diameter: number;
}

export interface Guess {
  /** A job with all of it, to be corrected. */
  job: string;
  /** Least and greatest corner [mm]; null where the moves tell none. */
  stock: number[] | null;
  tools: GuessedTool[];
}

/** Reads a guess; null where nothing tells the control. */
export async function guessOf(question: api.Question, signal: AbortSignal): Promise<Guess | null> {
  const answer = await api.guess(question, signal);
  if (answer.state !== "done") return null;
  const values = plain(parse(answer.job)) as { stock?: { box?: { min?: number[]; max?: number[] } }; tool?: GuessedTool[] };
  const { min, max } = values.stock?.box ?? {};
  // The text says by itself where the stock is to be filled in.
  const told = !/^# The stock is to be filled in/m.test(answer.job);
  return { job: answer.job, stock: told && min && max ? [...min, ...max] : null, tools: values.tool ?? [] };
}
