// One figure of the page: picture, inputs, numbers, explanation, the input to copy, the question for the class.
import { useSignal } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import { Fields } from "./fields";
import { type Key, has, num, word } from "./language";
import { Prose, Symbol } from "./marks";
import { type Drawing, type Figure, type Row, shown } from "./model";
import { change, reset, stateOf, values } from "./state";

/** Widest picture [px]: as wide as a page of paper. */
const WIDEST = 700;

export function FigureView({ figure }: { figure: Figure }) {
  const state = stateOf(figure);
  const v = values(figure, state);
  const mine = state.mode.value === "mine";
  const printed = state.printed.value;
  const wrong = figure.wrong?.(v) ?? null;
  const rows = wrong ? [] : figure.rows(v);
  const texts: Record<string, string> = {};
  for (const f of figure.fields) texts[f.key] = texts[`${f.key}field`] = num(v[f.key], f.digits, true);
  for (const r of rows) {
    texts[r.key] = shown(r);
    texts[`${r.key}Printed`] = shown(r, r.printed ?? r.value);
  }
  const key = (end: string): Key => `${figure.words}.${end}` as Key;
  const said = wrong ? word(wrong, texts) : word(key("says"), texts);
  const differs = rows.some((r) => differing(r));
  const difference = !differs && has(key("agrees")) ? key("agrees") : key("differs");
  const heading = headingOf(figure);
  const paragraphs = ["p1", "p2", "p3", "p4"].map(key).filter(has);
  return (
    <article class="figure" id={`figure-${figure.id}`} data-figure={figure.id} aria-labelledby={`title-${figure.id}`}>
      <header>
        <h2 id={`title-${figure.id}`}>
          <span class="no">{heading}</span> {word(key("title"))}
        </h2>
        <div class="switches">
          <div class="seg" role="group" aria-label={word("case.which")}>
            <button aria-pressed={!mine} data-case="paper" onClick={() => (state.mode.value = "paper")}>
              {word("case.paper")}
            </button>
            <button aria-pressed={mine} data-case="mine" onClick={() => (state.mode.value = "mine")}>
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
          <Picture figure={figure} drawing={{ v, printed, rows: new Map(rows.map((r) => [r.key, r])), text: (row) => texts[row] ?? "–", set: (patch) => change(figure, state, patch), id: figure.words, width: WIDEST }} said={said} />
          {wrong && (
            <p class="sentence" role="status">
              <Prose text={word(wrong, texts)} />
            </p>
          )}
          <figcaption>
            {!wrong && <Prose text={word(key("caption"), texts)} />} {word(figure.table ? "figure.drawnTable" : "figure.drawn", { after: figure.after })}
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
        {figure.mistake && !wrong && <p class="differs">
            <Prose text={word(difference, texts)} />
          </p>}
        {paragraphs.map((p) => (
          <p key={p}>
            <Prose text={word(p, texts)} />
          </p>
        ))}
        <Copy text={figure.toml(v)} name={`${word("copy.what")}: ${heading}`} />
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
