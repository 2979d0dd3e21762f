// Figure 2: a cutter opens a bore. Plan and half section at one moment, and the load along the way.
import { num, word } from "../language";
import { Axes, Handle, Label, ScaleBar } from "../marks";
import type { Drawing, Figure, Point, Row, Values } from "../model";
import { type Box, Plane } from "../plane";
import { type Way, askWay, boreToml, loadAt, placeAt } from "./bored";

const deg = (n: number) => (n * 180) / Math.PI;

function gone(v: Values, way: Way): number {
  return Math.min(way.length, Math.max(0, v.s));
}

function rows(v: Values, data: unknown[]): Row[] {
  const way = data[0] as Way;
  const s = gone(v, way);
  const load = loadAt(way, s);
  return [
    { key: "R", symbol: "s.R", name: "q.R", unit: "u.mm", value: way.radius, digits: 3 },
    { key: "n", symbol: "s.n", name: "q.n", value: way.turns, digits: 2, trim: true },
    { key: "step", symbol: "s.H", name: "q.H", unit: "u.mm", value: way.step, digits: 4 },
    { key: "L", symbol: "s.L", name: "q.Lspiral", unit: "u.mm", value: way.spiral, digits: 3 },
    { key: "all", symbol: "s.Lw", name: "q1.all", unit: "u.mm", value: way.length, digits: 2 },
    { key: "way", symbol: "s.s", name: "q1.way", unit: "u.mm", value: s, digits: 2 },
    { key: "time", symbol: "s.t", name: "q1.time", unit: "u.s", value: load.time, digits: 3 },
    { key: "speed", symbol: "s.vF", name: "q1.speed", unit: "u.mmSecond", value: load.speed, digits: 2 },
    ...(load.engagement === null ? [] : [{ key: "angle", symbol: "s.angle", name: "q.angle", unit: "u.deg", value: deg(load.engagement), digits: 1 } as Row]),
    ...(way.peak === null ? [] : [{ key: "peak", symbol: "s.anglePeak", name: "q1.peak", unit: "u.deg", value: deg(way.peak), digits: 1 } as Row]),
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const way = c.data[0] as Way;
  const s = gone(v, way);
  const { at, along } = placeAt(way, s);
  const R = v.D / 2;
  const r = v.d / 2;
  const size = Math.min(width - 16, 430);
  const plan = new Plane([-1.12 * R, -1.12 * R], [1.12 * R, 1.12 * R], { left: (width - size) / 2, top: 24, width: size, height: size });
  const path = (from: number, to: number): string => {
    const inner = way.way.filter((p) => p[0] > from && p[0] < to).map((p): Point => [p[1], p[2]]);
    return plan.line([placeAt(way, from).at, ...inner, placeAt(way, to).at]);
  };
  const load = loadAt(way, s);
  const side = way.clockwise ? -1 : 1;
  // The engaged arc goes from the wall that is left behind, beside the cutter, to the front.
  const out = Math.atan2(along[1], along[0]) - (side * Math.PI) / 2;
  const arc = (turn: number): Point => plan.at([at[0] + r * Math.cos(out + side * turn), at[1] + r * Math.sin(out + side * turn)]);
  const sector = load.engagement === null ? "" : `M${plan.at(at).join(" ")}L${Array.from({ length: 25 }, (_, i) => arc(((load.engagement ?? 0) * i) / 24).join(" ")).join("L")}Z`;
  const tip = plan.at([at[0] + 1.5 * r * along[0], at[1] + 1.5 * r * along[1]]);
  const spin = Array.from({ length: 13 }, (_, i) => plan.at([at[0] + 0.55 * r * Math.cos(2.6 - i * 0.24), at[1] + 0.55 * r * Math.sin(2.6 - i * 0.24)]).join(" ")).join("L");
  const section: Box = { left: 16, top: size + 62, width: width - 32, height: 110 };
  const chart: Box = { left: 56, top: size + 230, width: width - 84, height: 120 };
  const samples = way.samples.filter((row) => row[3] !== null);
  return {
    height: size + 404,
    children: (
      <>
        <circle cx={plan.x(0)} cy={plan.y(0)} r={1.12 * R * plan.scale} class="body2" />
        <circle cx={plan.x(0)} cy={plan.y(0)} r={R * plan.scale} class="part" />
        {way.entry > 0 && <circle cx={plan.x(0)} cy={plan.y(0)} r={(way.entry + r) * plan.scale} class="removed" />}
        <path d={path(0, s)} class="cleared" style={{ strokeWidth: `${v.d * plan.scale}px` }} />
        <path d={path(0, s)} class="thin" />
        <path d={path(s, way.length)} class="ghost" />
        <circle cx={plan.at(at)[0]} cy={plan.at(at)[1]} r={r * plan.scale} class="cutter" />
        {sector && <path d={sector} class="load" />}
        <path d={`M${plan.at(at).join(" ")}L${tip.join(" ")}`} class="speed" marker-end="url(#tg-arrow)" />
        <path d={`M${spin}`} marker-end="url(#tg-arrow)" />
        <Label at={[8, 16]} text={word("f12.plan")} />
        <ScaleBar plane={plan} at={[14, size + 30]} />
        <Section c={c} way={way} at={at} s={s} box={section} />
        <Axes box={chart} x={[0, way.length]} y={[0, 200]} xName={word("f12.way")} yName={word("f16.engagement")}>
          {(a) => (
            <>
              <path d={samples.map((row, i) => `${i && row[0] - samples[i - 1][0] < way.length / 20 ? "L" : "M"}${a.x(row[0]).toFixed(1)} ${a.y(deg(row[3] as number)).toFixed(1)}`).join("")} class="curve" />
              <path d={`M${a.x(s)} ${chart.top}V${chart.top + chart.height}`} class="dashed" />
              <Handle
                at={[a.x(s), a.y(load.engagement === null ? 0 : deg(load.engagement))]}
                name={word("f12.handle")}
                value={Number(s.toFixed(1))}
                min={0}
                max={Math.ceil(way.length)}
                told={`${num(s, 1)} ${word("u.mm")}, ${c.text("angle")}`}
                move={(to) => c.set({ s: ((to[0] - chart.left) / chart.width) * way.length })}
                step={(dx, dy) => c.set({ s: gone(c.now(), way) + 10 * (dx + dy) })}
              />
            </>
          )}
        </Axes>
        <Handle
          at={plan.at(at)}
          name={word("f16.cutter")}
          value={Number(s.toFixed(1))}
          min={0}
          max={Math.ceil(way.length)}
          told={`${num(s, 1)} ${word("u.mm")}, ${c.text("angle")}`}
          move={(to) => {
            // The nearest place of the way that is not far from where the cutter is along it.
            const [x, y] = plan.back(to);
            const turn = Math.max(60, 2 * Math.PI * Math.hypot(...at));
            const near = way.way.filter((p) => Math.abs(p[0] - s) < 0.75 * turn);
            if (near.length) c.set({ s: near.reduce((a, b) => (Math.hypot(b[1] - x, b[2] - y) < Math.hypot(a[1] - x, a[2] - y) ? b : a))[0] });
          }}
          step={(dx, dy) => c.set({ s: gone(c.now(), way) + 10 * (dx + dy) })}
        />
      </>
    ),
  };
}

/** The stock through the middle of the bore and the cutter: what is removed on both sides. */
function Section({ c, way, at, s, box }: { c: Drawing; way: Way; at: Point; s: number; box: Box }) {
  const { v } = c;
  const [R, r] = [v.D / 2, v.d / 2];
  const distance = Math.hypot(...at);
  const along: Point = distance > 1e-6 ? [at[0] / distance, at[1] / distance] : [1, 0];
  // Both ends of what the cutter has swept on the line of the section.
  let [low, high] = way.entry > 0 ? [-way.entry - r, way.entry + r] : [-r, r];
  for (const [gone, x, y] of [...way.way.filter((p) => p[0] <= s), [s, ...at] as [number, number, number]]) {
    if (gone > s) break;
    const [u, w] = [x * along[0] + y * along[1], -x * along[1] + y * along[0]];
    if (Math.abs(w) > r) continue;
    const half = Math.sqrt(r * r - w * w);
    [low, high] = [Math.min(low, u - half), Math.max(high, u + half)];
  }
  const floor = way.floors[way.floors.length - 1];
  const plane = new Plane([-1.12 * R, floor * 1.25], [1.12 * R, -floor * 0.5], box);
  const body: Point[] = [[-1.12 * R, 0], [low, 0], [low, floor], [high, floor], [high, 0], [1.12 * R, 0], [1.12 * R, floor * 1.2], [-1.12 * R, floor * 1.2]];
  return (
    <g data-removed={`${low.toFixed(2)} ${high.toFixed(2)}`}>
      <Label at={[8, box.top - 8]} text={word("f12.section")} />
      <path d={plane.line(body, true)} class="hatched" />
      <path d={plane.line([[-1.12 * R, 0], [low, 0], [low, floor], [high, floor], [high, 0], [1.12 * R, 0]])} class="part" />
      {[-R, R].map((u) => (
        <path key={u} d={`M${plane.x(u)} ${plane.y(0)}V${plane.y(floor)}`} class="dashed" />
      ))}
      <path d={plane.line([[distance - r, -floor * 0.45], [distance - r, floor], [distance + r, floor], [distance + r, -floor * 0.45]])} class="cutter" />
      <path d={`M${plane.x(0)} ${plane.y(-floor * 0.4)}V${plane.y(floor * 1.2)}`} class="axis" />
    </g>
  );
}

export const fig12: Figure = {
  id: "1.2",
  words: "f12",
  after: "2",
  fields: [
    { key: "s", symbol: "s.s", name: "q1.way", unit: "u.mm", min: 0, max: 100000, step: 10, digits: 2, free: true },
    { key: "D", symbol: "s.D", name: "q.D", unit: "u.mm", min: 20, max: 500, step: 5, digits: 2, saved: [120, 150, 180, 250] },
    { key: "d", symbol: "s.d", name: "q.d", unit: "u.mm", min: 4, max: 100, step: 1, digits: 2, saved: [25, 32, 50, 63] },
    { key: "H", symbol: "s.Hz", name: "q.Hz", unit: "u.mm", min: 0.5, max: 30, step: 0.5, digits: 2, saved: [2, 6, 8, 12] },
    { key: "delta", symbol: "s.delta", name: "q.delta", unit: "u.mm", min: 0, max: 5, step: 0.25, digits: 2, saved: [0, 0.5, 2] },
    { key: "depth", symbol: "s.hBore", name: "q1.depth", unit: "u.mm", min: 2, max: 60, step: 1, digits: 1, saved: [15] },
    { key: "limit", symbol: "s.angleMax", name: "q1.limit", unit: "u.deg", min: 20, max: 150, step: 5, digits: 1, saved: [45, 90], counts: (v) => v.strategy === 3 },
    { key: "strategy", symbol: "s.r", name: "f16.strategy", min: 0, max: 3, step: 1, digits: 0, options: ["f16.involute", "f16.lens", "f16.archimedes", "f12.constant"] },
    { key: "entry", symbol: "s.r", name: "f12.entry", min: 0, max: 1, step: 1, digits: 0, options: ["f12.plunge", "f12.helix"] },
  ],
  start: { s: 900, D: 200, d: 40, H: 4, delta: 1, depth: 30, limit: 60, strategy: 0, entry: 0 },
  // A path of constant engagement begins on a circle.
  series: (v) => [{ strategy: 3, entry: 1 }, ...[0, 1, 2].map((strategy) => ({ ...v, strategy, entry: 1 }))],
  asks: (v) => [askWay(v)],
  more: (v, data) => ({ unloaded: loadAt(data[0] as Way, gone(v, data[0] as Way)).engagement === null ? word("f12.unloaded") : "", direction: (data[0] as Way).clockwise ? "" : word("f12.climb") }),
  rows,
  draw,
  toml: boreToml,
};
