// The share of the point in material along the way, with the feed of each stretch.
import type { Signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { untranslated } from "../../app/verbatim";
import type { Hole, Load as Curve } from "../../base/drillsheet";
import { fixed, short, ticks } from "../../base/format";
import { t, unit } from "../../words";
import { useWidth } from "./room";
import { atWay, zoneClass } from "./stages";

const [TOP, PLOT, BELOW, RIGHT] = [12, 120, 40, 14];

/** The share at a place of the way, between two of its known places. */
function shareAt({ way, share }: Curve, at: number): number {
  const next = way.findIndex((x) => x >= at);
  if (next <= 0) return share[next < 0 ? share.length - 1 : 0];
  const [x0, x1] = [way[next - 1], way[next]];
  const [y0, y1] = [share[next - 1], share[next]];
  return x1 > x0 ? y0 + ((y1 - y0) * (at - x0)) / (x1 - x0) : y1;
}

export function Load({ hole, way }: { hole: Hole; way: Signal<number | null> }) {
  const curve = hole.load && hole.load.way.length > 1 ? hole.load : null;
  const box = useRef<HTMLDivElement>(null);
  const width = useWidth(box, 560);
  const whole = hole.lengths.L_rx;
  const most = Math.max(...hole.zones.map((z) => z.feed));
  const left = 36;
  const x = (mm: number) => left + ((width - left - RIGHT) * mm) / whole;
  const y = (share: number) => TOP + PLOT * (1 - share);
  let gone = 0;
  const zones = hole.zones.map((z) => {
    const from = gone;
    gone += z.from - z.to;
    return { ...z, start: from, stop: gone };
  });
  const feed = zones.map((z, i) => `${i ? "L" : "M"}${x(z.start).toFixed(1)} ${y(z.feed / most).toFixed(1)}H${x(z.stop).toFixed(1)}`).join("");
  const line = curve?.way.map((mm, i) => `${i ? "L" : "M"}${x(mm).toFixed(1)} ${y(curve.share[i]).toFixed(1)}`).join("");
  const now = way.value === null ? null : atWay(hole.zones, way.value);
  const at = way.value ?? 0;
  const move = (e: PointerEvent) => {
    const bounds = (e.currentTarget as Element).getBoundingClientRect();
    const mm = ((e.clientX - bounds.left - left) / (width - left - RIGHT)) * whole;
    way.value = Math.min(whole, Math.max(0, mm));
  };
  const told = now && curve ? [t("drill.inMaterial", { share: fixed(shareAt(curve, at), 2) }), `${short(hole.zones[now.index].feed)} ${unit("mm/rev")}`] : [];
  const plate = x(at) > width / 2 ? x(at) - 168 : x(at) + 8;
  return (
    <section class="panel" aria-label={t("drill.load")} tabIndex={-1} data-panel="load">
      <header>
        <h2>{t("drill.load")}</h2>
      </header>
      <p class="q legend">
        <span>
          <i class="sample" /> {t("drill.share")}
        </span>
        <span>
          <i class="sample feed" /> {t("drill.feedShare", { most: short(most) })}
        </span>
      </p>
      <div class="drawing" ref={box}>
        {curve ? (
          <svg
            class="load"
            width={width}
            height={TOP + PLOT + BELOW}
            role="img"
            aria-label={t("drill.load")}
            onPointerDown={(e) => {
              if (e.pointerType !== "touch") e.currentTarget.setPointerCapture(e.pointerId);
              move(e);
            }}
            onPointerMove={(e) => e.buttons === 1 && e.pointerType !== "touch" && move(e)}
          >
            {zones.map((z, i) => (
              <rect key={i} class={`${zoneClass(z.stage)} under`} x={x(z.start)} y={TOP} width={Math.max(0, x(z.stop) - x(z.start))} height={PLOT} />
            ))}
            {[0, 0.5, 1].map((share) => (
              <g key={share}>
                <path class="grid" d={`M${left} ${y(share)}H${width - RIGHT}`} />
                <text x={left - 6} y={y(share) + 4} text-anchor="end">
                  {short(share)}
                </text>
              </g>
            ))}
            {ticks(whole, Math.max(2, width / 90)).map((mm) => (
              <g key={mm}>
                <path class="axis" d={`M${x(mm)} ${TOP + PLOT}v4`} />
                <text x={x(mm)} y={TOP + PLOT + 16} text-anchor="middle">
                  {short(mm)}
                </text>
              </g>
            ))}
            <path class="axis" d={`M${left} ${TOP}V${TOP + PLOT}H${width - RIGHT}`} />
            <text x={width - RIGHT} y={TOP + PLOT + 33} text-anchor="end">
              {t("drill.wayAxis")}
            </text>
            <path class="area" d={`${line}L${x(whole)} ${y(0)}L${x(0)} ${y(0)}Z`} />
            <path class="share" d={line} />
            <path class="feed" d={feed} />
            {now && (
              <g class="hair">
                <path d={`M${x(at)} ${TOP}V${TOP + PLOT}`} />
                <rect x={plate} y={TOP + 32} width="160" height="36" rx="3" />
                <text x={plate + 8} y={TOP + 47} class="w b">
                  {told[0]}
                </text>
                <text x={plate + 8} y={TOP + 62} {...untranslated}>
                  {told[1]}
                </text>
              </g>
            )}
          </svg>
        ) : (
          <p class="q hint">{t("drill.noLoad")}</p>
        )}
      </div>
    </section>
  );
}
