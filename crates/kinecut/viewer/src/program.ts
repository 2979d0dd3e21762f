// The program as a list that only holds the rows in sight, so that a hundred thousand lines stay fluent.
import { json } from "./decode";
import { type Listing, type Part, listing } from "./listing";
import type { Cursor, Place, Track } from "./track";
import { duration, millimetres } from "./words";

/** Height of a row [px], as in the style sheet. */
const ROW = 20;
/** Rows kept above and below those in sight. */
const SPARE = 12;
/** Longest list a browser lays out [px]; a longer program is reached through a list scaled to it. */
const TALLEST = 8_000_000;

export class ProgramList {
  private readonly list = document.getElementById("kc-list") as HTMLElement;
  private readonly current = document.getElementById("kc-line") as HTMLElement;
  private readonly rows = document.createElement("div");
  private readonly space = document.createElement("div");
  private readonly text: Listing;
  private readonly parts: Part[];
  private readonly tabs = document.getElementById("kc-tabs");
  private part!: Part;
  private readonly marks = new Map<number, string>();
  private from = -1;
  private to = -1;
  /** Height of the list and how far it is scrolled [px]: to ask the browser would make it lay out the page. */
  private room = 0;
  private scrolled = 0;

  constructor(private readonly track: Track, private readonly cursor: Cursor) {
    this.text = listing(track.head);
    this.parts = this.text.parts;
    this.part = this.parts[0] ?? { file: "", from: 0, to: 0 };
    this.showTabs();
    const order = ["note", "warning", "doubt", "error"];
    for (const [line, severity] of json<[number, string][]>("kc-marks")) {
      const known = this.marks.get(line);
      if (!known || order.indexOf(severity) > order.indexOf(known)) this.marks.set(line, severity);
    }
    this.space.className = "space";
    this.space.style.height = `${this.height}px`;
    this.rows.className = "rows";
    this.list.append(this.space, this.rows);
    this.list.addEventListener(
      "scroll",
      () => {
        this.scrolled = this.list.scrollTop;
        this.fill();
      },
      { passive: true },
    );
    new ResizeObserver(() => {
      this.room = this.list.clientHeight;
      this.fill();
    }).observe(this.list);
    this.room = this.list.clientHeight;
    this.list.addEventListener("click", (e) => {
      const row = (e.target as Element).closest<HTMLElement>("[data-row]");
      if (row) cursor.go(track.ofLine(Number(row.dataset.row)), "program");
    });
    this.list.addEventListener("keydown", (e) => this.key(e));
    cursor.listen((place, source) => this.follow(place, source));
    this.fill();
  }

  /** Lines of the program that is shown. */
  private get count(): number {
    return this.part.to - this.part.from;
  }

  private get height(): number {
    return Math.min(this.count * ROW, TALLEST);
  }

  /** The first line in sight, with fraction, among those of all programs. */
  private get top(): number {
    const whole = this.count * ROW;
    if (whole <= TALLEST) return this.part.from + this.scrolled / ROW;
    return this.part.from + ((this.scrolled / (TALLEST - this.room)) * (whole - this.room)) / ROW;
  }

  private scrollTo(line: number): void {
    const whole = this.count * ROW;
    const at = (line - this.part.from) * ROW;
    this.scroll(whole <= TALLEST ? at : (at / (whole - this.room)) * (TALLEST - this.room));
  }

  private scroll(to: number): void {
    this.scrolled = Math.max(0, Math.min(to, this.height - this.room));
    this.list.scrollTop = this.scrolled;
  }

  /** A tab for each program, where there are several. */
  private showTabs(): void {
    this.list.setAttribute("aria-label", this.parts.length > 1 ? `Program ${this.part.file}` : "Program");
    if (!this.tabs) return;
    this.tabs.replaceChildren(
      ...this.parts.map((part, i) => {
        const tab = document.createElement("button");
        tab.type = "button";
        tab.id = `kc-tab-${i}`;
        tab.textContent = part.file;
        tab.setAttribute("role", "tab");
        tab.setAttribute("aria-selected", String(part === this.part));
        tab.setAttribute("aria-controls", "kc-list");
        tab.addEventListener("click", () => this.show(part));
        return tab;
      }),
    );
  }

  /** Shows another program from its beginning. */
  private show(part: Part): void {
    if (part === this.part) return;
    this.part = part;
    this.showTabs();
    this.space.style.height = `${this.height}px`;
    this.scroll(0);
    this.fill(true);
  }

  private fill(force = false): void {
    const top = this.top;
    const count = Math.ceil(this.room / ROW) + 1;
    const from = Math.max(this.part.from, Math.floor(top) - SPARE);
    const to = Math.min(this.part.to, Math.floor(top) + count + SPARE);
    const shift = this.scrolled + (from - top) * ROW;
    this.rows.style.transform = `translateY(${shift}px)`;
    if (!force && from === this.from && to === this.to) return;
    this.from = from;
    this.to = to;
    const rows: HTMLElement[] = [];
    for (let l = from; l < to; l++) rows.push(this.row(l));
    this.rows.replaceChildren(...rows);
  }

  private row(line: number): HTMLElement {
    const row = document.createElement("div");
    row.id = `kc-row-${line}`;
    row.dataset.row = String(line);
    row.setAttribute("role", "option");
    row.setAttribute("aria-posinset", String(line - this.part.from + 1));
    row.setAttribute("aria-setsize", String(this.count));
    const here = line === this.cursor.place.line;
    row.setAttribute("aria-selected", String(here));
    const span = (name: string, text: string) => {
      const s = document.createElement("span");
      s.className = name;
      s.textContent = text;
      row.append(s);
      return s;
    };
    span("number", String(line - this.part.from + 1));
    const mark = this.marks.get(line);
    const sign = span(`mark ${mark ?? ""}`, mark === "error" ? "✕" : mark === "doubt" ? "?" : mark === "warning" ? "!" : mark === "note" ? "i" : "");
    if (mark) sign.title = mark;
    const piece = this.track.ofLine(line).piece;
    const role = piece < 0 ? "" : this.track.head.roles[this.track.role[piece]];
    const tick = span(`role ${role}`, "");
    if (role) tick.title = role;
    // Comments step back: ( ... ) and from ; to the end.
    const code = span("text", "");
    for (const bit of this.text.line(line).split(/(\([^)]*\)?|;.*$)/)) {
      if (!bit) continue;
      const s = document.createElement("span");
      if (bit[0] === "(" || bit[0] === ";") s.className = "comment";
      s.textContent = bit;
      code.append(s);
    }
    return row;
  }

  private follow(place: Place, source: string): void {
    const own = this.parts.find((part) => place.line >= part.from && place.line < part.to);
    if (own) this.show(own);
    const top = this.top;
    const seen = this.room / ROW;
    if (place.line >= 0 && source !== "program" && (place.line < top + 1 || place.line > top + seen - 2)) {
      this.scrollTo(Math.max(0, place.line - seen / 2));
    }
    if (source === "keys") {
      if (place.line < top) this.scrollTo(place.line);
      else if (place.line > top + seen - 1) this.scrollTo(place.line - seen + 1);
    }
    this.fill();
    for (const row of this.rows.children) {
      row.setAttribute("aria-selected", String(Number((row as HTMLElement).dataset.row) === place.line));
    }
    this.list.setAttribute("aria-activedescendant", `kc-row-${place.line}`);
    const { lineTime, lineLength, head, role, tool } = this.track;
    const words = [`line ${place.line - this.part.from + 1}`];
    if (this.parts.length > 1) words.unshift(this.part.file);
    if (place.piece >= 0) {
      words.push(head.roles[role[place.piece]]);
      const number = head.tools[tool[place.piece]]?.number;
      if (number !== undefined) words.push(`T${number}`);
    } else {
      words.push("no motion");
    }
    if (lineLength[place.line] > 0) words.push(`${millimetres(lineLength[place.line])} mm`);
    if (lineTime[place.line] > 0) words.push(lineTime[place.line] < 10 ? `${millimetres(lineTime[place.line])} s` : duration(lineTime[place.line]));
    this.current.textContent = words.join(" · ");
  }

  private key(e: KeyboardEvent): void {
    const page = Math.max(1, Math.floor(this.list.clientHeight / ROW) - 1);
    const here = this.cursor.place.line;
    const to: Record<string, number> = {
      ArrowDown: here + 1, ArrowUp: here - 1, PageDown: here + page, PageUp: here - page, Home: this.part.from, End: this.part.to - 1,
    };
    if (!(e.key in to) || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    this.cursor.go(this.track.ofLine(Math.min(this.text.count - 1, Math.max(0, to[e.key]))), "keys");
  }
}
