// Figure 2: the path of a tooth of a face mill, by the circle that rolls.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { Plane } from "../plane";

const TURN = 2 * Math.PI;
/** Turns that are drawn. */
const TURNS = 3;

/** A tooth at an angle (equations 1 and 2): the axis of the cutter is at (r t, r). */
export function tooth(r: number, R: number, t: number, phase = 0): Point {
  return [r * t - R * Math.sin(t + phase), r - R * Math.cos(t + phase)];
}

function rows(v: Values): Row[] {
  const R = v.D / 2;
  const r = (v.fz * v.z) / TURN;
  const [x, y] = tooth(r, R, v.t * TURN);
  const velocity = Math.atan2(R * Math.sin(v.t * TURN), r - R * Math.cos(v.t * TURN));
  return [
    { key: "R", symbol: "s.R", name: "q4.R", unit: "u.mm", value: R, digits: 3 },
    { key: "r", symbol: "s.r", name: "q4.r", unit: "u.mm", value: r, digits: 6 },
    { key: "feed", symbol: "s.f", name: "q4.feed", unit: "u.mm", value: v.fz * v.z, digits: 3 },
    { key: "drawn", symbol: "s.kr", name: "q4.drawn", unit: "u.mm", value: r * v.k, digits: 3 },
    { key: "x", symbol: "s.x", name: "q4.x", unit: "u.mm", value: x, digits: 3 },
    { key: "y", symbol: "s.y", name: "q4.y", unit: "u.mm", value: y, digits: 3 },
    { key: "way", symbol: "s.vdir", name: "q4.direction", unit: "u.deg", value: (velocity * 180) / Math.PI, digits: 2 },
    { key: "off", symbol: "s.dev", name: "q4.off", unit: "u.deg", value: (Math.asin(Math.min(1, r / R)) * 180) / Math.PI, digits: 4 },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const R = v.D / 2;
  const r = (v.k * v.fz * v.z) / TURN;
  const long = TURNS * TURN * r;
  const pad = 0.1 * R;
  const [min, max]: [Point, Point] = [
    [-R - pad, -R - pad + r],
    [long + R + pad, R + pad + r],
  ];
  const height = Math.min(520, ((width - 20) * (max[1] - min[1])) / (max[0] - min[0]));
  const plane = new Plane(min, max, { left: 10, top: 22, width: width - 20, height });
  const k = plane.scale;
  const t = v.t * TURN;
  const axis = plane.at([r * t, r]);
  const own = plane.at(tooth(r, R, t));
  const mark = plane.at([r * t - r * Math.sin(t), r - r * Math.cos(t)]);
  const curve = (from: number, to: number) => plane.curve((u) => tooth(r, R, u), from, to, Math.max(8, Math.ceil((to - from) * 16)));
  // The front half removes stock: there the tooth is ahead of the axis.
  const halves = Array.from({ length: 2 * (TURNS + 2) }, (_, i) => ({ from: (i - 2) * Math.PI, front: i % 2 === 1 })).filter((h) => h.from < TURNS * TURN);
  const turn = (to: Point): number => {
    const [x, y] = plane.back(to);
    const angle = Math.atan2(-(x - r * t), -(y - r));
    return v.t + Math.atan2(Math.sin(angle - t), Math.cos(angle - t)) / TURN;
  };
  return {
    height: height + 52,
    children: (
      <>
        <path d={`M${plane.x(min[0])} ${plane.y(0)}H${plane.x(max[0])}`} class="part" />
        <path d={`M${plane.x(min[0])} ${plane.y(r)}H${plane.x(max[0])}`} class="axis" />
        {halves.map((h) => (
          <path key={h.from} d={curve(Math.max(-Math.PI, h.from), Math.min(TURNS * TURN, h.from + Math.PI))} class={h.front ? "curve" : "ghost"} />
        ))}
        <circle cx={axis[0]} cy={axis[1]} r={R * k} class="cutter" />
        {Array.from({ length: v.z }, (_, i) => plane.at(tooth(r, R, t, (TURN * i) / v.z))).map(([x, y], i) => (
          <path key={i} d={`M${axis[0] + 0.86 * (x - axis[0])} ${axis[1] + 0.86 * (y - axis[1])}L${x} ${y}`} class={i === 0 ? "part" : ""} />
        ))}
        <circle cx={axis[0]} cy={axis[1]} r={r * k} class="second" />
        <path d={`M${axis[0]} ${axis[1]}L${mark[0]} ${mark[1]}`} class="second" />
        <Dot at={plane.at([r * t, 0])} />
        <Label at={[axis[0] + 0.75 * r * k + 6, axis[1] + 0.75 * r * k + 12]} text="1" />
        <Label at={[own[0] + (own[0] < axis[0] ? -14 : 14), own[1] + (own[1] < axis[1] ? -10 : 18)]} text="2" anchor={own[0] < axis[0] ? "end" : "start"} />
        <Label at={[axis[0] + 0.72 * R * k, axis[1] - 0.72 * R * k - 6]} text="3" />
        <Label at={[plane.at(tooth(r, R, TURN * (TURNS - 0.35)))[0] + 8, plane.at(tooth(r, R, TURN * (TURNS - 0.35)))[1] - 6]} text="4" />
        <Label at={[plane.x(min[0]) + 4, 16]} text={word("f42.exaggerated", { k: String(v.k).replace(".", word("decimal")) })} />
        <ScaleBar plane={plane} at={[14, height + 44]} />
        <Label at={[axis[0] - 10, axis[1] - 10]} symbol="s.r" anchor="end" />
        <Handle
          at={own}
          name={word("f42.tooth")}
          value={v.t}
          min={0}
          max={TURNS}
          told={`x ${c.text("x")}, y ${c.text("y")}`}
          move={(to) => c.set({ t: turn(to) })}
          step={(dx, dy) => c.set({ t: v.t + (dx + dy) / 72 })}
        />
        <Handle
          at={axis}
          name={word("f42.axis")}
          value={v.t}
          min={0}
          max={TURNS}
          told={`x ${c.text("x")}, y ${c.text("y")}`}
          move={(to) => c.set({ t: plane.back(to)[0] / (r * TURN) })}
          step={(dx) => c.set({ t: v.t + dx / 36 })}
        />
      </>
    ),
  };
}

export const fig42: Figure = {
  id: "4.2",
  words: "f42",
  after: "2",
  fields: [
    { key: "D", symbol: "s.D", name: "q.d", unit: "u.mm", min: 10, max: 400, step: 1, digits: 2 },
    { key: "fz", symbol: "s.fz", name: "q4.fz", unit: "u.mm", min: 0.01, max: 2, step: 0.01, digits: 3 },
    { key: "z", symbol: "s.z", name: "q4.z", min: 1, max: 40, step: 1, digits: 0 },
    { key: "t", symbol: "s.t", name: "q4.t", min: 0, max: TURNS, step: 0.05, digits: 3 },
    { key: "k", symbol: "s.k", name: "q4.k", min: 1, max: 200, step: 1, digits: 0 },
  ],
  start: { D: 100, fz: 0.12, z: 7, t: 1.3, k: 60 },
  rows,
  draw,
  toml: (v) => `[tool]\ndiameter = ${tomlNumber(v.D)}\nteeth = ${v.z}\n\n[operation]\nfeed_per_tooth = ${tomlNumber(v.fz)}`,
};
