// The keys of a table as fields and sections, from the schema.
import { useMemo } from "preact/hooks";
import type { Form } from "../../schema/schema";
import { type Document, keyOf } from "../../store/document";
import type { Value } from "../../toml/edit";
import type { Path } from "../../toml/parse";
import { named, t } from "../../words";
import { change, drop } from "./change";
import { NumberField, NumbersField, type Option, RawField, SelectField, TextField } from "./field";
import { ordered } from "./order";

interface Props {
  doc: Document;
  path: Path;
  /** The form that the value has. */
  form: Form;
  /** Keys that are shown elsewhere. */
  without?: string[];
}

/** Longest default that is shown before one asks for more. */
const SHORT = 12;

function hasShortDefault(form: Form): boolean {
  const { kind, standard } = form;
  if (standard === null || kind === "table" || kind === "list" || kind === "map") return false;
  return standard.length <= SHORT || (form.kind === "number" && /^[-\d.]+(\s|$)/.test(standard) && standard.length <= 24);
}

/** All keys of a table: those that are given, needed or have a plain default; the others on demand. */
export function Fields({ doc, path, form, without = [] }: Props) {
  const here = keyOf(path);
  const word = form.key("type")?.own.const;
  const [first, more] = useMemo(() => {
    const given = doc.value(path);
    const there = typeof given === "object" && given !== null ? Object.keys(given) : [];
    const all = ordered(form.keys.filter((key) => !without.includes(key) && form.key(key)?.own.const === undefined));
    const shown = (key: string) => there.includes(key) || form.required(key) || hasShortDefault(form.key(key) as Form);
    return [all.filter(shown), all.filter((key) => !shown(key))];
  }, [here, word, form.own]);
  const one = (key: string) => <Value_ key={key} doc={doc} path={[...path, key]} form={form.key(key) as Form} optional={!form.required(key)} />;
  return (
    <>
      {scalarsFirst(first, form).map(one)}
      {more.length > 0 && (
        <details class="more">
          <summary>{t("form.more", { n: more.length })}</summary>
          {scalarsFirst(more, form).map(one)}
        </details>
      )}
    </>
  );
}

function scalarsFirst(keys: string[], form: Form): string[] {
  const isSection = (key: string) => form.key(key)?.of(undefined).kind === "table" && form.key(key)?.kind !== "choice";
  return [...keys.filter((key) => !isSection(key)), ...keys.filter(isSection)];
}

function Value_({ doc, path, form, optional }: { doc: Document; path: Path; form: Form; optional: boolean }) {
  const key = path[path.length - 1] as string;
  const label = named(key);
  const of = { doc, path, form, label };
  const { kind } = form;
  if (key === "tool" && kind === "choice") return <ToolField of={of} optional={optional} />;
  if (kind === "number" || kind === "whole") return <NumberField of={of} optional={optional} />;
  if (kind === "text") return <TextField of={of} optional={optional} numbers={false} />;
  if (kind === "truth") return <TruthField of={of} optional={optional} />;
  if (kind === "list") {
    const { item, length } = form;
    if (item.kind === "number" && length !== null && length <= 3) return <NumbersField of={of} count={length} />;
    return <RawField of={of} optional={optional} />;
  }
  if (kind === "table") return <Section doc={doc} path={path} form={form} optional={optional} label={label} />;
  if (kind === "choice" || kind === "word") return <ChoiceField of={of} optional={optional} />;
  return <RawField of={of} optional={optional} />;
}

function TruthField({ of, optional }: { of: { doc: Document; path: Path; form: Form; label: string }; optional: boolean }) {
  const { doc, path, form } = of;
  const value = doc.value(path);
  const options: Option[] = ["true", "false"].map((word) => ({ value: word, label: word }));
  const set = (word: string) => (word === "" ? drop(doc, path) : change(doc, path, word === "true"));
  return <SelectField of={of} options={options} value={value === undefined ? "" : String(value)} set={set} standard={optional ? (form.standard ?? "\u2013") : null} />;
}

function ToolField({ of, optional }: { of: { doc: Document; path: Path; form: Form; label: string }; optional: boolean }) {
  const { doc, path } = of;
  const all = doc.tools.value;
  if (all.length === 0) return <TextField of={of} optional={optional} numbers />;
  const value = doc.value(path);
  const byName = typeof value === "string";
  const options = all.map(({ number, name }) => ({ value: byName ? name : String(number), label: `T${number} ${name}` }));
  const set = (word: string) => (word === "" ? drop(doc, path) : change(doc, path, byName ? word : Number(word)));
  return <SelectField of={of} options={options} value={value === undefined ? "" : String(value)} set={set} standard={optional ? "\u2013" : null} />;
}

/** The word by which one of several forms is chosen. */
function choiceName(form: Form): string {
  const { kind } = form;
  if (kind === "word") return String(form.own.const);
  if (kind === "table") {
    const type = form.key("type")?.own.const;
    if (typeof type === "string") return type;
    return form.keys.length === 1 ? form.keys[0] : (form.own.required ?? form.keys).join(", ");
  }
  return kind;
}

function ChoiceField({ of, optional }: { of: { doc: Document; path: Path; form: Form; label: string }; optional: boolean }) {
  const { doc, path, form } = of;
  const value = doc.value(path);
  const { words } = form;
  if (words) {
    const options = words.map(({ word, about }) => ({ value: word, label: word, about }));
    const set = (word: string) => (word === "" ? drop(doc, path) : change(doc, path, word));
    return <SelectField of={of} options={options} value={value === undefined ? "" : String(value)} set={set} standard={optional ? (form.standard ?? "\u2013") : null} />;
  }
  const { choices } = form;
  const simple = choices.every((c) => c.kind === "number" || c.kind === "whole" || c.kind === "text");
  if (simple) return <TextField of={of} optional={optional} numbers />;
  const now = value === undefined ? null : form.of(value);
  const names = choices.map(choiceName);
  const chosen = now ? choiceName(now) : "";
  const set = (name: string) => {
    if (name === "") return drop(doc, path);
    const next = choices[names.indexOf(name)];
    if (next) change(doc, path, (next.example ?? (next.kind === "text" ? "" : 0)) as Value);
  };
  const options = choices.map((c, i) => ({ value: names[i], label: names[i].replaceAll("_", " "), about: c.own.description }));
  return (
    <>
      <SelectField of={of} options={options} value={chosen} set={set} standard={optional ? (form.standard ?? "\u2013") : null} />
      {now && value !== undefined && <Inner doc={doc} path={path} form={now} />}
    </>
  );
}

/** What a chosen form asks for, below its word. */
function Inner({ doc, path, form }: { doc: Document; path: Path; form: Form }) {
  if (form.kind === "word") return null;
  if (form.kind === "table") {
    // A table of one key is its word; what it asks for stands below.
    const only = form.keys.length === 1 ? form.key(form.keys[0]) : undefined;
    const way = [...path, form.keys[0]];
    const inner = only?.of(doc.value(way));
    return (
      <div class="inner">
        {only && inner?.kind === "table" ? <Fields doc={doc} path={way} form={inner} /> : <Fields doc={doc} path={path} form={form} />}
      </div>
    );
  }
  const of = { doc, path, form, label: named(String(path[path.length - 1])) };
  const field = form.kind === "number" || form.kind === "whole" ? <NumberField of={of} optional={false} /> : form.kind === "text" ? <TextField of={of} optional={false} numbers={false} /> : <RawField of={of} optional={false} />;
  return <div class="inner">{field}</div>;
}

function Section({ doc, path, form, optional, label }: Props & { optional: boolean; label: string }) {
  const value = doc.value(path);
  const there = value !== undefined;
  return (
    <section class="part" role="group" aria-label={label}>
      <h3 title={form.about.replaceAll("`", "")}>
        {label}
        <span class="sp" />
        {!there && (
          <button class="small" onClick={() => change(doc, path, (form.example ?? {}) as Value)}>
            {t("form.add")}
          </button>
        )}
        {there && optional && (
          <button class="small ghost icon" aria-label={t("form.take", { name: label })} title={t("form.take", { name: label })} onClick={() => drop(doc, path)}>
            <span aria-hidden="true">×</span>
          </button>
        )}
      </h3>
      {there && <Fields doc={doc} path={path} form={form.of(value)} />}
    </section>
  );
}
