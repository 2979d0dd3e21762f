// Questions of figures whose numbers are answers of kinecut. In the workbench its server is asked; a page that is saved holds answers.

/** A question for a verb; `keep` takes from the answer what the figure draws and shows. */
export interface Question {
  verb: "grazing" | "drill" | "face" | "hole";
  flags?: Record<string, unknown>;
  text: string;
  /** A word for what is kept: figures may keep different things of one answer. */
  as: string;
  keep: (answer: never) => unknown;
  /** What is kept where kinecut has a finding in place of a result; without it the figure has none. */
  refused?: (code: string) => unknown;
  /** The figure is drawn without its answer, until that has come. */
  later?: boolean;
}

/** An answer as far as it is kept, or the reason why there is none. */
export type Known = { kept: unknown } | { wrong: string };

export type Ask = (verb: string, flags: Record<string, unknown>, text: string, name: string) => Promise<unknown>;

/** Answers that are kept in memory; a page that is saved keeps all it has. */
const MOST = 4000;

const known = new Map<string, Known>();
let asker: Ask | null = null;

/** Who answers; without one the page is alone. */
export function askedBy(ask: Ask): void {
  asker = ask;
}

export function isAlone(): boolean {
  return asker === null;
}

function keyOf({ verb, flags, text, as }: Question): string {
  return JSON.stringify([verb, flags ?? {}, as, text]);
}

export function answerTo(question: Question): Known | undefined {
  return known.get(keyOf(question));
}

export function hold(key: string, answer: Known): void {
  known.set(key, answer);
}

function findingOf(told: unknown): { message: string; code: string } | null {
  const of = told as { message?: unknown; code?: unknown; error?: { message?: unknown; code?: unknown } } | null;
  const finding = of?.error ?? of;
  return typeof finding?.message === "string" && typeof finding.code === "string" ? (finding as { message: string; code: string }) : null;
}

/** Asks, and holds the answer; `name` tells questions apart of which the newest counts. */
export async function ask(question: Question, name: string): Promise<Known | null> {
  const there = answerTo(question);
  if (there || !asker) return there ?? null;
  const told = await asker(question.verb, question.flags ?? {}, question.text, name);
  const finding = findingOf(told);
  let answer: Known;
  try {
    if (!finding) answer = { kept: question.keep(told as never) };
    else answer = question.refused ? { kept: question.refused(finding.code) } : { wrong: `${finding.code}: ${finding.message}` };
  } catch (error) {
    // An answer of another form, as that of a hole that cannot be drilled, tells its reason itself.
    if (!(error instanceof Told)) throw error;
    answer = { wrong: error.message };
  }
  while (known.size >= MOST) known.delete(known.keys().next().value as string);
  hold(keyOf(question), answer);
  return answer;
}

/** The reason of an answer that has no result. */
export class Told extends Error {}

/** Holds of the questions that are given, by their keys. */
export function heldOf(questions: Question[]): Record<string, Known> {
  return Object.fromEntries(questions.flatMap((q) => (answerTo(q) ? [[keyOf(q), answerTo(q) as Known]] : [])));
}

/** A number with no more digits than are drawn. */
export function short(n: number, digits = 3): number {
  return Number(n.toFixed(digits)) + 0;
}
