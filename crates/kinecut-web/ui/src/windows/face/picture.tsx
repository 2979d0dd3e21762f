// The part under the cutter: dragged to shift, turned by its ring; where teeth leave badly, well, and where they enter is the verb's answer.
import { useRef } from "preact/hooks";
import { fixed, short } from "../../base/format";
import { untranslated } from "../../app/verbatim";
import { t, unit } from "../../words";
import type { Edge, FaceAnswer, Stretch } from "./answer";
import { type Frame, type Point, faceOf, middle, pointOn, round, round360, strokeOf, turned } from "./shape";
import { useWidth } from "./size";
import type { Face, Hand } from "./state";

/** Steps of the arrow keys [deg, mm]; with Shift ten times, with Alt a tenth. */
const STEP = { turn: 1, beside: 0.1 };
/** A pointer that moved less clicks [px]. */
const STILL = 4;

interface Layout {
  width: number;
  height: number;
  /** Pixels for a mm. */
  scale: number;
  centre: Point;
  /** The centre of the cutter. */
  cutter: Point;
  frame: Frame;
  /** Place of the ring. */
  ring: Point;
  /** About what the part turns. */
  pivot: Point;
}

function layout(answer: FaceAnswer, hand: Hand, along: number, width: number): Layout {
  const { outline, cutter } = answer;
  const height = Math.round(width < 420 ? width * 0.95 : Math.min(560, width * 0.85));
  const { centre: own, radius } = round(outline);
  const half = Math.max(cutter.radius, radius) * 1.14;
  const scale = Math.min(width / 2, height / 2) / half;
  const centre: Point = [width / 2, height / 2];
  const line = middle(outline, hand.turn) + hand.beside;
  const pivotTurned = turned(own, hand.turn);
  const frame: Frame = (p) => {
    const [x, y] = turned(p, hand.turn);
    return [centre[0] + (x - pivotTurned[0] + along) * scale, centre[1] - (y - line) * scale];
  };
  const pivot = frame(own);
  const reach = Math.min(radius * scale + 12, half * scale - 14);
  const angle = (hand.turn * Math.PI) / 180;
  const ring: Point = [pivot[0] + reach * Math.cos(angle), pivot[1] - reach * Math.sin(angle)];
  return { width, height, scale, centre, cutter: [centre[0] - 0.22 * half * scale, centre[1]], frame, ring, pivot };
}

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
  const grip = useRef<{ kind: "turn" | "shift"; x: number; y: number; hand: Hand; along: number; moved: boolean } | null>(null);
  const l = layout(least, hand, face.along.value, width);

  const place = (e: PointerEvent): Point => {
    const bounds = (e.currentTarget as Element).getBoundingClientRect();
    return [e.clientX - bounds.left, e.clientY - bounds.top];
  };
  const down = (e: PointerEvent) => {
    if (e.button !== 0) return;
    const [x, y] = place(e);
    const isRing = Math.hypot(x - l.ring[0], y - l.ring[1]) < (e.pointerType === "touch" ? 26 : 14);
    (e.currentTarget as Element).setPointerCapture(e.pointerId);
    grip.current = { kind: isRing ? "turn" : "shift", x, y, hand, along: face.along.value, moved: false };
  };
  const move = (e: PointerEvent) => {
    const g = grip.current;
    if (!g) return;
    const [x, y] = place(e);
    if (!g.moved && Math.hypot(x - g.x, y - g.y) < STILL) return;
    g.moved = true;
    if (g.kind === "turn") {
      const turn = (Math.atan2(l.pivot[1] - y, x - l.pivot[0]) * 180) / Math.PI;
      face.move({ turn: Math.round(turn * 100) / 100, beside: g.hand.beside });
    } else {
      face.along.value = g.along + (x - g.x) / l.scale;
      const beside = Math.round((g.hand.beside + (y - g.y) / l.scale) * 1000) / 1000;
      if (beside !== face.hand.value?.beside) face.move({ turn: hand.turn, beside });
    }
  };
  const up = (e: PointerEvent) => {
    const g = grip.current;
    grip.current = null;
    if (g && !g.moved && e.type === "pointerup") face.label.value = labelAt(least.outline.edges, l, place(e));
  };
  const key = (e: KeyboardEvent) => {
    const by = (e.shiftKey ? 10 : 1) * (e.altKey ? 0.1 : 1);
    const steps: Record<string, Partial<Hand>> = {
      ArrowLeft: { turn: STEP.turn },
      ArrowRight: { turn: -STEP.turn },
      ArrowDown: { beside: STEP.beside },
      ArrowUp: { beside: -STEP.beside },
    };
    const step = steps[e.key];
    if (!step) return;
    e.preventDefault();
    const neat = (n: number) => Number(n.toFixed(6));
    face.move({ turn: neat(hand.turn + by * (step.turn ?? 0)), beside: neat(hand.beside + by * (step.beside ?? 0)) });
  };
  return (
    <>
      <div
        class="held"
        tabIndex={0}
        role="application"
        aria-label={t("face.picture")}
        aria-describedby="face-live"
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={up}
        onPointerCancel={up}
        onKeyDown={key}
        style={{ height: l.height }}
        data-late={face.late.value || undefined}
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
