// The plan of a hole, beside the drawings and tables: the facts above all, findings, blocks.
import { useSignal } from "@preact/signals";
import { Name, Said } from "../../app/verbatim";
import type * as api from "../../base/api";
import type { Hole } from "../../base/drillsheet";
import { fixed, short } from "../../base/format";
import type { Schema } from "../../schema/schema";
import type { Document } from "../../store/document";
import { tell } from "../../store/session";
import { t, unit } from "../../words";
import { Control } from "./strip";

export function Facts({ hole, old, speed, diameter }: { hole: Hole; old: boolean; speed: number | undefined; diameter: number }) {
  const share = hole.constant_feed_time > 0 ? hole.saved_time / hole.constant_feed_time : 0;
  const { coordinates: c } = hole;
  const facts: [string, string, string, string][] = [
    ["time", t("drill.fact.time"), `${fixed(hole.time, 2)} ${unit("s")}`, t("drill.fact.constant", { feed: short(hole.constant_feed), time: fixed(hole.constant_feed_time, 2) })],
    ["saved", t("drill.fact.saved"), `${fixed(hole.saved_time, 2)} ${unit("s")}`, t("drill.fact.share", { percent: fixed(100 * share, 0) })],
    ["way", t("drill.fact.way"), `${fixed(hole.lengths.L_rx, 3)} ${unit("mm")}`, t("drill.fact.fromTo", { from: fixed(c.Z_nvr1, 3), to: fixed(c.Z_end, 3) })],
    ["speed", t("drill.fact.speed"), `${fixed(hole.spindle_speed, 1)} ${unit("rev/min")}`, speed === undefined ? "" : t("drill.fact.cutting", { speed: short(speed), diameter: short(diameter, 6) })],
  ];
  // Without a number all of the load is on one lip.
  if (hole.lip_eccentricity === null || hole.lip_eccentricity > 0) {
    const value = hole.lip_eccentricity === null ? t("drill.fact.oneSided") : fixed(hole.lip_eccentricity, 3);
    facts.push(["lips", t("drill.fact.lips"), value, t("drill.fact.lipsNote")]);
  }
  return (
    <dl class={`facts${old ? " older" : ""}`}>
      {facts.map(([key, name, value, note]) => (
        <div key={key} data-fact={key}>
          <dt>{name}</dt>
          <dd>
            {key === "lips" ? value : <Name>{value}</Name>}
            <small>{note}</small>
          </dd>
        </div>
      ))}
    </dl>
  );
}

export function Findings({ hole, refused, of }: { hole: Hole; refused: (api.Finding & { hole: number })[]; of: number }) {
  const all: (api.Finding & { hole?: number })[] = [...refused, ...hole.findings];
  return (
    <section class="panel" aria-label={t("panel.findings")} tabIndex={-1} data-panel="findings">
      <header>
        <h2>{t("panel.findings")}</h2>
      </header>
      {all.length === 0 ? (
        <p class="q pad">{t("drill.noFindings")}</p>
      ) : (
        <ol class="findings">
          {all.map((f, i) => (
            <li key={i} class={f.severity === "error" ? "bad" : f.severity === "note" ? "" : "np"}>
              <span class="t">
                {f.hole !== undefined && `${t("drill.hole", { n: f.hole, of })}: `}
                <Said text={f.message} />
              </span>
              {f.help && (
                <p class="cure">
                  <Said text={f.help} />
                </p>
              )}
              <p class="code-of">
                {t(`findings.severity.${f.severity}`)} <Name>{f.code}</Name>
              </p>
            </li>
          ))}
        </ol>
      )}
    </section>
  );
}

export function Blocks({ doc, schema, text, control }: { doc: Document; schema: Schema; text: string; control: string }) {
  const copied = useSignal(false);
  const copy = () =>
    void navigator.clipboard.writeText(text).then(
      () => {
        copied.value = true;
        setTimeout(() => (copied.value = false), 2000);
      },
      (error: unknown) => tell(String(error)),
    );
  return (
    <section class="panel blocks" aria-label={t("drill.blocks")} tabIndex={-1} data-panel="blocks">
      <header>
        <h2>{t("drill.blocks")}</h2>
        <Name class="q">{control}</Name>
        <span class="sp" />
        <button class="ghost" disabled={text === ""} onClick={copy}>
          {copied.value ? t("drill.copied") : t("drill.copy")}
        </button>
      </header>
      <div class="controls">
        <Control doc={doc} schema={schema} />
      </div>
      {text === "" ? (
        <p class="q pad">{t("drill.noBlocks")}</p>
      ) : (
        <pre class="nc" tabIndex={0} role="region" aria-label={t("program.text")} translate={false}>
          {text}
        </pre>
      )}
      <p class="q pad small-print">{t("drill.blocksNote")}</p>
    </section>
  );
}
