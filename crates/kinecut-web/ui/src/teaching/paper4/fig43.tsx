// Figure 3: the face, one turn of a tooth, and the angle at which it leaves.
import { word } from "../language";
import { Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { Plane, turned } from "../plane";
import { isWide, lengths } from "./lengths";
import { COVER, CUTTER, type Crossing, type Edge, FEED, LEAST, LOOPS, along, crossings, turnedEdge } from "./part";

const TURN = 2 * Math.PI;
const r = FEED / TURN;
const deg = (n: number) => (n * 180) / Math.PI;

function state(v: Values) {
  const edges = COVER.map((edge) => turnedEdge(edge, (v.gamma * Math.PI) / 180));
  const all = crossings(edges, r, CUTTER, v.c, v.m);
  const exits = all.filter((k) => k.psi > 0 && k.front);
  const one = exits.length ? exits[Math.min(exits.length, v.exit) - 1] : null;
  return { edges, all, exits, one };
}

function rows(v: Values): Row[] {
  const { all, exits, one } = state(v);
  const bad = exits.filter((k) => deg(k.psi) < v.psi0);
  const common: Row[] = [
    { key: "entries", symbol: "s.Nin", name: "q4.entries", value: all.filter((k) => k.psi <= 0 && k.front).length, digits: 0 },
    { key: "exits", symbol: "s.Nout", name: "q4.exits", value: exits.length, digits: 0 },
    { key: "bad", symbol: "s.Nbad", name: "q4.bad", value: bad.length, digits: 0 },
    { key: "back", symbol: "s.Nback", name: "q4.back", value: all.filter((k) => k.psi > 0 && !k.front).length, digits: 0 },
  ];
  if (!one) return common;
  return [
    ...common,
    { key: "psi", symbol: "s.Psi", name: "q4.psi", unit: "u.deg", value: deg(one.psi), digits: 3 },
    { key: "x", symbol: "s.x", name: "q4.xOut", unit: "u.mm", value: one.at[0], digits: 3 },
    { key: "y", symbol: "s.y", name: "q4.yOut", unit: "u.mm", value: one.at[1], digits: 3 },
    { key: "e", symbol: "s.e", name: "q4.eDir", unit: "u.deg", value: deg(turned(Math.atan2(one.e[1], one.e[0]))), digits: 3 },
    { key: "t", symbol: "s.tdir", name: "q4.tDir", unit: "u.deg", value: deg(turned(Math.atan2(one.v[1], one.v[0]))), digits: 3 },
    { key: "least", symbol: "s.Psimin", name: "q4.least", unit: "u.deg", value: Math.min(...exits.map((k) => deg(k.psi))), digits: 3 },
  ];
}

function outline(plane: Plane, edges: Edge[]): string {
  const piece = (edge: Edge) => plane.line(Array.from({ length: edge.centre ? 49 : 2 }, (_, i) => along(edge, i / (edge.centre ? 48 : 1))));
  const joined = (part: Edge[]) => part.map((edge, i) => (i ? piece(edge).replace("M", "L") : piece(edge))).join("") + "Z";
  return LOOPS.map(({ first, count }) => joined(edges.slice(first, first + count))).join("");
}

function draw(c: Drawing) {
  const { v, width } = c;
  const wide = width >= 560;
  const big = wide ? Math.round(width * 0.62) : width - 16;
  const small = wide ? width - big - 28 : Math.min(300, width - 16);
  const plane = new Plane([-112, -64], [66, 64], { left: 8, top: 8, width: big, height: big * 0.86 });
  const inset = { left: wide ? big + 20 : 8, top: wide ? 30 : big * 0.86 + 46, size: small };
  const { edges, all, one } = state(v);
  const place = (t: number): Point => [r * t - CUTTER * Math.sin(t), v.c - CUTTER * Math.cos(t)];
  const first = TURN * v.m;
  const axis: Point = [FEED * v.m, v.c];
  const body = outline(plane, edges);
  const [hx, hy] = plane.at([56 * Math.cos((v.gamma * Math.PI) / 180), 56 * Math.sin((v.gamma * Math.PI) / 180)]);
  const height = wide ? Math.max(big * 0.86 + 40, small + 60) : big * 0.86 + small + 62;
  return {
    height,
    children: (
      <>
        <path d={body} class="body2" fill-rule="evenodd" />
        <path d={body} class="part" />
        <path d={`M${plane.x(-112)} ${plane.at(axis)[1]}H${plane.x(66)}`} class="axis" marker-end="url(#tg-arrow)" />
        <path d={plane.curve(place, first, first + Math.PI, 60)} class="ghost" />
        <path d={plane.curve(place, first + Math.PI, first + TURN, 60)} class="curve" />
        {all.filter((k) => k.front).map((k) => (
          <Cross key={k.t} k={k} plane={plane} limit={v.psi0} chosen={k === one} />
        ))}
        {c.printed && <Misprint plane={plane} edge={edges[0]} />}
        <ScaleBar plane={plane} at={[14, big * 0.86 + 20]} />
        {one && <Inset c={c} k={one} edge={edges[one.edge]} box={inset} scale={plane.scale} />}
        <Handle
          at={plane.at(axis)}
          name={word("f43.axis")}
          value={v.m}
          min={-130}
          max={130}
          told={`${c.text("m")}; ${c.text("c")}`}
          move={(to) => {
            const [x, y] = plane.back(to);
            c.set({ m: x / FEED, c: y });
          }}
          step={(dx, dy) => c.set({ m: v.m + Math.sign(dx) * Math.max(1, Math.abs(dx)) * (dx === 0 ? 0 : 1), c: v.c + dy })}
        />
        <Handle
          at={[hx, hy]}
          name={word("q4.gamma")}
          value={v.gamma}
          min={0}
          max={360}
          told={`γ ${c.text("gamma")}°`}
          move={(to) => {
            const [x, y] = plane.back(to);
            c.set({ gamma: deg(turned(Math.atan2(y, x))) });
          }}
          step={(dx, dy) => c.set({ gamma: (v.gamma + dx + dy + 360) % 360 })}
        />
      </>
    ),
  };
}

/** A place where the tooth enters (open) or leaves (filled; a cross where the burr is primary). */
function Cross({ k, plane, limit, chosen }: { k: Crossing; plane: Plane; limit: number; chosen: boolean }) {
  const [x, y] = plane.at(k.at);
  if (k.psi <= 0) return <circle cx={x} cy={y} r="4" class="entry" />;
  const bad = deg(k.psi) < limit;
  return (
    <g class={bad ? "badExit" : "goodExit"}>
      {bad ? <path d={`M${x - 5} ${y - 5}l10 10M${x - 5} ${y + 5}l10 -10`} /> : <circle cx={x} cy={y} r="4.5" class="dot" />}
      {chosen && <circle cx={x} cy={y} r="10" class="chosen" />}
    </g>
  );
}

/** The line of equation 6 as printed: parallel to its side, and beside it. */
function Misprint({ plane, edge }: { plane: Plane; edge: Edge }) {
  const shift = edge.end[1] - edge.start[1];
  const line = plane.line([
    [edge.start[0], edge.start[1] + shift],
    [edge.end[0], edge.end[1] + shift],
  ]);
  const y = plane.y(edge.end[1] + shift);
  return (
    <g>
      <path d={line} class="wrongline" />
      <Label at={[plane.box.left + plane.box.width, y - 12]} text={word("f43.printed")} class="bad" anchor="end" />
    </g>
  );
}

/** The chosen exit, enlarged. */
function Inset({ c, k, edge, box, scale }: { c: Drawing; k: Crossing; edge: Edge; box: { left: number; top: number; size: number }; scale: number }) {
  const half = 9;
  const plane = new Plane([k.at[0] - half, k.at[1] - half], [k.at[0] + half, k.at[1] + half], { left: box.left, top: box.top, width: box.size, height: box.size });
  const P = plane.at(k.at);
  const arm = (d: Point, length: number): Point => [P[0] + d[0] * length, P[1] - d[1] * length];
  const long = box.size * 0.36;
  const [e, t] = [arm(k.e, long), arm(k.v, long)];
  const arc = long * 0.62;
  const [a, b] = [arm(k.e, arc), arm(k.v, arc)];
  const middle = Math.atan2(k.e[1], k.e[0]) + k.psi / 2;
  const path = (s: number): Point => [r * s - CUTTER * Math.sin(s), c.v.c - CUTTER * Math.cos(s)];
  return (
    <>
      <Label at={[box.left, box.top - 8]} text={word("f43.exit", { n: String(Math.min(c.v.exit, c.rows.get("exits")?.value ?? 1)), k: String(Math.round(plane.scale / scale)) })} />
      <svg x={box.left} y={box.top} width={box.size} height={box.size} viewBox={`${box.left} ${box.top} ${box.size} ${box.size}`}>
        <rect x={box.left + 0.5} y={box.top + 0.5} width={box.size - 1} height={box.size - 1} class="inset" />
        <path d={plane.line(Array.from({ length: 97 }, (_, i) => along(edge, i / 96)))} class="part" />
        <path d={plane.curve(path, k.t - 0.3, k.t + 0.3, 30)} class="thin" />
        <path d={`M${P[0]} ${P[1]}L${e[0]} ${e[1]}`} class="third" marker-end="url(#tg-arrow)" />
        <path d={`M${P[0]} ${P[1]}L${t[0]} ${t[1]}`} class="curve" marker-end="url(#tg-arrow)" />
        <path d={`M${a[0]} ${a[1]}A${arc} ${arc} 0 0 0 ${b[0]} ${b[1]}`} marker-end="url(#tg-arrow)" />
        <Label at={[e[0] + 6, e[1] + (k.e[1] > 0 ? -4 : 14)]} symbol="s.e" />
        <Label at={[t[0] + 6, t[1] + (k.v[1] > 0 ? -4 : 14)]} symbol="s.tdir" />
        <Label at={[P[0] + Math.cos(middle) * arc * 0.62, P[1] - Math.sin(middle) * arc * 0.62 + 4]} symbol="s.Psi" anchor="middle" />
        <Label at={[box.left + 10, box.top + 20]} symbol="s.Psi" row="psi" c={c} />
      </svg>
    </>
  );
}

export const fig43: Figure = {
  id: "4.3",
  words: "f43",
  after: "3",
  fields: [
    { key: "gamma", symbol: "s.gamma", name: "q4.gamma", unit: "u.deg", min: 0, max: 360, step: 1, digits: 3 },
    { key: "c", symbol: "s.c", name: "q4.c", unit: "u.mm", min: -60, max: 60, step: 0.5, digits: 3 },
    { key: "m", symbol: "s.m", name: "q4.m", min: -130, max: 130, step: 1, digits: 0 },
    { key: "psi0", symbol: "s.Psi0", name: "q4.psi0", unit: "u.deg", min: 1, max: 179, step: 1, digits: 1 },
    { key: "exit", symbol: "s.i", name: "q4.exit", min: 1, max: 12, step: 1, digits: 0 },
  ],
  start: { gamma: Number(LEAST.placement.turn.toFixed(3)), c: Number(LEAST.placement.offset.toFixed(3)), m: -50, psi0: 90, exit: 1 },
  mistake: true,
  wrong: (v) => (state(v).exits.length === 0 ? "f43.none" : null),
  warns: (v) => (isWide(lengths(v.gamma, v.c, v.psi0, 72).reach) ? "f45.wide" : null),
  rows,
  draw,
  toml: (v) => `placement = { angle = ${tomlNumber(v.gamma)}, offset = ${tomlNumber(v.c)} }`,
};
