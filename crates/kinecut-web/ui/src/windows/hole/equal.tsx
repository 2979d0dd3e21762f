// All strategies on equal terms at three feeds, and the paper's claims on this hole: `kinecut hole --compare`, which takes seconds.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Said } from "../../app/verbatim";
import * as api from "../../base/api";
import { fixed, short, timeOfDay } from "../../base/format";
import type { Document } from "../../store/document";
import { tell } from "../../store/session";
import { t } from "../../words";

interface Row {
  strategy: string;
  figures: { length: number; blocks: number; load: { most: number; mean: number }; runs: { feed: number; time: number; stops: number | null }[] } | null;
  error: api.Finding | null;
}

interface Compared {
  comparison: { rows: Row[]; claims: { claim: string; holds: string; found: string }[] };
}

interface Known {
  compared: Compared;
  text: string;
  at: Date;
}

let generation = 0;

export function Equal({ doc }: { doc: Document }) {
  const known = useSignal<Known | null>(null);
  const wrong = useSignal<api.Finding | null>(null);
  const control = useRef<AbortController | null>(null);
  const asking = useSignal(false);
  useEffect(() => () => control.current?.abort(), [doc]);
  const ask = async () => {
    const { signal } = (control.current = new AbortController());
    const text = doc.text.peek();
    asking.value = true;
    wrong.value = null;
    try {
      const answer = await api.verb<Compared>("hole", { generation: ++generation, new: `${doc.name.replaceAll("/", "-")}-compared.toml`, text, compare: true }, signal);
      if (signal.aborted) return;
      if ("comparison" in answer) known.value = { compared: answer, text, at: new Date() };
      else wrong.value = answer;
    } catch (error) {
      if (!signal.aborted) tell(error instanceof Error && error.message ? error.message : String(error));
    } finally {
      if (!signal.aborted) asking.value = false;
    }
  };
  const stop = () => {
    control.current?.abort();
    asking.value = false;
  };
  const compared = known.value?.compared.comparison;
  const isOld = known.value !== null && known.value.text !== doc.text.value;
  const feeds = compared?.rows.find((r) => r.figures)?.figures?.runs.map((r) => r.feed * 0.06) ?? [];
  return (
    <section class="panel equal" aria-label={t("hole.equal")} tabIndex={-1} data-panel="equal">
      <header>
        <h2>{t("hole.equal")}</h2>
        {isOld && known.value && <span class="tag np">{t("hole.equalOld", { time: timeOfDay(known.value.at) })}</span>}
        <span class="sp" />
        {asking.value ? (
          <button data-act="stop" onClick={stop}>
            {t("outcome.stop")}
          </button>
        ) : (
          <button data-act="compare" onClick={() => void ask()}>
            {t("hole.compare")}
          </button>
        )}
        {asking.value && <span class="waits" />}
      </header>
      {wrong.value && (
        <p class="pad" role="alert">
          <Said text={wrong.value.message} /> {wrong.value.help && <Said text={wrong.value.help} />}
        </p>
      )}
      {!compared && <p class="q pad small-print">{t(asking.value ? "hole.comparing" : "hole.equalHow")}</p>}
      {compared && (
        <>
          <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t("hole.equal") })}>
            <table data-table="equal">
              <thead>
                <tr>
                  <th scope="col">{t("hole.way")}</th>
                  <th scope="col" class="r">{t("hole.column.length")}</th>
                  <th scope="col" class="r">{t("hole.column.blocks")}</th>
                  <th scope="col" class="r">{t("hole.column.engagement")}</th>
                  <th scope="col" class="r">{t("hole.column.mean")}</th>
                  {feeds.map((feed) => (
                    <th key={feed} scope="col" class="r">
                      {t("hole.column.timeAt", { feed: short(feed, 4) })}
                    </th>
                  ))}
                </tr>
              </thead>
              <tbody>
                {compared.rows.map(({ strategy, figures, error }) => (
                  <tr key={strategy} data-row={strategy}>
                    <th scope="row">
                      <code translate={false}>{strategy}</code>
                    </th>
                    {figures ? (
                      <>
                        <td class="r" translate={false}>{fixed(figures.length, 1)}</td>
                        <td class="r" translate={false}>{figures.blocks}</td>
                        <td class="r" translate={false}>{fixed((figures.load.most * 180) / Math.PI, 1)}</td>
                        <td class="r" translate={false}>{fixed((figures.load.mean * 180) / Math.PI, 1)}</td>
                        {figures.runs.map((run) => (
                          <td key={run.feed} class="r" translate={false}>{fixed(run.time, 2)}</td>
                        ))}
                      </>
                    ) : (
                      <td colSpan={4 + feeds.length} class="q">{error ? <Said text={error.message} /> : t("hole.notPossible")}</td>
                    )}
                  </tr>
                ))}
              </tbody>
            </table>
          </div>
          <h3 class="pad">{t("hole.claims")}</h3>
          <dl class="claims" lang="en" data-claims={compared.claims.length}>
            {compared.claims.map(({ claim, holds, found }) => (
              <div key={claim}>
                <dt>
                  <b>{claim}</b> <span class="tag note">{holds}</span>
                </dt>
                <dd class="q">{found}</dd>
              </div>
            ))}
          </dl>
        </>
      )}
    </section>
  );
}
