// The part under the cutter: dragged to shift, turned by its ring; where teeth leave badly, well, and where they enter is the verb's answer.
import { fixed, short } from "../../base/format";
import { untranslated } from "../../app/verbatim";
import { t, unit } from "../../words";
import type { Edge, FaceAnswer, Stretch } from "./answer";
import { useHands } from "./hands";
import { type Layout, layout } from "./layout";
import { type Point, faceOf, pointOn, round360, strokeOf } from "./shape";
import { useWidth } from "./size";
import type { Face, Hand } from "./state";

/** The class of a stretch: colour, width and dash of how it is met. */
function classOf(stretch: Stretch, edge: Edge): string {
  if (stretch.met === "entry") return "ex-in";
  if (stretch.met !== "exit") return "ex-none";
  if (!(stretch.weight && stretch.weight > 0)) return "ex-ok";
  return edge.weight === 0 ? "ex-off" : "ex-bad";
}

const ORDER = ["ex-in", "ex-none", "ex-ok", "ex-off", "ex-bad"];

export function Picture({ face }: { face: Face }) {
  const [box, width] = useWidth(640);
  const least = face.least.value?.answer;
  const hand = face.hand.value;
  return (
    <div class="flat" ref={box}>
      {least && hand ? <Held face={face} least={least} hand={hand} width={width.value} /> : <p class="q hint">{face.leastWrong.value ? t("face.noPicture") : t("face.searching")}</p>}
    </div>
  );
}

function Held({ face, least, hand, width }: { face: Face; least: FaceAnswer; hand: Hand; width: number }) {
  const l = layout(least, hand, face.along.value, face.view.value, width);
  const hands = useHands(face, hand, l, (at) => (face.label.value = labelAt(least.outline.edges, l, at)));
  return (
    <>
      <div
        class={hands.pans.value ? "held pans" : "held"}
        tabIndex={0}
        role="application"
        aria-label={t("face.picture")}
        aria-describedby="face-live"
        onPointerDown={hands.down}
        onPointerMove={hands.move}
        onPointerUp={hands.up}
        onPointerCancel={hands.up}
        // The middle button would begin to scroll.
        onMouseDown={(e) => e.button === 1 && e.preventDefault()}
        onWheel={hands.wheel}
        onKeyDown={hands.key}
        style={{ height: l.height }}
        data-late={face.late.value || undefined}
        data-zoom={face.view.value.zoom.toFixed(3)}
      >
        <svg width={l.width} height={l.height} aria-hidden="true">
          <path class="body" d={faceOf(least.outline, l.frame, l.scale)} />
          <Cutter answer={least} l={l} />
          <path class="feedline" d={`M8 ${l.centre[1]}H${l.width - 18}`} />
          <path class="tip" d={`M${l.width - 18} ${l.centre[1] - 5}l10 5-10 5Z`} />
          <text class="b accent" x={l.width - 12} y={20} text-anchor="end">
            {t("face.feed")} →
          </text>
          <Exits face={face} l={l} />
          <Marked face={face} l={l} />
          <path class="arm" d={`M${l.pivot[0]} ${l.pivot[1]}L${l.ring[0]} ${l.ring[1]}`} />
          <circle class="grip" cx={l.ring[0]} cy={l.ring[1]} r={9} />
          <path class="gripmark" d={`M${l.ring[0] - 4} ${l.ring[1] + 1}a4.5 4.5 0 1 1 4.5 4`} />
          <circle class="grip" cx={l.pivot[0]} cy={l.pivot[1]} r={5} />
          <Told l={l} hand={hand} />
          <Scale l={l} />
        </svg>
      </div>
      <p class="sr" id="face-live" role="status">
        <Spoken face={face} />
      </p>
    </>
  );
}

/** The label of the nearest edge, if the pointer is on one; null beside. */
function labelAt(edges: Edge[], l: Layout, [x, y]: Point): string | null {
  let [best, label]: [number, string | null] = [10, null];
  for (const edge of edges) {
    const count = edge.sweep === undefined ? 24 : 32;
    for (let i = 0; i <= count; i++) {
      const p = l.frame(pointOn(edge, i / count));
      const far = Math.hypot(p[0] - x, p[1] - y);
      if (far < best) [best, label] = [far, edge.label];
    }
  }
  return label;
}

function Cutter({ answer, l }: { answer: FaceAnswer; l: Layout }) {
  const { cutter } = answer;
  const r = cutter.radius * l.scale;
  const [x, y] = l.cutter;
  const inner = r * 0.78;
  // Clockwise, on the left; counter-clockwise for a left-hand cutter.
  const arc = (a: number) => `${x + inner * Math.cos(a)} ${y - inner * Math.sin(a)}`;
  const [from, to] = cutter.left_hand ? [2.7, 3.58] : [3.58, 2.7];
  const end: Point = [x + inner * Math.cos(to), y - inner * Math.sin(to)];
  const way = (cutter.left_hand ? 180 : 0) - (to * 180) / Math.PI + 90;
  return (
    <g class="cutter">
      <circle cx={x} cy={y} r={r} />
      {cutter.teeth.map((tooth, i) => {
        const turn = 20 + (360 * i) / cutter.teeth.length;
        const a = (turn * Math.PI) / 180;
        return <rect key={i} x={-5} y={-7} width={10} height={14} rx={2} transform={`translate(${x + r * Math.cos(a)} ${y - r * Math.sin(a)}) rotate(${90 - turn})`} data-radius={tooth.radius} />;
      })}
      <path class="spin" d={`M${arc(from)}A${inner} ${inner} 0 0 ${cutter.left_hand ? 0 : 1} ${arc(to)}`} />
      <path class="tip" d="M-4 5L0-5 4 5Z" transform={`translate(${end[0]} ${end[1]}) rotate(${way})`} />
      <circle class="dot" cx={x} cy={y} r={4} />
      <text class="w" x={12} y={20}>
        {t("face.cutter", { d: fixed(2 * cutter.radius, 0), n: cutter.teeth.length })}
      </text>
    </g>
  );
}

/** Edges by how teeth meet them; where that is not known, as plain edges. */
function Exits({ face, l }: { face: Face; l: Layout }) {
  const placed = face.placed.value;
  const outline = face.outline.value;
  if (!outline) return null;
  const answer = placed?.answer;
  if (!answer || answer.outline.edges.length !== outline.edges.length) return <path class="ex-unknown" d={outline.edges.map((e) => strokeOf(e, 0, 1, l.frame, l.scale)).join("")} />;
  const paths: Record<string, string> = {};
  for (const stretch of answer.stretches) {
    const edge = answer.outline.edges[stretch.edge];
    const name = classOf(stretch, edge);
    paths[name] = (paths[name] ?? "") + strokeOf(edge, stretch.from, stretch.to, l.frame, l.scale);
  }
  return (
    <g class={face.late.value || placed.text !== face.text.value ? "exits aged" : "exits"}>
      {ORDER.filter((name) => paths[name]).map((name) => (
        <path key={name} class={name} d={paths[name]} />
      ))}
    </g>
  );
}

/** The edges of the label that was clicked. */
function Marked({ face, l }: { face: Face; l: Layout }) {
  const label = face.label.value;
  const edges = face.outline.value?.edges.filter((e) => label !== null && e.label === label) ?? [];
  if (edges.length === 0) return null;
  return <path class="chosen" d={edges.map((e) => strokeOf(e, 0, 1, l.frame, l.scale)).join("")} />;
}

function Told({ l, hand }: { l: Layout; hand: Hand }) {
  const right = l.ring[0] > l.width - 60;
  const below = l.ring[1] < l.height - 40;
  return (
    <>
      <text {...untranslated} class="w b" x={l.ring[0] + (right ? -14 : 0)} y={l.ring[1] + (below ? 26 : -16)} text-anchor={right ? "end" : "middle"}>
        {fixed(round360(hand.turn), 1)}°
      </text>
      <text class="w b" x={l.pivot[0]} y={l.pivot[1] + 22} text-anchor="middle">
        {t("face.offsetAt", { mm: fixed(hand.beside, 1) })}
      </text>
    </>
  );
}

function Scale({ l }: { l: Layout }) {
  const mm = [0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500].find((n) => n * l.scale >= 56) ?? 1000;
  const long = mm * l.scale;
  return (
    <g class="scale" transform={`translate(14 ${l.height - 12})`}>
      <path d={`M0-5v5h${long}v-5`} />
      <text {...untranslated} x={long + 6} y={1}>
        {short(mm)} {unit("mm")}
      </text>
    </g>
  );
}

/** The result in a sentence, for who hears it. */
function Spoken({ face }: { face: Face }) {
  const placed = face.placed.value;
  if (!placed || face.late.value) return null;
  const { turn, beside } = placed.hand;
  const where = { turn: fixed(turn, 1), mm: fixed(beside, 2) };
  if (!placed.answer) return <>{t("face.notHere", where)}</>;
  const way = placed.answer.ways[placed.answer.chosen];
  return <>{t("face.spoken", { bad: fixed(way.bad, 1), ...where })}</>;
}
