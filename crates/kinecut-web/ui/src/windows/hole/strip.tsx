// The numbers of a hole: fields from the schema, those that one tries out with a slider.
import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { Form, type Schema } from "../../schema/schema";
import { type Document, keyOf } from "../../store/document";
import type { Path } from "../../toml/parse";
import type { Key } from "../../words/en";
import { t } from "../../words";
import { change, drop } from "../job/change";
import { Fields } from "../job/fields";
import { NumberField, NumbersField, SelectField } from "../job/field";
import { usePump } from "./pump";
import { numberOf, table } from "./question";

interface Shown {
  path: Path;
  label: Key;
  /** Least and most of its slider by the value that it has, and its step. */
  slide?: (value: number, cutter: number) => [number, number, number];
}

const around = (share: number, step: number) => (value: number): [number, number, number] => [step, Math.max(step, Math.ceil((share * value) / step) * step), step];

/** The fields in their order. */
export const FIELDS: Shown[] = [
  { path: ["operation", "diameter"], label: "hole.field.diameter", slide: (v, cutter) => [Math.ceil(cutter + 1), Math.ceil(2 * v), 1] },
  { path: ["tool", "diameter"], label: "hole.field.cutter", slide: around(2.4, 0.5) },
  { path: ["operation", "strategy"], label: "hole.field.strategy" },
  { path: ["operation", "direction"], label: "hole.field.direction" },
  { path: ["operation", "rough", "stepover"], label: "hole.field.stepover", slide: around(4, 0.1) },
  { path: ["operation", "rough", "engagement"], label: "hole.field.engagement" },
  { path: ["operation", "rough", "allowance"], label: "hole.field.allowance", slide: (v) => [0, Math.max(2, 2 * v), 0.05] },
  { path: ["operation", "rough", "feed"], label: "hole.field.roughFeed", slide: around(6, 100) },
  { path: ["operation", "finish", "turns"], label: "hole.field.turns", slide: () => [1, 8, 1] },
  { path: ["operation", "finish", "contact"], label: "hole.field.contact" },
  { path: ["operation", "finish", "feed"], label: "hole.field.finishFeed", slide: around(6, 100) },
  { path: ["operation", "finish", "start"], label: "hole.field.start" },
  { path: ["operation", "finish", "touch_angle"], label: "hole.field.touch" },
  { path: ["dynamics", "acceleration"], label: "hole.field.acceleration" },
  { path: ["dynamics", "jerk"], label: "hole.field.jerk" },
  { path: ["post", "control"], label: "hole.field.control" },
];

/** The controls that programs are written for. */
const CONTROLS = ["sinumerik-840d", "fanuc", "linuxcnc", "grbl", "heidenhain"];

/** Whether a field is seen: those of a pass that is left out are not, nor those that exclude what is given. */
function isSeen(doc: Document, path: Path): boolean {
  const operation = table(doc.values.value.operation);
  const [holder, pass, key] = path.map(String);
  if (holder !== "operation" || (pass !== "rough" && pass !== "finish")) return true;
  if (operation[pass] === undefined) return false;
  if (key === "engagement") return operation.strategy === "constant-engagement" || table(operation.rough).engagement !== undefined;
  if (key === "touch_angle") return table(operation.finish).start === undefined || table(operation.finish).touch_angle !== undefined;
  return true;
}

export function Strip({ doc, schema }: { doc: Document; schema: Schema }) {
  const root = new Form(schema, { $ref: "#/$defs/HoleTable" });
  const cutter = numberOf(table(doc.values.value.tool).diameter) ?? 0;
  return (
    <section class="panel strip" aria-label={t("hole.numbers")} tabIndex={-1} data-panel="numbers">
      {FIELDS.filter(({ path }) => isSeen(doc, path)).map((shown) => (
        <One key={keyOf(shown.path)} doc={doc} root={root} shown={shown} cutter={cutter} />
      ))}
    </section>
  );
}

/** The form that holds a key, also where its table is not written. */
function holderOf(root: Form, doc: Document, path: Path): Form | undefined {
  let form: Form | undefined = root;
  let value: unknown = doc.values.value;
  for (const step of path.slice(0, -1)) {
    value = table(value)[String(step)];
    form = form?.key(String(step))?.of(value);
  }
  return form;
}

function One({ doc, root, shown: { path, label, slide }, cutter }: { doc: Document; root: Form; shown: Shown; cutter: number }) {
  const key = String(path[path.length - 1]);
  const holder = holderOf(root, doc, path);
  const form = holder?.key(key);
  if (!form || !holder) return null;
  const of = { doc, path, form, label: t(label) };
  const optional = !holder.required(key);
  if (key === "start") return <NumbersField of={of} count={2} />;
  const words = key === "control" ? CONTROLS.map((word) => ({ word, about: "" })) : form.words;
  if (words) {
    const value = doc.value(path);
    const set = (word: string) => (word === "" ? drop(doc, path) : change(doc, path, word));
    return (
      <SelectField
        of={of}
        options={words.map(({ word, about }) => ({ value: word, label: word, about }))}
        value={typeof value === "string" ? value : ""}
        set={set}
        standard={optional || key === "control" ? (form.standard ?? CONTROLS[0]) : null}
      />
    );
  }
  return (
    <div class="slides">
      <NumberField of={of} optional={optional} />
      {slide && <Slider doc={doc} path={path} label={t(label)} bounds={slide} cutter={cutter} standard={form.standard} />}
    </div>
  );
}

interface SliderProps {
  doc: Document;
  path: Path;
  label: string;
  bounds: (value: number, cutter: number) => [number, number, number];
  cutter: number;
  standard: string | null;
}

function Slider({ doc, path, label, bounds, cutter, standard }: SliderProps) {
  const pump = usePump(doc);
  const value = numberOf(doc.value(path)) ?? Number(standard ?? NaN);
  // The bounds are those of the value that was found: they stay while one slides.
  const first = useRef(value);
  if (!Number.isFinite(value)) return null;
  const [low, high, step] = bounds(Number.isFinite(first.current) ? first.current : value, cutter);
  return (
    <input
      type="range"
      aria-label={t("hole.slider", { name: label })}
      min={Math.min(low, value)}
      max={Math.max(high, value)}
      step={step}
      value={value}
      onInput={(e) => {
        const next = Number(Number(e.currentTarget.value).toPrecision(10));
        pump(() => change(doc, path, next));
      }}
    />
  );
}

/** The keys of a table that have a field above. */
function above(...holder: string[]): string[] {
  return FIELDS.filter(({ path }) => path.length === holder.length + 1 && holder.every((step, i) => path[i] === step)).map(({ path }) => String(path[path.length - 1]));
}

/** All other keys of operation, passes, tool and machine. */
export function Rest({ doc, schema }: { doc: Document; schema: Schema }) {
  // Dozens of fields: they are made when they are looked at.
  const open = useSignal(false);
  const root = new Form(schema, { $ref: "#/$defs/HoleTable" });
  const shown = FIELDS.map(({ path }) => keyOf(path));
  const wrong = doc.wrong.value?.key;
  const operation = table(doc.values.value.operation);
  const passes = (["rough", "finish"] as const).filter((pass) => operation[pass] !== undefined);
  const one = (path: string[], title: string, without: string[] = [], leave?: string) => {
    const form = root.at(path, doc.values.value);
    if (!form) return null;
    return (
      <section key={path.join()} role="group" aria-label={title}>
        <h3>
          {title}
          {leave !== undefined && (
            <button class="small" onClick={() => drop(doc, path)}>
              {leave}
            </button>
          )}
        </h3>
        <Fields doc={doc} path={path} form={form} without={[...above(...path), ...without]} />
      </section>
    );
  };
  const isWrong = wrong !== undefined && !shown.includes(wrong);
  return (
    <details class="panel rest" open={isWrong || open.value} onToggle={(e) => (open.value = e.currentTarget.open)}>
      <summary>{t("drill.rest")}</summary>
      {(isWrong || open.value) && (
        <div class="form">
          {one(["operation"], t("drill.operation"), ["tool", ...passes])}
          {passes.map((pass) => one(["operation", pass], t(`hole.pass.${pass}`), [], passes.length > 1 ? t("hole.leaveOut") : undefined))}
          {one(["tool"], t("drill.tool"), ["type"])}
          {doc.values.value.dynamics !== undefined && one(["dynamics"], t("hole.machine"))}
        </div>
      )}
    </details>
  );
}
