// The parameter plane: up the profile, the angle about the axis across; where the tool enters, the curve by its spans, folds. What is looked
// at here is looked at on the tool.
import { useMemo } from "preact/hooks";
import { untranslated } from "../../app/verbatim";
import { fixed } from "../../base/format";
import { t } from "../../words";
import { curvesOf, regionsOf } from "./planelines";
import type { Piece, Sheet } from "./sheet";
import type { Looked } from "./state";
import { useWidth } from "./width";

/** Height of an edge, which has no length, and least height of an element [px]. */
const [FAN, LEAST] = [20, 16];
const HEIGHT = 440;
const [TOP, BOTTOM] = [12, 34];
/** Way of the place that is looked at by a key [deg], and by the height of the plane. */
const [TURN, RISE] = [5, 0.01];
/** Distance within which the pointer is on a curve [px]. */
const NEAR = 9;

interface Layout {
  left: number;
  right: number;
  /** Bottom and height of each piece [px]. */
  rows: [number, number][];
}

function layoutOf(pieces: Piece[], width: number): Layout {
  const length = (p: Piece) => (p.fan ? 0 : p.parameter === "mm" ? p.to - p.from : (Math.abs(p.to - p.from) * Math.PI * Math.abs(p.radius ?? 0)) / 180);
  const fans = pieces.filter((p) => p.fan).length;
  const all = pieces.reduce((sum, p) => sum + length(p), 0) || 1;
  const room = HEIGHT - TOP - BOTTOM;
  const fixedRoom = fans * FAN + (pieces.length - fans) * LEAST;
  const squeeze = Math.min(1, room / fixedRoom);
  const free = Math.max(0, room - squeeze * fixedRoom);
  let at = HEIGHT - BOTTOM;
  const rows = pieces.map((p): [number, number] => {
    const high = p.fan ? squeeze * FAN : squeeze * LEAST + (free * length(p)) / all;
    const bottom = at;
    at -= high;
    return [bottom, high];
  });
  return { left: width < 420 ? 92 : 112, right: width - 12, rows };
}

export function Plane({ looked, dim }: { looked: Looked; dim: boolean }) {
  const [box, width] = useWidth(260);
  const sheet = looked.sheet.value;
  return (
    <section class="panel plane" aria-label={t("grazing.plane")} tabIndex={-1} data-panel="plane">
      <header>
        <h2>{t("grazing.plane")}</h2>
        <span class="q">{t("grazing.planeHow")}</span>
      </header>
      <div class={`drawing${dim ? " dim" : ""}`} ref={box}>
        {sheet && <Drawing sheet={sheet} looked={looked} width={width.value} />}
      </div>
    </section>
  );
}

function Drawing({ sheet, looked, width }: { sheet: Sheet; looked: Looked; width: number }) {
  const layout = useMemo(() => layoutOf(sheet.pieces, width), [sheet, width]);
  const { left, right, rows } = layout;
  const x = (theta: number) => left + ((right - left) * theta) / 360;
  const y = (piece: number, u: number) => {
    const p = sheet.pieces[piece];
    const [bottom, high] = rows[piece];
    return bottom - (high * (u - p.from)) / (p.to - p.from);
  };
  const top = rows[rows.length - 1][0] - rows[rows.length - 1][1];
  const regions = useMemo(() => regionsOf(sheet, x, y), [layout]);
  const curves = useMemo(() => curvesOf(sheet, x, y), [layout]);
  const spot = looked.spot.value;

  const at = (px: number, py: number) => {
    const theta = Math.min(360, Math.max(0, ((px - left) / (right - left)) * 360));
    const piece = Math.max(0, rows.findIndex(([bottom, high]) => py <= bottom && py >= bottom - high));
    const p = sheet.pieces[piece];
    const part = Math.min(1, Math.max(0, (rows[piece][0] - py) / rows[piece][1]));
    return { piece, u: p.from + part * (p.to - p.from), theta };
  };
  const point = (px: number, py: number) => {
    let [best, found]: [number, [number, number] | null] = [NEAR, null];
    sheet.loops.forEach(({ points }, loop) => {
      points.forEach((p, index) => {
        const away = Math.hypot(x(p.theta) - px, y(p.piece, p.u) - py);
        if (away < best) [best, found] = [away, [loop, index]];
      });
    });
    if (found) return looked.lookAtCurve(found[0], found[1]);
    const place = at(px, py);
    looked.lookAt(place.piece, place.u, place.theta);
  };
  const keys = (e: KeyboardEvent) => {
    const way: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const by = way[e.key];
    if (e.key === "Escape" && spot) looked.spot.value = null;
    if (!by || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    const step = e.shiftKey ? 5 : 1;
    const [px, py] = spot ? [x(spot.theta), y(spot.piece, spot.u)] : [(left + right) / 2, (top + HEIGHT - BOTTOM) / 2];
    const theta = ((((px - left) / (right - left)) * 360 + by[0] * TURN * step + 360) % 360) as number;
    const place = at(x(theta), Math.min(HEIGHT - BOTTOM, Math.max(top, py + by[1] * RISE * HEIGHT * step)));
    looked.lookAt(place.piece, place.u, theta);
  };
  let last = Infinity;
  return (
    <svg
      width={width}
      height={HEIGHT}
      role="img"
      tabindex={0}
      aria-label={t("grazing.planeIs", { n: sheet.loops.length })}
      {...untranslated}
      onPointerMove={(e) => {
        const own = e.currentTarget.getBoundingClientRect();
        point(e.clientX - own.left, e.clientY - own.top);
      }}
      onPointerLeave={() => (looked.spot.value = null)}
      onKeyDown={keys}
    >
      <clipPath id="grazing-plane">
        <rect x={left} y={top} width={right - left} height={HEIGHT - BOTTOM - top} />
      </clipPath>
      <g clip-path="url(#grazing-plane)">
        <rect class="leaves" x={left} y={top} width={right - left} height={HEIGHT - BOTTOM - top} />
        <path class="enters" d={regions} />
        {rows.slice(1).map(([bottom], i) => (
          <path key={i} class="border" d={`M${left} ${bottom}H${right}`} />
        ))}
        {[90, 180, 270].map((theta) => (
          <path key={theta} class="border" d={`M${x(theta)} ${top}V${HEIGHT - BOTTOM}`} />
        ))}
        {sheet.whole.map((piece) => (
          <path key={`w${piece}`} class="whole" d={`M${left} ${rows[piece][0] - rows[piece][1] / 2}H${right}`} />
        ))}
        {sheet.circles.map((circle, i) => (
          <path key={`c${i}`} class="whole" d={`M${left} ${y(circle.piece, circle.at)}H${right}`} />
        ))}
        {curves.map(({ span, kind, d }, i) => (
          <path key={i} data-span={span} class={`curve kind${kind}${looked.span.value === span ? " on" : ""}`} d={d} onClick={() => (looked.span.value = looked.span.value === span ? null : span)} />
        ))}
        {sheet.folds.map((fold, i) => (
          <circle key={i} class="fold" cx={x(fold.theta)} cy={y(fold.piece, fold.u)} r="4.5" />
        ))}
        {spot && <path class="cross" d={`M${left} ${y(spot.piece, spot.u)}H${right}M${x(spot.theta)} ${top}V${HEIGHT - BOTTOM}`} />}
        {spot && <circle class="spot" cx={x(spot.theta)} cy={y(spot.piece, spot.u)} r="7" />}
      </g>
      <path class="frame" d={`M${left} ${top}H${right}V${HEIGHT - BOTTOM}H${left}Z`} />
      {rows.map(([bottom, high], i) => {
        const middle = bottom - high / 2;
        // Names that would lie on each other are left out.
        if (last - middle < 11) return null;
        last = middle;
        return (
          <text key={i} x={left - 6} y={middle + 4} text-anchor="end">
            {sheet.pieces[i].what}
          </text>
        );
      })}
      {[0, 90, 180, 270, 360].map((theta) => (
        <text key={theta} x={x(theta)} y={HEIGHT - BOTTOM + 15} text-anchor={theta === 360 ? "end" : "middle"}>
          {theta}°
        </text>
      ))}
      <text x={(left + right) / 2} y={HEIGHT - 4} text-anchor="middle">
        {t("grazing.planeAxis")}
      </text>
    </svg>
  );
}

/** The place that is looked at, in words. */
export function ReadOut({ looked }: { looked: Looked }) {
  const sheet = looked.sheet.value;
  const spot = looked.spot.value;
  if (!sheet) return null;
  const piece = spot && sheet.pieces[spot.piece];
  return (
    <p class="readout" role="status" data-readout={spot ? (spot.on ? "curve" : spot.enters ? "enters" : sheet.whole.includes(spot.piece) ? "slides" : "leaves") : ""}>
      {spot && piece ? (
        <>
          <b translate={false}>{piece.what}</b>{" "}
          <span>{t(piece.parameter === "mm" ? "grazing.atWay" : "grazing.atNormal", { u: fixed(spot.u, 3), theta: fixed(spot.theta, 2), z: fixed(spot.point[2], 3) })}</span>{" "}
          <b>{t(spot.on ? "grazing.onCurve" : spot.enters ? "grazing.enters" : sheet.whole.includes(spot.piece) ? "grazing.slides" : "grazing.leaves")}</b>
        </>
      ) : (
        <span class="q">{t("grazing.readHow")}</span>
      )}
    </p>
  );
}
