// Reads TOML with the place of every key and value. It goes on after a mistake at the next line, because a text is wrong most of
// the time while it is typed; the server says what is wrong.

export interface Leaf {
  kind: "leaf";
  value: string | number | boolean;
  from: number;
  to: number;
}

export interface List {
  kind: "list";
  /** Whether its items are written as `[[name]]`. */
  headed: boolean;
  items: Node[];
  from: number;
  to: number;
}

export interface Entry {
  key: string;
  keyFrom: number;
  keyTo: number;
  node: Node;
}

export interface Table {
  kind: "table";
  form: "root" | "header" | "inline" | "dotted";
  entries: Map<string, Entry>;
  /** From the header or brace up to the end of the last line that belongs to it or to its inner tables. */
  from: number;
  to: number;
  /** Where another key would be written: the end of its own last line, or of its last inline entry. */
  end: number;
}

export type Node = Leaf | List | Table;
export type Path = (string | number)[];

class Wrong extends Error {}

const BARE = /[A-Za-z0-9_-]/;
const ESCAPES: Record<string, string> = { b: "\b", t: "\t", n: "\n", f: "\f", r: "\r", '"': '"', "\\": "\\", e: "\u001b" };

function table(form: Table["form"], from: number, to = from): Table {
  return { kind: "table", form, entries: new Map(), from, to, end: to };
}

class Reader {
  at = 0;

  constructor(readonly text: string) {}

  get done(): boolean {
    return this.at >= this.text.length;
  }

  peek(n = 0): string {
    return this.text[this.at + n] ?? "";
  }

  /** Skips blanks; with `lines` also comments and line ends. */
  skip(lines: boolean): void {
    for (;;) {
      const c = this.peek();
      if (c === " " || c === "\t" || (lines && (c === "\n" || c === "\r"))) this.at++;
      else if (lines && c === "#") this.toLineEnd();
      else return;
    }
  }

  toLineEnd(): void {
    const end = this.text.indexOf("\n", this.at);
    this.at = end < 0 ? this.text.length : end;
  }

  want(c: string): void {
    if (this.peek() !== c) throw new Wrong();
    this.at++;
  }

  /** One key, bare or quoted. */
  key(): { key: string; from: number; to: number } {
    const from = this.at;
    if (this.peek() === '"' || this.peek() === "'") {
      const key = String(this.string());
      return { key, from, to: this.at };
    }
    while (BARE.test(this.peek())) this.at++;
    if (this.at === from) throw new Wrong();
    return { key: this.text.slice(from, this.at), from, to: this.at };
  }

  /** Keys with dots between them. */
  keys(): { key: string; from: number; to: number }[] {
    const all = [this.key()];
    for (;;) {
      const before = this.at;
      this.skip(false);
      if (this.peek() !== ".") {
        this.at = before;
        return all;
      }
      this.at++;
      this.skip(false);
      all.push(this.key());
    }
  }

  string(): string {
    const quote = this.peek();
    const long = this.text.startsWith(quote.repeat(3), this.at);
    this.at += long ? 3 : 1;
    // A line end straight behind the quotes is none of the text.
    if (long && this.text.startsWith("\r\n", this.at)) this.at += 2;
    else if (long && this.peek() === "\n") this.at++;
    let out = "";
    for (;;) {
      if (this.done) throw new Wrong();
      const c = this.peek();
      if (!long && c === "\n") throw new Wrong();
      if (long ? this.text.startsWith(quote.repeat(3), this.at) : c === quote) {
        this.at += long ? 3 : 1;
        return out;
      }
      this.at++;
      if (c !== "\\" || quote === "'") {
        out += c;
        continue;
      }
      const end = long ? /^[ \t]*\r?\n\s*/.exec(this.text.slice(this.at)) : null;
      if (end) {
        this.at += end[0].length;
        continue;
      }
      const e = this.peek();
      this.at++;
      if (e === "u" || e === "U") {
        const length = e === "u" ? 4 : 8;
        const code = Number.parseInt(this.text.slice(this.at, this.at + length), 16);
        this.at += length;
        out += Number.isNaN(code) || code > 0x10ffff ? "\ufffd" : String.fromCodePoint(code);
      } else {
        out += ESCAPES[e] ?? "";
      }
    }
  }

  value(): Node {
    const from = this.at;
    const c = this.peek();
    if (c === '"' || c === "'") return { kind: "leaf", value: this.string(), from, to: this.at };
    if (c === "[") return this.list();
    if (c === "{") return this.inline();
    const word = /[A-Za-z0-9_+\-.:]/;
    while (word.test(this.peek())) this.at++;
    const raw = this.text.slice(from, this.at);
    if (raw === "") throw new Wrong();
    return { kind: "leaf", value: scalar(raw), from, to: this.at };
  }

  private list(): List {
    const from = this.at++;
    const items: Node[] = [];
    for (;;) {
      this.skip(true);
      if (this.peek() === "]") break;
      items.push(this.value());
      this.skip(true);
      if (this.peek() === ",") this.at++;
      else if (this.peek() !== "]") throw new Wrong();
    }
    this.at++;
    return { kind: "list", headed: false, items, from, to: this.at };
  }

  private inline(): Table {
    const out = table("inline", this.at++);
    out.end = this.at;
    for (;;) {
      this.skip(true);
      if (this.peek() === "}") break;
      const keys = this.keys();
      this.skip(true);
      this.want("=");
      this.skip(true);
      put(out, keys, this.value());
      out.end = this.at;
      this.skip(true);
      if (this.peek() === ",") this.at++;
      else if (this.peek() !== "}") throw new Wrong();
    }
    this.at++;
    out.to = this.at;
    return out;
  }
}

function scalar(raw: string): string | number | boolean {
  if (raw === "true" || raw === "false") return raw === "true";
  const plain = raw.replaceAll("_", "");
  if (/^[+-]?inf$/.test(plain)) return plain[0] === "-" ? -Infinity : Infinity;
  const number = /^[+-]?(\d+(\.\d+)?([eE][+-]?\d+)?|0x[0-9a-fA-F]+|0o[0-7]+|0b[01]+)$/.test(plain) ? Number(plain) : NaN;
  return Number.isNaN(number) ? raw : number;
}

/** Writes an entry under keys with dots. */
function put(into: Table, keys: { key: string; from: number; to: number }[], node: Node): void {
  let at = into;
  for (const { key, from, to } of keys.slice(0, -1)) {
    const known = at.entries.get(key)?.node;
    if (known?.kind === "table") {
      at = known;
    } else {
      const next = table("dotted", from, node.to);
      at.entries.set(key, { key, keyFrom: from, keyTo: to, node: next });
      at = next;
    }
    at.to = Math.max(at.to, node.to);
    at.end = node.to;
  }
  const last = keys[keys.length - 1];
  at.entries.set(last.key, { key: last.key, keyFrom: last.from, keyTo: last.to, node });
}

/** The table a header names; `again` for one more item of a list of tables. */
function headed(root: Table, keys: { key: string; from: number; to: number }[], again: boolean, from: number, to: number): Table[] {
  const way = [root];
  let at = root;
  keys.forEach(({ key, from: keyFrom, to: keyTo }, i) => {
    const last = i + 1 === keys.length;
    let entry = at.entries.get(key);
    if (!entry) {
      const node: Node = last && again ? { kind: "list", headed: true, items: [], from, to } : table("header", from, to);
      entry = { key, keyFrom, keyTo, node };
      at.entries.set(key, entry);
    }
    const { node } = entry;
    if (node.kind === "list") {
      if (last && again && node.headed) node.items.push(table("header", from, to));
      const item = node.items[node.items.length - 1];
      if (item?.kind !== "table") throw new Wrong();
      node.to = Math.max(node.to, to);
      at = item;
    } else if (node.kind === "table") {
      at = node;
    } else {
      throw new Wrong();
    }
    way.push(at);
  });
  at.end = to;
  return way;
}

/** Reads a text; what cannot be read is left out. */
export function parse(text: string): Table {
  const reader = new Reader(text);
  const root = table("root", 0);
  /** The table whose lines are read, with those around it. */
  let way = [root];
  const grow = (to: number) => {
    for (const t of way) t.to = Math.max(t.to, to);
  };
  while (!reader.done) {
    reader.skip(true);
    if (reader.done) break;
    const start = reader.at;
    try {
      if (reader.peek() === "[") {
        const again = reader.peek(1) === "[";
        reader.at += again ? 2 : 1;
        reader.skip(false);
        const keys = reader.keys();
        reader.skip(false);
        reader.want("]");
        if (again) reader.want("]");
        way = headed(root, keys, again, start, reader.at);
        grow(reader.at);
      } else {
        const keys = reader.keys();
        reader.skip(false);
        reader.want("=");
        reader.skip(false);
        put(way[way.length - 1], keys, reader.value());
        way[way.length - 1].end = reader.at;
        grow(reader.at);
      }
      reader.skip(false);
      if (reader.peek() === "#") reader.toLineEnd();
      else if (!reader.done && reader.peek() !== "\n" && reader.peek() !== "\r") throw new Wrong();
    } catch (error) {
      if (!(error instanceof Wrong)) throw error;
      // A value may have run over line ends: the next line after the beginning is tried.
      reader.at = start;
      reader.toLineEnd();
      const own = way[way.length - 1];
      own.end = Math.max(own.end, reader.at);
      grow(reader.at);
    }
  }
  root.to = text.length;
  return root;
}

/** The node at a path; undefined where there is none. */
export function at(root: Node | undefined, path: Path): Node | undefined {
  let node = root;
  for (const key of path) {
    if (typeof key === "number") node = node?.kind === "list" ? node.items[key] : undefined;
    else node = node?.kind === "table" ? node.entries.get(key)?.node : undefined;
  }
  return node;
}

/** A node as plain values. */
export function plain(node: Node | undefined): unknown {
  if (!node) return undefined;
  if (node.kind === "leaf") return node.value;
  if (node.kind === "list") return node.items.map(plain);
  return Object.fromEntries([...node.entries].map(([key, entry]) => [key, plain(entry.node)]));
}

/** The path to the innermost key or item about a place of the text. */
export function pathAt(root: Table, place: number): Path {
  const path: Path = [];
  let node: Node = root;
  for (;;) {
    let next: { step: string | number; node: Node } | undefined;
    if (node.kind === "table") {
      for (const { key, keyFrom, node: child } of node.entries.values()) {
        const from = child.kind === "leaf" || child.from > keyFrom ? Math.min(keyFrom, child.from) : child.from;
        // Of several lists of tables that run through one another the one whose item holds the place is meant.
        if (child.kind === "list" && child.headed) {
          const index = child.items.findIndex((item) => item.from <= place && place <= item.to);
          if (index >= 0) next = { step: key, node: child };
        } else if (from <= place && place <= child.to) {
          next = { step: key, node: child };
        }
      }
    } else if (node.kind === "list") {
      const index: number = node.items.findIndex((item) => item.from <= place && place <= item.to);
      if (index >= 0) next = { step: index, node: node.items[index] };
    }
    if (!next) return path;
    path.push(next.step);
    node = next.node;
  }
}
