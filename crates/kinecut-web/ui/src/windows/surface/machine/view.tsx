// The machine in space; without WebGL the drawing of the library at the same positions.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import * as api from "../../../base/api";
import { theme } from "../../../app/theme";
import { t } from "../../../words";
import { useWidth } from "../../face/size";
import { image } from "../layouts/drawings";
import { Newest } from "../newest";
import { type Look, MachineScene } from "./scene";
import { joints, pose, shown, source, words } from "./state";

const TURN = 1 / 140;
const STEP = 0.12;

export function MachineView() {
  const [box, width] = useWidth(560);
  const canvas = useRef<HTMLCanvasElement>(null);
  const scene = useRef<MachineScene | null>(null);
  const flat = useSignal(false);
  const machine = shown.value?.machine;
  const height = Math.round(Math.min(560, Math.max(300, 0.76 * width.value)));
  useEffect(() => {
    if (!machine || !canvas.current) return;
    try {
      scene.current = new MachineScene(canvas.current, machine);
      scene.current.resize(width.value, height);
      if (pose.value) scene.current.at(pose.value.pose);
    } catch {
      flat.value = true;
    }
    return () => {
      scene.current?.close();
      scene.current = null;
    };
  }, [machine]);
  useEffect(() => scene.current?.resize(width.value, height), [width.value, height]);
  useEffect(() => void (pose.value && scene.current?.at(pose.value.pose)), [pose.value]);
  useEffect(() => scene.current?.recolour(), [theme.value]);
  const grip = useRef<[number, number] | null>(null);
  const key = (e: KeyboardEvent) => {
    const turn = { ArrowLeft: [STEP, 0], ArrowRight: [-STEP, 0], ArrowUp: [0, STEP], ArrowDown: [0, -STEP] }[e.key];
    if (turn) scene.current?.turn(turn[0], turn[1]);
    else if (e.key === "+" || e.key === "-") scene.current?.near(e.key === "+" ? 1.2 : 1 / 1.2);
    else return;
    e.preventDefault();
  };
  if (flat.value) return <Still />;
  return (
    <div class="flat" ref={box}>
      <span class="seg looks" role="group" aria-label={t("surface.view")}>
        {(["iso", "top", "front", "right"] as Look[]).map((look) => (
          <button key={look} onClick={() => scene.current?.look(look)}>
            {t(`surface.view.${look}`)}
          </button>
        ))}
      </span>
      <div
        class="held"
        tabIndex={0}
        role="application"
        aria-label={t("axes.picture", { code: machine?.code ?? "" })}
        onKeyDown={key}
        onPointerDown={(e) => {
          e.currentTarget.setPointerCapture(e.pointerId);
          grip.current = [e.clientX, e.clientY];
        }}
        onPointerMove={(e) => {
          if (!grip.current) return;
          scene.current?.turn((e.clientX - grip.current[0]) * TURN, (e.clientY - grip.current[1]) * TURN);
          grip.current = [e.clientX, e.clientY];
        }}
        onPointerUp={() => (grip.current = null)}
        onPointerCancel={() => (grip.current = null)}
        onWheel={(e) => {
          if (!e.ctrlKey && document.activeElement !== e.currentTarget) return;
          e.preventDefault();
          scene.current?.near(e.deltaY < 0 ? 1.1 : 1 / 1.1);
        }}
        style={{ height }}
      >
        <canvas ref={canvas} aria-hidden="true" style={{ width: width.value, height }} />
      </div>
    </div>
  );
}

const stills = new Newest();

/** The drawing of the library. */
function Still() {
  const svg = useSignal("");
  useEffect(() => {
    const at = words(joints.value);
    const flags = { ...source.value, ...(at && { at }) };
    stills.ask((signal, generation) => api.drawing("machine", { ...flags, generation }, signal)).then((text) => text !== null && (svg.value = text), () => (svg.value = ""));
  }, [source.value, joints.value]);
  return <div class="flat still">{svg.value && <img src={image(svg.value, theme.value)} alt={t("axes.picture", { code: shown.value?.machine.code ?? "" })} />}</div>;
}
