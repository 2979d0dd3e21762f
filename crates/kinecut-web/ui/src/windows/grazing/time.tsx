// The time of a move: slider, play, and the volume that the tool enters over it.
import { useEffect } from "preact/hooks";
import { untranslated } from "../../app/verbatim";
import { fixed, short, ticks } from "../../base/format";
import { t } from "../../words";
import { INTERVALS, type Scrub } from "./scrub";
import type { Growth } from "./sheet";
import { useWidth } from "./width";

/** Time of a whole move in play [ms]. */
const PLAY = 4000;
const HIGH = 96;
const [LEFT, TOP, BOTTOM] = [64, 8, 18];

export function TimePanel({ scrub, growth }: { scrub: Scrub; growth: Growth }) {
  const playing = scrub.playing.value;
  useEffect(() => {
    if (!playing) return;
    const begin = scrub.at.peek() >= INTERVALS ? 0 : scrub.at.peek();
    const from = performance.now() - (begin / INTERVALS) * PLAY;
    let frame = 0;
    const step = () => {
      const at = ((performance.now() - from) / PLAY) * INTERVALS;
      scrub.go(at);
      if (at >= INTERVALS) scrub.playing.value = false;
      else frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
    return () => cancelAnimationFrame(frame);
  }, [playing]);
  const at = scrub.at.value;
  const moment = growth.moments[at];
  const tip = moment?.pose.map((row) => row[3]) ?? [0, 0, 0];
  return (
    <section class="panel time" aria-label={t("envelope.time")} tabIndex={-1} data-panel="time">
      <div class="slide">
        <button onClick={() => (scrub.playing.value = !playing)} data-play={playing ? "on" : "off"}>
          {t(playing ? "envelope.pause" : "envelope.play")}
        </button>
        <input
          type="range"
          min="0"
          max={INTERVALS}
          step="1"
          value={at}
          aria-label={t("envelope.slider")}
          aria-valuetext={t("envelope.at", { t: fixed(moment?.t ?? 0, 3), x: fixed(tip[0], 2), y: fixed(tip[1], 2), z: fixed(tip[2], 2) })}
          onInput={(e) => {
            scrub.playing.value = false;
            scrub.go(Number(e.currentTarget.value));
          }}
        />
        <output>{t("envelope.at", { t: fixed(moment?.t ?? 0, 3), x: fixed(tip[0], 2), y: fixed(tip[1], 2), z: fixed(tip[2], 2) })}</output>
      </div>
      <Chart scrub={scrub} growth={growth} />
    </section>
  );
}

function Chart({ scrub, growth }: { scrub: Scrub; growth: Growth }) {
  const most = Math.max(...growth.moments.map((m) => m.volume_rate), 1e-9);
  const high = HIGH - TOP - BOTTOM;
  const [box, wide] = useWidth(240);
  const width = wide.value;
  const x = (time: number) => LEFT + (width - LEFT - 10) * time;
  const y = (rate: number) => HIGH - BOTTOM - (high * rate) / most;
  const moment = growth.moments[scrub.at.value];
  return (
    <div class="rates" ref={box}>
    <svg
      width={width}
      height={HIGH}
      role="img"
      aria-label={t("envelope.rates")}
      {...untranslated}
      onClick={(e) => {
        const own = e.currentTarget.getBoundingClientRect();
        scrub.go(((e.clientX - own.left - LEFT) / (width - LEFT - 10)) * INTERVALS);
      }}
    >
      {ticks(most, 3).map((rate) => (
        <g key={rate}>
          <path class="border" d={`M${LEFT} ${y(rate)}H${width - 10}`} />
          <text x={LEFT - 6} y={y(rate) + 4} text-anchor="end">
            {short(rate, 3)}
          </text>
        </g>
      ))}
      <path class="rate" d={`M${growth.moments.map((m) => `${x(m.t).toFixed(1)} ${y(m.volume_rate).toFixed(1)}`).join("L")}`} />
      {moment && <path class="cross" d={`M${x(moment.t)} ${TOP}V${HIGH - BOTTOM}`} />}
      {moment && <circle class="spot" cx={x(moment.t)} cy={y(moment.volume_rate)} r="4" />}
      {[0, 0.25, 0.5, 0.75, 1].map((time) => (
        <text key={time} x={x(time)} y={HIGH - 4} text-anchor="middle">
          {time}
        </text>
      ))}
    </svg>
    </div>
  );
}
