// Figure 5: the involute through a chosen start inside the circle.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Row, type Values, tomlNumber } from "../model";
import { Plane } from "../plane";
import { TURN, involute, through } from "../involute";
import { RADIUS, TURNS, X0, Y0, pieces } from "./fields";

function rows(v: Values): Row[] {
  const s = through([v.x0, v.y0], v.R, v.n);
  const other = Math.abs(s.psi - s.psiPrinted) > 1e-9;
  return [
    { key: "r", symbol: "s.r", name: "q.r", unit: "u.mm", value: s.r, digits: 6 },
    { key: "rho", symbol: "s.rho", name: "q.rho", unit: "u.mm", value: s.rho, digits: 4 },
    { key: "phi0", symbol: "s.phi0", name: "q.phi0", unit: "u.rad", value: s.phi0, digits: 5 },
    { key: "psi", symbol: "s.psi", name: "q.psi", unit: "u.rad", value: s.psi, digits: 6, ...(other ? { printed: s.psiPrinted } : {}) },
    { key: "theta0", symbol: "s.theta0", name: "q.theta0", unit: "u.rad", value: s.tangent, digits: 5 },
    { key: "x", symbol: "s.xT", name: "q.xT", unit: "u.mm", value: s.touch[0], digits: 3 },
    { key: "y", symbol: "s.yT", name: "q.yT", unit: "u.mm", value: s.touch[1], digits: 3 },
    { key: "L", symbol: "s.L", name: "q.L", unit: "u.mm", value: s.length, digits: 3 },
    { key: "Rn", symbol: "s.Rn", name: "q.Rn", unit: "u.mm", value: s.rn, digits: 3 },
    { key: "nv", symbol: "s.nv", name: "q.nv", value: s.visible, digits: 4, printed: s.visiblePrinted },
    { key: "miss", symbol: "s.miss", name: "q.miss", unit: "u.mm", value: other ? 2 * s.rho * Math.abs(Math.sin((s.psiPrinted - s.psi) / 2)) : 0, digits: 2 },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const size = Math.min(width - 16, 600);
  // Where the circle fills the width, numbers are above it.
  const head = width < 620 ? (c.printed ? 88 : 48) : 0;
  const out = Math.max(1.1 * v.R, Math.min(1.4 * v.R, 1.06 * Math.hypot(v.x0, v.y0)));
  const plane = new Plane([-out, -out], [out, out], { left: (width - size) / 2, top: 8 + head, width: size, height: size });
  const O = plane.at([0, 0]);
  const inside = Math.hypot(v.x0, v.y0) < v.R;
  const s = inside ? through([v.x0, v.y0], v.R, v.n) : null;
  const end = TURN * v.n;
  const start = plane.at([v.x0, v.y0]);
  const unit = v.R / 100;
  return {
    height: size + 16 + head,
    children: (
      <>
        <path d={`M${plane.x(-1.07 * v.R)} ${O[1]}H${plane.x(1.07 * v.R)}M${O[0]} ${plane.y(-1.07 * v.R)}V${plane.y(1.07 * v.R)}`} class="axis" />
        <circle cx={O[0]} cy={O[1]} r={v.R * plane.scale} class="part" />
        {s && <Turned c={c} plane={plane} end={end} />}
        <Dot at={O} symbol="s.O" dx={8} dy={-6} />
        <Label at={[plane.x(0.71 * v.R) + 8, plane.y(0.71 * v.R) - 6]} symbol="s.R" />
        <Label at={[start[0] + (v.x0 < 0 ? -14 : 14), start[1] - 12]} symbol="s.T0" anchor={v.x0 < 0 ? "end" : "start"} />
        <ScaleBar plane={plane} at={[14, size + 4 + head]} />
        <Handle
          at={start}
          name={word("q.T0")}
          value={v.x0}
          min={-500}
          max={500}
          told={`${c.text("x0")}; ${c.text("y0")}`}
          move={(at) => {
            const [x, y] = plane.back(at);
            c.set({ x0: x, y0: y });
          }}
          step={(dx, dy) => c.set({ x0: v.x0 + dx * unit, y0: v.y0 + dy * unit })}
        />
      </>
    ),
  };
}

/** The curve before and after it is turned, and the circle on which both begin. */
function Turned({ c, plane, end }: { c: Drawing; plane: Plane; end: number }) {
  const { v } = c;
  const s = through([v.x0, v.y0], v.R, v.n);
  const O = plane.at([0, 0]);
  const P = plane.at(s.tp);
  const T = plane.at(s.touch);
  const start = plane.at([v.x0, v.y0]);
  const wrongBranch = c.printed && Math.abs(s.psi - s.psiPrinted) > 1e-9;
  const far = Math.abs(s.visible - s.visiblePrinted) > 0.05;
  const arc = Math.min(0.45 * s.rho, 0.3 * v.R);
  const a0 = Math.atan2(s.tp[1], s.tp[0]);
  const at = (angle: number, k = 1): [number, number] => plane.at([arc * k * Math.cos(angle), arc * k * Math.sin(angle)]);
  const [b0, b1] = [at(a0), at(a0 + s.psi)];
  return (
    <>
      <circle cx={O[0]} cy={O[1]} r={s.rho * plane.scale} class="dotted" />
      <path d={plane.curve(involute(s.r), 0, s.phi0, pieces(v.n))} class="dashed" />
      <path d={plane.curve(involute(s.r), s.phi0, end, pieces(v.n))} class="ghost" />
      <path d={plane.curve(involute(s.r, s.psi), s.phi0, end, pieces(v.n))} class="curve" />
      {wrongBranch && <path d={plane.curve(involute(s.r, s.psiPrinted), s.phi0, end, pieces(v.n))} class="wrongline" />}
      {s.rho > 0 && <path d={`M${P[0]} ${P[1]}L${O[0]} ${O[1]}L${start[0]} ${start[1]}`} />}
      {Math.abs(s.psi) > 0.02 && (
        <>
          <path d={`M${b0[0]} ${b0[1]}A${arc * plane.scale} ${arc * plane.scale} 0 ${Math.abs(s.psi) > Math.PI ? 1 : 0} ${s.psi > 0 ? 0 : 1} ${b1[0]} ${b1[1]}`} marker-end="url(#tg-arrow)" />
          <Label at={at(a0 + s.psi / 2, 1.25)} symbol="s.psi" row="psi" c={c} anchor={Math.cos(a0 + s.psi / 2) < 0 ? "end" : "start"} />
        </>
      )}
      <Dot at={P} symbol="s.TP" dx={s.tp[0] < 0 ? -8 : 8} dy={16} anchor={s.tp[0] < 0 ? "end" : "start"} />
      <Dot at={T} symbol="s.Tpsi" dx={s.touch[0] < 0 ? 10 : -10} dy={s.touch[1] < 0 ? -8 : 18} anchor={s.touch[0] < 0 ? "start" : "end"} />
      <Label at={[14, 24]} symbol="s.phi0" row="phi0" c={c} />
      <Label at={[14, 44]} symbol="s.nv" row="nv" c={c} />
      {c.printed && <Label at={[14, 64]} text={word("f15.formula", { n: c.text("nvPrinted") })} class={far ? "bad" : ""} />}
      {wrongBranch && <Label at={[14, 84]} text={word("f15.branch", { psi: c.text("psiPrinted") })} class="bad" />}
    </>
  );
}

export const fig15: Figure = {
  id: "1.5",
  words: "f15",
  after: "5",
  fields: [X0, Y0, RADIUS, TURNS],
  start: { x0: -40, y0: 40, R: 80, n: 2 },
  mistake: true,
  wrong: (v) => (Math.hypot(v.x0, v.y0) >= v.R ? "f15.outside" : null),
  rows,
  draw,
  toml: (v) => `finish = { turns = ${v.n}, feed = 3000, start = [${tomlNumber(v.x0)}, ${tomlNumber(v.y0)}] }`,
};
