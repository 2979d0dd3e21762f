// Velocities of tip and top as arrows over the picture: dragged in its plane, or moved by keys.
import { useRef } from "preact/hooks";
import { fixed } from "../../base/format";
import { t } from "../../words";
import { type Sheet, type Vec } from "./sheet";
import type { Stage } from "./stage";
import type { Looked } from "./state";

/** Way of an arrow's head by a key [px]. */
const STEP = 4;
/** Length of its head [px]. */
const HEAD = 11;
/** Least distance of a handle's middle from the edge of the picture [px]. */
const EDGE = 15;

interface Props {
  stage: Stage;
  sheet: Sheet;
  looked: Looked;
  /** Reads the picture again after each drawing. */
  frame: number;
  /** The reason why the motion cannot be moved. */
  fixed: boolean;
}

export function Handles({ stage, sheet, looked, fixed: isFixed }: Props) {
  const scale = looked.scale.value;
  const ends = looked.ends(sheet);
  const arrows = (["tip", "top"] as const).map((which, i) => {
    const base: Vec = [0, 0, sheet.ends[i].z];
    const end = base.map((c, k) => c + ends[which][k] * scale) as Vec;
    const to = stage.project(end);
    // A head that left the picture can still be taken at its edge.
    const { clientWidth, clientHeight } = stage.canvas;
    const grip: [number, number] = [Math.min(clientWidth - EDGE, Math.max(EDGE, to[0])), Math.min(clientHeight - EDGE, Math.max(EDGE, to[1]))];
    return { which, from: stage.project(base), to, grip };
  });
  return (
    <>
      <svg class="arrows" aria-hidden="true">
        {arrows.map(({ which, from, to }) => (
          <path key={which} data-arrow={which} class={which} d={arrow(from, to)} />
        ))}
        {arrows.map(({ which, to }) => (
          <text key={which} x={to[0] + 18} y={to[1] + 4}>
            {t(`grazing.end.${which}`)}
          </text>
        ))}
      </svg>
      {!isFixed && arrows.map(({ which, grip }) => <Grip key={which} which={which} at={grip} stage={stage} sheet={sheet} looked={looked} velocity={ends[which]} />)}
    </>
  );
}

function arrow([x, y]: number[], [u, v]: number[]): string {
  const length = Math.hypot(u - x, v - y);
  if (length < 1) return "";
  const [a, b] = [(u - x) / length, (v - y) / length];
  const head = Math.min(HEAD, length);
  const [p, q] = [u - a * head, v - b * head];
  const wide = 0.42 * head;
  return `M${x} ${y}L${p} ${q}M${u} ${v}L${p - b * wide} ${q + a * wide}L${p + b * wide} ${q - a * wide}Z`;
}

interface GripProps {
  which: "tip" | "top";
  at: [number, number];
  stage: Stage;
  sheet: Sheet;
  looked: Looked;
  velocity: Vec;
}

function Grip({ which, at, stage, sheet, looked, velocity }: GripProps) {
  const from = useRef<{ x: number; y: number; velocity: Vec } | null>(null);
  const to = (begin: Vec, right: number, down: number, both: boolean) => {
    const scale = looked.scale.peek() || 1;
    const by = stage.across(right, down);
    looked.drag(looked.sheet.peek() ?? sheet, which, begin.map((c, k) => c + by[k] / scale) as Vec, both);
  };
  return (
    <button
      class={`grip ${which}`}
      data-grip={which}
      style={{ left: `${at[0]}px`, top: `${at[1]}px` }}
      aria-label={t(`grazing.grip.${which}`, { x: fixed(velocity[0], 1), y: fixed(velocity[1], 1), z: fixed(velocity[2], 1) })}
      title={t("grazing.gripHow")}
      onPointerDown={(e) => {
        if (e.button !== 0) return;
        e.preventDefault();
        e.currentTarget.focus();
        e.currentTarget.setPointerCapture(e.pointerId);
        from.current = { x: e.clientX, y: e.clientY, velocity };
        looked.holding = true;
      }}
      onPointerMove={(e) => from.current && to(from.current.velocity, e.clientX - from.current.x, e.clientY - from.current.y, e.shiftKey)}
      onPointerUp={() => {
        from.current = null;
        looked.released();
      }}
      onPointerCancel={() => {
        from.current = null;
        looked.released();
      }}
      onKeyDown={(e) => {
        const way: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
        const by = way[e.key];
        if (!by || e.ctrlKey || e.metaKey) return;
        e.preventDefault();
        e.stopPropagation();
        const step = STEP * (e.altKey ? 0.1 : 1) * (e.shiftKey ? 10 : 1);
        to(velocity, by[0] * step, by[1] * step, false);
      }}
    />
  );
}
