// The hole in plan, to scale: what is cut, the path, its involute, the cutter at a place of it. Start and point of tangency are dragged.
import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useMemo, useRef } from "preact/hooks";
import { untranslated } from "../../app/verbatim";
import { fixed, short } from "../../base/format";
import { t } from "../../words";
import { useWidth } from "../drill/room";
import type { Figure, Pass, Plan, Point, Run } from "./answer";
import { Handle } from "./handle";
import { lineOf, ring, sector, stretch } from "./lines";
import { usePump } from "./pump";
import { numberOf, pointOf, startIn, table, touchIn } from "./question";
import type { State } from "./state";
import { nearest, readingAt, spotAt } from "./track";

/** Half of what is seen, in radii of the bore. */
const SEEN = 1.13;
/** Distance from the path within which a press moves the cutter [px]. */
const NEAR = 12;
/** Step of the arrow keys [mm, deg]; with Shift ten times, with Alt a tenth. */
const STEP = 1;

export function PlanDrawing({ state, plan, pass, run }: { state: State; plan: Plan; pass: Pass; run: Run }) {
  const box = useRef<HTMLDivElement>(null);
  const width = useWidth(box, 620);
  return (
    <div class="drawing plan" ref={box}>
      <Drawing state={state} plan={plan} pass={pass} run={run} width={width} />
    </div>
  );
}

/** Radius that is open before a pass, as far as the answer says [mm]. */
function openBefore(state: State, plan: Plan, pass: Pass): number | null {
  const cutter = plan.cutter_diameter / 2;
  const rough = plan.passes.find((p) => p.pass === "rough");
  if (pass.pass === "finish" && rough) return rough.path_radius + cutter;
  if (pass.entry_radius > 0) return pass.entry_radius + cutter;
  const drilled = numberOf(table(table(table(state.doc.values.value.operation).entry)["pre-drilled"]).diameter);
  return drilled === null ? null : drilled / 2;
}

function Drawing({ state, plan, pass, run, width }: { state: State; plan: Plan; pass: Pass; run: Run; width: number }) {
  const { doc } = state;
  const pump = usePump(doc);
  const pan = useRef<{ x: number; y: number; from: Point } | null>(null);
  const dragged = useSignal<{ name: "start" | "touch"; at: Point } | null>(null);
  const height = Math.round(width < 480 ? width : Math.min(660, width * 0.86));
  const radius = plan.diameter / 2;
  const cutter = plan.cutter_diameter / 2;
  const view = state.view.value;
  const scale = (Math.min(width, height) / 2 / (SEEN * radius)) * view.zoom;
  const toPage = ([x, y]: Point): Point => [width / 2 + (x - view.x) * scale, height / 2 - (y - view.y) * scale];
  const toPlace = (e: { clientX: number; clientY: number }, svg: Element): Point => {
    const bounds = svg.getBoundingClientRect();
    return [view.x + (e.clientX - bounds.left - width / 2) / scale, view.y - (e.clientY - bounds.top - height / 2) / scale];
  };
  const svg = useRef<SVGSVGElement>(null);
  const { figure } = pass;
  const isLead = pass.pass === "finish" && figure !== undefined;

  const down = (e: PointerEvent) => {
    if (e.button !== 0 || !svg.current || e.pointerType === "touch") return;
    const place = toPlace(e, svg.current);
    svg.current.setPointerCapture(e.pointerId);
    const { s, off } = nearest(run, ...place);
    const spot = spotAt(run, state.s.value);
    if (Math.hypot(place[0] - spot.x, place[1] - spot.y) * scale < 16 || off * scale < NEAR) state.go(s);
    else pan.current = { x: e.clientX, y: e.clientY, from: [view.x, view.y] };
  };
  const move = (e: PointerEvent) => {
    if (e.buttons !== 1 || !svg.current?.hasPointerCapture(e.pointerId)) return;
    const p = pan.current;
    if (p) state.view.value = { ...view, x: p.from[0] - (e.clientX - p.x) / scale, y: p.from[1] + (e.clientY - p.y) / scale };
    else state.go(nearest(run, ...toPlace(e, svg.current)).s);
  };
  const up = () => (pan.current = null);
  const wheel = (e: WheelEvent) => {
    if (!svg.current || !e.ctrlKey) return;
    e.preventDefault();
    state.zoom(1.0015 ** -e.deltaY, ...toPlace(e, svg.current));
  };

  // The start is that of the text: it is ahead of what is drawn.
  const written = pointOf(table(table(doc.values.value.operation).finish).start);
  const start: Point | null = dragged.value?.name === "start" ? dragged.value.at : written ? [written[0] - plan.at[0], written[1] - plan.at[1]] : (figure?.start ?? null);
  const touch: Point | null = dragged.value?.name === "touch" ? dragged.value.at : (figure?.touch ?? null);
  const moveStart = (to: Point) => pump(() => startIn(doc, plan, to));
  const turnTouch = (degrees: number, of: Figure) => pump(() => touchIn(doc, state.plan.peek() ?? plan, state.pass.peek()?.figure ?? of, degrees));

  const material = `M0 0H${width}V${height}H0Z`;
  const hole = circlePath(toPage([0, 0]), radius * scale);
  const open = openBefore(state, plan, pass);
  const ruler = [1, 2, 5, 10, 20, 50, 100, 200].find((mm) => mm * scale >= 46) ?? 500;
  return (
    <svg
      ref={svg}
      class="involute"
      width={width}
      height={height}
      role="group"
      aria-label={t("hole.planIs", { diameter: short(plan.diameter, 6), radius: fixed(pass.path_radius, 3) })}
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={up}
      onPointerCancel={up}
      onWheel={wheel}
    >
      <defs>
        <pattern id="hole-hatch" width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
          <path class="hatch" d="M0 0V7" />
        </pattern>
      </defs>
      <path class="solid" d={material} />
      <g transform={`translate(${width / 2} ${height / 2}) scale(${scale} ${-scale}) translate(${-view.x} ${-view.y})`}>
        {open !== null && <circle class="open" r={open} />}
        <Swept state={state} run={run} cutter={cutter} />
      </g>
      <path class="outside" fill-rule="evenodd" d={material + hole} />
      <path fill="url(#hole-hatch)" fill-rule="evenodd" d={material + hole} />
      <g transform={`translate(${width / 2} ${height / 2}) scale(${scale} ${-scale}) translate(${-view.x} ${-view.y})`}>
        <path class="axis-line" d={`M${-SEEN * radius} 0H${SEEN * radius}M0 ${-SEEN * radius}V${SEEN * radius}`} />
        {pass.pass === "rough" && <Allowance plan={plan} pass={pass} />}
        <circle class="bore" r={radius} />
        <circle class="wall" r={pass.path_radius} />
        {figure && state.construction.value && <Construction figure={figure} pass={pass} isLead={isLead} />}
        <Ghosts state={state} pass={pass} />
        <Path run={run} pass={pass} />
        <Cutter state={state} plan={plan} run={run} />
      </g>
      <Labels toPage={toPage} plan={plan} pass={pass} figure={state.construction.value ? figure : undefined} isLead={isLead} />
      <Dot state={state} run={run} toPage={toPage} />
      {isLead && touch && (
        <Handle
          name="touch"
          sign="Tψ"
          at={toPage(touch)}
          label={t("hole.touchHandle")}
          now={degreesOf(touch)}
          range={[-180, 180]}
          told={t("hole.degrees", { deg: fixed(degreesOf(touch), 2) })}
          onDrag={(e) => {
            if (!svg.current) return;
            const place = toPlace(e, svg.current);
            const far = Math.hypot(...place);
            if (far === 0) return;
            dragged.value = { name: "touch", at: [(place[0] * pass.path_radius) / far, (place[1] * pass.path_radius) / far] };
            turnTouch(degreesOf(place), figure);
          }}
          onEnd={() => (dragged.value = null)}
          onKey={(x, y, by) => turnTouch(degreesOf(figure.touch) + (y - x) * by * STEP, figure)}
        />
      )}
      {isLead && start && (
        <Handle
          name="start"
          sign="T0"
          at={toPage(start)}
          label={t("hole.startHandle")}
          now={Math.hypot(...start)}
          range={[0, pass.path_radius]}
          told={t("hole.fromCentre", { x: fixed(start[0], 3), y: fixed(start[1], 3) })}
          onDrag={(e) => {
            if (!svg.current) return;
            const place = toPlace(e, svg.current).map((v) => Number(v.toFixed(scale > 8 ? 3 : 2))) as Point;
            dragged.value = { name: "start", at: place };
            moveStart(place);
          }}
          onEnd={() => (dragged.value = null)}
          onKey={(x, y, by) => moveStart([start[0] + x * by * STEP, start[1] + y * by * STEP])}
        />
      )}
      <g class="size">
        <path d={`M10 ${height - 16}v6h${ruler * scale}v-6`} />
        <text x={16 + ruler * scale} y={height - 8} {...untranslated}>
          {ruler} mm
        </text>
      </g>
    </svg>
  );
}

function circlePath([x, y]: Point, r: number): string {
  return `M${x + r} ${y}A${r} ${r} 0 1 1 ${x - r} ${y}A${r} ${r} 0 1 1 ${x + r} ${y}Z`;
}

function degreesOf([x, y]: Point): number {
  return (Math.atan2(y, x) * 180) / Math.PI;
}

/** What the cutter has swept on the way so far: a line as wide as the cutter. */
function Swept({ state, run, cutter }: { state: State; run: Run; cutter: number }) {
  return <path class="swept" d={stretch(run, 0, Math.max(1e-3, state.s.value))} stroke-width={2 * cutter} />;
}

/** The allowance that roughing leaves. */
function Allowance({ plan, pass }: { plan: Plan; pass: Pass }) {
  const inner = pass.path_radius + plan.cutter_diameter / 2;
  if (!(plan.diameter / 2 - inner > 1e-6)) return null;
  return <path class="allowance" fill-rule="evenodd" d={ring(plan.diameter / 2) + ring(inner)} />;
}

/** Where the parts of a way end: before the spiral, the spiral, the circle at the wall, the way out. */
function partsOf(run: Run, pass: Pass): [string, number, number][] {
  const from = run.measured?.[0] ?? 0;
  const wall = Math.min(run.length, from + pass.length);
  // Further circles without infeed, and an overlap, are between the circle and the way out.
  const out = Math.min(run.length, wall + pass.circle_length);
  const inner = pass.pass === "rough" ? "rough" : "lead";
  return [
    ["lead", 0, from],
    [inner, from, wall],
    [pass.pass === "rough" ? "rough" : "finish", wall, out],
    ["lead", out, run.length],
  ];
}

function Path({ run, pass }: { run: Run; pass: Pass }) {
  const parts = useMemo(() => partsOf(run, pass).map(([name, from, to]) => [name, stretch(run, from, to)]), [run, pass]);
  return (
    <>
      {parts.map(([name, d], i) => d && <path key={i} class={`way ${name}`} d={d} />)}
    </>
  );
}

function Ghosts({ state, pass }: { state: State; pass: Pass }) {
  return (
    <>
      {state.others.ghosts(pass.pass).map(({ other, run, index, isOld }) => (
        <path key={other.id} class={`way ghost g${index}${isOld ? " aged" : ""}`} data-ghost={other.id} d={stretch(run, 0, run.length)} />
      ))}
    </>
  );
}

/** The base circle or evolute, the spiral that is not run, and how it was turned. */
function Construction({ figure, pass, isLead }: { figure: Figure; pass: Pass; isLead: boolean }) {
  const { base_centre: c, base_radius: r } = figure;
  const isTurned = isLead && Math.abs(figure.psi) > 1e-9;
  return (
    <g class="construction">
      {figure.osculated.map((radius) => isLead && <circle key={radius} class="thin" r={radius} />)}
      {isTurned && <path class="unturned" d={lineOf(figure.unturned)} />}
      {isTurned && <circle class="thin" r={Math.hypot(...figure.start)} />}
      {figure.before.length > 0 && <path class="before" d={lineOf(figure.before)} />}
      {figure.evolute.length > 0 ? <path class="base" d={lineOf(figure.evolute)} /> : <circle class="base" cx={c[0]} cy={c[1]} r={r} />}
      {isLead && <path class="thread" d={lineOf([figure.start_centre, figure.start])} />}
      {isLead && <path class="thread" d={lineOf([[0, 0], [figure.touch[0], figure.touch[1]]])} />}
      {pass.pass === "rough" && <circle class="base" cx={c[0]} cy={c[1]} r={r} />}
    </g>
  );
}

function Cutter({ state, plan, run }: { state: State; plan: Plan; run: Run }) {
  const { x, y, heading } = spotAt(run, state.s.value);
  const cutter = plan.cutter_diameter / 2;
  const engaged = readingAt(run, state.s.value).engagement ?? 0;
  // From the wall's side on towards the front.
  const side = plan.clockwise ? 1 : -1;
  return (
    <g class="cutter">
      <circle class="edge" cx={x} cy={y} r={cutter} />
      <path class="engaged" d={sector([x, y], cutter, heading + (side * Math.PI) / 2, -side * engaged)} data-deg={((engaged * 180) / Math.PI).toFixed(2)} />
    </g>
  );
}

/** The centre of the cutter, and the direction in which it runs. */
function Dot({ state, run, toPage }: { state: State; run: Run; toPage: (p: Point) => Point }) {
  const { x, y, heading } = spotAt(run, state.s.value);
  const [px, py] = toPage([x, y]);
  const [c, s] = [Math.cos(heading), -Math.sin(heading)];
  const at = (along: number, across: number) => `${(px + along * c - across * s).toFixed(1)} ${(py + along * s + across * c).toFixed(1)}`;
  return (
    <g class="centre" data-x={x.toFixed(4)} data-y={y.toFixed(4)}>
      <path class="run" d={`M${at(0, 0)}L${at(24, 0)}M${at(17, -4)}L${at(25, 0)}L${at(17, 4)}`} />
      <circle cx={px} cy={py} r={4} />
    </g>
  );
}

function Labels({ toPage, plan, pass, figure, isLead }: { toPage: (p: Point) => Point; plan: Plan; pass: Pass; figure?: Figure; isLead: boolean }) {
  const texts: { at: Point; text: ComponentChildren; dx: number; dy: number }[] = [];
  const diagonal = (r: number, deg: number): Point => [r * Math.cos((deg * Math.PI) / 180), r * Math.sin((deg * Math.PI) / 180)];
  texts.push({ at: diagonal(plan.diameter / 2, 52), text: `⌀${short(plan.diameter, 6)}`, dx: 6, dy: -6 });
  texts.push({ at: diagonal(pass.path_radius, 236), text: `R ${fixed(pass.path_radius, 3)}`, dx: -74, dy: 12 });
  texts.push({ at: [0, 0], text: "O", dx: 4, dy: 13 });
  if (figure && isLead) {
    texts.push({ at: figure.base_centre, text: "C", dx: -12, dy: 14 });
    if (Math.abs(figure.psi) > 1e-9) texts.push({ at: figure.unturned_start, text: <>T<tspan dy="3" font-size="10">P</tspan></>, dx: 6, dy: -6 });
  }
  return (
    <g {...untranslated}>
      {texts.map(({ at, text, dx, dy }, i) => {
        const [x, y] = toPage(at);
        return (
          <text key={i} class="w plate" x={x + dx} y={y + dy}>
            {text}
          </text>
        );
      })}
      {figure && isLead && Math.abs(figure.psi) > 1e-9 && <circle class="mark" cx={toPage(figure.unturned_start)[0]} cy={toPage(figure.unturned_start)[1]} r={3} />}
    </g>
  );
}
