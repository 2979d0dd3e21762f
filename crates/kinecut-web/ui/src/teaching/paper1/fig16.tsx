// Figure 6: roughing along a spiral, and the engagement of the cutter on it.
import { word } from "../language";
import { Axes, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane, distance } from "../plane";
import { TURN, engagement, involute, lens } from "../involute";
import { pieces } from "./fields";

interface Spiral {
  R: number;
  n: number;
  r: number;
  /** By an angle that grows by a turn with each turn; beyond the spiral is the closing circle. */
  path: (u: number) => Point;
  direction: (u: number) => number;
  length: number;
}

const INVOLUTE = 0;
const LENS = 1;
const ARCHIMEDES = 2;
/** Names of the paths in an input. */
const STRATEGIES = ["involute", "lens-1", "archimedean"];

function spiral(v: Values, way = v.way): Spiral {
  const R = (v.D - v.d) / 2 - v.delta;
  const n = Math.max(1, Math.ceil(R / v.H - 1e-12));
  const r = R / (TURN * n);
  const end = TURN * n;
  const on = way === LENS ? lens(1, r) : way === ARCHIMEDES ? (u: number): Point => [r * u * Math.sin(u), -r * u * Math.cos(u)] : involute(r);
  return {
    R,
    n,
    r,
    path: (u) => (u <= end ? on(u) : [R * Math.sin(u), -R * Math.cos(u)]),
    // The tangent of the Archimedean spiral is turned outwards by acot θ from the normal of its radius.
    direction: (u) => (way === ARCHIMEDES && u <= end ? u - Math.PI / 2 + Math.atan(u) : u),
    length: way === ARCHIMEDES ? (r / 2) * (end * Math.hypot(1, end) + Math.asinh(end)) : Math.PI * n * R,
  };
}

const place = (v: Values, n: number) => TURN * Math.min(v.turn, n + 1);

function angleAt(s: Spiral, u: number, cutter: number): number {
  return (engagement(s.path, s.direction, u, cutter, 1.6 * TURN) * 180) / Math.PI;
}

const curves = new Map<string, [number, number][]>();

/** Engagement over turns; kept, as moving the cutter does not change it. */
function load(v: Values, way: number): [number, number][] {
  const key = [v.D, v.d, v.H, v.delta, way].join();
  let found = curves.get(key);
  if (!found) {
    const s = spiral(v, way);
    const per = s.n > 40 ? 8 : 16;
    found = Array.from({ length: (s.n + 1) * per }, (_, i): [number, number] => {
      const turn = (i + 1) / per;
      return [turn, angleAt(s, TURN * turn, v.d / 2)];
    });
    if (curves.size > 40) curves.clear();
    curves.set(key, found);
  }
  return found;
}

function rows(v: Values): Row[] {
  const s = spiral(v);
  const cutter = v.d / 2;
  return [
    { key: "R", symbol: "s.R", name: "q.R", unit: "u.mm", value: s.R, digits: 3 },
    { key: "n", symbol: "s.n", name: "q.n", value: s.n, digits: 0 },
    { key: "H", symbol: "s.H", name: "q.H", unit: "u.mm", value: s.R / s.n, digits: 4 },
    { key: "r", symbol: "s.r", name: "q.r", unit: "u.mm", value: s.r, digits: 6 },
    { key: "L", symbol: "s.L", name: "q.Lspiral", unit: "u.mm", value: s.length, digits: 3 },
    { key: "circle", symbol: "s.Lc", name: "q.Lcircle", unit: "u.mm", value: TURN * s.R, digits: 3 },
    { key: "turn", symbol: "s.turn", name: "q.turn", value: place(v, s.n) / TURN, digits: 3 },
    { key: "angle", symbol: "s.angle", name: "q.angle", unit: "u.deg", value: angleAt(s, place(v, s.n), cutter), digits: 1 },
    { key: "quarter", symbol: "s.angle", name: "q.quarter", unit: "u.deg", value: angleAt(s, TURN / 4, cutter), digits: 1 },
    { key: "first", symbol: "s.angle", name: "q.first", unit: "u.deg", value: angleAt(s, TURN, cutter), digits: 1 },
    { key: "last", symbol: "s.angle", name: "q.last", unit: "u.deg", value: angleAt(s, TURN * s.n, cutter), digits: 1 },
  ];
}

function wrong(v: Values) {
  if (v.d >= v.D) return "f16.tooLarge" as const;
  if ((v.D - v.d) / 2 - v.delta <= 0) return "f16.noRoom" as const;
  return v.H > v.d ? ("f16.ridges" as const) : null;
}

function draw(c: Drawing) {
  const { v, width } = c;
  const size = Math.min(width - 16, 560);
  const half = 0.53 * v.D;
  const plane = new Plane([-half, -half], [half, half], { left: (width - size) / 2, top: 8, width: size, height: size });
  const O = plane.at([0, 0]);
  const k = plane.scale;
  const ok = wrong(v) === null;
  const ring = `M${O[0] - (v.D / 2) * k} ${O[1]}a${(v.D / 2) * k} ${(v.D / 2) * k} 0 1 0 ${v.D * k} 0a${(v.D / 2) * k} ${(v.D / 2) * k} 0 1 0 ${-v.D * k} 0Z`;
  const inner = Math.max(0, v.D / 2 - v.delta) * k;
  return {
    height: size + (ok ? 210 : 16),
    children: (
      <>
        <path d={`${ring}M${O[0] - inner} ${O[1]}a${inner} ${inner} 0 1 1 ${2 * inner} 0a${inner} ${inner} 0 1 1 ${-2 * inner} 0Z`} class="hatched" fill-rule="evenodd" />
        <path d={ring} class="part" />
        <path d={`M${plane.x(-half)} ${O[1]}H${plane.x(half)}M${O[0]} ${plane.y(-half)}V${plane.y(half)}`} class="axis" />
        {ok && <Path c={c} plane={plane} />}
        <Label at={[plane.x(-0.36 * v.D) - 6, plane.y(0.36 * v.D) - 6]} symbol="s.D" anchor="end" />
        <ScaleBar plane={plane} at={[14, size + 4]} />
        <Handle
          at={plane.at([v.D / 2, 0])}
          name={word("q.D")}
          value={v.D}
          min={10}
          max={400}
          told={`${c.text("D")}`}
          move={(at) => c.set({ D: 2 * Math.hypot(...plane.back(at)) })}
          step={(dx, dy) => c.set({ D: v.D + dx + dy })}
        />
        {ok && <Load c={c} box={{ left: 46, top: size + 44, width: width - 66, height: 120 }} />}
      </>
    ),
  };
}

function Path({ c, plane }: { c: Drawing; plane: Plane }) {
  const { v } = c;
  const s = spiral(v);
  const k = plane.scale;
  const u = place(v, s.n);
  const P = s.path(u);
  const [x, y] = plane.at(P);
  const cutter = (v.d / 2) * k;
  const from = s.direction(u) - Math.PI / 2;
  const angle = (c.rows.get("angle")?.value ?? 0) * (Math.PI / 180);
  const at = (a: number): string => `${(x + cutter * Math.cos(a)).toFixed(2)} ${(y - cutter * Math.sin(a)).toFixed(2)}`;
  const H = s.R / s.n;
  const near = (to: Point): number => {
    const all = Array.from({ length: (s.n + 1) * 72 + 1 }, (_, i) => (TURN * i) / 72);
    return all.reduce((best, w) => (distance(s.path(w), to) < distance(s.path(best), to) ? w : best), u);
  };
  return (
    <>
      {v.way !== INVOLUTE && <path d={plane.curve(spiral(v, INVOLUTE).path, 0, TURN * s.n, pieces(s.n))} class="ghost" />}
      <circle cx={plane.x(0)} cy={plane.y(0)} r={s.R * k} class="third" />
      <path d={plane.curve(s.path, 0, TURN * s.n, pieces(s.n))} class="curve" />
      <circle cx={x} cy={y} r={cutter} class="cutter" />
      <path d={`M${x} ${y}L${at(from)}A${cutter} ${cutter} 0 0 0 ${at(from + angle)}Z`} class="load" />
      <Label at={[x, y - cutter - 8]} symbol="s.angle" text={`${c.text("angle")}°`} anchor="middle" />
      <path d={`M${plane.x(0)} ${plane.y(-s.R + H)}V${plane.y(-s.R)}`} class="part" />
      <Label at={[plane.x(0) + 8, plane.y(-s.R + H / 2) + 4]} symbol="s.H" row="H" c={c} />
      <Label at={[plane.x(0.7 * s.R) - 6, plane.y(0.7 * s.R) + 16]} symbol="s.R" row="R" c={c} anchor="end" />
      <Handle
        at={[x, y]}
        name={word("f16.cutter")}
        value={u / TURN}
        min={0}
        max={s.n + 1}
        told={word("f16.told", { turn: c.text("turn"), angle: c.text("angle") })}
        move={(to) => c.set({ turn: near(plane.back(to)) / TURN })}
        step={(dx, dy) => c.set({ turn: Math.min(s.n + 1, u / TURN + (dx + dy) / 36) })}
      />
    </>
  );
}

function Load({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const s = spiral(v);
  const line = (all: [number, number][], sx: (n: number) => number, sy: (n: number) => number) => all.map(([t, a], i) => `${i ? "L" : "M"}${sx(t).toFixed(1)} ${sy(a).toFixed(1)}`).join("");
  const at = c.rows.get("turn")?.value ?? 0;
  const angle = c.rows.get("angle")?.value ?? 0;
  return (
    <Axes box={box} x={[0, s.n + 1]} y={[0, 180]} xName={word("f16.turns")} yName={word("f16.engagement")}>
      {(scale) => (
        <>
          {v.way !== INVOLUTE && <path d={line(load(v, INVOLUTE), scale.x, scale.y)} class="ghost" />}
          <path d={line(load(v, v.way), scale.x, scale.y)} class="second" />
          <path d={`M${scale.x(at)} ${box.top}V${box.top + box.height}`} class="dashed" />
          <circle cx={scale.x(at)} cy={scale.y(angle)} r="4" class="dot" />
        </>
      )}
    </Axes>
  );
}

export const fig16: Figure = {
  id: "1.6",
  words: "f16",
  after: "6",
  fields: [
    { key: "D", symbol: "s.D", name: "q.D", unit: "u.mm", min: 10, max: 400, step: 1, digits: 2 },
    { key: "d", symbol: "s.d", name: "q.d", unit: "u.mm", min: 1, max: 200, step: 1, digits: 2 },
    { key: "H", symbol: "s.Hz", name: "q.Hz", unit: "u.mm", min: 1, max: 100, step: 0.1, digits: 3 },
    { key: "delta", symbol: "s.delta", name: "q.delta", unit: "u.mm", min: 0, max: 50, step: 0.1, digits: 3 },
    { key: "turn", symbol: "s.turn", name: "q.turn", min: 0, max: 200, step: 0.05, digits: 6 },
    { key: "way", symbol: "s.turn", name: "f16.strategy", min: 0, max: 2, step: 1, digits: 0, options: ["f16.involute", "f16.lens", "f16.archimedes"] },
  ],
  start: { D: 200, d: 40, H: 4, delta: 1, turn: 1, way: INVOLUTE },
  wrong,
  rows,
  draw,
  toml: (v) => `diameter = ${tomlNumber(v.D)}\nstrategy = "${STRATEGIES[v.way]}"\nrough = { stepover = ${tomlNumber(v.H)}, allowance = ${tomlNumber(v.delta)}, feed = 6000 }`,
};
