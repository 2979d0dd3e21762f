// Figure 7: onto the finishing circle and off it, and the depth of cut on the way.
import { word } from "../language";
import { Axes, Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";
import { TURN, lens, lensAt, lensCurvatureRadius, lensLength, lensReach } from "../involute";
import { RADIUS, TURNS, X0, Y0, pieces } from "./fields";

/** Names of the contacts in an input. */
const CONTACTS = ["g2", "g4", "g6"];

function rotate([x, y]: Point, angle: number): Point {
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  return [c * x - s * y, s * x + c * y];
}

function lead(v: Values, order = v.contact) {
  const r = v.R / (TURN * v.n);
  const end = TURN * v.n;
  const rho = Math.hypot(v.x0, v.y0);
  const t0 = lensAt(order, rho / r, v.n);
  const plain = lens(order, r);
  const p = plain(t0);
  const psi = rho === 0 ? 0 : Math.atan2(p[0] * v.y0 - p[1] * v.x0, p[0] * v.x0 + p[1] * v.y0);
  const t1 = lensAt(order, Math.max(0, v.R - v.delta) / r, v.n);
  return {
    r,
    end,
    t0,
    psi,
    path: (t: number) => rotate(plain(t), psi),
    touch: [v.R * Math.sin(psi), -v.R * Math.cos(psi)] as Point,
    length: r * (lensLength(order, end) - lensLength(order, t0)),
    rn: r * lensCurvatureRadius(order, t0),
    /** Angle before the joint at which the allowance is met first, and the way from there. */
    first: end - Math.max(t1, t0),
    way: r * (lensLength(order, end) - lensLength(order, Math.max(t1, t0))),
    jerk: order === 0 ? ((v.F * 1000) / 60) ** 3 * (r / v.R ** 3) : 0,
  };
}

/** Of the curve whose start has the roll angle in place of the tangent angle, as table 3 prints it. */
function misread(v: Values) {
  const l = lead(v, 0);
  const about: Point = [v.x0, v.y0];
  const turnedBack = (t: number): Point => {
    const [x, y] = l.path(t);
    const [dx, dy] = rotate([x - about[0], y - about[1]], -l.psi);
    return [about[0] + dx, about[1] + dy];
  };
  return { path: turnedBack, end: turnedBack(l.end) };
}

/** The roll angle as table 3 has it; its last digit is rounded up. */
const PRINTED = 9.04482;

function rows(v: Values): Row[] {
  const l = lead(v);
  const m = misread(v);
  const far = Math.hypot(...m.end);
  // Onto the wall, and nowhere beyond it: by the points of the curve.
  const end = Math.hypot(...l.path(l.end));
  const beyond = Math.max(...Array.from({ length: 257 }, (_, i) => Math.hypot(...l.path(l.t0 + ((l.end - l.t0) * i) / 256)))) - v.R;
  const paper = v.contact === 0 && v.x0 === -40 && v.y0 === 40 && v.R === 80 && v.n === 2;
  return [
    { key: "r", symbol: "s.r", name: "q.r", unit: "u.mm", value: l.r, digits: 6 },
    { key: "x", symbol: "s.xT", name: "q.xT", unit: "u.mm", value: l.touch[0], digits: 3, ...(paper ? { printed: 0 } : {}) },
    { key: "y", symbol: "s.yT", name: "q.yT", unit: "u.mm", value: l.touch[1], digits: 3, ...(paper ? { printed: -79 } : {}) },
    { key: "theta0", symbol: "s.theta0", name: "q.theta0", unit: "u.rad", value: l.t0 + l.psi, digits: 5, ...(v.contact === 0 ? { printed: paper ? PRINTED : l.t0 } : {}) },
    { key: "L", symbol: "s.L", name: "q.L", unit: "u.mm", value: l.length, digits: 3 },
    { key: "Rn", symbol: "s.Rn", name: "q.Rn", unit: "u.mm", value: l.rn, digits: 3 },
    { key: "circle", symbol: "s.Lc", name: "q.Lcircle", unit: "u.mm", value: TURN * v.R, digits: 3 },
    { key: "end", symbol: "s.Rend", name: "q.Rend", unit: "u.mm", value: end, digits: 2, ...(v.contact === 0 ? { printed: far } : {}) },
    { key: "gouge", symbol: "s.gouge", name: "q.gouge", unit: "u.mm", value: Math.max(0, beyond), digits: 2, ...(v.contact === 0 ? { printed: Math.max(0, far - v.R) } : {}) },
    { key: "first", symbol: "s.eps", name: "q.firstTouch", unit: "u.rad", value: l.first, digits: 3 },
    { key: "way", symbol: "s.lw", name: "q.thin", unit: "u.mm", value: l.way, digits: 2 },
    { key: "jerk", symbol: "s.dj", name: "q.jerkStep", unit: "u.mmS3", value: l.jerk, digits: 3 },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const size = Math.min(width - 16, 560);
  // Where the circle fills the width, the legend is above it.
  const head = width < 620 ? 84 : 0;
  const ok = Math.hypot(v.x0, v.y0) < v.R;
  const m = ok && c.printed && v.contact === 0 ? misread(v) : null;
  const out = Math.min(1.6 * v.R, Math.max(1.12 * v.R, 1.06 * Math.hypot(v.x0, v.y0), m ? 1.06 * Math.hypot(...m.end) : 0));
  const plane = new Plane([-out, -out], [out, out], { left: (width - size) / 2, top: 8 + head, width: size, height: size });
  const O = plane.at([0, 0]);
  const k = plane.scale;
  const inner = Math.max(0, v.R - v.delta) * k;
  const outer = v.R * k;
  const start = plane.at([v.x0, v.y0]);
  const unit = v.R / 100;
  const circle = (R: number, way: 0 | 1) => `M${O[0] - R} ${O[1]}a${R} ${R} 0 1 ${way} ${2 * R} 0a${R} ${R} 0 1 ${way} ${-2 * R} 0Z`;
  return {
    height: size + head + (ok ? 210 : 16),
    children: (
      <>
        <path d={circle(outer, 0) + circle(inner, 1)} class="hatched" fill-rule="evenodd" />
        <path d={`M${plane.x(-1.08 * v.R)} ${O[1]}H${plane.x(1.08 * v.R)}M${O[0]} ${plane.y(-1.08 * v.R)}V${plane.y(1.08 * v.R)}`} class="axis" />
        <path d={circle(outer, 0)} class="part" />
        {ok && <Leads c={c} plane={plane} />}
        {m && <path d={plane.curve(m.path, lead(v, 0).t0, TURN * v.n, pieces(v.n))} class="wrongline" />}
        {m && <Label at={[Math.min(plane.at(m.end)[0] + 8, width - 150), plane.at(m.end)[1] - 10]} text={word("f17.misread", { gouge: c.text("gougePrinted") })} class="bad" />}
        <Dot at={O} symbol="s.O" />
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
        {ok && <Depth c={c} box={{ left: 52, top: size + head + 44, width: width - 72, height: 120 }} />}
      </>
    ),
  };
}

function Leads({ c, plane }: { c: Drawing; plane: Plane }) {
  const { v } = c;
  const l = lead(v);
  // The way off is the way on in a mirror through the centre and the point of tangency, run backwards.
  const mirrored = (t: number): Point => {
    const [x, y] = rotate(l.path(t), -l.psi);
    return rotate([-x, y], l.psi);
  };
  const T = plane.at(l.touch);
  const F = plane.at(l.path(l.end - l.first));
  return (
    <>
      <path d={plane.curve(l.path, l.t0, l.end, pieces(v.n))} class="curve" />
      <path d={plane.curve(mirrored, l.t0, l.end, pieces(v.n))} class="fourth" />
      <path d={plane.curve(l.path, l.end - l.first, l.end, 48)} class="strip" />
      <Dot at={T} symbol="s.Tpsi" dx={l.touch[0] < 0 ? 10 : -10} dy={l.touch[1] < 0 ? -10 : 20} anchor={l.touch[0] < 0 ? "start" : "end"} />
      <Dot at={F} />
      <Dot at={plane.at(mirrored(l.t0))} symbol="s.T1" />
      <Label at={[14, 24]} text={word("f17.in")} />
      <path d="M14 32h46" class="curve" />
      <Label at={[14, 52]} text={word("f17.out")} />
      <path d="M14 60h46" class="fourth" />
      <Label at={[14, 80]} symbol="s.eps" row="first" c={c} />
    </>
  );
}

/** Depth of cut over the angle before the joint, of all three kinds of contact. */
function Depth({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const r = v.R / (TURN * v.n);
  const end = TURN * v.n;
  const reach = Math.min(end, Math.max(2, ...[0, 1, 2].map((k) => lead(v, k).first * 1.15)));
  const line = (order: number, sx: (n: number) => number, sy: (n: number) => number) =>
    Array.from({ length: 81 }, (_, i) => -reach + (reach * i) / 80)
      .map((e, i) => `${i ? "L" : "M"}${sx(e).toFixed(1)} ${sy(Math.max(0, r * lensReach(order, end + e) - (v.R - v.delta))).toFixed(1)}`)
      .join("");
  const top = Math.max(v.delta, 0.1);
  return (
    <Axes box={box} x={[-reach, 0]} y={[0, top * 1.1]} xName={word("f17.before")} yName={word("f17.depth")}>
      {(s) => (
        <>
          {[0, 1, 2].filter((k) => k !== v.contact).map((k) => <path key={k} d={line(k, s.x, s.y)} class="ghost" />)}
          <path d={line(v.contact, s.x, s.y)} class="curve" />
        </>
      )}
    </Axes>
  );
}

export const fig17: Figure = {
  id: "1.7",
  words: "f17",
  after: "7",
  fields: [
    X0,
    Y0,
    RADIUS,
    TURNS,
    { key: "delta", symbol: "s.delta", name: "q.delta", unit: "u.mm", min: 0, max: 20, step: 0.1, digits: 3 },
    { key: "F", symbol: "s.F", name: "q.F", unit: "u.mMin", min: 0.1, max: 60, step: 1, digits: 2 },
    { key: "contact", symbol: "s.n", name: "f17.contact", min: 0, max: 2, step: 1, digits: 0, options: ["f17.g2", "f17.g4", "f17.g6"] },
  ],
  start: { x0: -40, y0: 40, R: 80, n: 2, delta: 1, F: 6, contact: 0 },
  mistake: true,
  wrong: (v) => (Math.hypot(v.x0, v.y0) >= v.R ? "f15.outside" : null),
  rows,
  draw,
  toml: (v) => `finish = { turns = ${v.n}, feed = ${tomlNumber(v.F * 1000)}, contact = "${CONTACTS[v.contact]}", start = [${tomlNumber(v.x0)}, ${tomlNumber(v.y0)}] }`,
};
