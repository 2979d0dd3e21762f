// Figure 3: the involute of a circle, its thread, and the circles that it touches.
import { word } from "../language";
import { Axes, Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlAbove, tomlNumber } from "../model";
import { type Box, Plane, add, polar } from "../plane";
import { TURN, involute, unrolled } from "../involute";
import { RADIUS, TURNS, pieces } from "./fields";

function of(v: Values) {
  const r = v.R / (TURN * v.n);
  const phi = Math.min(v.phi, TURN * v.n);
  const contact: Point = add([-r, 0], polar(r, phi));
  return { r, phi, end: involute(r)(phi), contact };
}

function rows(v: Values): Row[] {
  const { r, phi, end, contact } = of(v);
  return [
    { key: "r", symbol: "s.r", name: "q.r", unit: "u.mm", value: r, digits: 6 },
    { key: "phi", symbol: "s.phi", name: "q.phi", unit: "u.rad", value: phi, digits: 3 },
    { key: "Rkr", symbol: "s.Rkr", name: "q.Rkr", unit: "u.mm", value: r * phi, digits: 4, printed: -r * phi },
    { key: "L", symbol: "s.L", name: "q.L", unit: "u.mm", value: (r * phi * phi) / 2, digits: 4 },
    { key: "x", symbol: "s.x", name: "q.xEnd", unit: "u.mm", value: end[0], digits: 4 },
    { key: "y", symbol: "s.y", name: "q.yEnd", unit: "u.mm", value: end[1], digits: 4 },
    { key: "off", symbol: "s.OE", name: "q.off", unit: "u.mm", value: Math.hypot(...contact), digits: 4 },
    { key: "H", symbol: "s.H", name: "q.H", unit: "u.mm", value: v.R / v.n, digits: 4 },
    { key: "jump", symbol: "s.jump", name: "q.jump", unit: "u.perMm2", value: 1 / (TURN * v.n * v.R * v.R), digits: 4, power: true },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const wide = width >= 540;
  const side = wide ? (width - 24) / 2 : width - 16;
  const chartTop = (wide ? side : 2 * side + 12) + 46;
  const { r, phi, end, contact } = of(v);
  const curve = involute(r);
  const whole: Box = { left: 8, top: 24, width: side, height: side - 24 };
  const a = new Plane([-1.06 * v.R, -1.06 * v.R], [1.06 * v.R, 1.06 * v.R], whole);
  // The second picture shows as many turns as the thread has made, at most three.
  const turns = Math.min(3, Math.max(1, Math.ceil(phi / TURN - 1e-9)));
  const reach = 1.16 * TURN * r * turns;
  const zoomed = phi <= TURN * 3 + 1e-9 ? reach : 1.16 * r * phi;
  const b = new Plane([-zoomed, -zoomed], [zoomed, zoomed], wide ? { left: side + 16, top: 24, width: side, height: side - 24 } : { left: 8, top: side + 36, width: side, height: side - 24 });
  const circles = Array.from({ length: v.n }, (_, i) => (v.R * (i + 1)) / v.n);
  const E = b.at(contact);
  const P = b.at(end);
  const until = Math.min(TURN * v.n, TURN * Math.max(turns, Math.ceil(phi / TURN)));
  const snap = (next: number) => (Math.abs(next / TURN - Math.round(next / TURN)) < 0.012 ? TURN * Math.round(next / TURN) : next);
  return {
    height: chartTop + 172,
    children: (
      <>
        <Label at={[whole.left + 4, 18]} text={word("panel.a")} />
        <path d={`M${a.x(-1.05 * v.R)} ${a.y(0)}H${a.x(1.05 * v.R)}M${a.x(0)} ${a.y(-1.05 * v.R)}V${a.y(1.05 * v.R)}`} class="axis" />
        {circles.map((R, i) => (
          <circle key={i} cx={a.x(0)} cy={a.y(0)} r={R * a.scale} class={i + 1 === v.n ? "part" : "ghost"} />
        ))}
        <path d={a.curve(curve, 0, TURN * v.n, pieces(v.n))} class="curve" />
        <circle cx={a.at(end)[0]} cy={a.at(end)[1]} r="3.5" class="dot" />
        <Label at={[a.x(0.72 * v.R) + 4, a.y(0.72 * v.R) - 4]} symbol="s.R" />
        <ScaleBar plane={a} at={[whole.left + 6, whole.top + whole.height - 2]} />
        <Label at={[b.box.left + 4, b.box.top - 6]} text={`${word("panel.b")} ${word("f13.enlarged", { k: String(Math.round(b.scale / a.scale)) })}`} />
        <svg x={b.box.left} y={b.box.top} width={b.box.width} height={b.box.height} viewBox={`${b.box.left} ${b.box.top} ${b.box.width} ${b.box.height}`}>
          <path d={`M${b.x(-zoomed)} ${b.y(0)}H${b.x(zoomed)}M${b.x(0)} ${b.y(-zoomed)}V${b.y(zoomed)}`} class="axis" />
          <path d={b.curve(curve, 0, until, pieces(until / TURN))} class="curve" />
          <circle cx={b.x(-r)} cy={b.y(0)} r={r * b.scale} class="part" />
          <circle cx={E[0]} cy={E[1]} r={r * phi * b.scale} class="ghost" />
          <path d={`M${E[0]} ${E[1]}L${P[0]} ${P[1]}`} class="second" />
        </svg>
        <Dot at={b.at([0, 0])} symbol="s.O" />
        <Dot at={E} symbol="s.E" dx={-8} dy={16} anchor="end" />
        <Label at={[E[0] + 0.62 * (P[0] - E[0]) + (P[1] > E[1] === P[0] > E[0] ? -10 : 10), E[1] + 0.62 * (P[1] - E[1]) + 12]} symbol="s.Rkr" row="Rkr" c={c} anchor={P[1] > E[1] === P[0] > E[0] ? "end" : "start"} />
        {c.printed && <Label at={[b.box.left + 6, b.box.top + b.box.height - 8]} text={`${word("f13.printedRkr")} ${c.text("RkrPrinted")}`} class="bad" />}
        <Handle
          at={P}
          name={word("f13.handle")}
          value={phi}
          min={0}
          max={TURN * v.n}
          told={`φ ${c.text("phi")}`}
          move={(at) => c.set({ phi: Math.min(TURN * v.n, snap(unrolled(r, b.back(at), phi))) })}
          step={(dx, dy) => c.set({ phi: Math.min(TURN * v.n, phi + (dx + dy) * 0.1) })}
        />
        {kink(c, { left: 56, top: chartTop, width: width - 76, height: 120 })}
      </>
    ),
  };
}

/** Curvature of the last turn and of the closing circle, over the way from the joint. */
function kink({ v }: Drawing, box: Box) {
  const r = v.R / (TURN * v.n);
  const first = Math.max(TURN * v.n - TURN, TURN * 0.5);
  const joint = TURN * v.n;
  const way = (phi: number) => (r * (phi * phi - joint * joint)) / 2;
  const top = 1000 / (r * first);
  const end = -way(first) * 0.7;
  const points = Array.from({ length: 61 }, (_, i) => first + ((joint - first) * i) / 60);
  return (
    <Axes box={box} x={[way(first), end]} y={[(1000 / v.R) * (2 - (top * v.R) / 1000 > 0.2 ? 2 - (top * v.R) / 1000 : 0), top]} xName={word("f13.way")} yName={word("f13.curvature")}>
      {(s) => (
        <>
          <path d={`M${s.x(0)} ${box.top}V${box.top + box.height}`} class="dashed" />
          <path d={`${points.map((p, i) => `${i ? "L" : "M"}${s.x(way(p)).toFixed(1)} ${s.y(1000 / (r * p)).toFixed(1)}`).join("")}`} class="curve" />
          <path d={`M${s.x(0)} ${s.y(1000 / v.R)}H${s.x(end)}`} class="part" />
          <Label at={[s.x(0) + 8, s.y(1000 / v.R) - 10]} text={word("f13.kink")} />
        </>
      )}
    </Axes>
  );
}

export const fig13: Figure = {
  id: "1.3",
  words: "f13",
  after: "3",
  fields: [RADIUS, TURNS, { key: "phi", symbol: "s.phi", name: "q.phi", unit: "u.rad", min: 0, max: 251.327413, step: 0.1, digits: 6 }],
  start: { R: 79, n: 20, phi: 9 },
  mistake: true,
  rows,
  draw,
  toml: (v) => `diameter = ${tomlNumber(2 * v.R + 42)}\nrough = { stepover = ${tomlAbove(v.R / v.n)}, allowance = 1, feed = 6000 }`,
};
