// The window of face milling with the least burr.
import { fixed } from "../../base/format";
import { Name, Said } from "../../app/verbatim";
import { t } from "../../words";
import { Acts, Looks } from "./acts";
import { Certificate, Wrong } from "./certificate";
import { Graph } from "./graph";
import { face } from "./open";
import { Picture } from "./picture";
import { Settings, Weights } from "./settings";
import { Start } from "./start";
import type { Face } from "./state";
import { outlineOf } from "./question";
import { middle, short } from "./shape";
import { Method, Ways } from "./ways";

export function FaceWindow() {
  const of = face.value;
  if (!of) return <Start />;
  return (
    <main class="facing" key={of.name}>
      <Head of={of} />
      {of.refused.value && (
        <p class="across" role="alert">
          <Said text={of.refused.value} />
        </p>
      )}
      {of.leastWrong.value && (
        <div class="across" role="alert">
          <Wrong message={of.leastWrong.value.message} help={of.leastWrong.value.help} />
        </div>
      )}
      <Facts of={of} />
      <div class="cols">
        <div class="stack">
          <section class="panel" aria-label={t("face.part")} tabIndex={-1} data-panel="part">
            <header>
              <h2>{t("face.part")}</h2>
              <span class="q">{t("face.partHow")}</span>
              <span class="sp" />
              <Looks face={of} />
            </header>
            <Picture face={of} />
            <Legend of={of} />
            <Numbers of={of} />
          </section>
          <Settings face={of} />
          <Weights face={of} />
        </div>
        <div class="stack">
          <section class="panel" aria-label={t("face.graph")} tabIndex={-1} data-panel="graph">
            <header>
              <h2>{t("face.graph")}</h2>
              {of.map.value && of.map.value.text !== of.text.value && <span class="tag np">{t("face.older")}</span>}
              <span class="sp" />
              <span class="q">{t("face.graphHow")}</span>
              {of.comparing.value && !of.map.value && <span class="waits" />}
            </header>
            <Graph face={of} />
          </section>
          <Certificate face={of} />
          <Ways face={of} />
          <Method face={of} />
        </div>
      </div>
      <Notes of={of} />
    </main>
  );
}

function Head({ of }: { of: Face }) {
  const least = of.least.value?.answer;
  const drawing = outlineOf(of.text.value);
  return (
    <div class="head">
      <h1>
        <Name>{least?.title ?? of.name}</Name>
      </h1>
      {least && <span class="q">{t("face.about", { name: drawing ?? of.name, n: least.outline.loops.length, mm: fixed(least.outline.perimeter, 1) })}</span>}
      <Acts face={of} />
    </div>
  );
}

function Facts({ of }: { of: Face }) {
  const least = of.least.value?.answer;
  const placed = of.placed.value;
  const optimum = of.optimum.value;
  const stale = of.least.value !== null && of.least.value.text !== of.text.value;
  const way = placed?.answer?.ways[placed.answer.chosen];
  const guard = placed?.answer?.guard ?? 0;
  const beyond = placed?.answer && short(placed.answer.outline, placed.hand.turn, middle(placed.answer.outline, placed.hand.turn) + placed.hand.beside, placed.answer.cutter.radius - placed.answer.margin) > 1e-6;
  const withGuard = least && least.guard > 0 && <small>{t("face.withTheGuard", { deg: fixed(least.guard, 1) })}</small>;
  const late = of.late.value || (placed !== null && placed.text !== of.text.value);
  const at = placed && t("face.at", { turn: fixed(placed.hand.turn, 2), mm: fixed(placed.hand.beside, 2) });
  return (
    <dl class="facts">
      <div data-fact="hand" data-late={late || undefined}>
        <dt>
          {t("face.underHand")} {late && <span class="tag np">{t("face.older")}</span>}
        </dt>
        {way ? (
          <dd>
            <b class={way.bad > 0 ? "bad" : ""}>{t("face.mmBad", { mm: fixed(way.bad, 1) })}</b>
            <small>{late ? at : t("face.ofExits", { mm: fixed(way.exits, 1) })}</small>
            {beyond && <small class="np">{t("face.beyondMargin", { mm: fixed(placed?.answer?.margin ?? 0, 2) })}</small>}
            {guard > 0 && <small>{t("face.guardedBad", { mm: fixed(way.guarded, 1), deg: fixed(guard, 1) })}</small>}
          </dd>
        ) : placed ? (
          <dd>
            <b>{t("face.impossible")}</b>
            <small>{placed.wrong && <Said text={placed.wrong.message} />}</small>
          </dd>
        ) : (
          <dd>
            <b>{t("face.notKnown")}</b>
          </dd>
        )}
      </div>
      <div data-fact="least">
        <dt>
          {t(optimum?.complete ? "face.least" : "face.leastSoFar")} {stale && <span class="tag np">{t("face.older")}</span>}
        </dt>
        <dd>
          {optimum ? (
            <>
              <b>{t("face.mm", { mm: fixed(optimum.value, 3) })}</b>
              <small>{t("face.at", { turn: fixed(optimum.placement.turn, 2), mm: fixed(of.handOf(optimum.placement).beside, 2) })}</small>
              {withGuard}
            </>
          ) : (
            <b>{t(least && !stale ? "face.leastNone" : "face.notKnown")}</b>
          )}
        </dd>
      </div>
      <div data-fact="drawn">
        <dt>{t("face.asDrawn")}</dt>
        <dd>
          {least?.as_drawn ? (
            <>
              <b>{t("face.mm", { mm: fixed(least.guard > 0 ? least.as_drawn.guarded : least.as_drawn.bad, 1) })}</b>
              <small>{t("face.drawnAt")}</small>
              {withGuard}
            </>
          ) : (
            <b>{least ? t("face.drawnNot") : t("face.notKnown")}</b>
          )}
        </dd>
      </div>
      <div data-fact="pass">
        <dt>{t("face.pass")}</dt>
        <dd>
          {way && placed?.answer ? (
            <>
              <b>{t("face.seconds", { s: fixed(way.time, 1) })}</b>
              <small>{t("face.speeds", { n: fixed(placed.answer.cutter.spindle_speed, 0), feed: fixed(placed.answer.cutter.feed, 0) })}</small>
            </>
          ) : (
            <b>{t("face.notKnown")}</b>
          )}
        </dd>
      </div>
    </dl>
  );
}

function Legend({ of }: { of: Face }) {
  const answer = of.placed.value?.answer ?? of.least.value?.answer;
  const bad = answer?.bad_exit_angles.map((b) => `${fixed(b.from, 0)}° – ${fixed(b.to, 0)}°`).join(", ") ?? "";
  const off = answer?.outline.edges.some((e) => e.weight === 0);
  const sample = (name: string) => (
    <svg width="30" height="8" aria-hidden="true">
      <path class={name} d="M0 4h30" />
    </svg>
  );
  return (
    <div class="key">
      <span>
        {sample("ex-bad")}
        {t("face.keyBad", { bad })}
      </span>
      <span>
        {sample("ex-ok")}
        {t("face.keyGood")}
      </span>
      <span>
        {sample("ex-in")}
        {t("face.keyIn")}
      </span>
      {off && (
        <span>
          {sample("ex-off")}
          {t("face.keyOff")}
        </span>
      )}
    </div>
  );
}

/** The bad exits as numbers, edge by edge. */
function Numbers({ of }: { of: Face }) {
  const answer = of.placed.value?.answer;
  if (!answer) return null;
  const bad = answer.stretches.filter((s) => s.met === "exit" && s.weight !== undefined && s.weight > 0);
  return (
    <details class="numbers">
      <summary>{t("face.numbers")}</summary>
      <div class="wide" tabIndex={0} role="region" aria-label={t("face.numbersOf")}>
        <table>
          <thead>
            <tr>
              <th scope="col" class="n">{t("face.edge")}</th>
              <th scope="col">{t("face.edgeName")}</th>
              <th scope="col" class="n">{t("face.colBad")}</th>
              <th scope="col" class="n">{t("face.colAngles")}</th>
              <th scope="col" class="n">{t("face.weight")}</th>
            </tr>
          </thead>
          <tbody translate={false}>
            {bad.map((s, i) => {
              const edge = answer.outline.edges[s.edge];
              const angles = [...(s.exit_angles ?? [])].sort((a, b) => a - b);
              return (
                <tr key={i}>
                  <td class="n">{s.edge}</td>
                  <td>{edge.label ?? "\u2013"}</td>
                  <td class="n">{fixed((s.to - s.from) * edge.length, 3)}</td>
                  <td class="n">{angles.map((a) => `${fixed(a, 1)}°`).join(" – ")}</td>
                  <td class="n">{fixed(edge.weight * (s.weight ?? 0), 2)}</td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
    </details>
  );
}

/** The rule by which angles are counted, and findings: sentences of the verb. */
function Notes({ of }: { of: Face }) {
  const least = of.least.value?.answer;
  if (!least) return null;
  return (
    <section class="panel notes" aria-label={t("face.notes")}>
      <header>
        <h2>{t("face.notes")}</h2>
      </header>
      <ul>
        <li>
          <Said text={least.rule} />
        </li>
        {least.outline.notes.map((n) => (
          <li key={n}>
            <Said text={n} />
          </li>
        ))}
        {least.findings.map((f, i) => (
          <li key={i}>
            <b>{t(`findings.severity.${f.severity}`)}</b> <Said text={f.message} /> {f.help && <Said text={f.help} />}
          </li>
        ))}
      </ul>
    </section>
  );
}

/** The bar's word of it. */
export function FaceStatus({ of }: { of: Face }) {
  const ms = of.drawnIn.value;
  return <span class="opt">{ms === null ? "" : t("face.drawnIn", { ms: Math.round(ms), asked: Math.round(of.placed.value?.ms ?? 0) })}</span>;
}
