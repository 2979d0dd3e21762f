// Completion of keys and values from the schema, with unit, need and example.
import { type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { shown } from "../schema/unit";
import { Form, type Schema, variants } from "../schema/schema";
import { write, type Value } from "../toml/edit";
import { type Path, at, parse, plain } from "../toml/parse";
import { t } from "../words";

/** Where in a text something is typed: the table, the keys within its line, and the key whose value it is. */
export interface Typed {
  path: Path;
  key: string | null;
  /** Where the word begins that is typed. */
  from: number;
}

/** Reads the header above and the braces of the line. */
export function typedAt(text: string, place: number): Typed {
  const path = headerPath(text, place);
  const start = text.lastIndexOf("\n", place - 1) + 1;
  const line = text.slice(start, place);
  const bare = line.replace(/"(?:[^"\\]|\\.)*"|'[^']*'/g, (s) => "x".repeat(s.length));
  let at = 0;
  let key: string | null = null;
  const open: { key: string | null; table: boolean }[] = [];
  for (let i = 0; i < bare.length; i++) {
    const c = bare[i];
    if (c === "=") {
      key = line.slice(at, i).trim().replace(/^["']|["']$/g, "");
      at = i + 1;
    } else if (c === "{" || c === "[") {
      open.push({ key, table: c === "{" });
      if (c === "{" && key !== null) path.push(...key.split("."));
      key = c === "{" ? null : key;
      at = i + 1;
    } else if (c === "}" || c === "]") {
      const last = open.pop();
      if (last?.table && last.key !== null) path.length -= last.key.split(".").length;
      key = last?.key ?? null;
      at = i + 1;
    } else if (c === ",") {
      if (open[open.length - 1]?.table) key = null;
      at = i + 1;
    }
  }
  const word = /["'\w-]*$/.exec(line.slice(at))?.[0] ?? "";
  return { path, key, from: place - word.length };
}

function headerPath(text: string, place: number): Path {
  const counts = new Map<string, number>();
  let path: Path = [];
  const end = text.lastIndexOf("\n", place - 1) + 1;
  for (const [, open, names] of text.slice(0, end).matchAll(/^[ \t]*(\[\[?)[ \t]*([^\]\n]+?)[ \t]*\]/gm)) {
    const keys = names.split(".").map((k) => k.trim().replace(/^["']|["']$/g, ""));
    path = [];
    keys.forEach((key, i) => {
      path.push(key);
      const known = path.join("\u0000");
      if (i + 1 === keys.length && open === "[[") {
        counts.set(known, (counts.get(known) ?? -1) + 1);
        // Lists within begin anew.
        for (const inner of counts.keys()) if (inner.startsWith(`${known}\u0000`)) counts.delete(inner);
      }
      const count = counts.get(known);
      if (count !== undefined) path.push(count);
    });
  }
  return path;
}

function info(form: Form): string {
  const example = form.example;
  const told = example === undefined ? "" : `\n${t("text.example", { example: write(example as Value) })}`;
  return form.about.replaceAll("`", "") + told;
}

export function completion(schema: () => Schema | null, tools: () => { number: number; name: string }[]) {
  return (context: CompletionContext): CompletionResult | null => {
    const root = schema();
    if (!root) return null;
    const text = context.state.doc.toString();
    const { path, key, from } = typedAt(text, context.pos);
    if (/^[ \t]*(#|\[)/.test(context.state.doc.lineAt(context.pos).text)) return null;
    const tree = parse(text);
    const values = plain(tree);
    const table = new Form(root, root).at(path, values);
    if (!table) return null;
    if (key === null) {
      if (!context.explicit && from === context.pos) return null;
      return { from, options: keysOf(table, plain(at(tree, path))), validFor: /^[\w-]*$/ };
    }
    const form = valueForm(table, key);
    if (!form) return null;
    const options = key === "tool" && path.includes("operation") ? toolsOf(tools()) : valuesOf(form);
    if (options.length === 0) return null;
    return { from, options, validFor: /^["'\w-]*$/ };
  };
}

/** The form of a key in any of the forms of a table; `type` has the words of all of them. */
function valueForm(table: Form, key: string): Form | undefined {
  return table.key(key);
}

function keysOf(table: Form, value: unknown): Completion[] {
  const there = typeof value === "object" && value !== null ? Object.keys(value) : [];
  return table.keys
    .filter((key) => !there.includes(key))
    .map((key) => {
      const form = table.key(key) as Form;
      const need = table.required(key);
      const unit = shown(form.unit);
      const example = form.example;
      const insert = example === undefined ? `${key} = ` : `${key} = ${write(example as Value)}`;
      return { label: key, type: "property", detail: [unit, need ? t("text.required") : ""].filter(Boolean).join(" · "), info: info(form), apply: insert, boost: need ? 5 : 0 };
    });
}

function valuesOf(form: Form): Completion[] {
  const words = form.words;
  if (words) return words.map(({ word, about }) => ({ label: `"${word}"`, type: "enum", info: about }));
  if (form.kind === "truth") return ["true", "false"].map((label) => ({ label, type: "keyword" }));
  const mixed = form.choices.flatMap((choice) => {
    if (choice.kind === "word") return [{ label: `"${String(choice.own.const)}"`, type: "enum", info: choice.about }];
    const example = choice.example;
    return example === undefined || example === "" ? [] : [{ label: write(example as Value), type: "text", detail: shown(choice.unit), info: choice.about }];
  });
  return mixed;
}

function toolsOf(tools: { number: number; name: string }[]): Completion[] {
  return tools.flatMap(({ number, name }) => [
    { label: String(number), type: "constant", detail: name },
    { label: write(name), type: "constant", detail: `T${number}` },
  ]);
}

/** The kinds of operations that there are. */
export function kinds(schema: Schema): { word: string; about: string; form: Form }[] {
  const setup = new Form(schema, schema).key("setup")?.item;
  const item = setup?.of({}).key("operation")?.item;
  if (!item) return [];
  return variants(item, "type").map(({ word, form }) => ({ word, about: form.own.description ?? "", form }));
}
