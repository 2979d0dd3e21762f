// The panel of the section: the drawing with the drill at any place of its way, and the library's own drawings of the same hole.
import { type Signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { theme } from "../../app/theme";
import { Name } from "../../app/verbatim";
import type { Hole } from "../../base/drillsheet";
import { fixed, short } from "../../base/format";
import { t, unit } from "../../words";
import type { Figure } from "./page";
import type { Question } from "./question";
import { Section } from "./section";
import { atTime, atWay, stageName } from "./stages";

interface Props {
  question: Question;
  hole: Hole;
  way: Signal<number | null>;
  drawings: Figure[];
  waits: boolean;
}

/** A drill is shown at its own pace, but no longer than this [s]. */
const LONGEST = 12;

export function SectionPanel({ question, hole, way, drawings, waits }: Props) {
  const view = useSignal(-1);
  const playing = useSignal(false);
  const whole = hole.lengths.L_rx;
  const shown = drawings[view.value];
  const now = way.value === null ? null : atWay(hole.zones, way.value);

  useEffect(() => {
    if (!playing.value) return;
    const rate = Math.max(1, hole.time / LONGEST);
    const from = way.value === null || way.value >= whole ? 0 : (atWay(hole.zones, way.value)?.time ?? 0);
    let began = -1;
    let frame = requestAnimationFrame(function step(at) {
      if (began < 0) began = at;
      const time = from + ((at - began) / 1000) * rate;
      way.value = Math.min(whole, atTime(hole.zones, time));
      if (time >= hole.time) playing.value = false;
      else frame = requestAnimationFrame(step);
    });
    return () => cancelAnimationFrame(frame);
  }, [playing.value, hole]);

  return (
    <section class="panel section" aria-label={t("drill.section")} tabIndex={-1} data-panel="section">
      <header>
        <h2>{t("drill.section")}</h2>
        <span class="q hides">{t("drill.drag")}</span>
        <span class="sp" />
        {drawings.length > 0 && (
          <select aria-label={t("drill.drawing")} value={shown ? view.value : -1} onChange={(e) => (view.value = Number(e.currentTarget.value))} data-drawings={drawings.length}>
            <option value={-1}>{t("drill.interactive")}</option>
            {drawings.map((d, i) => (
              <option key={i} value={i} lang="en">
                {d.title}
              </option>
            ))}
          </select>
        )}
        {waits && <span class="waits" />}
      </header>
      {shown ? (
        <div class="figures">
          <img class="wide" src={shown.wide(theme.value)} width={shown.width[0]} height={shown.height[0]} alt={shown.about} lang="en" />
          <img class="narrow" src={shown.narrow(theme.value)} width={shown.width[1]} height={shown.height[1]} alt={shown.about} lang="en" />
          <p class="q pad small-print">{t("drill.ownDrawing")}</p>
        </div>
      ) : (
        <Section question={question} hole={hole} way={way} />
      )}
      <div class="travel">
        <button class="icon" aria-label={playing.value ? t("time.pause") : t("time.play")} data-play={playing.value ? "on" : "off"} onClick={() => (playing.value = !playing.value)}>
          <span aria-hidden="true">{playing.value ? "❚❚" : "▶"}</span>
        </button>
        <input
          type="range"
          min={0}
          max={1000}
          step={1}
          value={Math.round(((way.value ?? 0) / whole) * 1000)}
          aria-label={t("drill.way")}
          aria-valuetext={now ? `Z ${fixed(now.z, 3)}, ${stageName(hole.zones[now.index].stage)}` : t("drill.noPlace")}
          onInput={(e) => {
            playing.value = false;
            way.value = (whole * Number(e.currentTarget.value)) / 1000;
          }}
        />
        <button class="ghost" disabled={way.value === null} onClick={() => { playing.value = false; way.value = null; }}>
          {t("drill.allPlaces")}
        </button>
        <output class="at" data-at={now ? now.z.toFixed(3) : ""}>
          {now ? (
            <>
              <Name>Z {fixed(now.z, 3)}</Name> {stageName(hole.zones[now.index].stage)}{" "}
              <Name>
                {short(hole.zones[now.index].feed)} {unit("mm/rev")}, {fixed(now.time, 2)} {unit("s")}
              </Name>
            </>
          ) : (
            t("drill.noPlace")
          )}
        </output>
      </div>
    </section>
  );
}
