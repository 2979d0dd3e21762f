// The program as a list that only holds the rows in sight, linked with the one cursor.
import { useComputed, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { programLine } from "../../app/go";
import { Name } from "../../app/verbatim";
import { type Document, keyOf } from "../../store/document";
import { runAt } from "../../store/runs";
import { cursor, place } from "../../store/session";
import { t } from "../../words";
import { chosenPath, runsOf } from "./items";
import { linesOf } from "./lines";

/** Height of a row [px], as in the style sheet. */
const ROW = 17;
const SPARE = 10;
/** Longest list a browser lays out [px]. */
const TALLEST = 8_000_000;

export function ProgramPanel({ doc }: { doc: Document }) {
  const list = useRef<HTMLDivElement>(null);
  const from = useSignal(0);
  const room = useSignal(40);
  const finding = useSignal(false);
  const work = doc.work.value;
  const track = doc.shown.value?.track ?? null;
  const lines = linesOf(work);
  const marks = useComputed(() => {
    const all = new Map<number, string>();
    const order = ["note", "warning", "doubt", "error"];
    for (const f of doc.findings.value) {
      const line = programLine(doc, f);
      if (line !== null && order.indexOf(f.severity) > order.indexOf(all.get(line) ?? "")) all.set(line, f.severity);
    }
    return all;
  }).value;
  const height = Math.min(TALLEST, lines.length * ROW);
  const scale = lines.length * ROW > TALLEST ? TALLEST / (lines.length * ROW) : 1;

  useEffect(() => {
    const box = list.current as HTMLDivElement;
    const look = () => {
      room.value = Math.ceil(box.clientHeight / ROW);
      from.value = Math.floor(box.scrollTop / scale / ROW);
    };
    const watch = new ResizeObserver(look);
    watch.observe(box);
    box.addEventListener("scroll", look, { passive: true });
    look();
    return () => {
      watch.disconnect();
      box.removeEventListener("scroll", look);
    };
  }, [scale]);

  const line = place.value.line;
  const toSight = (l: number) => {
    const box = list.current;
    if (!box || l < 0) return;
    const top = l * ROW * scale;
    if (top < box.scrollTop + ROW || top > box.scrollTop + box.clientHeight - 2 * ROW) box.scrollTop = top - box.clientHeight / 2;
  };
  useEffect(() => toSight(line), [line, work]);

  const go = (l: number) => track && l >= 0 && l < track.lines && cursor.go(track.ofLine(l), "program");
  const keys = (e: KeyboardEvent) => {
    const to = { ArrowDown: line + 1, ArrowUp: line - 1, PageDown: line + room.value, PageUp: line - room.value, Home: 0, End: lines.length - 1 }[e.key];
    if (to === undefined || e.ctrlKey || e.metaKey) return;
    e.preventDefault();
    go(Math.min(lines.length - 1, Math.max(0, to)));
  };
  /** Goes to the next line that has a text; tells whether there is one. */
  const search = (text: string): boolean => {
    const l = found(lines, text.toUpperCase(), Math.max(line, 0));
    if (l < 0) return false;
    go(l);
    toSight(l);
    return true;
  };
  const own = doc.kind === "program" ? [] : runsOf(work?.operations, chosenPath(doc));
  /** The block of the operation under the cursor. */
  const here = runAt(work?.operations, line);
  const chosen = keyOf(chosenPath(doc));
  useEffect(() => {
    // Who chooses an operation in the form sees its first line.
    if (own.length > 0 && here?.key !== chosen) toSight(own[0].from);
  }, [chosen, doc]);
  const program = work?.programs.findLast((p) => line < 0 ? p.first === 0 : p.first <= line) ?? work?.programs[0];
  const first = Math.max(0, from.value - SPARE);
  const last = Math.min(lines.length, from.value + room.value + SPARE);
  const top = scale === 1 ? first * ROW : (list.current?.scrollTop ?? 0) - (from.value - first) * ROW;
  const rows = [];
  for (let l = first; l < last; l++) {
    const inside = own.some((run) => run.from <= l && l < run.to);
    const piece = track && l < track.lines ? track.ofLine(l).piece : -1;
    const role = piece >= 0 ? track?.head.roles[track.role[piece]] : "none";
    const mark = marks.get(l);
    const number = l - (work?.programs.findLast((p) => p.first <= l)?.first ?? 0) + 1;
    const under = here !== undefined && here.from <= l && l < here.to;
    rows.push(
      <div key={l} class={`l${l === line ? " on" : inside ? " in" : ""}${under ? " block" : ""}`} data-line={l} onClick={() => go(l)}>
        <i>{number}</i>
        <em class={`role ${role}`} />
        <span class={mark ? `wave ${mark}` : undefined}>{colours(lines[l])}</span>
      </div>,
    );
  }
  return (
    <section class="panel pprog" aria-label={t("panel.program")} tabIndex={-1} data-panel="program">
      <header>
        <h2>{program ? <Name>{program.file}</Name> : t("panel.program")}</h2>
        {program && <span class="q">{t("program.lines", { control: program.control, n: program.lines })}</span>}
        <span class="sp" />
        {work && work.programs.length > 1 && (
          <select aria-label={t("program.which")} translate={false} value={program?.file} onChange={(e) => go(work.programs.find((p) => p.file === e.currentTarget.value)?.first ?? 0)}>
            {work.programs.map((p) => (
              <option key={p.file}>{p.file}</option>
            ))}
          </select>
        )}
        <button class="ghost" aria-expanded={finding.value} disabled={lines.length === 0} onClick={() => (finding.value = !finding.value)}>
          {t("program.find")}
        </button>
      </header>
      {finding.value && <FindBar search={search} />}
      <div class={`code${doc.wrong.value ? " dim" : ""}`} tabIndex={0} role="region" aria-label={t("program.text")} ref={list} onKeyDown={keys} translate={false}>
        {lines.length === 0 ? (
          <p class="q hint" translate={true}>
            {t("program.none")}
          </p>
        ) : (
          <div class="space" style={{ height: `${height}px` }}>
            <div class="rows" style={{ transform: `translateY(${top}px)` }}>
              {rows}
            </div>
          </div>
        )}
      </div>
    </section>
  );
}

/** The next line behind one that has a text, from the beginning on if need be; -1 for none. */
function found(lines: string[], what: string, from: number): number {
  if (what === "") return -1;
  for (let i = 1; i <= lines.length; i++) {
    const l = (from + i) % lines.length;
    if (lines[l].toUpperCase().includes(what)) return l;
  }
  return -1;
}

function FindBar({ search }: { search: (text: string) => boolean }) {
  const text = useSignal("");
  const missed = useSignal(false);
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => field.current?.focus(), []);
  return (
    <form
      class="find"
      onSubmit={(e) => {
        e.preventDefault();
        missed.value = !search(text.value);
      }}
    >
      <input aria-label={t("program.findWhat")} autocomplete="off" spellcheck={false} value={text.value} onInput={(e) => (text.value = e.currentTarget.value)} ref={field} />
      <button>{t("program.find")}</button>
      {missed.value && <span class="q">{t("program.notFound")}</span>}
    </form>
  );
}

/** Comments of a program are quiet. */
function colours(text: string) {
  const comment = /\([^)]*\)|;.*$/.exec(text);
  if (!comment) return text;
  return [text.slice(0, comment.index), <span class="cc">{comment[0]}</span>, text.slice(comment.index + comment[0].length)];
}
