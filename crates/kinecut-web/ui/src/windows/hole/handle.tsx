// A place of a drawing that is dragged with mouse or finger, or moved by the arrow keys.
import { untranslated } from "../../app/verbatim";
import type { Point } from "./answer";

interface Props {
  name: string;
  /** Its letter and index. */
  sign: string;
  at: Point;
  label: string;
  now: number;
  range: [number, number];
  /** Its place in words. */
  told: string;
  onDrag: (e: PointerEvent) => void;
  onEnd: () => void;
  /** Steps to the right and up. */
  onKey: (x: number, y: number, by: number) => void;
}

const STEPS: Record<string, Point> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export function Handle({ name, sign, at: [x, y], label, now, range, told, onDrag, onEnd, onKey }: Props) {
  return (
    <g
      class={`handle ${name}`}
      data-handle={name}
      tabindex={0}
      role="slider"
      aria-label={label}
      aria-valuenow={Number(now.toFixed(3))}
      aria-valuemin={range[0]}
      aria-valuemax={Number(range[1].toFixed(3))}
      aria-valuetext={told}
      onPointerDown={(e) => {
        if (e.button !== 0) return;
        e.stopPropagation();
        e.currentTarget.focus();
        e.currentTarget.setPointerCapture(e.pointerId);
      }}
      onPointerMove={(e) => {
        if (!e.currentTarget.hasPointerCapture(e.pointerId)) return;
        e.stopPropagation();
        onDrag(e);
      }}
      onPointerUp={(e) => {
        e.stopPropagation();
        onEnd();
      }}
      onPointerCancel={onEnd}
      onKeyDown={(e) => {
        const step = STEPS[e.key];
        if (!step) return;
        e.preventDefault();
        e.stopPropagation();
        onKey(step[0], step[1], (e.shiftKey ? 10 : 1) * (e.altKey ? 0.1 : 1));
      }}
    >
      <circle class="reach" cx={x} cy={y} r={18} />
      <circle class="grip" cx={x} cy={y} r={7} />
      <text class="w plate b" x={x + 11} y={y - 9} {...untranslated}>
        {sign[0]}
        <tspan dy="3" font-size="10">
          {sign.slice(1)}
        </tspan>
      </text>
    </g>
  );
}
