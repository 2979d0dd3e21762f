// Charts on one axis: speed, acceleration, jerk, engagement, curvature along the way or over time, with the cursor of the plan.
import type { ComponentChildren } from "preact";
import { useMemo, useRef } from "preact/hooks";
import { untranslated } from "../../app/verbatim";
import { fixed, short, ticks } from "../../base/format";
import { t } from "../../words";
import { useWidth } from "../drill/room";
import type { Pass, Plan, Run, Samples } from "./answer";
import { QUANTITIES, type Quantity, limitOf, rangeOf } from "./quantities";
import type { Axis, State } from "./state";
import { mixed, readingAt, timeAt } from "./track";

const [LEFT, RIGHT, TOP, PLOT, GAP, BELOW] = [54, 12, 36, 74, 46, 34];
/** Width below which there is room for one remark [px]. */
const NARROW = 560;
/** Places of a curve by which its range is found. */
const PLACES = 240;

export function Charts({ state, plan, pass, run }: { state: State; plan: Plan; pass: Pass; run: Run }) {
  const box = useRef<HTMLDivElement>(null);
  const width = useWidth(box, 560);
  return (
    <section class="panel charts" aria-label={t("hole.charts")} tabIndex={-1} data-panel="charts">
      <header>
        <h2>{t("hole.charts")}</h2>
        <span class="sp" />
        <Zoom state={state} />
        <span class="seg" role="radiogroup" aria-label={t("hole.axis")}>
          {(["way", "time"] as Axis[]).map((axis) => (
            <button
              key={axis}
              role="radio"
              aria-checked={state.axis.value === axis}
              data-axis={axis}
              onClick={() => {
                state.axis.value = axis;
                state.window.value = [0, 1];
              }}
            >
              {t(`hole.axis.${axis}`)}
            </button>
          ))}
        </span>
      </header>
      <div class="drawing" ref={box}>
        <All state={state} plan={plan} pass={pass} run={run} width={width} />
      </div>
      <Legend state={state} pass={pass} />
    </section>
  );
}

function Zoom({ state }: { state: State }) {
  const [from, to] = state.window.value;
  const whole = (run: Run | undefined) => (run ? (state.axis.value === "way" ? run.length : run.time) : 1);
  const set = (by: number) => {
    const middle = Math.min(1, Math.max(0, state.along.value / whole(state.pass.value?.run)));
    const half = Math.min(0.5, Math.max(0.0005, ((to - from) / 2) * by));
    const start = Math.min(1 - 2 * half, Math.max(0, middle - half));
    state.window.value = [start, start + 2 * half];
  };
  return (
    <span class="zoom">
      <button class="icon ghost" aria-label={t("hole.closer")} title={t("hole.closer")} data-zoom="in" onClick={() => set(1 / 3)}>
        <span aria-hidden="true">+</span>
      </button>
      <button class="icon ghost" aria-label={t("hole.farther")} title={t("hole.farther")} data-zoom="out" disabled={to - from >= 1} onClick={() => set(3)}>
        <span aria-hidden="true">−</span>
      </button>
    </span>
  );
}

function columnOf(run: Run, axis: Axis): number[] {
  return axis === "way" ? run.samples.s : run.samples.time;
}

interface Curve {
  name: string;
  run: Run;
  column: keyof Samples;
}

function All({ state, plan, pass, run, width }: { state: State; plan: Plan; pass: Pass; run: Run; width: number }) {
  const svg = useRef<SVGSVGElement>(null);
  const axis = state.axis.value;
  const others = state.others.ghosts(pass.pass).filter(({ other }) => !isSame(other.id, state, plan, pass));
  const longest = Math.max(...[run, ...others.map((g) => g.run)].map((r) => (axis === "way" ? r.length : r.time)));
  const own = axis === "way" ? run.length : run.time;
  const [from, to] = state.window.value;
  // Zoomed in, the axis is that of the hole's own run; as a whole the longest is seen.
  const seen: [number, number] = to - from >= 1 ? [0, longest] : [from * own, to * own];
  const height = TOP + QUANTITIES.length * (PLOT + GAP) - GAP + BELOW;
  const x = (value: number) => LEFT + ((width - LEFT - RIGHT) * (value - seen[0])) / (seen[1] - seen[0]);
  const at = (e: PointerEvent) => {
    const bounds = svg.current?.getBoundingClientRect();
    if (bounds) state.goAlong(seen[0] + ((e.clientX - bounds.left - LEFT) / (width - LEFT - RIGHT)) * (seen[1] - seen[0]));
  };
  const cursor = state.along.value;
  const told = QUANTITIES.map((q) => reading(run, state.s.value, q)).join(", ");
  const step = (seen[1] - seen[0]) / 100;
  const lengths = ticks(seen[1] - seen[0], width < 480 ? 4 : 7);
  const grid = lengths.length > 1 ? lengths[1] : seen[1] - seen[0];
  const marks = Array.from({ length: Math.floor(seen[1] / grid + 1e-9) - Math.ceil(seen[0] / grid - 1e-9) + 1 }, (_, i) => (Math.ceil(seen[0] / grid - 1e-9) + i) * grid);
  return (
    <div
      class="slide"
      role="slider"
      tabIndex={0}
      aria-label={t("hole.cursor")}
      aria-valuemin={0}
      aria-valuemax={Number(own.toFixed(3))}
      aria-valuenow={Number(cursor.toFixed(3))}
      aria-valuetext={`${placeOf(axis, cursor)}: ${told}`}
      onKeyDown={(e) => {
        const by = (e.shiftKey ? 10 : 1) * (e.altKey ? 0.1 : 1) * step;
        const to = { ArrowLeft: cursor - by, ArrowRight: cursor + by, Home: 0, End: own }[e.key];
        if (to === undefined) return;
        e.preventDefault();
        state.goAlong(to);
      }}
    >
      <svg
        ref={svg}
        class="runs"
        width={width}
        height={height}
        aria-hidden="true"
        onPointerDown={(e) => {
          if (e.pointerType !== "touch") e.currentTarget.setPointerCapture(e.pointerId);
          at(e);
        }}
        onPointerMove={(e) => e.buttons === 1 && e.pointerType !== "touch" && at(e)}
      >
        {QUANTITIES.map((quantity, i) => (
          <Chart
            key={quantity.name}
            quantity={quantity}
            top={TOP + i * (PLOT + GAP)}
            width={width}
            x={x}
            seen={seen}
            axis={axis}
            limit={limitOf(state, plan, quantity.name)}
            curves={[
              ...others.map(({ other, run: of, index, isOld }) => ({ name: `ghost g${index}${isOld ? " aged" : ""}`, id: other.id, run: of, column: quantity.column })),
              ...(quantity.along ? [{ name: `own along ${pass.pass}`, run, column: quantity.along }] : []),
              { name: `own ${pass.pass}`, run, column: quantity.column },
            ]}
            marks={marks}
            now={reading(run, state.s.value, quantity)}
          />
        ))}
        <Joints run={run} x={x} seen={seen} axis={axis} height={height} />
        {marks.map((mark) => (
          <text key={mark} x={x(mark)} y={height - BELOW + 14} text-anchor="middle" {...untranslated}>
            {short(mark, 6)}
          </text>
        ))}
        <text x={width - RIGHT} y={height - 4} text-anchor="end">
          {t(`hole.axisUnit.${axis}`)}
        </text>
        {cursor >= seen[0] && cursor <= seen[1] && (
          <g class="hair">
            <path d={`M${x(cursor).toFixed(1)} ${TOP}V${height - BELOW}`} />
          </g>
        )}
      </svg>
    </div>
  );
}

/** Whether a way of doing it is the one that the text asks for. */
export function isSame(id: string, state: State, plan: Plan, pass: Pass): boolean {
  return id === (pass.pass === "rough" ? plan.strategy : state.contact.value);
}

function placeOf(axis: Axis, value: number): string {
  return axis === "way" ? `${fixed(value, 2)} mm` : `${fixed(value, 3)} s`;
}

function reading(run: Run, s: number, { column, factor, decimals, unit }: Quantity): string {
  const value = readingAt(run, s)[column];
  return value === null ? "\u2013" : `${fixed(value * factor, decimals)} ${unit}`;
}

function Joints({ run, x, seen, axis, height }: { run: Run; x: (v: number) => number; seen: [number, number]; axis: Axis; height: number }) {
  const places = run.joints.map((j) => (axis === "way" ? j.s : timeAt(run, j.s))).filter((p) => p >= seen[0] && p <= seen[1]);
  return <path class="joint" d={places.map((p) => `M${x(p).toFixed(1)} ${TOP}V${height - BELOW}`).join("")} />;
}

interface ChartProps {
  quantity: Quantity;
  top: number;
  width: number;
  x: (v: number) => number;
  seen: [number, number];
  axis: Axis;
  limit: number | null;
  curves: (Curve & { id?: string })[];
  marks: number[];
  now: string;
}

function Chart({ quantity, top, width, x, seen, axis, limit, curves, marks, now }: ChartProps) {
  const { factor } = quantity;
  const { values, most, least } = useMemo(() => {
    const inside = curves.flatMap(({ run, column }) =>
      columnOf(run, axis).flatMap((p, i) => {
        const v = run.samples[column][i];
        return p >= seen[0] && p <= seen[1] && v !== null ? [v * factor] : [];
      }),
    );
    const even = curves.flatMap(({ run, column }) => {
      const along = columnOf(run, axis);
      const last = Math.min(seen[1], along[along.length - 1]);
      return Array.from({ length: PLACES + 1 }, (_, i) => mixed(along, run.samples[column], seen[0] + ((last - seen[0]) * i) / PLACES)).flatMap((v) => (v === null ? [] : [v * factor]));
    });
    return { values: even, most: Math.max(...inside, -Infinity), least: Math.min(...inside, Infinity) };
  }, [curves.map((c) => c.id ?? c.column).join(), curves[curves.length - 1]?.run, curves[0]?.run, seen[0], seen[1], axis]);
  const { low, high, above, below } = rangeOf(values, most, least, limit);
  const y = (v: number) => top + PLOT * (1 - (Math.min(high, Math.max(low, v)) - low) / (high - low));
  const steps = ticks(high - low, 3);
  const grid = steps.length > 1 ? steps[1] : high - low;
  const rows = Array.from({ length: Math.floor(high / grid + 1e-9) - Math.ceil(low / grid - 1e-9) + 1 }, (_, i) => (Math.ceil(low / grid - 1e-9) + i) * grid);
  const line = ({ run, column }: Curve): string => {
    const along = columnOf(run, axis);
    const values = run.samples[column];
    let pen = false;
    let d = "";
    for (let i = 0; i < along.length; i++) {
      const v = values[i];
      // One place beyond either end, so that the line reaches the edge.
      if (v === null || along[Math.min(i + 1, along.length - 1)] < seen[0] || along[Math.max(0, i - 1)] > seen[1]) {
        pen = false;
        continue;
      }
      d += `${pen ? "L" : "M"}${x(along[i]).toFixed(1)} ${y(v * factor).toFixed(1)}`;
      pen = true;
    }
    return d;
  };
  const id = `hole-clip-${quantity.name}`;
  return (
    <g data-chart={quantity.name}>
      <clipPath id={id}>
        <rect x={LEFT} y={top - 1} width={Math.max(0, width - LEFT - RIGHT)} height={PLOT + 2} />
      </clipPath>
      {rows.map((v) => (
        <g key={v}>
          <path class={Math.abs(v) < 1e-12 ? "grid zero" : "grid"} d={`M${LEFT} ${y(v).toFixed(1)}H${width - RIGHT}`} />
          <text x={LEFT - 5} y={y(v) + 4} text-anchor="end" {...untranslated}>
            {short(Math.abs(v) < 1e-12 ? 0 : v, 4)}
          </text>
        </g>
      ))}
      <path class="grid" d={marks.map((m) => `M${x(m).toFixed(1)} ${top}V${top + PLOT}`).join("")} />
      <g clip-path={`url(#${id})`}>
        {limit !== null && limit <= high && <path class="limit" d={`M${LEFT} ${y(limit).toFixed(1)}H${width - RIGHT}`} />}
        {curves.map((curve) => (
          <path key={curve.name} class={`curve ${curve.name}`} data-of={curve.id ?? curve.column} d={line(curve)} />
        ))}
      </g>
      <text class="w b" x={LEFT} y={top - 20}>
        {t(`hole.quantity.${quantity.name}`)}
        <Unit>{` [${quantity.unit}]`}</Unit>
      </text>
      <text class="w b now" x={width - RIGHT} y={top - 20} text-anchor="end" data-now={quantity.name} {...untranslated}>
        {now}
      </text>
      <Note x={LEFT} y={top - 6}>
        {[
          above && t("hole.above", { most: `${short(most, 4)} ${quantity.unit}` }),
          below && t("hole.below", { least: `${short(least, 4)} ${quantity.unit}` }),
          limit !== null && limit > high && t(`hole.limitAbove.${quantity.name === "speed" ? "feed" : "axis"}`, { limit: `${short(limit, 4)} ${quantity.unit}` }),
        ]
          .filter((word) => typeof word === "string")
          .slice(0, width < NARROW ? 1 : 3)
          .join("; ")}
      </Note>
    </g>
  );
}

function Unit({ children }: { children: string }) {
  return <tspan {...untranslated}>{children}</tspan>;
}

function Note({ x, y, children }: { x: number; y: number; children: ComponentChildren }) {
  if (!children) return null;
  return (
    <text class="plate" x={x} y={y}>
      {children}
    </text>
  );
}

function Legend({ state, pass }: { state: State; pass: Pass }) {
  const sample = (name: string) => (
    <svg width="30" height="8" aria-hidden="true">
      <path class={`curve ${name}`} d="M0 4h30" />
    </svg>
  );
  return (
    <div class="key">
      <span>
        {sample(`own ${pass.pass}`)} {t("hole.keyWhole")}
      </span>
      <span>
        {sample(`own along ${pass.pass}`)} {t("hole.keyAlong")}
      </span>
      <span>
        {sample("limit")} {t("hole.keyLimit")}
      </span>
      <span>
        {sample("joint")} {t("hole.keyJoint")}
      </span>
      {state.others.ghosts(pass.pass).map(({ other, index, isOld }) => (
        <span key={other.id}>
          {sample(`ghost g${index}`)} <code translate={false}>{other.id}</code> {isOld && t("hole.ghostOld")}
        </span>
      ))}
    </div>
  );
}
