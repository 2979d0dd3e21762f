// Placements and ways that are worth a look: each with its price.
import { useSignal } from "@preact/signals";
import { fixed } from "../../base/format";
import { Said } from "../../app/verbatim";
import { t } from "../../words";
import type { Way } from "./answer";
import type { Face } from "./state";
import { Survey } from "./survey";

export function Ways({ face }: { face: Face }) {
  const told = face.ways.value;
  const optimum = face.optimum.value;
  const stale = told !== null && told.text !== face.text.value;
  const guarded = (told?.answer.guard ?? 0) > 0;
  const all = useSignal(false);
  const ways = told?.answer.ways ?? [];
  const shown = ways.filter((w) => all.value || w.unbeaten);
  const go = (w: Way) => w.turn !== null && w.offset !== null && face.go(face.handOf({ turn: w.turn, offset: w.offset }));
  const isLeast = (w: Way) => optimum !== null && w.offset !== null && Math.abs(w.guarded - optimum.value) < 1e-6;
  return (
    <section class="panel" aria-label={t("face.ways")}>
      <header>
        <h2>{t("face.ways")}</h2>
        {all.value && <span class="q">{t("face.waysHow")}</span>}
        {stale && <span class="tag np">{t("face.older")}</span>}
        <span class="sp" />
        {(ways.length > shown.length || all.value) && (
          <button class="ghost" aria-pressed={all.value} onClick={() => (all.value = !all.value)}>
            {t("face.waysAll", { n: ways.length })}
          </button>
        )}
        {face.comparing.value && <span class="waits" />}
      </header>
      {told ? (
        <div class={`wide${stale ? " dim" : ""}`} tabIndex={0} role="region" aria-label={t("face.waysTable")}>
          <table>
            <thead>
              <tr>
                <th scope="col">{t("face.path")}</th>
                <th scope="col" class="n">{t("face.colBad")}</th>
                {guarded && <th scope="col" class="n">{t("face.colGuarded")}</th>}
                <th scope="col" class="n">{t("face.colTime")}</th>
                <th scope="col" class="n">{t("face.colLength")}</th>
                <th scope="col">{t("face.colPlace")}</th>
              </tr>
            </thead>
            <tbody>
              {shown.map((w, i) => (
                <tr key={i} class={w.unbeaten ? "" : "beaten"}>
                  <th scope="row" id={`way-${i}`}>
                    {isLeast(w) && <span aria-hidden="true">★ </span>}
                    <Said text={w.name} />
                    {!w.unbeaten && <span class="sr">{t("face.beaten")}</span>}
                    {w.unreached && <span class="tag np">{t("face.unreached")}</span>}
                  </th>
                  <td class="n" translate={false}>{fixed(w.bad, 1)}</td>
                  {guarded && <td class="n" translate={false}>{fixed(w.guarded, 1)}</td>}
                  <td class="n" translate={false}>{fixed(w.time, 1)}</td>
                  <td class="n" translate={false}>{fixed(w.feed_length, 1)}</td>
                  <td>
                    {w.offset !== null && w.turn !== null && (
                      <button class="small" id={`go-${i}`} onClick={() => go(w)} aria-labelledby={`go-${i} way-${i}`}>
                        {t("face.goThere")}
                      </button>
                    )}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      ) : (
        <p class="q hint">{face.comparing.value || face.searching.value ? t("face.waysCome") : t("face.waysNone")}</p>
      )}
    </section>
  );
}

/** The walk in words. */
function Walked({ face }: { face: Face }) {
  const walked = face.walk.value;
  if (!walked || walked.text !== face.text.value) return null;
  const { corners, evaluations } = walked.steps[walked.steps.length - 1];
  const said = { mm: fixed(corners[0].value, 3), n: evaluations, turn: fixed(walked.start.turn, 1), beside: fixed(walked.start.beside, 2) };
  return <p data-walk={walked.state}>{t(walked.state === "walks" ? "face.walking" : walked.state === "ended" ? "face.walked" : "face.walkStopped", said)}</p>;
}

/** The paper's own method: its walk from the placement under the hand, and where it ends from others. */
export function Method({ face }: { face: Face }) {
  const told = face.ways.value;
  const paper = told?.answer.paper;
  if (!told || !paper) return null;
  const { statistics: s, descent_from_as_drawn: first } = paper;
  const stale = told.text !== face.text.value;
  const walks = face.walk.value?.state === "walks";
  return (
    <section class={`panel method${stale ? " dim" : ""}`} aria-label={t("face.method")}>
      <header>
        <h2>{t("face.method")}</h2>
        {stale && <span class="tag np">{t("face.older")}</span>}
        <span class="sp" />
        <label class="box">
          <input type="checkbox" data-paper checked={face.showPaper.value} onChange={(e) => (face.showPaper.value = e.currentTarget.checked)} /> {t("face.showPaper")}
        </label>
        {walks ? (
          <button class="ghost" onClick={() => face.stopWalk()}>
            {t("outcome.stop")}
          </button>
        ) : (
          <button class="ghost" disabled={stale || !face.placed.value?.answer} onClick={() => void face.walkFrom()}>
            {t("face.walkHere")}
          </button>
        )}
      </header>
      <div class="pad">
        <Walked face={face} />
        {s && <p>{t("face.statistics", { n: paper.descents.length, best: fixed(s.best, 3), median: fixed(s.median, 1), worst: fixed(s.worst, 1), share: fixed(100 * s.within_one_percent, 0), evaluations: fixed(s.evaluations, 0) })}</p>}
        {first && <p>{t("face.fromDrawn", { mm: fixed(first.value, 3), n: first.evaluations })}</p>}
        {!s && !first && <p>{t("face.methodNone")}</p>}
        <p class="q">{t("face.methodEnds")}</p>
      </div>
      {paper.survey.some((p) => p.covered) && <Survey survey={paper.survey} turn={face.hand.value?.turn ?? null} />}
    </section>
  );
}
