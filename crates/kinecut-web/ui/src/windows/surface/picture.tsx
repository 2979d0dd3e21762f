// The surface with its two lines, what of it the tool has, and the motions; its point is dragged, and the rest turns the view.
import { useMemo, useRef } from "preact/hooks";
import { fixed } from "../../base/format";
import { untranslated } from "../../app/verbatim";
import { t } from "../../words";
import { useWidth } from "../face/size";
import { pretty, type Sketch, type Surface } from "./answer";
import { Arrows } from "./arrows";
import { Paper, VIEWS, line, quads, under } from "./space";
import { answer, at, split, stale, view, wrong } from "./state";

/** A pointer that moved less clicks [px]. */
const STILL = 4;
/** Reach of the point for a pointer [px]. */
const GRIP = { mouse: 16, touch: 30 };
/** Steps over a domain of the arrow keys; with Shift ten of them, with Alt a tenth. */
const STEPS = 100;

/** A value of a domain with the digits that a hand can choose. */
export function neat(value: number, from: number, to: number): string {
  const step = 10 ** Math.floor(Math.log10((to - from) / 5000));
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  return String(Number(Math.min(to, Math.max(from, Math.round(value / step) * step)).toFixed(digits)));
}

function go(surface: Surface, values: (number | null)[]): void {
  const next = { ...at.value };
  surface.variables.forEach(([name, from, to], i) => {
    const value = values[i];
    if (value !== null) next[name] = neat(value, from, to);
  });
  at.value = next;
}

export function Picture() {
  const [box, width] = useWidth(520);
  const shown = answer.value?.surface;
  return (
    <div class="flat" ref={box}>
      <Views />
      {shown?.sketch && shown.place ? <Held surface={shown} sketch={shown.sketch} width={width.value} /> : <p class="q hint">{wrong.value ? t("surface.noPicture") : t("surface.reading")}</p>}
    </div>
  );
}

function Held({ surface, sketch, width }: { surface: Surface; sketch: Sketch; width: number }) {
  const height = Math.round(Math.min(480, Math.max(280, 0.72 * width)));
  const place = surface.place as NonNullable<Surface["place"]>;
  const grip = useRef<{ point: boolean; x: number; y: number; yaw: number; pitch: number; moved: boolean } | null>(null);
  const { yaw, pitch } = view.value;
  // The mesh is of the surface alone: a place that moves leaves it as it is.
  const meshIs = JSON.stringify(sketch.mesh);
  const paper = useMemo(() => new Paper({ yaw, pitch }, sketch.mesh.flat(), width, height, 34), [meshIs, yaw, pitch, width, height]);
  const faces = useMemo(() => quads(sketch.mesh, paper, 2), [paper]);
  const one = sketch.splits.find((s) => s.machine_code === split.value?.machine_code && s.tool_code === split.value?.tool_code);
  const [x, y] = paper.px(place.point);

  const where = (e: PointerEvent): [number, number] => {
    const bounds = (e.currentTarget as Element).getBoundingClientRect();
    return [e.clientX - bounds.left, e.clientY - bounds.top];
  };
  const to = (e: PointerEvent) => {
    const shares = under(sketch.mesh, paper, where(e));
    go(surface, surface.variables.map(([, from, end], i) => from + shares[i] * (end - from)));
  };
  const down = (e: PointerEvent) => {
    if (e.button !== 0) return;
    const [px, py] = where(e);
    const point = Math.hypot(px - x, py - y) < (e.pointerType === "touch" ? GRIP.touch : GRIP.mouse);
    (e.currentTarget as Element).setPointerCapture(e.pointerId);
    grip.current = { point, x: px, y: py, yaw, pitch, moved: false };
  };
  const move = (e: PointerEvent) => {
    const g = grip.current;
    if (!g) return;
    const [px, py] = where(e);
    if (!g.moved && Math.hypot(px - g.x, py - g.y) < STILL) return;
    g.moved = true;
    if (g.point) to(e);
    else view.value = { yaw: g.yaw - (px - g.x) / 140, pitch: Math.min(Math.PI / 2, Math.max(-Math.PI / 2, g.pitch + (py - g.y) / 140)) };
  };
  const up = (e: PointerEvent) => {
    const g = grip.current;
    grip.current = null;
    if (g && !g.moved && e.type === "pointerup") to(e);
  };
  const key = (e: KeyboardEvent) => {
    const [i, sign] = ({ ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowDown: [1, -1], ArrowUp: [1, 1] } as Record<string, [number, number]>)[e.key] ?? [-1, 0];
    if (i < 0) return;
    e.preventDefault();
    const [, from, end] = surface.variables[i];
    const by = ((end - from) / STEPS) * (e.shiftKey ? 10 : e.altKey ? 0.1 : 1);
    go(surface, [0, 1].map((k) => (k === i ? place.variables[i][1] + sign * by : null)));
  };
  const spoken = place.variables.map(([name, value]) => `${name} ${fixed(value, 3)}`).join(", ");
  return (
    <>
      <div class="held" tabIndex={0} role="application" aria-label={t("surface.picture")} aria-describedby="surface-live" onPointerDown={down} onPointerMove={move} onPointerUp={up} onPointerCancel={up} onKeyDown={key} style={{ height }} data-stale={stale.value || undefined}>
        <svg width={width} height={height} aria-hidden="true">
          <g class="mesh">
            {faces.map((q, i) => (
              <path key={i} d={q.d} class={`lit l${Math.round(q.light * 5)}`} />
            ))}
          </g>
          {one?.tool === "surface" && (
            <g class="die">
              {faces.map((q, i) => (
                <path key={i} d={q.d} />
              ))}
            </g>
          )}
          {place.lines.map((l) => (
            <path key={l.variable} class={`through ${l.line}`} d={line(l.points.map((p) => paper.px(p)))} data-line={l.line} />
          ))}
          {one?.tool === "edge" && <path class="edge" d={line(one.points.map((p) => paper.px(p)))} />}
          <LineNames surface={surface} paper={paper} />
          {one && <Arrows arrows={one.motions} from={place.point} paper={paper} />}
          <circle class="reach" cx={x} cy={y} r={13} />
          <circle class={one?.tool === "point" ? "point tool" : "point"} cx={x} cy={y} r={6} data-point={`${x},${y}`} />
          <Scale paper={paper} />
        </svg>
      </div>
      <p class="sr" id="surface-live" aria-live="polite">
        {t("surface.spoken", { at: spoken, x: fixed(place.point[0], 3), y: fixed(place.point[1], 3), z: fixed(place.point[2], 3) })}
      </p>
    </>
  );
}

/** Names of the lines at their ends, with the variables that run along them. */
function LineNames({ surface, paper }: { surface: Surface; paper: Paper }) {
  const lines = surface.place?.lines ?? [];
  return (
    <>
      {lines.map((l) => {
        const [x, y] = paper.px(l.points[l.points.length - 1]);
        const right = x > paper.width / 2;
        return (
          <text key={l.variable} class={`lineName ${l.line}`} x={Math.min(paper.width - 4, Math.max(4, x + (right ? -8 : 8)))} y={Math.min(paper.height - 8, Math.max(14, y - 8))} text-anchor={right ? "end" : "start"}>
            {t(`surface.line.${l.line}`, { variable: pretty(l.variable) })}
          </text>
        );
      })}
    </>
  );
}

/** A bar of a round length. */
function Scale({ paper }: { paper: Paper }) {
  const most = (0.25 * paper.width) / paper.scale;
  const power = 10 ** Math.floor(Math.log10(most));
  const long = [5, 2, 1].map((n) => n * power).find((n) => n <= most) ?? power;
  const y = paper.height - 10;
  return (
    <g class="scale">
      <path d={`M12 ${y - 4}v8M12 ${y}h${long * paper.scale}m0 -4v8`} />
      <text x={18 + long * paper.scale} y={y + 4} {...untranslated}>
        {`${long} mm`}
      </text>
    </g>
  );
}

export function Views() {
  return (
    <span class="seg looks" role="group" aria-label={t("surface.view")}>
      {(Object.keys(VIEWS) as (keyof typeof VIEWS)[]).map((name) => (
        <button key={name} aria-pressed={view.value === VIEWS[name]} onClick={() => (view.value = VIEWS[name])} data-view={name}>
          {t(`surface.view.${name}`)}
        </button>
      ))}
    </span>
  );
}
