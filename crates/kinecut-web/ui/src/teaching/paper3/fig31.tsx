// Figure 1: a tool in motion, where it enters and leaves, and the curve between both.
import type { Vec } from "../../windows/grazing/sheet";
import { word } from "../language";
import { Handle, Label, ScaleBar } from "../marks";
import type { Drawing, Figure, Row, Values } from "../model";
import { CORNER, DIAMETER, MOTION, SPIN, START, VIEW, dragged, millToml } from "./motion";
import { Arrow, Eye, Solid, pathOf, sizeOf } from "./solid";
import { type Tool, asking } from "./tool";

/** Length of an arrow by its velocity [mm to mm/min], and degrees below the horizon from where the tool is seen. */
const [ARROW, RISE] = [0.013, -24];

function rows(_: Values, data: unknown[]): Row[] {
  const tool = data[0] as Tool;
  const { area, entering_area, gained, lost } = tool.entering;
  return [
    { key: "loops", symbol: "s.Nloop", name: "q3.loops", value: tool.loops.length, digits: 0 },
    { key: "length", symbol: "s.Lg", name: "q3.length", unit: "u.mm", value: tool.loops.reduce((sum, l) => sum + l.length, 0), digits: 3 },
    { key: "winding", symbol: "s.wind", name: "q3.winding", value: tool.loops.reduce((sum, l) => sum + l.winding, 0), digits: 0 },
    { key: "folds", symbol: "s.Nfold", name: "q3.folds", value: tool.folds.length, digits: 0 },
    { key: "share", symbol: "s.pe", name: "q3.share", unit: "u.percent", value: (100 * entering_area) / area, digits: 2 },
    { key: "gained", symbol: "s.Vin", name: "q3.gained", unit: "u.cm3Minute", value: gained / 1000, digits: 2 },
    { key: "lost", symbol: "s.Vout", name: "q3.lost", unit: "u.cm3Minute", value: lost / 1000, digits: 2 },
    { key: "tip", symbol: "s.vTip", name: "q3.vTip", unit: "u.mmMinute", value: Math.hypot(...tool.ends[0].velocity), digits: 1 },
    { key: "top", symbol: "s.vTop", name: "q3.vTop", unit: "u.mmMinute", value: Math.hypot(...tool.ends[1].velocity), digits: 1 },
  ];
}

/** The line about which the tool turns at this moment, nearest to the tool; null where it does not turn. */
function turning({ twist, ends }: Tool): { at: Vec; along: Vec } | null {
  const w = twist.turn.map((n) => (n * Math.PI) / 180) as Vec;
  const square = w[0] ** 2 + w[1] ** 2 + w[2] ** 2;
  if (square < 1e-9) return null;
  const v = twist.velocity;
  const at: Vec = [(w[1] * v[2] - w[2] * v[1]) / square, (w[2] * v[0] - w[0] * v[2]) / square, (w[0] * v[1] - w[1] * v[0]) / square];
  const length = Math.sqrt(square);
  const along: Vec = [w[0] / length, w[1] / length, w[2] / length];
  const lift = along[2] * ((ends[0].z + ends[1].z) / 2 - at[2]);
  return { at: [at[0] + lift * along[0], at[1] + lift * along[1], at[2] + lift * along[2]], along };
}

function draw(c: Drawing) {
  const { v, width } = c;
  const tool = c.data[0] as Tool;
  const { radius, low, high } = sizeOf(tool);
  const tall = Math.min(520, width * 0.85);
  const eye = new Eye(v.view, RISE, [-2.6 * radius, low - 14], [2.6 * radius, high + 12], { left: 8, top: 8, width: width - 16, height: tall });
  const axis = turning(tool);
  const inside = axis && Math.hypot(...eye.flat(axis.at)) < 4.5 * radius;
  const arrow = (k: 0 | 1): Vec => tool.ends[k].velocity.map((n) => n * ARROW) as Vec;
  const foot = (k: 0 | 1): Vec => [0, 0, tool.ends[k].z];
  const end = (k: 0 | 1): Vec => [arrow(k)[0], arrow(k)[1], tool.ends[k].z + arrow(k)[2]];
  return {
    height: tall + 52,
    children: (
      <>
        <path d={pathOf([eye.at([0, 0, low - 10]), eye.at([0, 0, high + 10])])} class="axis" />
        {axis && inside && (
          <>
            <path d={pathOf([-70, 70].map((t) => eye.at([axis.at[0] + t * axis.along[0], axis.at[1] + t * axis.along[1], axis.at[2] + t * axis.along[2]])))} class="fourth" />
            <Label at={[eye.at(axis.at)[0] + 6, eye.at(axis.at)[1] - 6]} text={word("f31.twistAxis")} />
          </>
        )}
        <Solid eye={eye} tool={tool} />
        <Label at={[eye.at([0, 0, high + 10])[0] + 6, eye.at([0, 0, high + 10])[1] + 4]} symbol="s.axisZ" />
        {([0, 1] as const).map((k) => (
          <Arrow key={k} eye={eye} from={foot(k)} by={arrow(k)} />
        ))}
        {([0, 1] as const).map((k) => (
          <Label key={k} at={[eye.at(end(k))[0] + 12, eye.at(end(k))[1] - 10]} symbol={k ? "s.vTop" : "s.vTip"} />
        ))}
        <g class="key">
          <rect x="12" y={tall + 30} width="14" height="12" class="entersKey" />
          <Label at={[32, tall + 41]} text={word("f31.enters")} />
          <rect x={width / 2} y={tall + 30} width="14" height="12" class="leavesKey" />
          <Label at={[width / 2 + 20, tall + 41]} text={word("f31.leaves")} />
        </g>
        <ScaleBar plane={eye.plane} at={[14, tall + 12]} />
        {([0, 1] as const).map((k) => (
          <Handle
            key={k}
            at={eye.at(end(k))}
            name={word(k ? "f31.topHandle" : "f31.tipHandle")}
            value={Math.round(c.rows.get(k ? "top" : "tip")?.value ?? 0)}
            min={0}
            max={9000}
            told={`${c.text(k ? "top" : "tip")} ${word("u.mmMinute")}`}
            move={(to) => {
              const [x, y] = eye.at(end(k));
              c.set(dragged(tool, v, k ? "top" : "tip", eye.moved(to[0] - x, to[1] - y).map((n) => n / ARROW) as Vec));
            }}
            step={(dx, dy) => c.set(dragged(tool, c.now(), k ? "top" : "tip", eye.moved(50 * dx * eye.plane.scale, -50 * dy * eye.plane.scale)))}
          />
        ))}
      </>
    ),
  };
}

export const fig31: Figure = {
  id: "3.1",
  words: "f31",
  after: "1",
  drawn: "figure.inferred",
  fields: [...MOTION, SPIN, DIAMETER, CORNER, VIEW],
  start: { ...START, D: 20, rc: 5, view: -47 },
  wrong: (v) => (v.rc >= v.D / 2 ? "f31.corner" : null),
  asks: (v) => [asking(millToml({ ...v, rc: Math.min(v.rc, v.D / 2 - 0.05) }))],
  rows,
  draw,
  toml: millToml,
};
