// The same hole in other ways: their figures as a table, each can be laid over plan and charts.
import { Said } from "../../app/verbatim";
import { fixed, short, timeOfDay } from "../../base/format";
import { t } from "../../words";
import type { Pass, Plan } from "./answer";
import { isSame } from "./charts";
import { idsOf } from "./others";
import type { State } from "./state";

/** A step in m/s², m/s³; an impulse where a lower derivative steps already. */
function step(value: number | null | undefined): string {
  if (value === undefined) return "\u2013";
  return value === null ? t("hole.impulse") : short(value / 1000, 3);
}

export function Ways({ state, plan, pass }: { state: State; plan: Plan; pass: Pass }) {
  const { others } = state;
  const known = others.known.value;
  const text = state.doc.answered.value?.text;
  const isOwn = (id: string) => isSame(id, state, plan, pass);
  return (
    <section class="panel ways" aria-label={t(`hole.ways.${pass.pass}`)} tabIndex={-1} data-panel="ways">
      <header>
        <h2>{t(`hole.ways.${pass.pass}`)}</h2>
        <span class="q">{t("hole.waysHow")}</span>
        {others.asking.value && <span class="waits" />}
      </header>
      <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t(`hole.ways.${pass.pass}`) })}>
        <table data-table="ways">
          <thead>
            <tr>
              <th scope="col">{t("hole.way")}</th>
              <th scope="col" class="r">{t("hole.column.length")}</th>
              <th scope="col" class="r">{t("hole.column.time")}</th>
              <th scope="col" class="r">{t("hole.column.engagement")}</th>
              <th scope="col" class="r">{t("hole.column.acceleration")}</th>
              <th scope="col" class="r">{t("hole.column.jerk")}</th>
              <th scope="col">{t("hole.column.contact")}</th>
              <th scope="col" class="r">{t("hole.column.stepA")}</th>
              <th scope="col" class="r">{t("hole.column.stepJ")}</th>
              <th scope="col" class="r">{t("hole.column.stops")}</th>
            </tr>
          </thead>
          <tbody>
            {idsOf(pass.pass).map((id, index) => {
              const other = known.get(id);
              const run = other?.pass?.run;
              const joint = run?.closing;
              const isOld = other !== undefined && other.text !== text;
              return (
                <tr key={id} data-row={id} data-old={isOld || undefined} class={isOwn(id) ? "on" : ""}>
                  <th scope="row">
                    <label>
                      <input type="checkbox" checked={others.shown.value.has(id)} disabled={!run} onChange={() => others.toggle(id)} />
                      <svg width="26" height="8" aria-hidden="true">
                        <path class={`curve ghost g${index}`} d="M0 4h26" />
                      </svg>
                      <code translate={false}>{id}</code>
                    </label>
                  </th>
                  {run ? (
                    <>
                      <td class="r" translate={false}>{fixed(run.length, 1)}</td>
                      <td class="r" translate={false}>{fixed(run.time, 2)}</td>
                      <td class="r" translate={false}>{run.peaks.engagement === null ? "\u2013" : fixed((run.peaks.engagement * 180) / Math.PI, 1)}</td>
                      <td class="r" translate={false}>{short(run.peaks.acceleration / 1000, 4)}</td>
                      <td class="r" translate={false}>{run.peaks.jerk === null ? "\u2013" : short(run.peaks.jerk / 1000, 4)}</td>
                      <td translate={false}>{joint?.contact ?? "\u2013"}</td>
                      <td class="r">{step(joint?.steps.acceleration)}</td>
                      <td class="r">{step(joint?.steps.jerk)}</td>
                      <td class="r" translate={false}>{run.stops ?? "\u2013"}</td>
                    </>
                  ) : (
                    <td colSpan={9} class="q">{other?.why ? <Said text={other.why} /> : t(other ? "hole.notPossible" : "hole.asked")}</td>
                  )}
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
      <p class="q pad small-print">
        {t("hole.waysNote")} {idsOf(pass.pass).some((id) => known.get(id) && known.get(id)?.text !== text) && state.doc.answered.value && t("hole.waysOld", { time: timeOfDay(state.doc.answered.value.at) })}
      </p>
    </section>
  );
}
