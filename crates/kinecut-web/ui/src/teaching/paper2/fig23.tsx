// Figure 3: points of drills in one scale, each with its length and its first contact on an inclined face.
import type { DrillSheet } from "../../base/drillsheet";
import { POINTS as KINDS, type PointKind, heightOf, lipOf, outline, silhouette } from "../../windows/drill/points";
import { Told, type Question } from "../asked";
import { type Key, num, word } from "../language";
import { Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";

const n = (x: number) => tomlNumber(x, 4);

/** The eight of the paper in its order, then the others that kinecut knows. */
const PAPER: PointKind[] = ["twist", "double-ground", "rounded-lips", "cast-iron", "slotted-chisel", "thinned-web", "gun", "annular"];
const OTHERS = KINDS.filter((k) => !PAPER.includes(k));
const ALL = [...PAPER, ...OTHERS];
/** Lengths that differ by less are the same on the drawing [mm]. */
const SAME = 1e-3;

/** Numbers of a point of the figure; those of the others are shares of the diameter. */
function numbersOf(kind: PointKind, v: Values): Record<string, unknown> {
  const share = (k: number) => Number((k * v.D).toPrecision(4));
  switch (kind) {
    case "double-ground":
      return { point_angle: v.point, second_angle: v.second };
    case "rounded-lips":
      return { lip_radius: v.rho };
    case "cast-iron":
      return { point_angle: v.point, second_angle: v.second, third_angle: v.third, slot: v.l };
    case "slotted-chisel":
      return { point_angle: v.point, slot: v.b };
    case "thinned-web":
      return { point_angle: v.point, flat: v.b };
    case "gun":
      return { apex: v.e };
    case "annular":
      return { core_diameter: share(0.6) };
    case "flat":
      return {};
    case "corner-radius":
      return { point_angle: v.point, corner_radius: share(0.1) };
    case "cannon":
      return { overlap: share(0.05), edge_angle: 70 };
    case "cone":
      return { cone_angle: 90 };
    case "centre":
      return { pilot_diameter: share(0.3), pilot_length: share(0.4), point_angle: 120, cone_angle: 60 };
    case "stepped":
      return { point_angle: v.point, stages: [{ diameter: share(0.6), length: share(0.8), shoulder_angle: 90 }] };
    default:
      return { point_angle: v.point };
  }
}

function toml(value: unknown): string {
  if (typeof value === "number") return n(value);
  if (Array.isArray(value)) return `[${value.map(toml).join(", ")}]`;
  return `{ ${Object.entries(value as object).map(([key, one]) => `${key} = ${toml(one)}`).join(", ")} }`;
}

function drillToml(kind: PointKind, v: Values): string {
  const point = kind === "flat" ? '"flat"' : `{ ${kind} = ${toml(numbersOf(kind, v))} }`;
  return `[tool]
number = 1
type = "drill"
diameter = ${n(v.D)}
point = ${point}
flute_length = 400

[operation]
type = "drill"
tool = 1
entry = { surface = "plane"${v.alpha === 0 ? "" : `, inclination = ${n(v.alpha)}`} }
exit = { surface = "plane" }
length = 50
approach = 2
overrun = 2
cutting_speed = 25
feed_per_rev = { entry = 0.6, steady = 0.8, exit = 0.2 }
`;
}

interface Pointed {
  L1: number;
  radius: number;
  printed: number | null;
}

function keep(sheet: DrillSheet): Pointed {
  const [hole] = sheet.holes ?? [];
  if (!hole) throw new Told(JSON.stringify(sheet));
  if ("error" in hole) throw new Told(`${hole.error.code}: ${hole.error.message}`);
  return { L1: hole.lengths.L_vr1, radius: hole.first_contact_radius, printed: hole.paper?.L_vr1_as_printed ?? null };
}

function asking(kind: PointKind, v: Values): Question {
  return { verb: "drill", flags: { paper: true }, text: drillToml(kind, v), as: "point", keep, refused: () => null, later: !PAPER.includes(kind) };
}

const MINE: Key[] = PAPER.map((_, i) => `f23.kind${i}` as Key);

function rows(v: Values, data: unknown[]): Row[] {
  const found: Row[] = [];
  PAPER.forEach((_, i) => {
    const one = data[i] as Pointed | null;
    if (one) found.push({ key: `L${i}`, symbol: "s.Lvr1", name: MINE[i], unit: "u.mm", value: one.L1, digits: 3, ...(one.printed !== null && { printed: one.printed }) });
  });
  PAPER.forEach((_, i) => {
    const one = data[i] as Pointed | null;
    if (one) found.push({ key: `r${i}`, symbol: "s.rFirst", name: MINE[i], unit: "u.mm", value: one.radius, digits: 3 });
  });
  found.push({ key: "limit", symbol: "s.alphaMax", name: "q2.limit", unit: "u.deg", value: 90 - v.point / 2, digits: 2 });
  return found;
}

function draw(c: Drawing) {
  const { width } = c;
  const columns = width >= 560 ? 4 : 2;
  const each = (width - 16 - 10 * (columns - 1)) / columns;
  const size = 112;
  const big: Box = { left: 8, top: 30, width: width - 16, height: 210 };
  const top = big.top + big.height + 52;
  const place = (i: number): Box => ({ left: 8 + (i % columns) * (each + 10), top: top + Math.floor(i / columns) * (size + 62), width: each, height: size });
  const gap = top + Math.ceil(PAPER.length / columns) * (size + 62) + 12;
  const others = (i: number): Box => ({ left: 8 + (i % columns) * (each + 10), top: gap + Math.floor(i / columns) * (size + 46), width: each, height: size });
  return {
    height: gap + Math.ceil(OTHERS.length / columns) * (size + 46),
    children: (
      <>
        <Mine c={c} box={big} />
        {PAPER.map((kind, i) => (
          <Tile key={kind} c={c} index={i} kind={kind} box={place(i)} />
        ))}
        <Label at={[8, gap - 12]} text={word("f23.others")} />
        {OTHERS.map((kind, i) => (
          <Tile key={kind} c={c} index={PAPER.length + i} kind={kind} box={others(i)} />
        ))}
      </>
    ),
  };
}

/** The outline of a point, where it has the length that kinecut gives. */
function shape(kind: PointKind, v: Values, one: Pointed | null | undefined): Point[] | null {
  const half = outline({ kind, numbers: numbersOf(kind, v) }, v.D) as Point[] | null;
  return half && one && Math.abs(heightOf(half as [number, number][]) - one.L1) < SAME ? half : null;
}

function Shape({ kind, v, half, plane, up }: { kind: PointKind; v: Values; half: Point[]; plane: Plane; up: number }) {
  const rings = silhouette(kind, half as [number, number][], up) as Point[][];
  const lip = lipOf({ kind, numbers: numbersOf(kind, v) }, v.D, up) as Point[] | null;
  const low = half.filter(([, z]) => z < SAME);
  const off = low.length > 0 && low[0][0] > SAME;
  return (
    <>
      {lip ? <path d={plane.line(lip, true)} class="cutter" /> : rings.map((ring, i) => <path key={i} d={plane.line(ring, true)} class="cutter" />)}
      <path d={plane.line(half)} class="part" />
      <path d={`M${plane.x(0)} ${plane.box.top}V${plane.box.top + plane.box.height}`} class="axis" />
      {off && <circle cx={plane.x(low[0][0])} cy={plane.y(0)} r="4" class="dot" />}
    </>
  );
}

function Tile({ c, index, kind, box }: { c: Drawing; index: number; kind: PointKind; box: Box }) {
  const { v } = c;
  const one = c.data[index] as Pointed | null | undefined;
  const half = shape(kind, v, one);
  const plane = new Plane([-0.62 * v.D, -0.12 * v.D], [0.62 * v.D, 1.1 * v.D], box);
  const isPaper = index < PAPER.length;
  const middle = box.left + box.width / 2;
  const below = box.top + box.height;
  return (
    <g data-point={kind}>
      {isPaper && index === v.form && <rect x={box.left} y={box.top - 4} width={box.width} height={box.height + 54} class="box on" />}
      {half && <Shape kind={kind} v={v} half={half} plane={plane} up={1.05 * v.D} />}
      {!half && <Label at={[middle, box.top + 60]} text={one === undefined ? "…" : "–"} anchor="middle" />}
      <Label at={[middle, below + 14]} text={word((isPaper ? `f23.name${index}` : `f23.other.${kind}`) as Key)} anchor="middle" />
      {isPaper ? (
        <>
          {c.printed && c.rows.get(`L${index}`)?.printed !== undefined ? (
            <Label at={[middle, below + 30]} symbol="s.Lvr1" text={c.text(`L${index}Printed`)} class="bad" anchor="middle" />
          ) : (
            <Label at={[middle, below + 30]} symbol="s.Lvr1" row={`L${index}`} c={c} anchor="middle" />
          )}
          <Label at={[middle, below + 46]} symbol="s.rFirst" row={`r${index}`} c={c} anchor="middle" />
        </>
      ) : (
        <Label at={[middle, below + 30]} symbol="s.Lvr1" text={one ? num(one.L1, 3) : "–"} anchor="middle" />
      )}
    </g>
  );
}

/** The point that is chosen, with handles on its corner, its lip and its second corner, over the inclined face. */
function Mine({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const kind = PAPER[v.form];
  const one = c.data[v.form] as Pointed | null;
  const half = shape(kind, v, one);
  const R = v.D / 2;
  const plane = new Plane([-1.3 * v.D, -0.25 * v.D], [1.3 * v.D, 0.8 * v.D], box);
  const slope = Math.tan((v.alpha * Math.PI) / 180);
  // The face touches the point where the answer has the first contact: at its radius, on the side that is higher.
  const touch = half && one ? heightAt(half, one.radius) - one.radius * Math.abs(slope) : 0;
  const face = (u: number): Point => [u, touch + u * slope];
  const corner: Point = half ? half[half.length - 1] : [R, 0.6 * R];
  const lip: Point | null = half && kind !== "annular" && kind !== "gun" && kind !== "rounded-lips" ? [(half[0][0] + half[1][0]) / 2, (half[0][1] + half[1][1]) / 2] : null;
  const kink: Point | null = half && (kind === "double-ground" || kind === "cast-iron") ? half[1] : null;
  const apex: Point | null = half && kind === "gun" ? half[1] : null;
  return (
    <>
      <Label at={[box.left + 4, box.top - 12]} text={word("f23.mine", { name: word(`f23.name${v.form}` as Key) })} />
      <clipPath id="tg-f23">
        <rect x={box.left} y={box.top} width={box.width} height={box.height} />
      </clipPath>
      <g clip-path="url(#tg-f23)">
        {half && <path d={plane.line([face(-1.3 * v.D), face(1.3 * v.D), [1.3 * v.D, -v.D], [-1.3 * v.D, -v.D]], true)} class="hatched" />}
        {half && <path d={plane.line([face(-1.3 * v.D), face(1.3 * v.D)])} class="part" />}
        {half && <Shape kind={kind} v={v} half={half} plane={plane} up={v.D} />}
      </g>
      <ScaleBar plane={plane} at={[14, box.top + box.height + 18]} />
      <Handle at={plane.at(corner)} name={word("q2.D")} value={v.D} min={2} max={60} told={`D ${v.D}`} move={(to) => c.set({ D: 2 * Math.abs(plane.back(to)[0]) })} step={(dx) => c.set({ D: c.now().D + dx })} />
      {lip && (
        <Handle
          at={plane.at(lip)}
          name={word("q2.point")}
          value={v.point}
          min={60}
          max={170}
          told={`2φ ${v.point}°`}
          move={(to) => {
            const [x, y] = plane.back(to);
            c.set({ point: (Math.atan2(Math.max(0.01, Math.abs(x) - (half as Point[])[0][0]), Math.max(0.01, y)) * 360) / Math.PI });
          }}
          step={(dx, dy) => c.set({ point: c.now().point + dx - dy })}
        />
      )}
      {kink && <Handle at={plane.at(kink)} name={word("q2.second")} value={v.second} min={30} max={170} told={`2φ1 ${v.second}°`} move={(to) => c.set({ second: (2 * Math.asin(Math.min(0.99, Math.max(0.2, (R - (kind === "cast-iron" ? 0.15 * v.D * Math.sin((v.third * Math.PI) / 360) : 0) - plane.back(to)[0]) / (0.2 * v.D)))) * 180) / Math.PI })} step={(dx, dy) => c.set({ second: c.now().second - dx + dy })} />}
      {apex && <Handle at={plane.at(apex)} name={word("q2.e")} value={v.e} min={0.1} max={20} told={`e ${v.e}`} move={(to) => c.set({ e: Math.abs(plane.back(to)[0]) })} step={(dx) => c.set({ e: c.now().e + 0.5 * dx })} />}
    </>
  );
}

function heightAt(half: Point[], r: number): number {
  for (let i = 1; i < half.length; i++) {
    const [[a, za], [b, zb]] = [half[i - 1], half[i]];
    if (r >= a - 1e-9 && r <= b + 1e-9) return b === a ? Math.min(za, zb) : za + ((zb - za) * (r - a)) / (b - a);
  }
  return half[0][1];
}

const isOf = (...kinds: number[]) => (v: Values) => kinds.includes(v.form);

export const fig23: Figure = {
  id: "2.3",
  words: "f23",
  after: "3",
  fields: [
    { key: "form", symbol: "s.D2", name: "q2.form", min: 0, max: 7, step: 1, digits: 0, options: MINE, free: true },
    { key: "D", symbol: "s.D2", name: "q2.D", unit: "u.mm", min: 2, max: 60, step: 1, digits: 2, saved: [10, 16, 24, 30] },
    { key: "alpha", symbol: "s.alpha", name: "q2.alpha", unit: "u.deg", min: 0, max: 60, step: 1, digits: 2, saved: [0, 5, 10, 30, 31, 35, 45] },
    { key: "point", symbol: "s.2phi", name: "q2.point", unit: "u.deg", min: 60, max: 170, step: 1, digits: 2, saved: [90, 100, 110, 130, 140, 150], counts: (v) => ![2, 6, 7].includes(v.form) },
    { key: "second", symbol: "s.2phi1", name: "q2.second", unit: "u.deg", min: 30, max: 170, step: 1, digits: 2, saved: [50, 60, 80, 90], counts: isOf(1, 3) },
    { key: "third", symbol: "s.2phi2", name: "q2.third", unit: "u.deg", min: 20, max: 170, step: 1, digits: 2, saved: [40, 48, 62], counts: isOf(3) },
    { key: "rho", symbol: "s.rho", name: "q2.rho", unit: "u.mm", min: 2, max: 100, step: 0.5, digits: 2, saved: [11, 12, 16, 20], counts: isOf(2) },
    { key: "l", symbol: "s.l", name: "q2.l", unit: "u.mm", min: 0, max: 10, step: 0.25, digits: 2, saved: [0, 0.5, 1.5, 2], counts: isOf(3) },
    { key: "b", symbol: "s.b", name: "q2.b", unit: "u.mm", min: 0.1, max: 10, step: 0.25, digits: 2, saved: [0.5, 1, 2, 3], counts: isOf(4, 5) },
    { key: "e", symbol: "s.eApex", name: "q2.e", unit: "u.mm", min: 0.1, max: 20, step: 0.5, digits: 2, saved: [2, 3, 4, 6, 7], counts: isOf(6) },
  ],
  start: { form: 1, D: 20, alpha: 20, point: 118, second: 70, third: 55, rho: 14, l: 1, b: 1.5, e: 5 },
  mistake: true,
  asks: (v) => ALL.map((kind) => asking(kind, v)),
  more: (v) => ({ name: word(`f23.name${v.form}` as Key), all: String(ALL.length) }),
  wrong: (v, data) => (data[v.form] === null ? "f23.refused" : null),
  rows,
  draw,
  toml: (v) => drillToml(PAPER[v.form], v),
};
