// One figure of the page: picture, inputs, numbers, explanation, the input to copy, the question for the class.
import { useSignal } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef } from "preact/hooks";
import { isAlone } from "./asked";
import { Fields } from "./fields";
import { type Key, has, num, word } from "./language";
import { Prose, Symbol } from "./marks";
import { type Drawing, type Figure, type Row, type Values, shown } from "./model";
import { type View, change, pump, reset, show, stateOf, values, viewOf } from "./state";

/** Widest picture [px]: as wide as a page of paper. */
const WIDEST = 700;

export function FigureView({ figure }: { figure: Figure }) {
  const state = stateOf(figure);
  const view = viewOf(figure, state);
  useEffect(() => pump(figure, state));
  const { v, data } = view;
  const isDrawn = view.is === "there" || view.is === "older";
  const mine = state.mode.value === "mine";
  const printed = state.printed.value;
  const wrong = isDrawn ? (figure.wrong?.(v, data) ?? null) : null;
  const warns = isDrawn && !wrong ? (figure.warns?.(v, data) ?? null) : null;
  const unread = Object.keys(state.wrong.value).length > 0;
  const rows = wrong || !isDrawn ? [] : figure.rows(v, data);
  const texts: Record<string, string> = isDrawn ? { ...figure.more?.(v, data) } : {};
  for (const f of figure.fields) texts[f.key] = texts[`${f.key}field`] = num(v[f.key], f.digits, true);
  for (const r of rows) {
    texts[r.key] = shown(r);
    texts[`${r.key}Printed`] = shown(r, r.printed ?? r.value);
  }
  const key = (end: string): Key => `${figure.words}.${end}` as Key;
  const sentence = wrong ? word(wrong, texts) : [key("says"), ...(warns ? [warns] : [])].map((k) => word(k, texts)).join(" ");
  const said = isDrawn ? sentence : reason(view);
  const differs = rows.some((r) => differing(r));
  const difference = !differs && has(key("agrees")) ? key("agrees") : key("differs");
  const heading = headingOf(figure);
  const paragraphs = ["p1", "p2", "p3", "p4"].map(key).filter(has);
  return (
    <article class="figure" id={`figure-${figure.id}`} data-figure={figure.id} data-is={view.is} data-more={view.more && !isAlone() ? "asked" : undefined} aria-labelledby={`title-${figure.id}`}>
      <header>
        <h2 id={`title-${figure.id}`}>
          <span class="no">{heading}</span> {word(key("title"))}
        </h2>
        <div class="switches">
          <div class="seg" role="group" aria-label={word("case.which")}>
            <button aria-pressed={!mine} data-case="paper" onClick={() => show(state, "paper")}>
              {word("case.paper")}
            </button>
            <button aria-pressed={mine} data-case="mine" onClick={() => show(state, "mine")}>
              {word("case.mine")}
            </button>
          </div>
          {figure.mistake && (
            <div class="seg" role="group" aria-label={word("printed.which")}>
              <button aria-pressed={!printed} data-printed="no" onClick={() => (state.printed.value = false)}>
                {word("printed.no")}
              </button>
              <button aria-pressed={printed} data-printed="yes" onClick={() => (state.printed.value = true)}>
                {word("printed.yes")}
              </button>
            </div>
          )}
          <button data-reset onClick={() => reset(figure, state)}>
            {word("case.reset")}
          </button>
        </div>
      </header>
      <div class="body">
        <figure>
          {isDrawn && (
            <Picture
              figure={figure}
              drawing={{ v, data, printed, rows: new Map(rows.map((r) => [r.key, r])), text: (row) => texts[row] ?? "–", set: (patch) => change(figure, state, patch), now: () => values(figure, state), id: figure.words, width: WIDEST }}
              said={said}
            />
          )}
          {view.is === "older" && <p class="older">{word("figure.older")}</p>}
          {!isDrawn && (
            <p class={view.is === "waits" ? "waits" : "sentence"} role="status">
              <Prose text={word(reasonKey(view))} /> {view.why && <span lang="en" translate={false}>{view.why}</span>}
            </p>
          )}
          {[wrong, warns, unread ? ("field.older" as const) : null].map(
            (told) =>
              told && (
                <p key={told} class="sentence" role="status" data-sentence={told}>
                  <Prose text={word(told, texts)} />
                </p>
              ),
          )}
          <figcaption>
            {!wrong && isDrawn && <Prose text={word(key("caption"), texts)} />} {figure.drawn ? word(figure.drawn) : word(figure.table ? "figure.drawnTable" : "figure.drawn", { after: figure.after })}
            {figure.asks ? ` ${word(isAlone() ? "figure.saved" : "figure.asked", { verb: verbsOf(figure, v), n: String(state.saved.length) })}` : isAlone() ? ` ${word("figure.computed")}` : ""}
          </figcaption>
        </figure>
        <div class="side">
          <h3>{word("side.inputs")}</h3>
          <Fields figure={figure} state={state} />
          <h3>{word("side.numbers")}</h3>
          <Numbers rows={rows} name={`${word("side.numbers")}: ${heading}`} />
        </div>
      </div>
      <div class="words">
        {figure.mistake && !wrong && isDrawn && <p class="differs">
            <Prose text={word(difference, texts)} />
          </p>}
        {isDrawn && paragraphs.map((p) => (
          <p key={p}>
            <Prose text={word(p, texts)} />
          </p>
        ))}
        {isDrawn && !wrong && figure.below?.(data)}
        <Copy text={figure.toml(v, data)} name={`${word("copy.what")}: ${heading}`} />
        <details class="ask">
          <summary>
            <b>{word("ask.head")}</b> <Prose text={word(key("ask"))} />
          </summary>
          <p>
            <Prose text={word(key("answer"), texts)} />
          </p>
        </details>
      </div>
    </article>
  );
}

/** Names of the verbs that answer, kept apart from the words round them. */
function verbsOf(figure: Figure, v: Values): string {
  return `\u2068${[...new Set(figure.asks?.(v).map((q) => q.verb))].join(", ")}\u2069`;
}

function reasonKey({ is }: View): Key {
  return is === "unsaved" ? "figure.unsaved" : is === "silent" ? "figure.silent" : is === "none" ? "figure.none" : "figure.waits";
}

function reason(view: View): string {
  return `${word(reasonKey(view))} ${view.why ?? ""}`.trim();
}

/** Whether the paper has another number, as far as digits are shown. */
function differing(row: Row): boolean {
  return row.printed !== undefined && shown(row) !== shown(row, row.printed);
}

/** Figure or table, with its number. */
export function headingOf({ id, table }: Figure): string {
  return word(table ? "figure.table" : "figure.no", { id: id.replace("T", "1") });
}

/** The picture, laid out for the width that there is. */
function Picture({ figure, drawing, said }: { figure: Figure; drawing: Drawing; said: string }) {
  const frame = useRef<HTMLDivElement>(null);
  const width = useSignal(0);
  useLayoutEffect(() => {
    const of = frame.current;
    if (!of) return;
    const fit = () => (width.value = Math.max(260, Math.min(WIDEST, Math.floor(of.clientWidth))));
    fit();
    const watch = new ResizeObserver(fit);
    watch.observe(of);
    return () => watch.disconnect();
  }, []);
  const { height, children } = figure.draw({ ...drawing, width: width.value || WIDEST });
  const w = width.value || WIDEST;
  return (
    <div class="frame" ref={frame}>
      <svg width={w} height={height} viewBox={`0 0 ${w} ${height}`} role="group" aria-label={said} class="picture">
        {children}
      </svg>
    </div>
  );
}

function Numbers({ rows, name }: { rows: Row[]; name: string }) {
  const printed = rows.some((r) => r.printed !== undefined);
  return (
    <div class="scroll" role="region" tabIndex={0} aria-label={name}>
      <table>
        <thead>
          <tr>
            <th scope="col">{word("numbers.symbol")}</th>
            <th scope="col">{word("numbers.name")}</th>
            <th scope="col" class="n">
              {word("numbers.value")}
            </th>
            {printed && (
              <th scope="col" class="n">
                {word("printed.yes")}
              </th>
            )}
            <th scope="col">{word("numbers.unit")}</th>
          </tr>
        </thead>
        <tbody>
          {rows.map((r) => (
            <tr key={r.key}>
              <th scope="row">
                <Symbol of={r.symbol} />
              </th>
              <td>{word(r.name)}</td>
              <td class="n" data-number={r.key} data-value={r.value}>
                {shown(r)}
              </td>
              {printed && (
                <td class="n" data-printed-number={r.key}>
                  {r.printed === undefined ? "" : differing(r) ? <s>{shown(r, r.printed)}</s> : shown(r, r.printed)}
                </td>
              )}
              <td>{r.unit ? word(r.unit) : ""}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Copy({ text, name }: { text: string; name: string }) {
  const copied = useSignal("");
  const field = useRef<HTMLElement>(null);
  return (
    <div class="copy">
      <span>{word("copy.what")}</span>
      <pre tabIndex={0} role="region" aria-label={name}>
        <code ref={field} translate={false} data-toml>
          {text}
        </code>
      </pre>
      <button
        data-copy
        onClick={() => {
          const done = () => (copied.value = text);
          // A page without a server may have no clipboard: the text is marked then, to be copied by hand.
          const mark = () => field.current && getSelection()?.selectAllChildren(field.current);
          if (navigator.clipboard) void navigator.clipboard.writeText(text).then(done, mark);
          else mark();
        }}
      >
        {copied.value === text ? word("copy.done") : word("copy.do")}
      </button>
    </div>
  );
}
