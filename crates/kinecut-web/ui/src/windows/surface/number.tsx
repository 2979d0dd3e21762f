// A field whose text goes to the verb as it is typed: a number, or a formula of numbers; or one of a number alone.
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { Said } from "../../app/verbatim";
import { evaluate } from "../../base/number";
import { t } from "../../words";

interface Props {
  id: string;
  label: ComponentChildren;
  name: string;
  /** What is typed; empty: the standard counts. */
  value: string;
  standard: string;
  unit?: string;
  put: (text: string) => void;
  wrong?: string | null;
}

/** One of the last decimal. */
function stepOf(text: string): number {
  return 10 ** -(/[.](\d+)/.exec(text)?.[1].length ?? 0);
}

/** A number of the page: what is none is told here, and changes nothing. */
export function PlainNumber({ value, set, wrong = null, ...rest }: Omit<Props, "value" | "put"> & { value: number | null; set: (n: number) => void }) {
  const draft = useSignal<{ text: string; of: number | null } | null>(null);
  // A text that is not finished stays until the number is another one.
  const typed = draft.value && draft.value.of === value ? draft.value.text : null;
  const bad = typed !== null && typed.trim() !== "" && evaluate(typed) === null;
  const put = (text: string) => {
    const n = text.trim() === "" ? 0 : evaluate(text);
    draft.value = { text, of: n ?? value };
    if (n !== null) set(n);
  };
  return <TextNumber {...rest} value={typed ?? (value === null ? "" : String(value))} put={put} wrong={bad ? t("form.wrongNumber") : wrong} />;
}

export function TextNumber({ id, label, name, value, standard, unit, put, wrong }: Props) {
  const key = (e: KeyboardEvent) => {
    if (e.key !== "ArrowUp" && e.key !== "ArrowDown") return;
    const now = value || standard;
    if (!/^-?\d*\.?\d+$/.test(now)) return;
    e.preventDefault();
    const by = stepOf(now) * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1) * (e.key === "ArrowUp" ? 1 : -1);
    put(String(Number((Number(now) + by).toPrecision(10))));
  };
  return (
    <div class={`num${wrong ? " wrong" : ""}`} data-number={id}>
      <label for={`sf-${id}`}>{label}</label>
      <span class="f">
        <input
          id={`sf-${id}`}
          aria-label={name}
          translate={false}
          inputMode="decimal"
          autocomplete="off"
          spellcheck={false}
          placeholder={standard}
          value={value}
          aria-invalid={wrong ? true : undefined}
          aria-describedby={wrong ? `sf-${id}-told` : undefined}
          onInput={(e) => put(e.currentTarget.value)}
          onKeyDown={key}
        />
        {unit && <small translate={false}>{unit}</small>}
      </span>
      {wrong && (
        <p class="told" id={`sf-${id}-told`}>
          <Said text={wrong} />
        </p>
      )}
    </div>
  );
}
