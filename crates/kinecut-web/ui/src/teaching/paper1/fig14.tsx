// Figure 4: the involute turned, so that it touches the circle at a chosen point.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { Plane, turned } from "../plane";
import { TURN, involute } from "../involute";
import { RADIUS, TURNS, pieces } from "./fields";

const touch = (v: Values): Point => [v.R * Math.sin(v.psi), -v.R * Math.cos(v.psi)];

function rows(v: Values): Row[] {
  const [x, y] = touch(v);
  return [
    { key: "r", symbol: "s.r", name: "q.r", unit: "u.mm", value: v.R / (TURN * v.n), digits: 6 },
    { key: "psi", symbol: "s.psi", name: "q.psi", unit: "u.rad", value: v.psi, digits: 6 },
    { key: "degrees", symbol: "s.psi", name: "q.psi", unit: "u.deg", value: (v.psi * 180) / Math.PI, digits: 3 },
    { key: "x", symbol: "s.xT", name: "q.xT", unit: "u.mm", value: x, digits: 3 },
    { key: "y", symbol: "s.yT", name: "q.yT", unit: "u.mm", value: y, digits: 3 },
    { key: "tangent", symbol: "s.theta", name: "q.tangentT", unit: "u.rad", value: turned(TURN * v.n + v.psi), digits: 6 },
    { key: "L", symbol: "s.L", name: "q.Lall", unit: "u.mm", value: Math.PI * v.n * v.R, digits: 4 },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const size = Math.min(width - 16, 560);
  const plane = new Plane([-1.12 * v.R, -1.12 * v.R], [1.12 * v.R, 1.12 * v.R], { left: (width - size) / 2, top: 8, width: size, height: size });
  const r = v.R / (TURN * v.n);
  const end = TURN * v.n;
  const T = touch(v);
  const O = plane.at([0, 0]);
  const P = plane.at(T);
  const first = plane.at([0, -v.R]);
  const arc = 0.42 * v.R;
  const [ax, ay] = plane.at([arc * Math.sin(v.psi), -arc * Math.cos(v.psi)]);
  const t: Point = [Math.cos(v.psi), Math.sin(v.psi)];
  const tangent = plane.line([
    [T[0] - 0.45 * v.R * t[0], T[1] - 0.45 * v.R * t[1]],
    [T[0] + 0.45 * v.R * t[0], T[1] + 0.45 * v.R * t[1]],
  ]);
  const set = (psi: number) => c.set({ psi: turned(psi) });
  return {
    height: size + 16,
    children: (
      <>
        <path d={`M${plane.x(-1.1 * v.R)} ${O[1]}H${plane.x(1.1 * v.R)}M${O[0]} ${plane.y(-1.1 * v.R)}V${plane.y(1.1 * v.R)}`} class="axis" />
        <circle cx={O[0]} cy={O[1]} r={v.R * plane.scale} class="part" />
        <path d={plane.curve(involute(r), 0, end, pieces(v.n))} class="thin" />
        <path d={plane.curve(involute(r, v.psi), 0, end, pieces(v.n))} class="curve" />
        <path d={`M${first[0]} ${first[1]}L${O[0]} ${O[1]}L${P[0]} ${P[1]}`} class="dashed" />
        <path d={tangent} class="second" />
        <path d={`M${O[0]} ${O[1] + arc * plane.scale}A${arc * plane.scale} ${arc * plane.scale} 0 ${v.psi > Math.PI ? 1 : 0} 0 ${ax} ${ay}`} marker-end="url(#tg-arrow)" />
        <Label at={plane.at([arc * 1.12 * Math.sin(v.psi / 2), -arc * 1.12 * Math.cos(v.psi / 2)])} symbol="s.psi" row="psi" c={c} />
        <Dot at={O} symbol="s.O" dx={-8} anchor="end" />
        <Label at={[P[0] + (T[0] > 0.4 * v.R ? -14 : 14), P[1] + (T[1] > 0 ? 24 : -14)]} symbol="s.Tpsi" anchor={T[0] > 0.4 * v.R ? "end" : "start"} />
        <Label at={[plane.x(-0.66 * v.R), plane.y(0.72 * v.R) - 12]} symbol="s.R" anchor="end" />
        <ScaleBar plane={plane} at={[14, size + 4]} />
        <Handle
          at={P}
          name={word("q.Tpsi")}
          value={v.psi}
          min={0}
          max={TURN}
          told={`ψ ${c.text("degrees")}°`}
          move={(at) => {
            const [x, y] = plane.back(at);
            set(Math.atan2(x, -y));
          }}
          step={(dx, dy) => set(v.psi + (dx + dy) * (Math.PI / 180))}
        />
      </>
    ),
  };
}

export const fig14: Figure = {
  id: "1.4",
  words: "f14",
  after: "4",
  fields: [{ ...RADIUS }, TURNS, { key: "psi", symbol: "s.psi", name: "q.psi", unit: "u.rad", min: 0, max: 6.283185, step: 0.01, digits: 6 }],
  start: { R: 80, n: 2, psi: 0.946567 },
  rows,
  draw,
  toml: (v) => {
    // Half a turn before the circle: near a whole turn the angle ψ hangs on the last digits of the start.
    const [x, y] = involute(v.R / (TURN * v.n), v.psi)(TURN * (v.n - 0.5));
    return `finish = { turns = ${v.n}, feed = 3000, start = [${tomlNumber(x)}, ${tomlNumber(y)}] }`;
  },
};
