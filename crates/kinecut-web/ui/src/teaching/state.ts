// The part of a figure that is shown: the paper's case or one's own, as printed or corrected; of a figure that asks, the last inputs that have answers.
import { type Signal, signal } from "@preact/signals";
import { type Known, type Question, answerTo, ask, heldOf, hold, isAlone } from "./asked";
import { type Figure, type Values, bounded } from "./model";

export interface State {
  own: Signal<Values>;
  mode: Signal<"paper" | "mine">;
  printed: Signal<boolean>;
  /** A field whose text is no number of it. */
  wrong: Signal<Record<string, string>>;
  /** Counts the resets: texts of fields begin anew. */
  again: Signal<number>;
  /** Counts the answers that came. */
  came: Signal<number>;
  /** The last inputs that had all answers. */
  last: { v: Values; data: unknown[] } | null;
  asking: boolean;
  /** Inputs that nobody answered, and why. */
  silent: Signal<{ v: Values; why: string } | null>;
  /** Inputs whose answers are in a saved page. */
  saved: Values[];
}

/** Whether inputs are changed by an arrow key just now. */
export const byKey = { on: false };

export function stepped(change: () => void): void {
  byKey.on = true;
  change();
  byKey.on = false;
}

const states = new Map<string, State>();

export function stateOf(figure: Figure): State {
  let state = states.get(figure.id);
  if (!state) {
    state = { own: signal({ ...figure.start }), mode: signal("paper"), printed: signal(false), wrong: signal({}), again: signal(0), came: signal(0), last: null, asking: false, silent: signal(null), saved: [] };
    states.set(figure.id, state);
  }
  return state;
}

export function values(figure: Figure, state: State): Values {
  return state.mode.value === "paper" ? figure.start : state.own.value;
}

/** Changes inputs; they are one's own case then. A saved page goes to the nearest inputs that have answers, unless a number is typed. */
export function change(figure: Figure, state: State, patch: Values, typed = false): void {
  const from = values(figure, state);
  const to = { ...from, ...bounded(figure.fields, patch) };
  state.own.value = typed || !isAlone() || allKnown(figure, to) ? to : nearest(figure, state, from, to);
  state.mode.value = "mine";
}

/** Shows the paper's case or one's own; texts that are no numbers stay behind. */
export function show(state: State, mode: "paper" | "mine"): void {
  if (state.mode.value === mode) return;
  state.mode.value = mode;
  state.wrong.value = {};
  state.again.value++;
}

export function reset(figure: Figure, state: State): void {
  state.own.value = { ...figure.start };
  state.mode.value = "paper";
  state.printed.value = false;
  state.wrong.value = {};
  state.again.value++;
}

/** One's own inputs of the figures of a paper, to be kept in a file. */
export function kept(figures: Figure[]): string {
  const changed = figures.filter((f) => JSON.stringify(stateOf(f).own.value) !== JSON.stringify(f.start));
  return JSON.stringify(Object.fromEntries(changed.map((f) => [f.id, stateOf(f).own.value])));
}

/** Takes kept inputs back; what is not of a figure is left out. */
export function take(figures: Figure[], text: string): void {
  const all = JSON.parse(text) as Record<string, Values>;
  for (const figure of figures) {
    const own = all[figure.id];
    if (own) stateOf(figure).own.value = { ...figure.start, ...bounded(figure.fields, own) };
  }
}

function questions(figure: Figure, v: Values): Question[] {
  return figure.asks?.(v) ?? [];
}

/** Questions without whose answers nothing is drawn. */
function needed(figure: Figure, v: Values): Question[] {
  return questions(figure, v).filter((q) => !q.later);
}

function allKnown(figure: Figure, v: Values): boolean {
  return needed(figure, v).every((q) => answerTo(q));
}

/** What is drawn: inputs, answers, and how they are to those that are wanted. */
export interface View {
  v: Values;
  data: unknown[];
  /** `older`: of the inputs before; `waits`: nothing yet; `none`: these inputs have no answer, for the reason given; `unsaved`: not in this page. */
  is: "there" | "older" | "waits" | "none" | "unsaved" | "silent";
  why?: string;
  /** Whether a part of it has not been answered yet. */
  more?: boolean;
}

export function viewOf(figure: Figure, state: State): View {
  const v = values(figure, state);
  if (!figure.asks) return { v, data: [], is: "there" };
  void state.came.value;
  const wrong = needed(figure, v).map(answerTo).find((a): a is { wrong: string } => a !== undefined && "wrong" in a);
  if (wrong) return { v, data: [], is: "none", why: wrong.wrong };
  if (allKnown(figure, v)) {
    const answers = questions(figure, v).map(answerTo);
    const data = answers.map((a) => (a && "kept" in a ? a.kept : undefined));
    state.last = { v, data };
    return { v, data, is: "there", more: answers.some((a) => a === undefined) };
  }
  if (isAlone()) return { v, data: [], is: "unsaved" };
  const silent = state.silent.value;
  if (silent?.v === v) return { v, data: [], is: "silent", why: silent.why };
  return state.last ? { ...state.last, is: "older" } : { v, data: [], is: "waits" };
}

/** Asks for what is missing; the next questions go out when the answers to those before have come. */
export function pump(figure: Figure, state: State): void {
  const v = values(figure, state);
  if (!figure.asks || isAlone() || state.asking || state.silent.peek()?.v === v) return;
  const open = (allKnown(figure, v) ? questions(figure, v) : needed(figure, v)).filter((q) => !answerTo(q));
  if (open.length === 0) return;
  state.asking = true;
  void Promise.all(open.map((q, i) => ask(q, `figure ${figure.id} ${i}.toml`)))
    .then(
      () => (state.silent.value = null),
      (error: unknown) => (state.silent.value = { v, why: error instanceof Error ? error.message : String(error) }),
    )
    .finally(() => {
      state.asking = false;
      state.came.value++;
    });
}

/** Inputs whose answers a saved page holds: the paper's and one's own, and from each of both one input after another through its values. */
export function series(figure: Figure): Values[] {
  const state = stateOf(figure);
  const all = new Map<string, Values>();
  const add = (v: Values) => all.set(JSON.stringify(figure.fields.filter((f) => !f.free).map((f) => v[f.key])), v);
  for (const base of [state.own.value, figure.start]) {
    add(base);
    for (const v of figure.series?.(base) ?? []) add({ ...base, ...v });
    for (const field of figure.fields) {
      if (field.free || !(field.counts?.(base) ?? true)) continue;
      for (const value of field.options?.map((_, i) => i) ?? field.saved ?? []) add({ ...base, [field.key]: value });
    }
  }
  return [...all.values()];
}

/** Questions that are on their way at once while a page is saved. */
const AT_ONCE = 3;

/** Answers of a paper's figures, for a page that works alone; `told` hears how far it is. What a figure can be drawn without is asked for the paper's
 * case and one's own alone. */
export async function answersFor(figures: Figure[], told: (done: number, of: number) => void): Promise<string> {
  const saved = figures.filter((f) => f.asks).map((figure) => ({ figure, all: series(figure) }));
  const wanted = saved.flatMap(({ figure, all }) => {
    const bases = [stateOf(figure).own.value, figure.start];
    return [...bases.flatMap((v) => questions(figure, v)), ...all.flatMap((v) => needed(figure, v))];
  });
  let next = 0;
  const work = async (lane: number): Promise<void> => {
    while (next < wanted.length) {
      told(next, wanted.length);
      await ask(wanted[next++], `figure to be saved ${lane}.toml`);
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, (_, lane) => work(lane)));
  // Inputs without all answers are no inputs of the page.
  const inputs = Object.fromEntries(saved.map(({ figure, all }) => [figure.id, all.filter((v) => allKnown(figure, v))]));
  return JSON.stringify({ inputs, answers: heldOf(wanted) });
}

/** Takes the answers of a saved page. */
export function takeAnswers(figures: Figure[], text: string): void {
  const { inputs, answers } = JSON.parse(text) as { inputs: Record<string, Values[]>; answers: Record<string, Known> };
  for (const [key, answer] of Object.entries(answers)) hold(key, answer);
  for (const figure of figures) stateOf(figure).saved = inputs[figure.id] ?? [];
}

/** The saved inputs nearest to those that are wanted, in steps of the fields; a hand that moves does not stay where it is. */
function nearest(figure: Figure, state: State, from: Values, to: Values): Values {
  const asked = figure.fields.filter((f) => !f.free);
  const free = Object.fromEntries(figure.fields.filter((f) => f.free).map((f) => [f.key, to[f.key]]));
  const way = (a: Values, b: Values) => asked.map((f) => (b[f.key] - a[f.key]) / (f.options ? 0.001 : f.step));
  const wanted = way(from, to);
  let [best, found] = [Infinity, from];
  for (const v of state.saved) {
    const gone = way(from, v);
    if (gone.every((g) => g === 0) || gone.reduce((sum, g, i) => sum + g * wanted[i], 0) <= 0) continue;
    const away = Math.hypot(...way(to, v));
    if (away < best) [best, found] = [away, v];
  }
  // A hand that drags must come nearer to others than to where it began; a key goes to the next.
  return { ...(byKey.on || best < Math.hypot(...wanted) ? found : from), ...free };
}
