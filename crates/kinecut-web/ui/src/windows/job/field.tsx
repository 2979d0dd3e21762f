// One value of the job as a field: a number with its unit, a word of several, a text, a list.
import { useSignal } from "@preact/signals";
import type { ComponentChildren, LabelHTMLAttributes } from "preact";
import { evaluate } from "../../base/number";
import { type Form } from "../../schema/schema";
import { shown } from "../../schema/unit";
import { type Document, keyOf, rangeOf } from "../../store/document";
import type { Value } from "../../toml/edit";
import { type Path, at, parse, plain } from "../../toml/parse";
import { t, typed, unit as unitText } from "../../words";
import { Said } from "../../app/verbatim";
import { change, drop } from "./change";

export interface Of {
  doc: Document;
  path: Path;
  form: Form;
  label: string;
}

/** The sentence of what is wrong with a value; the same finding is under it in the text. */
function wrongOf(doc: Document, path: Path): { text: string; severity: string } | null {
  const key = keyOf(path);
  const node = at(doc.tree.value, path);
  const text = doc.text.value;
  for (const finding of doc.findings.value) {
    if (finding.severity === "note") continue;
    if (finding.key !== undefined && finding.key !== "") {
      if (finding.key === key) return { text: finding.message, severity: finding.severity };
      continue;
    }
    const range = node && rangeOf(finding, doc.name, text, doc.tree.value);
    if (node?.kind === "leaf" && range && range.from >= node.from && range.to <= node.to && range.to > range.from) return { text: finding.message, severity: finding.severity };
  }
  return null;
}

/** A label with its field; `wrong` stands below. */
export function Row({ of, wrong, children, extra }: { of: Of; wrong?: string | null; children: ComponentChildren; extra?: LabelHTMLAttributes<HTMLLabelElement> }) {
  const { doc, path, label, form } = of;
  const id = `f-${keyOf(path)}`;
  const differs = JSON.stringify(doc.value(path)) !== JSON.stringify(plain(at(doc.savedTree.value, path)));
  const told = wrong ? { text: wrong, severity: "error" } : wrongOf(doc, path);
  return (
    <div class={`row${told ? " wrong" : ""}`} data-key={keyOf(path)}>
      <label for={id} title={form.about.replaceAll("`", "")} {...extra}>
        {label}
        {differs && <i class="dot" title={t("form.changed")} />}
        {differs && <span class="sr">{t("form.changed")}</span>}
      </label>
      {children}
      {told && (
        <p class={`told ${told.severity}`} id={`${id}-told`}>
          {wrong ? wrong : <Said text={told.text} />}
        </p>
      )}
    </div>
  );
}

/** The step of arrow keys and of dragging: one of the last decimal. */
function stepOf(text: string): number {
  const decimals = /[.,](\d+)/.exec(text)?.[1].length ?? 0;
  return 10 ** -decimals;
}

interface NumberProps {
  value: unknown;
  standard: string | null;
  unit: string;
  whole: boolean;
  id: string;
  name: string;
  set: (n: number) => void;
  clear: (() => void) | null;
  invalid: (text: string | null) => void;
  told: boolean;
  /** What the standard is. */
  standardIs?: "form.default" | "form.guessedField";
}

/** A field of a number: arrows step, Shift tenfold, Alt a tenth; sums are worked out. */
export function NumberInput({ value, standard, unit, whole, id, name, set, clear, invalid, told, standardIs = "form.default" }: NumberProps) {
  const draft = useSignal<string | null>(null);
  const text = value === undefined ? "" : typeof value === "object" ? JSON.stringify(value) : String(value);
  const plainStandard = standard !== null && /^[-\d.]+/.test(standard) ? (/^[-\d.]*\d/.exec(standard)?.[0] ?? "") : (standard ?? "");
  const take = (entry: string, final: boolean) => {
    if (entry.trim() === "") {
      if (clear && value !== undefined) clear();
      invalid(null);
      return;
    }
    const simple = /^\s*[-+\u2212]?\d*[.,]?\d+\s*$/.test(entry);
    if (!simple && !final) return;
    const n = evaluate(entry);
    if (n === null || (whole && !Number.isInteger(n))) {
      if (final || simple) invalid(whole ? t("form.wrongWhole") : t("form.wrongNumber"));
      return;
    }
    invalid(null);
    if (n !== value) set(n);
  };
  const step = (by: number) => {
    const now = typeof value === "number" ? value : (evaluate(plainStandard) ?? 0);
    const next = Number((now + by).toPrecision(12));
    draft.value = null;
    invalid(null);
    set(whole ? Math.round(next) : next);
  };
  return (
    <span class={`f${value === undefined ? " def" : ""}`}>
      <input
        id={id}
        aria-label={value === undefined && standard !== null ? t(standardIs, { name }) : name}
        aria-invalid={told || undefined}
        aria-describedby={told ? `${id}-told` : undefined}
        inputMode="decimal"
        autocomplete="off"
        spellcheck={false}
        placeholder={typed(plainStandard)}
        title={value === undefined && standard !== null ? t(standardIs, { name }) : undefined}
        value={draft.value ?? typed(text)}
        onInput={(e) => {
          draft.value = e.currentTarget.value;
          take(draft.value, false);
        }}
        onBlur={() => {
          if (draft.value === null) return;
          take(draft.value, true);
          draft.value = null;
        }}
        onKeyDown={(e) => {
          if (e.key === "Enter" && draft.value !== null) {
            take(draft.value, true);
            draft.value = null;
          }
          if (e.key !== "ArrowUp" && e.key !== "ArrowDown") return;
          e.preventDefault();
          const by = stepOf(text === "" ? plainStandard : text) * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1);
          step(e.key === "ArrowUp" ? by : -by);
        }}
      />
      {unit && <u translate={false}>{unitText(unit)}</u>}
    </span>
  );
}

function dragged(value: unknown, set: (n: number) => void): LabelHTMLAttributes<HTMLLabelElement> {
  if (typeof value !== "number") return {};
  return {
    class: "drags",
    onPointerDown: (e) => {
      const label = e.currentTarget;
      const from = e.clientX;
      const step = stepOf(String(value));
      let moved = false;
      const move = (to: PointerEvent) => {
        const steps = Math.round((to.clientX - from) / 4);
        if (steps === 0 && !moved) return;
        moved = true;
        set(Number((value + steps * step * (to.shiftKey ? 10 : 1)).toPrecision(12)));
      };
      const up = () => {
        label.removeEventListener("pointermove", move);
        label.removeEventListener("pointerup", up);
        label.removeEventListener("pointercancel", up);
      };
      label.setPointerCapture(e.pointerId);
      label.addEventListener("pointermove", move);
      label.addEventListener("pointerup", up);
      label.addEventListener("pointercancel", up);
    },
  };
}

export function NumberField({ of, optional }: { of: Of; optional: boolean }) {
  const { doc, path, form, label } = of;
  const invalid = useSignal<string | null>(null);
  const value = doc.value(path);
  const id = `f-${keyOf(path)}`;
  const set = (n: number) => change(doc, path, n);
  const told = invalid.value !== null || wrongOf(doc, path) !== null;
  return (
    <Row of={of} wrong={invalid.value} extra={dragged(value, set)}>
      <NumberInput
        value={value}
        standard={form.standard}
        unit={shown(form.unit, doc.values.value.units === "in")}
        whole={form.kind === "whole"}
        id={id}
        name={label}
        set={set}
        clear={optional ? () => drop(doc, path) : null}
        invalid={(text) => (invalid.value = text)}
        told={told}
      />
    </Row>
  );
}

/** Two or three numbers: a point, a box's corner. */
export function NumbersField({ of, count }: { of: Of; count: number }) {
  const { doc, path, label } = of;
  const invalid = useSignal<string | null>(null);
  const value = doc.value(path);
  const given = Array.isArray(value) ? value : [];
  const axes = count <= 3 ? ["X", "Y", "Z"] : Array.from({ length: count }, (_, i) => String(i + 1));
  const id = `f-${keyOf(path)}`;
  const set = (i: number, n: number) => {
    if (given[i] !== undefined) change(doc, [...path, i], n);
    else change(doc, path, Array.from({ length: count }, (_, k) => (k === i ? n : typeof given[k] === "number" ? given[k] : 0)));
  };
  return (
    <Row of={of} wrong={invalid.value}>
      <span class="numbers">
        {Array.from({ length: count }, (_, i) => (
          <NumberInput
            key={i}
            value={given[i]}
            standard={null}
            unit={axes[i]}
            whole={false}
            id={i === 0 ? id : `${id}-${i}`}
            name={t("form.axis", { name: label, axis: axes[i] })}
            set={(n) => set(i, n)}
            clear={null}
            invalid={(text) => (invalid.value = text)}
            told={invalid.value !== null}
          />
        ))}
      </span>
    </Row>
  );
}

export interface Option {
  value: string;
  label: string;
  about?: string;
}

export function SelectField({ of, options, value, set, standard }: { of: Of; options: Option[]; value: string; set: (value: string) => void; standard: string | null }) {
  const { doc, path, label } = of;
  const id = `f-${keyOf(path)}`;
  const told = wrongOf(doc, path) !== null;
  const known = options.some((o) => o.value === value);
  return (
    <Row of={of}>
      <span class={`f${value === "" ? " def" : ""}`}>
        <select id={id} aria-label={label} aria-invalid={told || undefined} value={value} translate={false} onChange={(e) => set(e.currentTarget.value)}>
          {(value === "" || standard !== null) && <option value="">{standard ?? "\u2013"}</option>}
          {!known && value !== "" && <option value={value}>{value}</option>}
          {options.map((o) => (
            <option key={o.value} value={o.value} title={o.about}>
              {o.label}
            </option>
          ))}
        </select>
      </span>
    </Row>
  );
}

/** A text, or a number or a text. */
export function TextField({ of, optional, numbers }: { of: Of; optional: boolean; numbers: boolean }) {
  const { doc, path, form, label } = of;
  const value = doc.value(path);
  const id = `f-${keyOf(path)}`;
  const draft = useSignal<string | null>(null);
  const told = wrongOf(doc, path) !== null;
  const take = (typed: string) => {
    if (typed === "" && optional) drop(doc, path);
    else change(doc, path, numbers && /^[-+]?\d+(\.\d+)?$/.test(typed.trim()) ? Number(typed) : typed);
  };
  return (
    <Row of={of}>
      <span class={`f text${value === undefined ? " def" : ""}`}>
        <input
          id={id}
          aria-label={label}
          aria-invalid={told || undefined}
          aria-describedby={told ? `${id}-told` : undefined}
          autocomplete="off"
          spellcheck={false}
          placeholder={form.standard ?? ""}
          value={draft.value ?? (value === undefined ? "" : String(value))}
          onInput={(e) => {
            draft.value = e.currentTarget.value;
            take(draft.value);
          }}
          onBlur={() => (draft.value = null)}
        />
      </span>
    </Row>
  );
}

/** What has no field of its own, as TOML writes it. */
export function RawField({ of, optional }: { of: Of; optional: boolean }) {
  const { doc, path, form, label } = of;
  const node = at(doc.tree.value, path);
  const id = `f-${keyOf(path)}`;
  const draft = useSignal<string | null>(null);
  const invalid = useSignal<string | null>(null);
  const text = node ? doc.text.value.slice(node.from, node.to) : "";
  const take = (typed: string, final: boolean) => {
    if (typed.trim() === "" && optional) {
      drop(doc, path);
      return;
    }
    const read = at(parse(`x = ${typed.replace(/\n/g, " ")}`), ["x"]);
    const whole = read && read.to === typed.replace(/\n/g, " ").trimEnd().length + 4;
    if (whole) {
      invalid.value = null;
      change(doc, path, plain(read) as Value, typed.trim());
    } else if (final) {
      const example = form.example;
      invalid.value = t("form.wrongList", { example: JSON.stringify(example ?? []) });
    }
  };
  const told = invalid.value !== null || wrongOf(doc, path) !== null;
  return (
    <Row of={of} wrong={invalid.value}>
      <span class={`f text${node ? "" : " def"}`}>
        <input
          id={id}
          class="mono"
          aria-label={label}
          aria-invalid={told || undefined}
          aria-describedby={told ? `${id}-told` : undefined}
          autocomplete="off"
          spellcheck={false}
          value={draft.value ?? text}
          onInput={(e) => {
            draft.value = e.currentTarget.value;
            take(draft.value, false);
          }}
          onBlur={() => {
            if (draft.value === null) return;
            take(draft.value, true);
            draft.value = null;
          }}
        />
      </span>
    </Row>
  );
}
