// Figure 1: a housing with bores, and for each of them the time of milling and of drilling.
import type { DrillSheet } from "../../base/drillsheet";
import { Told, type Question } from "../asked";
import { type Key, num, word } from "../language";
import { Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";
import { Eye, pathOf } from "../paper3/solid";

const n = (x: number) => tomlNumber(x, 4);
const rad = (x: number) => (x * Math.PI) / 180;

/** The housing, and the places of its bores in its top face [mm]. */
const SIZE = { x: 240, y: 130, z: 50 };
const PLACES: Point[] = [
  [62, 65],
  [140, 78],
  [196, 40],
  [204, 100],
];
const BLIND = 2;

interface Bore {
  at: Point;
  diameter: number;
  depth: number;
  through: boolean;
}

function boresOf(v: Values): Bore[] {
  return PLACES.map((at, i) => ({ at, diameter: v[`D${i + 1}`], depth: i === BLIND ? v.depth : SIZE.z, through: i !== BLIND }));
}

function millToml({ diameter, depth }: Bore, d: number): string {
  return `tool = { number = 1, name = "Cutter", type = "end-mill", diameter = ${n(d)}, flute_length = ${n(SIZE.z + 15)}, teeth = 4, centre_cutting = true, max_ramp_angle = 5 }
dynamics = { rapid = 60000, acceleration = 5, jerk = 100 }
post = { control = "sinumerik-840d", decimals = 4 }

[operation]
type = "bore"
tool = 1
at = [0, 0]
diameter = ${n(diameter)}
depth = ${n(depth)}
strategy = "involute"
speed = 2400
rough = { stepover = 4, allowance = 1, feed = 6000 }
finish = { turns = 2, feed = 3000 }
`;
}

function drillToml({ diameter, depth, through }: Bore): string {
  return `[tool]
number = 1
type = "drill"
diameter = ${n(diameter)}
point = { twist = { point_angle = 118 } }
flute_length = ${n(SIZE.z + diameter + 60)}

[operation]
type = "drill"
tool = 1
entry = { surface = "plane" }
${through ? `exit = { surface = "plane" }\nlength = ${n(depth)}\noverrun = 2` : `depth = ${n(depth)}`}
approach = 2
cutting_speed = 25
feed_per_rev = { entry = 0.2, steady = 0.3, exit = 0.2 }
`;
}

interface Milled {
  time: number;
  length: number;
  turns: number;
}

function keepMilled(answer: { feed_time?: number; feed_length: number; passes: { pass: string; turns: number }[] }): Milled {
  if (answer.feed_time === undefined) throw new Told(JSON.stringify(answer));
  return { time: answer.feed_time, length: answer.feed_length, turns: answer.passes.find((p) => p.pass === "rough")?.turns ?? 0 };
}

function keepDrilled(sheet: DrillSheet): number {
  const [hole] = sheet.holes ?? [];
  if (!hole || "error" in hole) throw new Told(hole && "error" in hole ? `${hole.error.code}: ${hole.error.message}` : JSON.stringify(sheet));
  return hole.time;
}

function asking(bore: Bore, d: number): Question[] {
  return [
    { verb: "hole", text: millToml(bore, d), as: "milled", keep: keepMilled, refused: () => null },
    { verb: "drill", text: drillToml(bore), as: "drilled", keep: keepDrilled, refused: () => null },
  ];
}

function answersOf(data: unknown[], i: number): { milled: Milled | null; drilled: number | null } {
  return { milled: data[2 * i] as Milled | null, drilled: data[2 * i + 1] as number | null };
}

function rows(v: Values, data: unknown[]): Row[] {
  const found: Row[] = [];
  boresOf(v).forEach((_, i) => {
    const { milled, drilled } = answersOf(data, i);
    if (milled) found.push({ key: `m${i + 1}`, symbol: `s.tm${i + 1}` as Key, name: "q1.milled", unit: "u.s", value: milled.time, digits: 2 });
    if (drilled !== null) found.push({ key: `d${i + 1}`, symbol: `s.td${i + 1}` as Key, name: "q1.drilled", unit: "u.s", value: drilled, digits: 2 });
  });
  const { milled } = answersOf(data, v.pick);
  if (milled) found.push({ key: "turns", symbol: "s.n", name: "q1.turns", value: milled.turns, digits: 2, trim: true }, { key: "length", symbol: "s.L", name: "q1.feedLength", unit: "u.mm", value: milled.length, digits: 1 });
  return found;
}

function draw(c: Drawing) {
  const { v, width } = c;
  const tall = Math.min(360, width * 0.62);
  const half: [number, number] = [SIZE.x / 2, SIZE.y / 2];
  const eye = new Eye(v.view, 34, [-150, -86], [150, 92], { left: 8, top: 30, width: width - 16, height: tall });
  const at = (x: number, y: number, z: number) => eye.at([x - half[0], y - half[1], z]);
  const box = [
    [0, 0],
    [SIZE.x, 0],
    [SIZE.x, SIZE.y],
    [0, SIZE.y],
  ] as Point[];
  // A side is seen whose outward normal points to the eye.
  const sides = box.map((p, i) => [p, box[(i + 1) % 4]] as const).filter(([p, q]) => (q[1] - p[1]) * eye.to[0] - (q[0] - p[0]) * eye.to[1] > 0);
  const circle = ({ at: [x, y], diameter }: Bore, z: number) => pathOf(Array.from({ length: 49 }, (_, i) => at(x + (diameter / 2) * Math.cos((i * Math.PI) / 24), y + (diameter / 2) * Math.sin((i * Math.PI) / 24), z)), true);
  const bores = boresOf(v);
  const section: Box = { left: 16, top: tall + 92, width: width - 32, height: 120 };
  const lines = 26;
  const table = section.top + section.height + 44;
  const columns = [12, Math.max(106, width * 0.22), Math.min(240, width * 0.48), Math.min(390, width * 0.72)];
  const handle = at(SIZE.x, 0, 0);
  return {
    height: table + lines * (bores.length + 1) + 10,
    children: (
      <>
        <Label at={[8, 18]} text={word("f11.part")} />
        {sides.map(([p, q], i) => (
          <path key={i} d={pathOf([at(...p, 0), at(...q, 0), at(...q, -SIZE.z), at(...p, -SIZE.z)], true)} class="side" />
        ))}
        <path d={pathOf(box.map((p) => at(...p, 0)), true)} class="top" />
        {bores.map((bore, i) => (
          <g key={i} class={i === v.pick ? "bore on" : "bore"}>
            <path d={circle(bore, 0)} class="opening" />
            {bore.through ? null : <path d={circle(bore, -bore.depth)} class="floor" clip-path={`url(#tg-f11-${i})`} />}
            <path d={circle(bore, -bore.depth)} class="dashed" />
            {[90, -90].map((turn) => {
              const t = rad(eye.azimuth + turn);
              const [x, y] = [bore.at[0] + (bore.diameter / 2) * Math.cos(t), bore.at[1] + (bore.diameter / 2) * Math.sin(t)];
              return <path key={turn} d={pathOf([at(x, y, 0), at(x, y, -bore.depth)])} class="dashed" />;
            })}
            <clipPath id={`tg-f11-${i}`}>
              <path d={circle(bore, 0)} />
            </clipPath>
            <Number c={c} i={i} at={at(bore.at[0], bore.at[1], 0)} up={at(bore.at[0], bore.at[1], 34)} />
          </g>
        ))}
        <ScaleBar plane={eye.plane} at={[14, tall + 44]} />
        <Section bore={bores[v.pick]} number={v.pick + 1} box={section} />
        {[word("f11.bore"), word("f11.diameter"), word("f11.milled"), word("f11.drilled")].map((text, i) => (
          <Label key={text} at={[columns[i], table]} text={text} />
        ))}
        {bores.map((bore, i) => {
          const { milled, drilled } = answersOf(c.data, i);
          const y = table + lines * (i + 1);
          return (
            <g key={i} class={i === v.pick ? "line on" : "line"}>
              <path d={`M12 ${y - 17}H${width - 12}`} class="grid" />
              <Label at={[columns[0], y]} text={`${i + 1} ${word(bore.through ? "f11.through" : "f11.blind")}`} class={i === v.pick ? "strong" : ""} />
              <Label at={[columns[1], y]} text={`⌀ ${num(bore.diameter, 2, true)}`} />
              {milled ? <Label at={[columns[2], y]} row={`m${i + 1}`} c={c} /> : <Label at={[columns[2], y]} text={word("f11.no")} />}
              {drilled !== null ? <Label at={[columns[3], y]} row={`d${i + 1}`} c={c} /> : <Label at={[columns[3], y]} text={word("f11.no")} />}
            </g>
          );
        })}
        <Handle at={handle} name={word("f11.view")} value={v.view} min={-80} max={-10} told={`${v.view}°`} move={(to) => c.set({ view: v.view + (to[0] - handle[0]) / 4 })} step={(dx, dy) => c.set({ view: c.now().view + 2 * (dx + dy) })} />
      </>
    ),
  };
}

/** The number of a bore, by which it is chosen. */
function Number({ c, i, at, up }: { c: Drawing; i: number; at: Point; up: Point }) {
  const press = () => c.set({ pick: i });
  return (
    <g
      class="press"
      role="button"
      tabindex={0}
      aria-pressed={i === c.v.pick}
      aria-label={word("f11.choose", { n: String(i + 1) })}
      data-press={`bore${i + 1}`}
      onClick={press}
      onKeyDown={(e: KeyboardEvent) => {
        if (e.key !== "Enter" && e.key !== " ") return;
        e.preventDefault();
        press();
      }}
    >
      <path d={pathOf([at, up])} />
      <rect x={up[0] - 14} y={up[1] - 14} width="28" height="28" rx="14" class={i === c.v.pick ? "box on" : "box"} />
      <text x={up[0]} y={up[1] + 5} text-anchor="middle">
        {i + 1}
      </text>
    </g>
  );
}

/** The bore that is chosen, cut through its axis. */
function Section({ bore, number, box }: { bore: Bore; number: number; box: Box }) {
  const r = bore.diameter / 2;
  const plane = new Plane([-90, -SIZE.z - 4], [90, 12], box);
  const wall: Point[] = bore.through
    ? []
    : [
        [-r, 0],
        [-r, -bore.depth],
        [r, -bore.depth],
        [r, 0],
      ];
  const part = (from: number, to: number): Point[] => [[from, 0], [to, 0], [to, -SIZE.z], [from, -SIZE.z]];
  return (
    <g data-section={bore.through ? "through" : "blind"}>
      <Label at={[8, box.top - 12]} text={word("f11.section", { n: String(number) })} />
      {bore.through ? (
        <>
          <path d={plane.line(part(-85, -r), true)} class="hatched" />
          <path d={plane.line(part(r, 85), true)} class="hatched" />
          {[-r, r].map((u) => (
            <path key={u} d={`M${plane.x(u)} ${plane.y(0)}V${plane.y(-SIZE.z)}`} class="part" />
          ))}
          <path d={`M${plane.x(-r)} ${plane.y(-SIZE.z)}H${plane.x(r)}`} class="netline" />
        </>
      ) : (
        <>
          <path d={plane.line([[-85, 0], ...wall, [85, 0], [85, -SIZE.z], [-85, -SIZE.z]], true)} class="hatched" />
          <path d={plane.line(wall)} class="part" />
        </>
      )}
      <path d={`M${plane.x(-85)} ${plane.y(0)}H${plane.x(-r)}M${plane.x(r)} ${plane.y(0)}H${plane.x(85)}M${plane.x(-85)} ${plane.y(-SIZE.z)}H${plane.x(bore.through ? -r : 85)}M${plane.x(r)} ${plane.y(-SIZE.z)}H${plane.x(85)}`} class="part" />
      <path d={`M${plane.x(0)} ${plane.y(11)}V${plane.y(-SIZE.z - 3)}`} class="axis" />
    </g>
  );
}

const diameter = (i: number, max: number, saved: number[]) => ({ key: `D${i}`, symbol: `s.bore${i}` as Key, name: (i === BLIND + 1 ? "q1.boreBlind" : "q1.bore") as Key, unit: "u.mm" as Key, min: 4, max, step: 1, digits: 2, saved });

export const fig11: Figure = {
  id: "1.1",
  words: "f11",
  after: "1",
  fields: [
    diameter(1, 96, [60, 70, 90, 96]),
    diameter(2, 60, [35, 40, 45, 60]),
    diameter(3, 50, [24, 26, 28, 36, 40]),
    diameter(4, 50, [8, 12, 20, 22, 24, 30]),
    { key: "depth", symbol: "s.hBore", name: "q1.depthBlind", unit: "u.mm", min: 2, max: 45, step: 1, digits: 1, saved: [10, 15, 20, 30, 35] },
    { key: "d", symbol: "s.d", name: "q.d", unit: "u.mm", min: 4, max: 50, step: 1, digits: 2, saved: [10, 12, 16, 25, 32] },
    { key: "pick", symbol: "s.n", name: "f11.pick", min: 0, max: 3, step: 1, digits: 0, options: ["f11.bore1", "f11.bore2", "f11.bore3", "f11.bore4"], free: true },
    { key: "view", symbol: "s.view", name: "q3.view", unit: "u.deg", min: -80, max: -10, step: 5, digits: 0, free: true },
  ],
  start: { D1: 80, D2: 50, D3: 32, D4: 16, depth: 25, d: 20, pick: 0, view: -55 },
  asks: (v) => boresOf(v).flatMap((bore) => asking(bore, v.d)),
  more: (v) => ({ n: String(v.pick + 1), kind: word(v.pick === BLIND ? "f11.blind" : "f11.through"), size: num(v[`D${v.pick + 1}`], 2, true) }),
  rows,
  draw,
  toml: (v) => millToml(boresOf(v)[v.pick], v.d),
};
