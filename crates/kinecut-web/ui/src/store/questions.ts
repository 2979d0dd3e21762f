// Questions of one verb: each kind has a window of its own, in which its texts are tabs.
import type { ComponentType } from "preact";
import type { Finding, VerbQuestion } from "../base/api";
import type { Key } from "../words/en";
import type { Document } from "./document";

/** An answer, with the text it is of. */
export interface Answered {
  answer: unknown;
  text: string;
  at: Date;
  /** The page of the same text; null before it has come, or where its kind asks for none. */
  page: string | null;
}

/** A text to begin with. */
export interface Begin {
  /** The command that opens it; its text names the button too. */
  command: Key;
  /** Name of the file that is made of it. */
  stem: string;
  text: string;
}

/** A kind of question, by the verb that answers it. */
export interface QuestionKind {
  /** Marks its window and its buttons in the page. */
  name: string;
  /** Whether the values of a text are a question of this kind. */
  isOf(values: Record<string, unknown>): boolean;
  /** Asks; a finding where the text as a whole is wrong. */
  ask(question: VerbQuestion, signal: AbortSignal): Promise<{ answer: unknown } | { wrong: Finding }>;
  /** Asks for the page of the text, once the numbers have rested; an empty text where there is none. */
  page?(question: VerbQuestion, signal: AbortSignal): Promise<string>;
  /** The findings of an answer. */
  findings(answer: unknown): Finding[];
  Window: ComponentType<{ doc: Document }>;
  begin?: Begin;
}

const all: QuestionKind[] = [];

/** Makes a kind known; the first that takes a text has it. */
export function answers(kind: QuestionKind): void {
  all.push(kind);
}

export function kindOf(values: Record<string, unknown>): QuestionKind | null {
  return all.find((kind) => kind.isOf(values)) ?? null;
}

/** The kinds that a text can be begun of. */
export function beginnings(): (QuestionKind & { begin: Begin })[] {
  return all.filter((kind): kind is QuestionKind & { begin: Begin } => kind.begin !== undefined);
}
