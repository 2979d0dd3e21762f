// Changes of a text that touch nothing but the value meant: comments, order and blanks stay.
import { type Entry, type List, type Node, type Path, type Table, at, parse } from "./parse";

/** A stretch of the text and what it becomes. */
export interface Change {
  from: number;
  to: number;
  insert: string;
}

export type Value = string | number | boolean | Value[] | { [key: string]: Value };

const BARE = /^[A-Za-z0-9_-]+$/;

/** A value as TOML writes it. */
export function write(value: Value): string {
  if (typeof value === "string") {
    const shown = value.replace(/[\u0000-\u001f\u007f"\\]/g, (c) => {
      if (c === '"' || c === "\\") return `\\${c}`;
      return `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`;
    });
    return `"${shown}"`;
  }
  if (typeof value === "number") return number(value);
  if (typeof value === "boolean") return String(value);
  if (Array.isArray(value)) return `[${value.map(write).join(", ")}]`;
  const entries = Object.entries(value);
  return entries.length === 0 ? "{}" : `{ ${entries.map(([k, v]) => `${name(k)} = ${write(v)}`).join(", ")} }`;
}

/** A number without an exponent where that is short enough, and without noise in its last digits. */
function number(n: number): string {
  const short = Number(n.toPrecision(12));
  const text = String(short);
  return text.includes("e") && Math.abs(short) >= 1e-9 && Math.abs(short) < 1e15 ? short.toFixed(12).replace(/0+$/, "").replace(/\.$/, "") : text;
}

function name(key: string): string {
  return BARE.test(key) ? key : write(key);
}

/** The change that gives a key its value; tables on the way are written inline. Null where the way is blocked by another value. */
export function set(text: string, path: Path, value: Value): Change | null {
  const root = parse(text);
  const known = at(root, path);
  if (known) return { from: known.from, to: known.to, insert: write(value) };
  // The deepest node that is there, and what is missing below it.
  let depth = path.length - 1;
  while (depth > 0 && !at(root, path.slice(0, depth))) depth--;
  const holder = at(root, path.slice(0, depth));
  const inner = path.slice(depth + 1).reduceRight<Value>((v, key) => (typeof key === "number" ? [v] : { [key]: v }), value);
  const key = path[depth];
  if (holder?.kind === "list" && typeof key === "number") return insertItem(holder, key, inner);
  if (holder?.kind !== "table" || typeof key !== "string") return null;
  return insertKey(text, holder, key, inner);
}

function insertItem(list: List, index: number, value: Value): Change | null {
  if (list.headed || index !== list.items.length) return null;
  const last = list.items[list.items.length - 1];
  const place = last ? last.to : list.from + 1;
  return { from: place, to: place, insert: (last ? ", " : "") + write(value) };
}

function insertKey(text: string, table: Table, key: string, value: Value): Change {
  const entry = `${name(key)} = ${write(value)}`;
  if (table.form === "inline") {
    const empty = table.entries.size === 0;
    return { from: table.end, to: table.end, insert: empty ? ` ${entry} ` : `, ${entry}` };
  }
  if (table.form === "dotted") {
    const first = [...table.entries.values()][0];
    const lineStart = text.lastIndexOf("\n", first.keyFrom) + 1;
    const before = text.slice(lineStart, first.keyFrom);
    const end = lineEnd(text, table.end);
    return { from: end, to: end, insert: `\n${before}${entry}` };
  }
  // Behind its own last line, before its inner tables; keys of the root come before the first header.
  if (table.form === "root" && ownEntries(table).length === 0) return { from: 0, to: 0, insert: `${entry}\n` };
  const end = lineEnd(text, table.form === "root" ? Math.max(...ownEntries(table).map(({ node }) => node.to)) : table.end);
  return { from: end, to: end, insert: `\n${indent(text, table)}${entry}` };
}

/** The entries that are lines of the table itself. */
function ownEntries(table: Table): Entry[] {
  return [...table.entries.values()].filter(({ node }) => !(node.kind === "table" && node.form === "header") && !(node.kind === "list" && node.headed));
}

function indent(text: string, table: Table): string {
  const own = ownEntries(table);
  const place = own.length > 0 ? own[own.length - 1].keyFrom : table.from;
  const start = text.lastIndexOf("\n", place - 1) + 1;
  return /^[ \t]*/.exec(text.slice(start, place))?.[0] ?? "";
}

function lineEnd(text: string, place: number): number {
  const end = text.indexOf("\n", place);
  return end < 0 ? text.length : end;
}

/** The change that takes a key or an item away, with the comment on its line; null where there is none. */
export function remove(text: string, path: Path): Change | null {
  const root = parse(text);
  const key = path[path.length - 1];
  const holder = at(root, path.slice(0, -1));
  const node = at(root, path);
  if (!node || !holder) return null;
  if (holder.kind === "list") {
    if (holder.headed) return removeSection(text, node);
    return removeBetween(holder.items, node.from, node.to, holder.from + 1, holder.to - 1);
  }
  if (holder.kind !== "table" || typeof key !== "string") return null;
  const entry = holder.entries.get(key) as Entry;
  if (holder.form === "inline") {
    const spans = [...holder.entries.values()].map((e) => ({ from: e.keyFrom, to: e.node.to }));
    return removeBetween(spans, entry.keyFrom, node.to, holder.from + 1, holder.to - 1);
  }
  if (node.kind === "table" && node.form === "header") return removeSection(text, node);
  const from = text.lastIndexOf("\n", entry.keyFrom - 1) + 1;
  const end = lineEnd(text, node.to);
  return { from, to: Math.min(text.length, end + 1), insert: "" };
}

function removeBetween(spans: { from: number; to: number }[], from: number, to: number, first: number, last: number): Change {
  const i = spans.findIndex((s) => s.from === from);
  if (spans.length === 1) return { from: first, to: last, insert: "" };
  // With the comma behind it, or the last one with that before it.
  return i + 1 < spans.length ? { from, to: spans[i + 1].from, insert: "" } : { from: spans[i - 1].to, to, insert: "" };
}

/** From the header, with the comments straight above it, up to the next header. */
function removeSection(text: string, node: Node): Change {
  let from = text.lastIndexOf("\n", node.from - 1) + 1;
  for (;;) {
    const start = text.lastIndexOf("\n", from - 2) + 1;
    if (from === 0 || !text.slice(start, from).trimStart().startsWith("#")) break;
    from = start;
  }
  let to = Math.min(text.length, lineEnd(text, node.to) + 1);
  while (text[to] === "\n") to++;
  // The last one takes the blank lines before it along.
  while (to === text.length && text[from - 1] === "\n" && text[from - 2] === "\n") from--;
  return { from, to, insert: "" };
}

/** The change that adds a table to a list of tables, behind the last one of the same parent. */
export function append(text: string, path: Path, rows: [string, Value][]): { change: Change; index: number } | null {
  const root = parse(text);
  const names = path.filter((step): step is string => typeof step === "string");
  const list = at(root, path);
  const body = [`[[${names.map(name).join(".")}]]`, ...rows.map(([k, v]) => `${name(k)} = ${write(v)}`)].join("\n");
  if (list && (list.kind !== "list" || !list.headed)) {
    if (list.kind !== "list") return null;
    const change = insertItem(list, list.items.length, Object.fromEntries(rows));
    return change && { change, index: list.items.length };
  }
  const parent = at(root, path.slice(0, -1));
  if (parent?.kind !== "table") return null;
  const last = list?.kind === "list" ? list.items[list.items.length - 1] : parent;
  const end = lineEnd(text, last.to);
  const before = end > 0 && text[end - 1] !== "\n" ? "\n\n" : "\n";
  return { change: { from: end, to: end, insert: `${before}${body}` }, index: list?.kind === "list" ? list.items.length : 0 };
}
