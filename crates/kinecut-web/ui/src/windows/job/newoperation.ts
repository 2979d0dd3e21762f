// Tables that are added to a job: the keys that they must have, with the examples of the schema.
import { kinds } from "../../editor/complete";
import { type Form } from "../../schema/schema";
import { type Document } from "../../store/document";
import { jobSchema } from "../../store/session";
import { type Value, append } from "../../toml/edit";
import { type Path, at, plain } from "../../toml/parse";
import { apply } from "./change";

/** The keys that a table must have, with their examples. */
export function rowsOf(form: Form, type: string | null, tool: Value | undefined): [string, Value][] {
  const rows: [string, Value][] = type === null ? [] : [["type", type]];
  for (const key of form.own.required ?? []) {
    if (key === "type" && type !== null) continue;
    const example = key === "tool" && tool !== undefined ? tool : form.key(key)?.example;
    if (example !== undefined) rows.push([key, example as Value]);
  }
  if (form.key("tool") && !form.required("tool") && tool !== undefined && type !== "hole") rows.push(["tool", tool]);
  return rows;
}

/** The tool of the last operation of a setup that has one. */
export function lastTool(doc: Document, path: Path): Value | undefined {
  const all = plain(at(doc.tree.value, path));
  const last = Array.isArray(all) ? all.findLast((o: Record<string, unknown>) => o.tool !== undefined) : undefined;
  return (last as { tool?: Value } | undefined)?.tool;
}

/** Adds a table to a list of the text and chooses it; false where the text has no place for it. */
export function add(doc: Document, path: Path, rows: [string, Value][]): boolean {
  const made = append(doc.text.value, path, rows);
  if (!made) return false;
  apply(doc, [made.change]);
  doc.chosen.value = [...path, made.index];
  return true;
}

/** Adds an operation of a kind with some of its values; the others are examples. */
export function addOperation(doc: Document, setup: number, kind: string, values: [string, Value][]): boolean {
  const schema = jobSchema.value;
  const own = schema && kinds(schema).find(({ word }) => word === kind);
  if (!own) return false;
  const path: Path = ["setup", setup, "operation"];
  const rows = new Map(rowsOf(own.form, kind, lastTool(doc, path)));
  for (const [key, value] of values) rows.set(key, value);
  return add(doc, path, [...rows]);
}
