// The outcome: always there, never dismissed.
import { computed } from "@preact/signals";
import type { Finding } from "../base/api";
import { short, timeOfDay } from "../base/format";
import { type Document, differences, sameFile } from "../store/document";
import { active, worker } from "../store/session";
import { plain, parse } from "../toml/parse";
import { foreign, t } from "../words";
import { goTo } from "./go";
import { Said } from "./verbatim";

type State = "safe" | "np" | "bad" | "wait" | "none";

interface Told {
  state: State;
  stale: boolean;
  word: string;
  what: preact.ComponentChild;
  scope: [string, preact.ComponentChild] | null;
  counts: [string, ...string[]] | null;
  act: { label: string; go: () => void } | null;
}

const OF: Record<string, State> = { safe: "safe", "not-proven": "np", "not-safe": "bad" };

export function Sign({ state }: { state: State }) {
  return (
    <svg class="sign" viewBox="0 0 48 48" aria-hidden="true">
      {state === "safe" && [<circle class="f" cx="24" cy="24" r="23" />, <path class="g" d="M13 25l8 8 15-17" />]}
      {state === "np" && [<path class="f" d="M24 .8 47.2 24 24 47.2.8 24Z" />, <path class="g" d="M18 18.5c.4-8 12.6-7.6 12 .4-.3 4.6-6 4.7-6 10M24 35.3v.2" />]}
      {state === "bad" && [<path class="f" d="M14.5 1h19L47 14.5v19L33.5 47h-19L1 33.5v-19Z" />, <path class="g" d="M16 16l16 16M32 16 16 32" />]}
      {state === "wait" && [
        <circle cx="24" cy="24" r="20" fill="none" stroke="var(--rule)" stroke-width="6" />,
        <path class="turns" d="M24 4a20 20 0 0 1 17 30.5" fill="none" stroke="var(--accent)" stroke-width="6" stroke-linecap="round" />,
      ]}
      {state === "none" && [
        <circle cx="24" cy="24" r="21" fill="none" stroke="var(--edge)" stroke-width="3.5" stroke-dasharray="7 5" />,
        <path d="M15 24h18" stroke="var(--edge)" stroke-width="4.4" stroke-linecap="round" />,
      ]}
    </svg>
  );
}

function words(outcome: string): string {
  return outcome === "safe" ? t("outcome.safe") : outcome === "not-proven" ? t("outcome.notProven") : t("outcome.notSafe");
}

function counted(found: Finding[], groups: number | null): [string, ...string[]] {
  const of = (severity: string) => found.filter((f) => f.severity === severity).length;
  const doubts = of("doubt");
  const lines = [t("outcome.counts", { errors: t("outcome.errors", { n: of("error") }), warnings: t("outcome.warnings", { n: of("warning") }) })];
  if (doubts > 0) lines.push(t("outcome.doubts", { n: doubts }));
  if (groups !== null && groups > 0) lines.push(t("outcome.groups", { n: groups }));
  return lines as [string, ...string[]];
}

function worst(found: Finding[]): Finding | undefined {
  const order = ["error", "doubt", "warning"];
  for (const severity of order) {
    const first = found.find((f) => f.severity === severity && (f.place?.line ?? 0) > 0);
    if (first) return first;
  }
  return undefined;
}

function placeAct(doc: Document, finding: Finding | undefined): Told["act"] {
  const line = finding?.place?.line;
  if (!finding || !line) return null;
  const own = sameFile(finding.place?.file ?? "", doc.name) && doc.kind !== "program";
  return { label: own ? t("outcome.goLine", { n: line }) : t("outcome.showLine", { n: line }), go: () => goTo(doc, finding) };
}

/** What changed since an outcome, in one sentence. */
function changes(before: string, now: string): string {
  const all = differences(plain(parse(before)), plain(parse(now)));
  if (all.length === 0) return t("outcome.changedText");
  if (all.length > 1) return t("outcome.changedMany", { n: all.length });
  const [one] = all;
  const shown = (v: unknown) => (typeof v === "object" ? JSON.stringify(v) : String(v));
  if (one.before === undefined) return t("outcome.addedOne", { key: one.key, now: shown(one.now) });
  if (one.now === undefined) return t("outcome.removedOne", { key: one.key, before: shown(one.before) });
  const key = one.key.split(".").at(-1) ?? one.key;
  return t("outcome.changedOne", { key, before: shown(one.before), now: shown(one.now) });
}

function none(doc: Document, wrong: Finding): Told {
  const { place } = wrong;
  return {
    state: "none",
    stale: false,
    word: t("outcome.none"),
    what: [
      place?.line ? `${t("outcome.place", { file: place.file.split("/").at(-1) ?? "", n: place.line })} ` : "",
      <Said text={wrong.message + (wrong.help ? `; ${wrong.help}` : "")} />,
    ],
    scope: [t("outcome.shown"), doc.work.value ? t("outcome.lastPlan") : t("outcome.noPlan")],
    counts: [t("outcome.mistakes", { n: 1 })],
    act: placeAct(doc, wrong),
  };
}

function waiting(doc: Document): Told {
  const { running, simulated } = doc;
  const run = running.value;
  const found = simulated.value?.findings.filter((f) => f.severity !== "note") ?? [];
  let what = t("outcome.planning");
  if (run) {
    const step = run.step === null ? "?" : short(run.step);
    if (run.step === null) what = t("outcome.simulatingAlone");
    else what = run.share === null ? t("outcome.simulatingStart", { step }) : t("outcome.simulating", { percent: Math.floor(100 * run.share), step });
  }
  const coarse = simulated.value ? { step: short(simulated.value.step), n: found.length } : null;
  const soFar = !coarse ? t("outcome.before") : found.length === 0 ? t("outcome.coarseClean", coarse) : t("outcome.coarseFound", coarse);
  return {
    state: "wait",
    stale: false,
    word: t("outcome.checking"),
    what,
    scope: [t("outcome.soFar"), soFar],
    counts: null,
    act: run ? { label: t("outcome.stop"), go: () => worker(doc).stop() } : null,
  };
}

function told(doc: Document): Told {
  const wrong = doc.wrong.value;
  const text = doc.text.value;
  if (wrong) return none(doc, wrong);
  const again = { label: t("outcome.again"), go: () => worker(doc).again() };
  if (doc.refused.value) {
    return { state: "none", stale: false, word: t("outcome.none"), what: [t("outcome.refused"), ": ", <Said text={doc.refused.value} />], scope: null, counts: null, act: again };
  }
  const judged = doc.judged.value;
  if (judged && judged.text === text && !doc.planning.value) {
    const { verdict } = judged;
    return {
      state: OF[verdict.outcome] ?? "none",
      stale: false,
      word: words(verdict.outcome),
      what: <Said text={verdict.headline} />,
      scope: verdict.scope.length > 0 ? [t("outcome.scope"), <Said text={`${verdict.scope.join(". ")}.`} />] : null,
      counts: counted(verdict.found, verdict.not_checked.length),
      act: placeAct(doc, worst(verdict.found)),
    };
  }
  const coarseKnown = doc.simulated.value !== null && doc.shown.value?.text === text;
  if (judged && !coarseKnown) {
    const time = timeOfDay(judged.at);
    return {
      state: OF[judged.verdict.outcome] ?? "none",
      stale: true,
      word: t("outcome.stale", { word: words(judged.verdict.outcome) }),
      what: changes(judged.text, text),
      scope: [t("outcome.shown"), doc.stopped.value ? t("outcome.staleStopped", { time }) : t("outcome.staleShown", { time })],
      counts: [t("outcome.outOfDate")],
      act: doc.stopped.value ? again : null,
    };
  }
  if (doc.stopped.value) {
    return { state: "none", stale: false, word: t("outcome.none"), what: t("outcome.stopped"), scope: [t("outcome.shown"), t("outcome.stoppedScope")], counts: null, act: again };
  }
  return waiting(doc);
}

export const outcome = computed(() => (active.value ? told(active.value) : null));

/** What the screen reader says: once for each outcome, not for each step of progress. */
const spoken = computed(() => {
  const now = outcome.value;
  return now && now.state !== "wait" && !now.stale ? now.word : (now?.word ?? "");
});

export function Outcome() {
  const now = outcome.value;
  if (!now) return null;
  return (
    <section class={`outcome ${now.state}${now.stale ? " stale" : ""}`} aria-label={t("outcome.name")} lang={foreign("outcome.name")} data-state={now.stale ? "stale" : now.state}>
      <Sign state={now.state} />
      <p class="word" role="status">
        {spoken.value}
      </p>
      <div class="body">
        <p class="what">{now.what}</p>
        {now.scope && (
          <p class="scope">
            <b>{now.scope[0]}</b>
            {now.scope[1]}
          </p>
        )}
      </div>
      {now.counts && (
        <p class="counts">
          <b>{now.counts[0]}</b>
          {now.counts.slice(1).map((line) => (
            <span key={line}>{line}</span>
          ))}
        </p>
      )}
      {now.act && (
        <div class="acts">
          <button onClick={now.act.go}>{now.act.label}</button>
        </div>
      )}
    </section>
  );
}
