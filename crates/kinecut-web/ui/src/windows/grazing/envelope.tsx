// The window of an envelope: a move under a slider, the tool at that moment, and what it has swept up to there.
import { Name } from "../../app/verbatim";
import type { Finding } from "../../base/api";
import { fixed } from "../../base/format";
import type { Document } from "../../store/document";
import { t } from "../../words";
import { Head, Mistakes, Notes, Settings, isOld, stateOf, useWindow } from "./parts";
import { Plane, ReadOut } from "./plane";
import { Scrub } from "./scrub";
import { type Growth, isGrowth } from "./sheet";
import { Looked } from "./state";
import { SweepView } from "./sweepview";
import { Spans } from "./tables";
import { TimePanel } from "./time";

export function EnvelopeWindow({ doc }: { doc: Document }) {
  const looked = Looked.of(doc, "envelope");
  const scrub = Scrub.of(doc);
  const { schema, late } = useWindow(doc, "envelope");
  const answer = looked.answer.value as Growth | Finding | undefined;
  const wrong = doc.wrong.value ?? (answer && !isGrowth(answer) ? answer : null) ?? scrub.wrong.value;
  const growth = looked.growth.value;
  const moment = looked.moment.value;
  const item = looked.item.value;
  const old = isOld(doc, late);
  return (
    <main class="moving envelope" data-state={stateOf(doc)}>
      <Head doc={doc} looked={looked} title={growth?.title || t("envelope.title")} about={growth ? `${growth.way}; ${growth.mode}` : ""} />
      <Mistakes doc={doc} wrong={wrong} late={late} />
      {scrub.refused.value && (
        <p class="across" role="alert">
          {scrub.refused.value}
        </p>
      )}
      {growth && <Facts growth={growth} scrub={scrub} old={old} />}
      <div class="cols">
        <div class="stack">
          <SweepView scrub={scrub} dim={old} />
          {growth && (
            <div class={old ? "older" : ""}>
              <TimePanel scrub={scrub} growth={growth} />
            </div>
          )}
        </div>
        <div class="stack">
          <Plane looked={looked} dim={old || scrub.late.value} />
          <ReadOut looked={looked} />
        </div>
        <div class="stack">{schema && <Settings doc={doc} verb="envelope" schema={schema} item={item} keys={["move", "screw", "joints", "of", "tool"]} />}</div>
      </div>
      {moment && (
        <div class={old || scrub.late.value ? "older" : ""}>
          <Spans sheet={moment} looked={looked} />
        </div>
      )}
      {growth && <Notes notes={growth.notes} findings={scrub.current(scrub.whole.value)?.findings ?? growth.findings} />}
    </main>
  );
}

function Facts({ growth, scrub, old }: { growth: Growth; scrub: Scrub; old: boolean }) {
  const whole = scrub.current(scrub.whole.value);
  const at = growth.moments[scrub.at.value];
  const part = scrub.part.value;
  const upTo = at?.t === 1 ? whole : at && part && part.t === at.t ? scrub.current(part) : null;
  const volume = (mm3: number) => <Name>{fixed(mm3 / 1000, 3)} cm³</Name>;
  const waits = scrub.sweeping.value;
  return (
    <dl class={`facts${old ? " older" : ""}`}>
      <div data-fact="way">
        <dt>{t("envelope.fact.way")}</dt>
        <dd>
          <Name>{fixed(growth.length, 3)} mm</Name>
                  <small>{t("envelope.fact.turn", { deg: fixed(growth.turn, 3) })}</small>
        </dd>
      </div>
      <div data-fact="now">
        <dt>{t("envelope.fact.now", { t: fixed(at?.t ?? 0, 3) })}</dt>
        <dd>{at?.t === 0 && whole ? volume(whole.tool_volume) : upTo ? volume(upTo.mesh.volume) : t(waits ? "envelope.comes" : "envelope.rests")}          <small>{t("envelope.fact.curves", { n: at?.curves ?? 0 })}</small>
        </dd>
      </div>
      <div data-fact="whole">
        <dt>{t("envelope.fact.whole")}</dt>
        <dd>{whole ? volume(whole.mesh.volume) : t(waits ? "envelope.comes" : "envelope.rests")}          <small>{whole && (whole.exact_volume === null ? t("envelope.fact.lines", { mm: fixed(whole.mesh.step, 3) }) : t("envelope.fact.exact", { cm: fixed(whole.exact_volume / 1000, 3) }))}</small>
        </dd>
      </div>
      <div data-fact="tool">
        <dt>{t("envelope.fact.tool")}</dt>
        <dd>{whole ? volume(whole.tool_volume) : t(waits ? "envelope.comes" : "envelope.rests")}</dd>
      </div>
      <div data-fact="inside">
        <dt>{t("envelope.fact.inside")}</dt>
        <dd>
          <Name>{whole && whole.walls.area > 0 ? `${fixed((100 * whole.walls.inside) / whole.walls.area, 1)} %` : "\u2013"}</Name>
                  <small>{whole && t("envelope.fact.cusps", { n: whole.cusps.length })}</small>
        </dd>
      </div>
    </dl>
  );
}
