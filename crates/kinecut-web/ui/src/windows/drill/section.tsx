// The section through the tool axis: part, surfaces, the drill where each stretch begins and ends, the stretches of one feed, and the drill
// at a place that one chooses.
import type { Signal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { untranslated } from "../../app/verbatim";
import type { Hole } from "../../base/drillsheet";
import { fixed, short } from "../../base/format";
import { widthOf } from "../../base/measure";
import { t, unit } from "../../words";
import { type Line, lineOf } from "./faces";
import { heightOf, outline, silhouette } from "./points";
import { type Question, exitFace } from "./question";
import { apart, useWidth } from "./room";
import { Heights } from "./scale";
import { stageName, zoneClass } from "./stages";

interface Props {
  question: Question;
  hole: Hole;
  /** Way from the start [mm]; null: no place is chosen. */
  way: Signal<number | null>;
}

/** Half the width of the part that is drawn, in radii of the hole. */
const WIDE = 2;
/** Greatest height of a drawing with its breaks [px]. */
const TALL = 640;
/** Least width of the part that is drawn [px]. */
const LEAST = 88;
/** Lengths that differ by less are the same on the drawing [mm]. */
const SAME = 1e-3;

interface Level {
  z: number;
  what: string;
  more: string | null;
}

function levels(question: Question, hole: Hole, narrow: boolean): Level[] {
  const { coordinates: c, lengths } = hole;
  const first = c.Z_nvr1 - question.approach;
  const all: Level[] = [{ z: c.Z_nvr1, what: t("drill.level.start"), more: t("drill.level.approach", { mm: short(question.approach) }) }];
  // The library gives the distance of the first contact from the zero; its height follows from the approach.
  if (Math.abs(Math.abs(first) - lengths.L_nvr) < 1e-6) all.push({ z: first, what: t("drill.level.contact"), more: t("drill.level.radius", { mm: fixed(hole.first_contact_radius, 3) }) });
  all.push({ z: c.Z_nvr2, what: t("drill.level.full"), more: t(narrow ? "drill.level.pointShort" : "drill.level.point", { mm: fixed(lengths.L_vr1, 3) }) });
  if (c.Z_nvyh1 !== null) all.push({ z: c.Z_nvyh1, what: t("drill.level.through"), more: null });
  const over = c.Z_nvyh1 !== null && question.overrun !== null ? t("drill.level.overrun", { mm: short(question.overrun) }) : null;
  all.push({ z: c.Z_end, what: t("drill.level.end"), more: over });
  return all.sort((a, b) => b.z - a.z);
}

export function Section({ question, hole, way }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const width = useWidth(box, 600);
  return (
    <div class="drawing" ref={box}>
      <Drawing question={question} hole={hole} way={way} width={width} />
      {question.ofMesh && <p class="q pad small-print">{t("drill.meshNote")}</p>}
      {question.isTurned && <p class="q pad small-print">{t("drill.turnedNote")}</p>}
      {question.hasMore && <p class="q pad small-print">{t("drill.moreNote")}</p>}
    </div>
  );
}

function Drawing({ question, hole, way, width }: Props & { width: number }) {
  const drawing = useRef<SVGSVGElement>(null);
  const { diameter } = question;
  const radius = diameter / 2;
  const half = question.point && outline(question.point, diameter);
  // Beside a hole that is there only a part of the edge cuts, which is shorter.
  const longer = half ? heightOf(half) - hole.lengths.L_vr1 : NaN;
  if (!half || !question.point || !(question.hasMore ? longer > -SAME : Math.abs(longer) < SAME)) {
    return <p class="q hint">{t("drill.noDrawing")}</p>;
  }
  const { kind } = question.point;
  const place = hole.at;
  const isThrough = hole.coordinates.Z_nvyh1 !== null;
  const above = lineOf(question.entry, "entry", place, 0);
  const below = isThrough ? lineOf(exitFace(question), "exit", place, question.length) : null;
  const start = hole.coordinates.Z_nvr1;
  const end = hole.coordinates.Z_end;
  const point = heightOf(half);
  const narrow = width < 500;
  const all = levels(question, hole, narrow);

  // Room at the left for the names of the stretches, at the right for those of the heights: as much as the words need and the part leaves.
  const names = Math.max(...hole.zones.map((z) => Math.max(widthOf(stageName(z.stage), true), widthOf(`${short(z.feed)} ${unit("mm/rev")}`))));
  const told = Math.max(...all.map((l) => Math.max(widthOf(l.what), l.more ? widthOf(l.more) : 0)));
  const bar = Math.max(narrow ? 104 : 112, 33 + names + 8);
  const words = Math.max(narrow ? 128 : 238, Math.min((narrow ? 14 : 92) + told + 8, width - bar - LEAST));
  const room = Math.max(LEAST, width - bar - words);
  const shown = [start, start + point, ...all.map((l) => l.z), ...all.map((l) => l.z + point), ...hole.zones.map((z) => z.to)];
  for (const line of [above, below]) {
    if (line) shown.push(...[-WIDE * radius, -radius, 0, radius, WIDE * radius].map((u) => line.height(clamp(u, line))));
  }
  const high = Math.max(...shown) + 0.7 * radius;
  const low = Math.min(...shown) - (isThrough ? 0.5 : 0.9) * radius;
  const header = 34;
  let scale = room / (2 * WIDE * radius);
  let heights = new Heights(high, low, scale, header, shown, radius);
  if (heights.pixels > TALL) {
    scale *= TALL / heights.pixels;
    heights = new Heights(high, low, scale, header, shown, radius);
  }
  const height = Math.ceil(header + heights.pixels + 30);
  const axis = bar + room / 2;
  const far = Math.min(8 * radius, room / 2 / scale);
  const x = (u: number) => axis + u * scale;
  const y = (z: number) => heights.y(z);
  const path = (places: number[][], close = true) => places.map(([u, z], i) => `${i ? "L" : "M"}${x(u).toFixed(1)} ${y(z).toFixed(1)}`).join("") + (close ? "Z" : "");

  // The part on both sides of the hole.
  const top = above ?? { height: () => Math.max(0, all[0].z - question.approach), from: -Infinity, to: Infinity };
  const sides = above
    ? [
        [-far, -radius],
        [radius, far],
      ].map(([from, to]) => body(top, below, from, to, low, below ? null : end + point))
    : [];
  const up = (z: number) => z + point + 0.6 * radius;
  const drill = (z: number) => silhouette(kind, half.map(([r, h]) => [r, z + h]), up(z)).map((ring) => path(ring)).join("");

  const middles = apart(all.map((l) => y(l.z)), all.map((l) => (narrow ? (l.more ? 46 : 32) : l.more ? 36 : 24)), header - 10, height - 4);
  const labels = width - words + 14;
  const zones = hole.zones.filter((z) => z.from - z.to > 0);
  const zoneRows = apart(zones.map((z) => (y(z.from) + y(z.to)) / 2), zones.map(() => 46), header - 12, height - 6);
  const travelled = way.value;
  const now = travelled === null ? null : start - travelled;
  const decade = 10 ** Math.floor(Math.log10((room * 0.3) / scale));
  const ruler = [5, 2, 1].map((n) => n * decade).find((n) => n * scale <= room * 0.34) ?? decade;

  const drag = (e: PointerEvent) => {
    const svg = drawing.current;
    if (!svg || e.pointerType === "touch") return;
    const move = (to: PointerEvent) => {
      const at = heights.z(((to.clientY - svg.getBoundingClientRect().top) * height) / svg.getBoundingClientRect().height);
      way.value = Math.min(start - end, Math.max(0, start - at));
    };
    const stop = () => {
      svg.removeEventListener("pointermove", move);
      svg.removeEventListener("pointerup", stop);
      svg.removeEventListener("pointercancel", stop);
    };
    svg.setPointerCapture(e.pointerId);
    svg.addEventListener("pointermove", move);
    svg.addEventListener("pointerup", stop);
    svg.addEventListener("pointercancel", stop);
    move(e);
  };

  return (
    <svg class="cut" ref={drawing} width={width} height={height} viewBox={`0 0 ${width} ${height}`} role="img" aria-label={t("drill.sectionOf", { from: fixed(start, 3), to: fixed(end, 3) })} data-point={point.toFixed(3)} onPointerDown={drag}>
      <defs>
        <pattern id="drill-hatch" width="8" height="8" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
          <path d="M0 0V8" class="hatch" />
        </pattern>
      </defs>
      {sides.map((side, i) => (
        <g key={i}>
          <path d={path(side.ring)} class="solid" />
          <path d={path(side.ring)} fill="url(#drill-hatch)" />
          <path d={path(side.top, false)} class="edge" />
          {below && <path d={path(side.bottom, false)} class="edge" />}
          <path d={path(side.wall, false)} class="edge" />
        </g>
      ))}
      {above && <path d={path(run(top, -radius, radius), false)} class="gone" />}
      {below && <path d={path(run(below, -radius, radius), false)} class="gone" />}
      {!isThrough && above && <Bottom rings={silhouette(kind, half.map(([r, h]) => [r, end + h]), end + point)} low={low} radius={radius} path={path} />}
      <path d={`M${axis} ${header - 6}V${height - 16}`} class="centre" />
      {now === null && (
        <>
          <path d={drill(start)} class="drill start" />
          <path d={drill(hole.coordinates.Z_nvr2)} class="drill entry" />
          {hole.coordinates.Z_nvyh1 !== null && <path d={drill(hole.coordinates.Z_nvyh1)} class="drill steady" />}
          <path d={drill(end)} class="drill exit" />
        </>
      )}
      {now !== null && <path d={drill(now)} class="drill now" data-z={now.toFixed(3)} />}
      {heights.breaks.map((b, i) => (
        <g key={i}>
          <path d={wave(axis - room / 2 - 2, axis + room / 2 + 2, y(b.high) + 4, y(b.low) - 4)} class="break" />
          <text x={axis} y={(y(b.high) + y(b.low)) / 2 + 4} text-anchor="middle">
            {t("drill.leftOut", { mm: short(b.high - b.low, 3) })}
          </text>
        </g>
      ))}
      <g class="size">
        <path d={`M${x(-radius)} ${header - 14}H${x(radius)}M${x(-radius)} ${header - 19}v10M${x(radius)} ${header - 19}v10`} />
        <text x={axis} y={header - 20} text-anchor="middle" class="w" {...untranslated}>
          ⌀ {short(diameter, 6)}
        </text>
      </g>
      {zones.map((z, i) => (
        <g key={i} class={zoneClass(z.stage)}>
          <rect x="10" y={y(z.from)} width="12" height={Math.max(1, y(z.to) - y(z.from))} class="stretch" />
          <path d={`M22 ${(y(z.from) + y(z.to)) / 2}L30 ${zoneRows[i]}`} class="leader" />
          <text x="33" y={zoneRows[i] - 9} class="w b">
            {stageName(z.stage)}
          </text>
          <text x="33" y={zoneRows[i] + 4} {...untranslated}>
            {short(z.feed)} {unit("mm/rev")}
          </text>
          <text x="33" y={zoneRows[i] + 17} {...untranslated}>
            {fixed(z.time, 2)} {unit("s")}
          </text>
        </g>
      ))}
      {all.map((l, i) => (
        <g key={i}>
          <path d={`M${axis} ${y(l.z)}H${labels - 20}L${labels - 4} ${middles[i]}`} class="leader" />
          <text x={labels} y={middles[i] + (narrow ? (l.more ? -10 : -3) : l.more ? -3 : 4)} class="w b" {...untranslated}>
            Z {fixed(l.z, 3)}
          </text>
          <text x={narrow ? labels : labels + 78} y={middles[i] + (narrow ? (l.more ? 4 : 11) : l.more ? -3 : 4)} class="w">
            {l.what}
          </text>
          {l.more && (
            <text x={narrow ? labels : labels + 78} y={middles[i] + (narrow ? 18 : 11)}>
              {l.more}
            </text>
          )}
        </g>
      ))}
      <g class="size">
        <path d={`M${bar} ${height - 12}v6h${ruler * scale}v-6`} />
        <text x={bar + ruler * scale + 6} y={height - 4} {...untranslated}>
          {short(ruler)} {unit("mm")}
        </text>
      </g>
    </svg>
  );
}

/** The part under a blind hole. */
function Bottom({ rings, low, radius, path }: { rings: [number, number][][]; low: number; radius: number; path: (places: number[][], close?: boolean) => string }) {
  return (
    <>
      {rings.map((ring, i) => {
        const edge = ring.slice(1, -1);
        const floor = [...edge, [edge[edge.length - 1][0], low], [edge[0][0], low]];
        return (
          <g key={i}>
            <path d={path(floor)} class="solid" />
            <path d={path(floor)} fill="url(#drill-hatch)" />
            <path d={path(edge, false)} class="edge" />
          </g>
        );
      })}
      <path d={path([[-radius, low], [radius, low]], false)} class="gone" />
    </>
  );
}

function clamp(u: number, line: Line): number {
  return Math.min(line.to, Math.max(line.from, u));
}

/** Places along a surface, no farther than it reaches. */
function run(line: Line, from: number, to: number): number[][] {
  const [a, b] = [clamp(from, line), clamp(to, line)];
  const pieces = 48;
  return Array.from({ length: pieces + 1 }, (_, i) => a + ((b - a) * i) / pieces).map((u) => [u, line.height(u)]);
}

/** The part beside the hole: between both surfaces, or down to where the drawing ends. */
function body(above: Line, below: Line | null, from: number, to: number, low: number, corner: number | null) {
  const reach = (u: number) => clamp(below ? clamp(u, below) : u, above);
  const [a, b] = [reach(from), reach(to)];
  const top = run(above, a, b);
  const bottom = below ? run(below, a, b) : [[a, low], [b, low]];
  // Beside a cylinder both sides may cross: there the part ends.
  const joined = bottom.map(([u, z]) => [u, Math.min(z, above.height(u))]);
  const inner = Math.abs(from) < Math.abs(to) ? a : b;
  const wall = [[inner, above.height(inner)], [inner, below ? Math.min(below.height(inner), above.height(inner)) : (corner ?? low)]];
  return { ring: [...top, ...[...joined].reverse()], top, bottom: joined, wall };
}

/** A band between two waves. */
function wave(left: number, right: number, high: number, low: number): string {
  const step = 14;
  const along = (from: number, to: number) => {
    const count = Math.max(1, Math.round(Math.abs(to - from) / step));
    const d = (to - from) / count;
    return Array.from({ length: count }, (_, i) => `q${(d / 2).toFixed(1)} ${i % 2 ? 5 : -5} ${d.toFixed(1)} 0`).join("");
  };
  return `M${left} ${high}${along(left, right)}L${right} ${low}${along(right, left)}Z`;
}
