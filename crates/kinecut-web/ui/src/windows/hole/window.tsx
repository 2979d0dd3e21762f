// The window of a milled hole: plan, charts, numbers, and the same hole in other ways.
import { effect, signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { offer } from "../../app/commands";
import { Name, Said } from "../../app/verbatim";
import * as api from "../../base/api";
import { fixed, short, timeOfDay } from "../../base/format";
import type { Schema } from "../../schema/schema";
import { type Document, keyOf } from "../../store/document";
import { edited, tell } from "../../store/session";
import { t } from "../../words";
import { Undo } from "../drill/undo";
import { Acts } from "./acts";
import type { Pass, Plan, Run } from "./answer";
import { Charts } from "./charts";
import { Equal } from "./equal";
import { Numbers } from "./numbers";
import { PlanDrawing } from "./plan";
import { numberOf, table } from "./question";
import { State } from "./state";
import { FIELDS, Rest, Strip } from "./strip";
import { readingAt, timeAt } from "./track";
import { Ways } from "./ways";

const schema = signal<Schema | null>(null);

/** An answer that takes longer makes what is shown old [ms]. */
const LATE = 100;

export function HoleWindow({ doc }: { doc: Document }) {
  const state = State.of(doc);
  const late = useSignal(false);
  const undo = Undo.of(doc);

  useEffect(() => {
    if (!schema.value) {
      api.schema("hole").then((known) => (schema.value = known as Schema)).catch((error: unknown) => tell(error instanceof Error ? error.message : String(error)));
    }
    const back = (by: -1 | 1) => () => {
      const text = undo.go(by);
      if (text !== null) edited(doc, text);
    };
    offer({ id: "command.undo", keys: ["Ctrl+Z"], run: back(-1) }, { id: "command.redo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"], run: back(1) });
    let timer = 0;
    const ends = [
      state.others.follow(),
      effect(() => undo.note(doc.text.value)),
      effect(() => {
        clearTimeout(timer);
        if (!doc.planning.value) late.value = false;
        else timer = window.setTimeout(() => (late.value = true), LATE);
      }),
    ];
    return () => {
      clearTimeout(timer);
      for (const end of ends) end();
    };
  }, [doc]);

  const known = doc.answered.value;
  const plan = state.plan.value;
  const pass = state.pass.value;
  const wrong = doc.wrong.value;
  const isOld = known !== null && known.text !== doc.text.value && (!doc.planning.value || late.value);
  const status = doc.planning.value ? "planning" : wrong || doc.refused.value ? "wrong" : known?.text === doc.text.value ? "done" : "planning";
  const diameter = numberOf(table(doc.values.value.operation).diameter);
  return (
    <main class="drilling hole" data-state={status} data-pass={pass?.pass}>
      <div class="head">
        <h1>{t("hole.title", { diameter: diameter === null ? "\u2013" : short(diameter, 6) })}</h1>
        {plan && (
          <span class="q">
            <Name>{`${plan.strategy}, ${plan.control}`}</Name>
          </span>
        )}
        <div class="acts">
          <Acts doc={doc} plan={isOld ? null : plan} />
        </div>
      </div>
      {/* Over what is below: nothing is pushed away under the hand that drags. */}
      <div class="messages">
        <div>
          {wrong && <Wrong doc={doc} />}
          {doc.refused.value && <p class="across" role="alert">{doc.refused.value}</p>}
          {isOld && known && !doc.planning.value && (
            <p class="oldness" role="status">
              {t("hole.old", { time: timeOfDay(known.at) })}
            </p>
          )}
        </div>
      </div>
      {pass?.run && <Facts run={pass.run} old={isOld} />}
      {schema.value && <Strip doc={doc} schema={schema.value} />}
      {plan && pass?.run ? (
        <div class="pair">
          <div class={`stack${isOld ? " older" : ""}`}>
            <Picture state={state} plan={plan} pass={pass} run={pass.run} waits={late.value} />
            <Numbers pass={pass} />
            {pass.pass === "rough" && <Entries plan={plan} />}
          </div>
          <div class={`stack${isOld ? " older" : ""}`}>
            <Charts state={state} plan={plan} pass={pass} run={pass.run} />
            <Ways state={state} plan={plan} pass={pass} />
            {pass.pass !== "rough" && <Entries plan={plan} />}
            <Notes plan={plan} />
            <Equal doc={doc} />
          </div>
        </div>
      ) : (
        <p class="q hint">{t(plan ? "hole.noPass" : wrong ? "hole.nothing" : "hole.planning")}</p>
      )}
      {schema.value && <Rest doc={doc} schema={schema.value} />}
    </main>
  );
}

/** The sentence above all numbers; the same sentence is at the field. */
function Wrong({ doc }: { doc: Document }) {
  const wrong = doc.wrong.value as api.Finding;
  const atField = wrong.key !== undefined && FIELDS.some(({ path }) => keyOf(path) === wrong.key);
  return (
    <div class="across wrong" role="alert" data-at={wrong.key ?? ""}>
      <div>
        {t("drill.noPlan")} <Said text={wrong.message} />
        {wrong.help && (
          <p class="q">
            <Said text={wrong.help} />
          </p>
        )}
      </div>
      {atField && <button onClick={() => document.getElementById(`f-${wrong.key}`)?.focus()}>{t("drill.toField")}</button>}
    </div>
  );
}

function Facts({ run, old }: { run: Run; old: boolean }) {
  const { peaks } = run;
  const deg = peaks.engagement === null ? null : (peaks.engagement * 180) / Math.PI;
  const facts: [string, string, string | null][] = [
    ["time", `${fixed(run.time, 3)} s`, t("hole.fact.timeNote", { mm: fixed(run.length, 1) })],
    [
      "engagement",
      deg === null ? "\u2013" : `${fixed(deg, 2)}°`,
      deg !== null ? t("hole.fact.engagementNote", { n: run.engagement_places }) : run.unmeasured ? run.unmeasured.message : t("hole.fact.noLoad"),
    ],
    ["acceleration", `${short(peaks.acceleration / 1000, 4)} m/s²`, t("hole.fact.alongNote", { along: `${short(peaks.along / 1000, 4)} m/s²` })],
    peaks.jerk === null || peaks.axis_jerk === null
      ? ["jerk", "\u2013", t("hole.fact.noJerk")]
      : ["jerk", `${short(peaks.jerk / 1000, 4)} m/s³`, t("hole.fact.axisNote", { axis: `${short(peaks.axis_jerk / 1000, 4)} m/s³` })],
    run.stops === null || run.smoothed === null
      ? ["stops", "\u2013", t("hole.fact.ownPlanner", { n: run.joint_count, mm: short(run.farthest, 3) })]
      : ["stops", String(run.stops), run.smoothed > 0 ? t("hole.fact.smoothed", { n: run.smoothed, mm: short(run.farthest, 3) }) : t("hole.fact.joints", { n: run.joint_count })],
  ];
  return (
    <dl class={`facts${old ? " older" : ""}`}>
      {facts.map(([name, value, note]) => (
        <div key={name} data-fact={name}>
          <dt>{t(`hole.fact.${name}` as "hole.fact.time")}</dt>
          <dd>
            <Name>{value}</Name>
            {note && <small>{note}</small>}
          </dd>
        </div>
      ))}
    </dl>
  );
}

function Picture({ state, plan, pass, run, waits }: { state: State; plan: Plan; pass: Pass; run: Run; waits: boolean }) {
  const s = state.s.value;
  const engaged = readingAt(run, s).engagement;
  return (
    <section class="panel picture" aria-label={t("hole.plan")} tabIndex={-1} data-panel="plan">
      <header>
        <h2>{t("hole.plan")}</h2>
        <span class="seg" role="radiogroup" aria-label={t("hole.pass")}>
          {plan.passes.map((p) => (
            <button key={p.pass} role="radio" aria-checked={pass.pass === p.pass} data-choose={p.pass} onClick={() => state.choose(p.pass)}>
              {t(`hole.pass.${p.pass}`)}
            </button>
          ))}
        </span>
        <span class="sp" />
        {pass.figure && (
          <label class="check">
            <input type="checkbox" checked={state.construction.value} onChange={(e) => (state.construction.value = e.currentTarget.checked)} />
            {t("hole.construction")}
          </label>
        )}
        <span class="zoom">
          <button class="icon ghost" aria-label={t("hole.larger")} title={t("hole.larger")} onClick={() => state.zoom(1.6)}>
            <span aria-hidden="true">+</span>
          </button>
          <button class="icon ghost" aria-label={t("hole.smaller")} title={t("hole.smaller")} onClick={() => state.zoom(1 / 1.6)}>
            <span aria-hidden="true">−</span>
          </button>
          <button class="ghost" onClick={() => state.fit()}>
            {t("face.fit")}
          </button>
        </span>
        {waits && <span class="waits" />}
      </header>
      <PlanDrawing state={state} plan={plan} pass={pass} run={run} />
      <div class="travel">
        <label for="hole-scrub">{t("hole.scrub")}</label>
        <input
          id="hole-scrub"
          type="range"
          min={0}
          max={run.length}
          step={run.length / 2000}
          value={s}
          aria-valuetext={t("hole.scrubbed", { mm: fixed(s, 1), deg: engaged === null ? "\u2013" : fixed((engaged * 180) / Math.PI, 1) })}
          onInput={(e) => state.go(Number(e.currentTarget.value))}
        />
        <p class="at">
          <Name>{`${fixed(s, 2)} mm, ${fixed(timeAt(run, s), 3)} s, ${engaged === null ? "\u2013" : `${fixed((engaged * 180) / Math.PI, 2)}°`}`}</Name>
        </p>
      </div>
      <PlanLegend pass={pass} construction={state.construction.value && pass.figure !== undefined} />
      <p class="q pad small-print">{t(pass.pass === "finish" && pass.figure ? "hole.planHow" : "hole.planHowRough")}</p>
    </section>
  );
}

function PlanLegend({ pass, construction }: { pass: Pass; construction: boolean }) {
  const sample = (name: string) => (
    <svg width="30" height="8" aria-hidden="true">
      <path class={name} d="M0 4h30" />
    </svg>
  );
  return (
    <div class="key">
      <span>
        {sample(`way ${pass.pass}`)} {t(`hole.key.${pass.pass}`)}
      </span>
      <span>
        {sample("way lead")} {t("hole.key.lead")}
      </span>
      <span>
        {sample("wall")} {t("hole.key.wall")}
      </span>
      {construction && (
        <span>
          {sample("base")} {t((pass.figure?.evolute.length ?? 0) > 0 ? "hole.key.evolute" : "hole.key.base")}
        </span>
      )}
      {construction && (pass.figure?.before.length ?? 0) > 0 && (
        <span>
          {sample("before")} {t("hole.key.before")}
        </span>
      )}
      {construction && (pass.figure?.unturned.length ?? 0) > 0 && (
        <span>
          {sample("unturned")} {t("hole.key.unturned")}
        </span>
      )}
    </div>
  );
}

/** The ways down, and which is taken. */
function Entries({ plan }: { plan: Plan }) {
  if (plan.entries.length === 0) return null;
  return (
    <section class="panel" aria-label={t("hole.entries")} tabIndex={-1} data-panel="entries">
      <header>
        <h2>{t("hole.entries")}</h2>
      </header>
      <ul class="entries pad">
        {plan.entries.map((e) => (
          <li key={e.way} data-chosen={e.chosen || undefined} class={e.possible ? "" : "q"}>
            <b lang="en">{e.way}</b> {e.chosen && <span class="tag note">{t("hole.entryChosen")}</span>} {!e.possible && <span class="tag np">{t("hole.entryNot")}</span>}{" "}
            <span class="q">
              <Said text={e.reason} />
            </span>
          </li>
        ))}
      </ul>
    </section>
  );
}

function Notes({ plan }: { plan: Plan }) {
  return (
    <section class="panel" aria-label={t("hole.notes")} tabIndex={-1} data-panel="findings">
      <header>
        <h2>{t("hole.notes")}</h2>
      </header>
      <ul class="entries pad">
        {plan.findings.map((f, i) => (
          <li key={i}>
            <b>{t(`findings.severity.${f.severity}`)}</b> <Said text={f.message} /> {f.help && <Said text={f.help} />}
          </li>
        ))}
        <li class="q">{t("hole.whole", { mm: fixed(plan.feed_length + plan.entry_length, 1), s: fixed(plan.feed_time, 2), n: plan.program_lines })}</li>
        <li class="q">{t("hole.evenness")}</li>
        <li class="q">{t("hole.scope")}</li>
      </ul>
    </section>
  );
}
