// What is shown of a figure: the paper's case or one's own, as printed or corrected.
import { type Signal, signal } from "@preact/signals";
import { type Figure, type Values, bounded } from "./model";

export interface State {
  own: Signal<Values>;
  mode: Signal<"paper" | "mine">;
  printed: Signal<boolean>;
  /** A field whose text is no number of it. */
  wrong: Signal<Record<string, string>>;
  /** Counts the resets: texts of fields begin anew. */
  again: Signal<number>;
}

const states = new Map<string, State>();

export function stateOf(figure: Figure): State {
  let state = states.get(figure.id);
  if (!state) {
    state = { own: signal({ ...figure.start }), mode: signal("paper"), printed: signal(false), wrong: signal({}), again: signal(0) };
    states.set(figure.id, state);
  }
  return state;
}

export function values(figure: Figure, state: State): Values {
  return state.mode.value === "paper" ? figure.start : state.own.value;
}

/** Changes inputs; they are one's own case then. */
export function change(figure: Figure, state: State, patch: Values): void {
  state.own.value = { ...values(figure, state), ...bounded(figure.fields, patch) };
  state.mode.value = "mine";
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
