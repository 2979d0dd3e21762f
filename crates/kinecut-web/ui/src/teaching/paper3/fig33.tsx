// Figures 3 a and b: a torus that bulges outwards and one that bulges inwards, with one ring of centres and one motion.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";
import { MOTION } from "./motion";
import { outcomeWord } from "./outcome";
import { along, profileOf } from "./profile";
import { type Tool, asking } from "./tool";

const n = (x: number) => tomlNumber(x, 4);
const rad = (x: number) => (x * Math.PI) / 180;

/** The tool: a quarter of a ring between a disc and a cylinder, or its hollow counterpart about the same centre. */
function ringToml(v: Values, hollow: boolean): string {
  const elements = hollow
    ? `bottom = ${n(v.zc - 8)}, elements = [{ to = [${n(v.xc - v.r)}, ${n(v.zc - 8)}] }, { to = [${n(v.xc - v.r)}, ${n(v.zc)}] }, { to = [${n(v.xc)}, ${n(v.zc + v.r)}], centre = [${n(v.xc)}, ${n(v.zc)}], convex = false }, { to = [${n(v.xc)}, ${n(v.zc + v.r + 8)}] }, { to = [0, ${n(v.zc + v.r + 8)}] }]`
    : `bottom = ${n(v.zc - v.r)}, elements = [{ to = [${n(v.xc)}, ${n(v.zc - v.r)}] }, { to = [${n(v.xc + v.r)}, ${n(v.zc)}], centre = [${n(v.xc)}, ${n(v.zc)}], convex = true }, { to = [${n(v.xc + v.r)}, ${n(v.zc + 16)}] }, { to = [0, ${n(v.zc + 16)}] }]`;
  return `tool = { shape = { contour = { ${elements} } } }\ntwist = { velocity = [${n(v.vx)}, ${n(v.vy)}, ${n(v.vz)}], turn = [${n(v.wx)}, ${n(v.wy)}, 0] }\n`;
}

function torusOf(tool: Tool): number {
  return tool.pieces.findIndex((p) => !p.fan && p.centre);
}

/** Normal angles of the folds of the torus, from below. */
export function foldsOf(tool: Tool): number[] {
  const piece = torusOf(tool);
  return tool.folds.filter((f) => f.piece === piece).map((f) => f.u).sort((a, b) => a - b);
}

function rows(_: Values, data: unknown[]): Row[] {
  const [a, b] = data as Tool[];
  const found: Row[] = [
    { key: "foldsA", symbol: "s.NfoldA", name: "q3.foldsA", value: foldsOf(a).length, digits: 0 },
    { key: "foldsB", symbol: "s.NfoldB", name: "q3.foldsB", value: foldsOf(b).length, digits: 0 },
  ];
  foldsOf(a).forEach((value, i) => found.push({ key: `a${i}`, symbol: i ? "s.phiA2" : "s.phiA1", name: "q3.foldA", unit: "u.deg", value, digits: 3 }));
  foldsOf(b).forEach((value, i) => found.push({ key: `b${i}`, symbol: i ? "s.phiB2" : "s.phiB1", name: "q3.foldB", unit: "u.deg", value, digits: 3 }));
  const length = (tool: Tool) => tool.loops.reduce((sum, l) => sum + l.length, 0);
  found.push({ key: "lengthA", symbol: "s.LgA", name: "q3.lengthA", unit: "u.mm", value: length(a), digits: 3 }, { key: "lengthB", symbol: "s.LgB", name: "q3.lengthB", unit: "u.mm", value: length(b), digits: 3 });
  return found;
}

function draw(c: Drawing) {
  const { width } = c;
  const wide = width >= 520;
  const each = wide ? (width - 30) / 2 : width - 16;
  const tall = wide ? 380 : 330;
  const box = (k: number): Box => (wide ? { left: 8 + k * (each + 14), top: 30, width: each, height: tall } : { left: 8, top: 30 + k * (tall + 56), width: each, height: tall });
  return {
    height: wide ? tall + 60 : 2 * tall + 116,
    children: (
      <>
        <View c={c} k={0} box={box(0)} />
        <View c={c} k={1} box={box(1)} />
      </>
    ),
  };
}

function View({ c, k, box }: { c: Drawing; k: 0 | 1; box: Box }) {
  const { v } = c;
  const tool = c.data[k] as Tool;
  const torus = tool.pieces[torusOf(tool)];
  const outline = profileOf(tool);
  const low = v.zc - Math.max(8, v.r);
  const high = v.zc + Math.max(16, v.r + 8);
  const plane = new Plane([-3, low - 3], [v.xc + v.r + 9, high], box);
  const E = plane.at([v.xc, v.zc]);
  // In a hollow the surface lies on the other side of the centre.
  const side = k === 0 ? 1 : -1;
  const place = (phi: number, r = v.r): Point => plane.at([v.xc + side * r * Math.cos(rad(phi)), v.zc + side * r * Math.sin(rad(phi))]);
  const P = place(v.phi);
  const arc = (r: number) => plane.curve((t) => [v.xc + side * r * Math.cos(rad(t)), v.zc + side * r * Math.sin(rad(t))], -90, 0, 24);
  const folds = foldsOf(tool);
  const far = v.r + 7;
  return (
    <>
      <Label at={[box.left + 2, box.top - 12]} text={`${word(k ? "panel.b" : "panel.a")} ${word(k ? "f33.inward" : "f33.outward")}`} />
      <path d={plane.line([[0, outline[0][1]], ...outline, [0, outline[outline.length - 1][1]]], true)} class="hatched" />
      <path d={plane.line(outline)} class="netline" />
      <path d={plane.line(along(torus))} class="part" />
      {[v.r * 0.55, v.r * 1.3].map((r) => (
        <path key={r} d={arc(r)} class="ghost" />
      ))}
      {folds.map((phi, i) => (
        <g key={i}>
          <path d={`M${E.join(" ")}L${place(phi, far).join(" ")}`} class="third" />
          <circle cx={place(phi)[0]} cy={place(phi)[1]} r="4.5" class="dot" />
          <Label at={[place(phi, far)[0] + side * 4, place(phi, far)[1] + (i && Math.abs(folds[0] - folds[1]) < 14 ? 4 : side > 0 ? 14 : -2)]} row={k ? `b${i}` : `a${i}`} c={c} anchor={side > 0 ? "start" : "end"} />
        </g>
      ))}
      <path d={`M${plane.x(0)} ${box.top}V${box.top + box.height}`} class="axis" />
      <path d={`M${E.join(" ")}L${P.join(" ")}`} class="second" />
      <path d={`M${P.join(" ")}l${44 * Math.cos(rad(v.phi))} ${-44 * Math.sin(rad(v.phi))}`} marker-end="url(#tg-arrow)" />
      <Dot at={E} symbol="s.E" dx={side > 0 ? -8 : 8} dy={side > 0 ? -6 : 16} anchor={side > 0 ? "end" : "start"} />
      <Dot at={P} symbol="s.P" dx={10} dy={side > 0 ? -10 : 18} />
      <ScaleBar plane={plane} at={[box.left + 6, box.top + box.height + 20]} />
      {k === 0 && (
        <>
          <Handle
            at={E}
            name={word("f33.centre")}
            value={v.xc}
            min={1}
            max={60}
            told={`E (${v.xc}; ${v.zc})`}
            move={(to) => {
              const [x, y] = plane.back(to);
              c.set({ xc: Math.max(v.r + 0.5, x), zc: y });
            }}
            step={(dx, dy) => c.set({ xc: Math.max(c.now().r + 0.5, c.now().xc + 0.5 * dx), zc: c.now().zc + 0.5 * dy })}
          />
          <Handle
            at={place(-45)}
            name={word("q3.tube")}
            value={v.r}
            min={0.2}
            max={20}
            told={`r ${v.r} mm`}
            move={(to) => {
              const [x, y] = plane.back(to);
              c.set({ r: Math.min(v.xc - 0.5, Math.hypot(x - v.xc, y - v.zc)) });
            }}
            step={(dx, dy) => c.set({ r: Math.min(c.now().xc - 0.5, c.now().r + 0.5 * (dx - dy)) })}
          />
        </>
      )}
    </>
  );
}

const own = (key: string, saved: number[]) => ({ ...(MOTION.find((f) => f.key === key) as (typeof MOTION)[number]), saved });

export const fig33: Figure = {
  id: "3.3",
  words: "f33",
  after: "3",
  fields: [
    { key: "r", symbol: "s.r", name: "q3.tube", unit: "u.mm", min: 0.2, max: 20, step: 0.5, digits: 2, saved: [1, 2, 3, 4, 5, 6, 7, 9, 10] },
    { key: "xc", symbol: "s.xc", name: "q3.xc", unit: "u.mm", min: 1, max: 60, step: 0.5, digits: 2, saved: [9, 10, 11, 13, 14, 16] },
    { key: "zc", symbol: "s.zcE", name: "q3.zc", unit: "u.mm", min: -40, max: 60, step: 0.5, digits: 2, saved: [4, 6, 7, 9, 10, 12] },
    { key: "phi", symbol: "s.phi", name: "q3.phi", unit: "u.deg", min: -90, max: 0, step: 5, digits: 1, free: true },
    own("vx", [-800, -300, 0]),
    own("vy", [0, 200, 500]),
    own("vz", [-600, -300, 0]),
    own("wx", [-500, 500]),
    own("wy", [1500, 2800]),
  ],
  start: { r: 8, xc: 12, zc: 8, phi: -20, vx: -508, vy: 348, vz: -432, wx: 0, wy: 2113 },
  wrong: (v) => (v.r >= v.xc ? "f33.tooLarge" : null),
  asks: (v) => {
    const r = Math.min(v.r, v.xc - 0.05);
    return [asking(ringToml({ ...v, r }, false)), asking(ringToml({ ...v, r }, true))];
  },
  more: (_, data) => ({ outcomeA: outcomeOf(data[0] as Tool), outcomeB: outcomeOf(data[1] as Tool) }),
  rows,
  draw,
  toml: (v) => [false, true].map((hollow) => `[[grazing]]\n${ringToml(v, hollow)}`).join("\n"),
};

function outcomeOf(tool: Tool): string {
  return outcomeWord(tool.pieces[torusOf(tool)]?.outcome);
}
