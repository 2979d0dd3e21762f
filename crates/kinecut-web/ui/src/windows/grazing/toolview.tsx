// The tool with its curve in three dimensions: handles of the motion, folds, the place that is looked at.
import { effect, useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { offer } from "../../app/commands";
import { t } from "../../words";
import { Body, besideMotion, extentOf, sheetSize } from "./body";
import { Handles } from "./handles";
import type { Sheet, Vec } from "./sheet";
import { Stage } from "./stage";
import type { Looked } from "./state";

const DIRECTIONS = ["motion", "iso", "top", "front", "right"] as const;
/** Distance within which the pointer is on a curve [px]. */
const NEAR = 9;

interface Around {
  stage: Stage;
  body: Body;
}

/** A finger scrolls the page until it has tapped the picture. */
export function startTouch(canvas: HTMLCanvasElement): void {
  if (!matchMedia("(pointer: coarse)").matches) return;
  canvas.style.touchAction = "pan-y";
  canvas.addEventListener("click", () => (canvas.style.touchAction = "none"));
  document.addEventListener("pointerdown", (e) => {
    if (e.target !== canvas) canvas.style.touchAction = "pan-y";
  });
}

export function ToolView({ looked, isFixed, dim, children }: { looked: Looked; isFixed: boolean; dim: boolean; children: ComponentChildren }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const around = useSignal<Around | null>(null);
  const frame = useSignal(0);
  const none = useSignal(false);
  const direction = useSignal<string>("motion");
  useEffect(() => {
    // Asked first, because the renderer would write to the console where a browser has none.
    if (document.createElement("canvas").getContext("webgl2") === null) {
      none.value = true;
      return;
    }
    const on = canvas.current as HTMLCanvasElement;
    const body = new Body();
    const stage = new Stage(on, { drawn: () => frame.value++, recolour: () => body.recolour() });
    stage.scene.add(body.group);
    startTouch(on);
    let size = 0;
    const ends = [
      effect(() => {
        const sheet = looked.sheet.value;
        if (!sheet) return;
        body.show(sheet);
        const { radius, low, high } = extentOf(sheet);
        const now = sheetSize(sheet);
        const out = 0.3 * now;
        stage.holds([-radius - out, -radius - out, low - 0.08 * now], [radius + out, radius + out, high + 0.08 * now]);
        looked.fit(sheet, now);
        // A tool of another size is fitted into the picture anew.
        if (Math.abs(now - size) > 0.02 * now) stage.look(direction.peek() === "motion" ? besideMotion(sheet) : direction.peek());
        size = now;
        stage.draw();
      }),
      effect(() => {
        body.choose(looked.span.value);
        stage.draw();
      }),
    ];
    around.value = { stage, body };
    return () => {
      for (const end of ends) end();
      around.value = null;
      stage.end();
    };
  }, [looked]);
  const sheet = looked.sheet.value;
  const look = (name: string) => {
    direction.value = name;
    if (sheet) around.value?.stage.look(name === "motion" ? besideMotion(sheet) : name);
  };
  useEffect(() => {
    offer(
      { id: "command.fit", keys: ["F"], run: () => look(direction.value) },
      { id: "command.iso", keys: ["1"], run: () => look("iso") },
      { id: "command.top", keys: ["2"], run: () => look("top") },
      { id: "command.front", keys: ["3"], run: () => look("front") },
      { id: "command.right", keys: ["4"], run: () => look("right") },
    );
  });
  return (
    <section class="panel tool" aria-label={t("grazing.tool")} tabIndex={-1} data-panel="tool">
      <header>
        <h2>{t("grazing.tool")}</h2>
        <span class="seg" role="radiogroup" aria-label={t("part.directions")}>
          {DIRECTIONS.map((name) => (
            <button key={name} role="radio" aria-checked={direction.value === name} onClick={() => look(name)} data-view={name}>
              {t(name === "motion" ? "grazing.alongMotion" : `part.${name}`)}
            </button>
          ))}
        </span>
      </header>
      <div class={`stage${dim ? " dim" : ""}`}>
        <canvas
          ref={canvas}
          tabIndex={0}
          role="img"
          aria-label={t("grazing.canvas")}
          onKeyDown={(e) => around.value?.stage.key(e) && e.preventDefault()}
          onPointerMove={(e) => e.buttons === 0 && around.value && sheet && under(around.value, sheet, looked, e)}
          onPointerLeave={() => (looked.spot.value = null)}
        />
        {none.value && <p class="hint">{t("part.noWebgl")}</p>}
        {around.value && sheet && (
          <>
            <Marks around={around.value} sheet={sheet} looked={looked} frame={frame.value} />
            <Handles stage={around.value.stage} sheet={sheet} looked={looked} frame={frame.value} fixed={isFixed} />
          </>
        )}
      </div>
      {children}
    </section>
  );
}

/** The curve's point near the pointer, or else the place of the surface under it. */
function under({ stage, body }: Around, sheet: Sheet, looked: Looked, e: PointerEvent): void {
  const [x, y] = [e.offsetX, e.offsetY];
  let [best, found]: [number, [number, number] | null] = [NEAR, null];
  sheet.loops.forEach(({ points }, loop) => {
    points.forEach((p, index) => {
      const [a, b] = stage.project(p.point);
      const away = Math.hypot(a - x, b - y);
      if (away < best) [best, found] = [away, [loop, index]];
    });
  });
  if (found) return looked.lookAtCurve(found[0], found[1]);
  const hit = stage.hit([body.solid], x, y);
  if (!hit) {
    looked.spot.value = null;
    return;
  }
  const place = nearest(sheet, Math.hypot(hit[0], hit[1]), hit[2]);
  looked.lookAt(place.piece, place.u, (Math.atan2(hit[1], hit[0]) * 180) / Math.PI);
}

/** Piece and parameter of a place of the outline. */
function nearest(sheet: Sheet, r: number, z: number): { piece: number; u: number } {
  let best = { piece: 0, u: 0, away: Infinity };
  for (const { piece, u, places } of sheet.bands) {
    if (sheet.pieces[piece].fan) continue;
    const [[ra, za], [rb, zb]] = places;
    const long = (rb - ra) ** 2 + (zb - za) ** 2;
    const part = long > 0 ? Math.min(1, Math.max(0, ((r - ra) * (rb - ra) + (z - za) * (zb - za)) / long)) : 0;
    const away = Math.hypot(ra + part * (rb - ra) - r, za + part * (zb - za) - z);
    if (away < best.away) best = { piece, u: u[0] + part * (u[1] - u[0]), away };
  }
  return best;
}

/** Folds, whole circles' heights, and the place that is looked at. */
function Marks({ around: { stage, body }, sheet, looked }: { around: Around; sheet: Sheet; looked: Looked; frame: number }) {
  const by = 0.02 * sheetSize(sheet);
  const spot = looked.spot.value;
  const mark = (point: Vec, name: string, key: string) => {
    const [x, y] = stage.project(point);
    const hidden = stage.hides([body.solid], point, by);
    return <circle key={key} class={`${name}${hidden ? " hidden" : ""}`} cx={x} cy={y} r={name === "fold" ? 4.5 : 7} />;
  };
  return (
    <svg class="marks" aria-hidden="true">
      {sheet.folds.map((fold, i) => mark(fold.point, "fold", `fold${i}`))}
      {spot && mark(spot.point, "spot", "spot")}
    </svg>
  );
}
