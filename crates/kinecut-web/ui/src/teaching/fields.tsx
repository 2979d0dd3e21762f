// The inputs of a figure: typed numbers and choices.
import { useSignal } from "@preact/signals";
import { evaluate } from "../base/number";
import { num, word } from "./language";
import { Symbol } from "./marks";
import type { Field, Figure } from "./model";
import { type State, change, stepped, values } from "./state";

export function Fields({ figure, state }: { figure: Figure; state: State }) {
  return (
    <div class="fields">
      {figure.fields.filter((field) => field.counts?.(values(figure, state)) ?? true).map((field) =>
        field.options ? <Choice key={field.key} figure={figure} state={state} field={field} /> : <Typed key={`${field.key}${state.again.value}`} figure={figure} state={state} field={field} />,
      )}
    </div>
  );
}

interface Props {
  figure: Figure;
  state: State;
  field: Field;
}

function Choice({ figure, state, field }: Props) {
  const now = values(figure, state)[field.key];
  const id = `tg-${figure.words}-${field.key}`;
  return (
    <div class="field choice">
      <label for={id}>{word(field.name)}</label>
      <select id={id} data-field={field.key} value={now} onChange={(e) => change(figure, state, { [field.key]: Number(e.currentTarget.value) })}>
        {field.options?.map((option, i) => (
          <option key={option} value={i} selected={i === now}>
            {word(option)}
          </option>
        ))}
      </select>
    </div>
  );
}

function Typed({ figure, state, field }: Props) {
  const draft = useSignal<string | null>(null);
  const now = values(figure, state)[field.key];
  const wrong = state.wrong.value[field.key];
  const id = `tg-${figure.words}-${field.key}`;
  const bounds = { min: num(field.min, field.digits, true), max: num(field.max, field.digits, true) };
  const typed = (text: string) => {
    draft.value = text;
    const n = evaluate(text);
    const { [field.key]: _, ...others } = state.wrong.value;
    if (n === null || n < field.min || n > field.max || (field.digits === 0 && !Number.isInteger(n))) {
      state.wrong.value = { ...others, [field.key]: text };
      return;
    }
    state.wrong.value = others;
    change(figure, state, { [field.key]: n }, true);
  };
  return (
    <div class={`field${wrong === undefined ? "" : " wrong"}`}>
      <label for={id}>
        <Symbol of={field.symbol} /> <span class="q">{word(field.name)}</span>
      </label>
      <span class="entry">
        <input
          id={id}
          data-field={field.key}
          inputMode="decimal"
          autocomplete="off"
          value={draft.value ?? num(now, field.digits, true)}
          aria-invalid={wrong !== undefined}
          aria-describedby={wrong === undefined ? undefined : `${id}-wrong`}
          onInput={(e) => typed(e.currentTarget.value)}
          onBlur={() => {
            if (state.wrong.value[field.key] === undefined) draft.value = null;
          }}
          onKeyDown={(e) => {
            const by = { ArrowUp: 1, ArrowDown: -1 }[e.key];
            if (by === undefined) return;
            e.preventDefault();
            draft.value = null;
            const { [field.key]: _, ...others } = state.wrong.value;
            state.wrong.value = others;
            stepped(() => change(figure, state, { [field.key]: now + by * field.step * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1) }));
          }}
        />
        <span class="unit q">{field.unit && word(field.unit)}</span>
      </span>
      {wrong !== undefined && (
        <p class="mistake" id={`${id}-wrong`}>
          {word(field.digits === 0 ? "field.whole" : "field.wrong", bounds)}
        </p>
      )}
    </div>
  );
}
