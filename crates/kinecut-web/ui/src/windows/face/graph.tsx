// The bad length over all placements: the cells and the number under the pointer are the verb's.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { fixed, short, ticks } from "../../base/format";
import { widthOf } from "../../base/measure";
import { untranslated } from "../../app/verbatim";
import { t } from "../../words";
import type { Descent, Placement } from "./answer";
import type { Map } from "./map";
import { middle, round360 } from "./shape";
import { useWidth } from "./size";
import type { Face, Hand } from "./state";

const TOP = 10;
const LEFT = 40;
const BELOW = 40;

/** The turn at the left border: in the middle of the widest gap between allowed turns, so that what is allowed is not cut. */
function beginOf(map: Map): number {
  const taken = new Uint8Array(360);
  for (const { turn } of map.steps.flat()) for (let i = Math.floor(turn[0]); i < turn[1]; i++) taken[((i % 360) + 360) % 360] = 1;
  let [best, middleOf] = [0, 0];
  for (let from = 0; from < 360; from++) {
    if (taken[from] || !taken[(from + 359) % 360]) continue;
    let n = 0;
    while (n < 360 && !taken[(from + n) % 360]) n++;
    if (n > best) [best, middleOf] = [n, from + n / 2];
  }
  return best === 0 ? 0 : Math.round(middleOf / 30) * 30;
}

export function Graph({ face }: { face: Face }) {
  const [box, width] = useWidth(560);
  const map = face.map.value?.map ?? null;
  const stale = face.map.value !== null && face.map.value.text !== face.text.value;
  return (
    <div class="graph" ref={box}>
      {map ? (
        <Plot face={face} map={map} width={width.value} stale={stale} />
      ) : (
        <p class="q hint">{face.comparing.value || face.searching.value ? t("face.graphComes") : face.leastWrong.value ? t("face.noPicture") : t("face.graphNone")}</p>
      )}
    </div>
  );
}

interface Axes {
  x: (turn: number) => number;
  y: (beside: number) => number;
  hand: (px: number, py: number) => Hand | null;
  right: number;
  bottom: number;
  begin: number;
}

function Plot({ face, map, width, stale }: { face: Face; map: Map; width: number; stale: boolean }) {
  const height = width < 420 ? 260 : 250;
  const right = width - 62;
  const bottom = height - BELOW;
  const begin = useMemo(() => beginOf(map), [map]);
  const axes: Axes = {
    right,
    bottom,
    begin,
    x: (turn) => LEFT + (round360(turn - begin) / 360) * (right - LEFT),
    y: (beside) => TOP + ((map.half - beside) / (2 * map.half)) * (bottom - TOP),
    hand: (px, py) => {
      if (px < LEFT || px > right || py < TOP || py > bottom) return null;
      return { turn: round360(begin + ((px - LEFT) / (right - LEFT)) * 360), beside: map.half - ((py - TOP) / (bottom - TOP)) * 2 * map.half };
    },
  };
  const cells = useMemo(() => cellPaths(map, axes), [map, width]);
  const point = (e: MouseEvent) => {
    const bounds = (e.currentTarget as Element).getBoundingClientRect();
    return axes.hand(e.clientX - bounds.left, e.clientY - bounds.top);
  };
  const neat = (h: Hand): Hand => ({ turn: Math.round(h.turn * 10) / 10, beside: Math.round(h.beside * 100) / 100 });
  const at = useSignal<Hand | null>(null);
  useEffect(() => () => void face.pointed(null), []);
  const go = (h: Hand | null) => {
    at.value = h && neat(h);
    void face.pointed(at.value);
  };
  return (
    <svg
      width={width}
      height={height}
      role="img"
      aria-label={t("face.graphIs")}
      class={stale ? "aged" : ""}
      onPointerMove={(e) => go(point(e))}
      onPointerLeave={() => go(null)}
      onPointerDown={(e) => go(point(e))}
      onClick={() => at.value && face.go(at.value)}
    >
      <defs>
        <pattern id="face-none" width="8" height="8" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
          <path class="hatch" d="M0 0V8" />
        </pattern>
      </defs>
      <rect class="ground" x={LEFT} y={TOP} width={right - LEFT} height={bottom - TOP} />
      <rect fill="url(#face-none)" x={LEFT} y={TOP} width={right - LEFT} height={bottom - TOP} />
      {cells.map((d, i) => d && <path key={i} class="cell" d={d} style={{ fill: `var(--scale${i})`, stroke: `var(--scale${i})` }} />)}
      <Paper face={face} axes={axes} />
      <Walked face={face} axes={axes} />
      <Marks face={face} axes={axes} />
      <Numbers map={map} axes={axes} width={width} height={height} />
      <Under face={face} axes={axes} at={at.value} />
    </svg>
  );
}

function cellPaths(map: Map, axes: Axes): string[] {
  return map.steps.map((cells) => {
    let d = "";
    for (const { turn, beside } of cells) {
      const wide = ((turn[1] - turn[0]) / 360) * (axes.right - LEFT);
      const from = axes.x(turn[0]);
      const [a, b] = [axes.y(beside[0]), axes.y(beside[1])];
      d += `M${from.toFixed(1)} ${a.toFixed(1)}H${Math.min(axes.right, from + wide).toFixed(1)}V${b.toFixed(1)}H${from.toFixed(1)}Z`;
    }
    return d;
  });
}

function Numbers({ map, axes, width, height }: { map: Map; axes: Axes; width: number; height: number }) {
  const { right, bottom, begin } = axes;
  const room = right - LEFT;
  const turns = Array.from({ length: 7 }, (_, i) => begin + 60 * i).filter((_, i) => room > 330 || i % 2 === 0);
  const offsets = ticks(map.half, 2).flatMap((n) => (n === 0 ? [0] : [n, -n]));
  const step = (bottom - TOP) / 16;
  return (
    <g>
      <rect class="frame" x={LEFT} y={TOP} width={room} height={bottom - TOP} />
      {turns.map((turn) => {
        const x = LEFT + ((turn - begin) / 360) * room;
        return (
          <g key={turn} {...untranslated}>
            <path class="axis" d={`M${x} ${bottom}v4`} />
            <text x={x} y={bottom + 16} text-anchor="middle">
              {round360(turn)}°
            </text>
          </g>
        );
      })}
      {offsets.map((n) => (
        <g key={n} {...untranslated}>
          <path class="axis" d={`M${LEFT} ${axes.y(n)}h-4`} />
          <text x={LEFT - 7} y={axes.y(n) + 4} text-anchor="end">
            {fixed(n, n % 1 === 0 ? 0 : 1)}
          </text>
        </g>
      ))}
      <text x={LEFT + room / 2} y={height - 6} text-anchor="middle">
        {t("face.axisTurn")}
      </text>
      <text transform={`translate(11 ${(TOP + bottom) / 2}) rotate(-90)`} text-anchor="middle">
        {t("face.axisOffset")}
      </text>
      {Array.from({ length: 16 }, (_, i) => (
        <rect key={i} x={right + 14} y={bottom - (i + 1) * step} width={12} height={step + 0.4} style={{ fill: `var(--scale${i})` }} />
      ))}
      {map.ticks.map(({ value, share }) => (
        <text key={value} {...untranslated} x={right + 30} y={bottom - share * (bottom - TOP) + 4}>
          {short(value)}
        </text>
      ))}
      <text x={width - 2} y={height - 6} text-anchor="end">
        {t("face.axisBad")}
      </text>
    </g>
  );
}

const STAR = "M0-8l2.6 6 6.4.5-5 4.2 1.6 6.3L0 5.5-5.6 9-4 2.700-9-1.500-2.600-2Z";

function Marks({ face, axes }: { face: Face; axes: Axes }) {
  const { outline, optimum } = face;
  const shape = outline.value;
  const hand = face.hand.value;
  if (!shape) return null;
  const of = (p: Placement) => ({ turn: p.turn, beside: p.offset - middle(shape, p.turn) });
  const place = (h: Hand) => `translate(${axes.x(h.turn)} ${axes.y(h.beside)})`;
  const best = optimum.value;
  const [x, y] = hand ? [axes.x(hand.turn), axes.y(hand.beside)] : [0, 0];
  const cross = `M${x} ${TOP}V${axes.bottom}M${LEFT} ${y}H${axes.right}`;
  const seen = hand && y >= TOP && y <= axes.bottom;
  return (
    <g>
      {best?.alternatives.map((a, i) => <circle key={i} class="other" r={3.5} transform={place(of(a.placement))} />)}
      {best && <path class="star" d={STAR} transform={place(of(best.placement))} />}
      {seen && <path class="cross out" d={cross} />}
      {seen && <path class="cross" d={cross} />}
      {seen && <circle class="hand" cx={x} cy={y} r={5} />}
    </g>
  );
}

/** Starts and ends of the paper's method; the verb does not tell what lies between. */
function Paper({ face, axes }: { face: Face; axes: Axes }) {
  const told = face.ways.value;
  const shape = face.outline.value;
  if (!face.showPaper.value || !told?.answer.paper || told.text !== face.text.value || !shape) return null;
  const { paper } = told.answer;
  const at = (p: Placement): [number, number] => [axes.x(p.turn), axes.y(p.offset - middle(shape, p.turn))];
  const line = (d: Descent) => {
    const [a, b] = [at(d.start), at(d.end)];
    // Over the border the straight line between them would lead the wrong way round.
    return Math.abs(a[0] - b[0]) > (axes.right - LEFT) / 2 ? `M${a}` : `M${a}L${b}`;
  };
  const inside = (d: Descent) => {
    const y = at(d.end)[1];
    return y >= TOP && y <= axes.bottom;
  };
  const first = paper.descent_from_as_drawn;
  return (
    <g class="paper">
      <path class="run" d={paper.descents.filter(inside).map(line).join("")} />
      {paper.descents.filter(inside).map((d, i) => {
        const [x, y] = at(d.end);
        return <circle key={i} class="end" cx={x} cy={y} r={2.6} />;
      })}
      {first && inside(first) && <path class="run first" d={line(first)} />}
      {first && inside(first) && <circle class="end first" cx={at(first.end)[0]} cy={at(first.end)[1]} r={4} />}
    </g>
  );
}

/** The way of the paper's method from the placement under the hand: its best corners, and its last triangle. */
function Walked({ face, axes }: { face: Face; axes: Axes }) {
  const walked = face.walk.value;
  const shape = face.outline.value;
  if (!walked || walked.text !== face.text.value || !shape) return null;
  const at = (p: Placement): [number, number] => [axes.x(p.turn), Math.min(axes.bottom, Math.max(TOP, axes.y(p.offset - middle(shape, p.turn))))];
  let d = "";
  let before = 0;
  const path = walked.steps.map((s) => s.corners[0]).filter((p, i, all) => i === 0 || p.turn !== all[i - 1].turn || p.offset !== all[i - 1].offset);
  for (const p of path) {
    const [x, y] = at(p);
    // Over the border it goes on at the other side.
    d += `${d === "" || Math.abs(x - before) > (axes.right - LEFT) / 2 ? "M" : "L"}${x.toFixed(1)} ${y.toFixed(1)}`;
    before = x;
  }
  const corners = walked.steps[walked.steps.length - 1].corners.map(at);
  const spread = Math.max(...corners.map(([x]) => x)) - Math.min(...corners.map(([x]) => x));
  return (
    <g class="walk" data-steps={path.length}>
      {spread < (axes.right - LEFT) / 2 && <path class="triangle" d={`M${corners.map((c) => c.join(" ")).join("L")}Z`} />}
      <path class="way out" d={d} />
      <path class="way" d={d} />
      {path.map((p, i) => (
        <circle key={i} class="step" cx={at(p)[0]} cy={at(p)[1]} r={i === path.length - 1 ? 4 : 2} />
      ))}
    </g>
  );
}

/** The read-out under the pointer: place first, then the verb's number. */
function Under({ face, axes, at }: { face: Face; axes: Axes; at: Hand | null }) {
  if (!at) return null;
  const under = face.under.value;
  const known = under && under.hand.turn === at.turn && under.hand.beside === at.beside && under.text === face.text.value ? under : null;
  const where = t("face.underWhere", { turn: fixed(at.turn, 1), mm: fixed(at.beside, 2) });
  const what = !known ? "…" : known.answer ? t("face.underBad", { bad: fixed(known.answer.ways[known.answer.chosen].guarded, 1) }) : t("face.underNot");
  const [x, y] = [axes.x(at.turn), axes.y(at.beside)];
  const wide = 14 + Math.max(widthOf(where), widthOf(what, true));
  const left = x + 14 + wide > axes.right ? x - 14 - wide : x + 14;
  const top = Math.min(Math.max(TOP, y - 20), axes.bottom - 40);
  return (
    <g class="told" data-ms={known?.ms} data-known={known ? "yes" : "no"}>
      <path class="hair" d={`M${x} ${TOP}V${axes.bottom}M${LEFT} ${y}H${axes.right}`} />
      <rect x={Math.max(LEFT, left)} y={top} width={wide} height={38} rx={4} />
      <text x={Math.max(LEFT, left) + 6} y={top + 15}>
        {where}
      </text>
      <text class="b" x={Math.max(LEFT, left) + 6} y={top + 31}>
        {what}
      </text>
    </g>
  );
}
