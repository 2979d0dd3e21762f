// Marks of a picture: symbols, labels, dimensions, handles, scale bar, axes of charts.
import type { ComponentChildren } from "preact";
import { type Key, num, word } from "./language";
import type { Drawing, Point } from "./model";
import { type Box, type Plane, round, ticks } from "./plane";
import { stepped } from "./state";

/** A symbol of the catalogue: what follows the underscore is its index. */
export function Symbol({ of }: { of: Key }) {
  const [base, index] = word(of).split("_");
  return (
    <i>
      {base}
      {index !== undefined && <sub>{index}</sub>}
    </i>
  );
}

/** A sentence of the catalogue; an underscore behind a symbol begins its index. */
export function Prose({ text }: { text: string }) {
  return (
    <>
      {text.split(/(_[\p{L}\p{M}\d]+)/u).map((part, i) => (i % 2 === 1 ? <sub key={i}>{part.slice(1)}</sub> : part))}
    </>
  );
}

function Spans({ of }: { of: Key }) {
  const [base, index] = word(of).split("_");
  return (
    <>
      <tspan class="sym">{base}</tspan>
      {index !== undefined && (
        <tspan class="index" dy="4">
          {index}
        </tspan>
      )}
    </>
  );
}

/** A sentence of the catalogue in a picture. */
export function Words({ at, text }: { at: Point; text: string }) {
  const parts = text.split(/(_[\p{L}\p{M}\d]+)/u);
  return (
    <text x={at[0]} y={at[1]} class="label">
      {parts.map((part, i) => (
        <tspan key={i} class={i % 2 === 1 ? "index" : undefined} dy={i % 2 === 1 ? 4 : i > 0 ? -4 : 0}>
          {i % 2 === 1 ? part.slice(1) : part}
        </tspan>
      ))}
    </text>
  );
}

interface LabelProps {
  at: Point;
  symbol?: Key;
  /** A row whose number follows the symbol. */
  row?: string;
  c?: Drawing;
  text?: string;
  anchor?: "start" | "middle" | "end";
  class?: string;
}

/** A text of the picture on a ground of its own. */
export function Label({ at, symbol, row, c, text, anchor = "start", class: kind = "" }: LabelProps) {
  const indexed = symbol !== undefined && word(symbol).includes("_");
  return (
    <text x={at[0]} y={at[1]} text-anchor={anchor} class={`label ${kind}`}>
      {symbol && <Spans of={symbol} />}
      {row && c && (
        <tspan dy={indexed ? -4 : 0} data-row={row}>
          {`${symbol ? "\u00a0" : ""}${c.text(row)}`}
        </tspan>
      )}
      {text && <tspan dy={indexed && !row ? -4 : 0}>{`${symbol ? "\u00a0" : ""}${text}`}</tspan>}
    </text>
  );
}

/** A cross for a point, with its symbol beside. */
export function Dot({ at, symbol, dx = 8, dy = -7, anchor }: { at: Point; symbol?: Key; dx?: number; dy?: number; anchor?: "start" | "middle" | "end" }) {
  return (
    <g>
      <circle cx={at[0]} cy={at[1]} r="3" class="dot" />
      {symbol && <Label at={[at[0] + dx, at[1] + dy]} symbol={symbol} anchor={anchor} />}
    </g>
  );
}

/** A dimension between two places: thin line with arrows, its number on it. */
export function Dimension({ from, to, children }: { from: Point; to: Point; children?: ComponentChildren }) {
  return (
    <g class="dimension">
      <path d={`M${from[0]} ${from[1]}L${to[0]} ${to[1]}`} marker-start="url(#tg-arrow-back)" marker-end="url(#tg-arrow)" />
      {children}
    </g>
  );
}

/** Arrows and hatches of all pictures of the page. */
export function Definitions() {
  return (
    <svg width="0" height="0" aria-hidden="true" class="definitions">
      <defs>
        <marker id="tg-arrow" viewBox="0 0 10 8" refX="9.5" refY="4" markerWidth="9" markerHeight="7" orient="auto" markerUnits="userSpaceOnUse">
          <path d="M0 0L10 4L0 8Z" class="arrow" />
        </marker>
        <marker id="tg-arrow-back" viewBox="0 0 10 8" refX="9.5" refY="4" markerWidth="9" markerHeight="7" orient="auto-start-reverse" markerUnits="userSpaceOnUse">
          <path d="M0 0L10 4L0 8Z" class="arrow" />
        </marker>
        <pattern id="tg-hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
          <path d="M0 0V7" class="hatch" />
        </pattern>
      </defs>
    </svg>
  );
}

interface HandleProps {
  at: Point;
  /** Its name, and what it is at, in words. */
  name: string;
  value: number;
  min: number;
  max: number;
  told: string;
  /** Is dragged to a place of the picture. */
  move: (at: Point) => void;
  /** Arrow keys: to the right and up; ten times as far with Shift, a tenth with Alt. */
  step: (dx: number, dy: number) => void;
}

/** What is dragged: with mouse, finger or arrow keys. */
export function Handle({ at, name, value, min, max, told, move, step }: HandleProps) {
  const place = (e: PointerEvent): Point => {
    const svg = (e.currentTarget as SVGElement).ownerSVGElement;
    const box = svg?.getBoundingClientRect();
    if (!svg || !box || box.width === 0) return at;
    const k = (svg.viewBox.baseVal.width || box.width) / box.width;
    return [(e.clientX - box.left) * k, (e.clientY - box.top) * k];
  };
  return (
    <g
      class="handle"
      role="slider"
      tabindex={0}
      aria-label={name}
      aria-valuenow={value}
      aria-valuemin={min}
      aria-valuemax={max}
      aria-valuetext={told}
      onPointerDown={(e: PointerEvent) => {
        if (e.button !== 0) return;
        e.preventDefault();
        (e.currentTarget as SVGElement).setPointerCapture(e.pointerId);
        (e.currentTarget as SVGElement).focus({ preventScroll: true });
      }}
      onMouseDown={(e: MouseEvent) => e.preventDefault()}
      onPointerMove={(e: PointerEvent) => {
        if ((e.currentTarget as SVGElement).hasPointerCapture(e.pointerId)) move(place(e));
      }}
      onKeyDown={(e: KeyboardEvent) => {
        const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
        if (!by) return;
        e.preventDefault();
        const k = e.shiftKey ? 10 : e.altKey ? 0.1 : 1;
        stepped(() => step(by[0] * k, by[1] * k));
      }}
    >
      <circle cx={at[0]} cy={at[1]} r="16" class="reach" />
      <circle cx={at[0]} cy={at[1]} r="7" class="grip" />
    </g>
  );
}

/** A place of the picture that is pressed, by mouse, finger or Enter. */
export function Press({ at, width, text, press, mark }: { at: Point; width: number; text: string; press: () => void; mark: string }) {
  return (
    <g
      class="press"
      role="button"
      tabindex={0}
      aria-label={text}
      data-press={mark}
      onClick={press}
      onKeyDown={(e: KeyboardEvent) => {
        if (e.key !== "Enter" && e.key !== " ") return;
        e.preventDefault();
        press();
      }}
    >
      <rect x={at[0]} y={at[1]} width={width} height="28" rx="4" class="box" />
      <text x={at[0] + width / 2} y={at[1] + 18} text-anchor="middle">
        {text}
      </text>
    </g>
  );
}

/** A bar of a round length, at a corner of the picture. */
export function ScaleBar({ plane, at }: { plane: Plane; at: Point }) {
  const length = round(90 / plane.scale);
  const px = length * plane.scale;
  const decimals = Math.max(0, -Math.floor(Math.log10(length)));
  return (
    <g class="scale">
      <path d={`M${at[0]} ${at[1] - 4}v4h${px}v-4`} />
      <Label at={[at[0] + px / 2, at[1] - 6]} text={`${num(length, decimals)} ${word("u.mm")}`} anchor="middle" />
    </g>
  );
}

export interface Scale {
  x: (x: number) => number;
  y: (y: number) => number;
}

interface AxesProps {
  box: Box;
  x: [number, number];
  y: [number, number];
  xName: string;
  yName: string;
  children: (s: Scale) => ComponentChildren;
}

/** A chart: axes with names and round ticks. */
export function Axes({ box, x, y, xName, yName, children }: AxesProps) {
  const s: Scale = {
    x: (n) => box.left + (box.width * (n - x[0])) / (x[1] - x[0]),
    y: (n) => box.top + box.height - (box.height * (n - y[0])) / (y[1] - y[0]),
  };
  const xs = ticks(x[0], x[1], Math.max(3, Math.min(7, box.width / 70)));
  const ys = ticks(y[0], y[1], 4);
  const places = (all: number[]): number => (all.length > 1 ? Math.max(0, Math.ceil(-Math.log10(all[1] - all[0]) - 1e-9)) : 0);
  return (
    <g class="chart">
      {ys.map((n) => (
        <g key={n}>
          <path d={`M${box.left} ${s.y(n)}h${box.width}`} class={Math.abs(n) < 1e-12 ? "zero" : "grid"} />
          <text x={box.left - 6} y={s.y(n) + 4} text-anchor="end" class="tick">
            {num(n, places(ys))}
          </text>
        </g>
      ))}
      {xs.map((n) => (
        <g key={n}>
          <path d={`M${s.x(n)} ${box.top + box.height}v4`} class="zero" />
          <text x={s.x(n)} y={box.top + box.height + 16} text-anchor="middle" class="tick">
            {num(n, places(xs))}
          </text>
        </g>
      ))}
      <path d={`M${box.left} ${box.top}v${box.height}h${box.width}`} class="zero" />
      <text x={box.left - 30} y={box.top - 8} class="label">
        {yName}
      </text>
      <text x={box.left + box.width} y={box.top + box.height + 32} text-anchor="end" class="label">
        {xName}
      </text>
      {children(s)}
    </g>
  );
}
