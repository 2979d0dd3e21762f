// Figure 1: the lines that make a cone, and the chain of motions.
import { type Key, num, word } from "../language";
import { Dimension, Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";

type Place = [number, number, number];

/** Equation 4 with its brackets. */
function place(v: Values, phi = v.phi, z = v.z): Place {
  const radius = v.R - z * Math.sin(v.alpha);
  return [radius * Math.cos(phi), radius * Math.sin(phi), z * Math.cos(v.alpha)];
}

/** Equation 4 as printed. */
function printedPlace(v: Values): Place {
  const short = v.z * Math.sin(v.alpha);
  return [v.R - short * Math.cos(v.phi), v.R - short * Math.sin(v.phi), v.z * Math.cos(v.alpha)];
}

/** Distance of the end of the chain of matrices from the end of the generatrix. */
function astray(v: Values): number {
  const end = { ...v, z: v.s };
  const place4 = chain(end).reduceRight<number[]>((p, { matrix }) => [0, 1, 2, 3].map((row) => p.reduce((sum, n, k) => sum + matrix[4 * row + k] * n, 0)), [0, 0, 0, 1]);
  return Math.hypot(...place(end).map((n, k) => n - place4[k]));
}

function rows(v: Values): Row[] {
  const [x, y, z] = place(v);
  const [px, py] = printedPlace(v);
  return [
    { key: "x", symbol: "s.x", name: "q5.x", unit: "u.mm", value: x, digits: 3, printed: px },
    { key: "y", symbol: "s.y", name: "q5.y", unit: "u.mm", value: y, digits: 3, printed: py },
    { key: "zz", symbol: "s.zc", name: "q5.z", unit: "u.mm", value: z, digits: 3 },
    { key: "radius", symbol: "s.Rz", name: "q5.radius", unit: "u.mm", value: v.R - v.z * Math.sin(v.alpha), digits: 3 },
    { key: "top", symbol: "s.Rs", name: "q5.top", unit: "u.mm", value: v.R - v.s * Math.sin(v.alpha), digits: 3, printed: v.R + v.s * Math.sin(v.alpha) },
    { key: "height", symbol: "s.h", name: "q5.height", unit: "u.mm", value: v.s * Math.cos(v.alpha), digits: 3 },
    { key: "degrees", symbol: "s.alpha", name: "q5.alpha", unit: "u.deg", value: (v.alpha * 180) / Math.PI, digits: 3 },
    { key: "off", symbol: "s.Dmax", name: "q5.off", unit: "u.mm", value: astray(v), digits: 1, printed: Math.abs(2 * v.s * Math.sin(v.alpha) * Math.cos(v.alpha)) },
  ];
}

/** Isometric: X to the lower left, Y to the lower right, Z up. */
function iso([x, y, z]: Place): Point {
  return [(y - x) * Math.cos(Math.PI / 6), z - (x + y) * 0.5];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const wide = width >= 560;
  const left: Box = { left: 8, top: 24, width: wide ? width * 0.44 : width - 16, height: wide ? 330 : 300 };
  const rest = width - left.width - 24;
  const plan: Box = wide ? { left: left.width + 20, top: 24, width: rest * 0.5 - 6, height: 330 } : { left: 8, top: 350, width: (width - 24) / 2, height: 230 };
  const section: Box = wide ? { left: plan.left + plan.width + 6, top: 24, width: rest * 0.5 - 6, height: 330 } : { left: plan.left + plan.width + 8, top: 350, width: plan.width, height: 230 };
  const below = section.top + section.height + 24;
  const matrices = width >= 480 ? 2 : 1;
  return {
    height: below + (4 / matrices) * 124 + 4,
    children: (
      <>
        <Label at={[left.left + 2, 16]} text={word("panel.a")} />
        <Net c={c} box={left} />
        <Label at={[plan.left + 2, plan.top - 8]} text={word("panel.b")} />
        <Plan c={c} box={plan} />
        <Label at={[section.left + 2, section.top - 8]} text={word("panel.c")} />
        <Section c={c} box={section} />
        {chain(v).map((link, i) => (
          <Link key={i} link={link} box={{ left: 8 + ((i % matrices) * (width - 8)) / matrices, top: below + Math.floor(i / matrices) * 124, width: (width - 8) / matrices - 8, height: 114 }} />
        ))}
      </>
    ),
  };
}

function Net({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const tall = v.s * Math.cos(v.alpha);
  const wide = 1.25 * Math.max(v.R, v.R - v.s * Math.sin(v.alpha));
  const plane = new Plane([-wide, -wide * 0.95], [wide, tall + wide * 0.7], box);
  const to = (phi: number, z: number) => plane.at(iso(place(v, phi, z)));
  const line = (points: Point[]) => points.map((p, i) => `${i ? "L" : "M"}${p[0].toFixed(1)} ${p[1].toFixed(1)}`).join("");
  // Turned away where the outward normal points from the eye, which looks from (1, 1, 1).
  const seen = (phi: number) => Math.cos(v.alpha) * (Math.cos(phi) + Math.sin(phi)) + Math.sin(v.alpha) > 0;
  const steps = Array.from({ length: 72 }, (_, i) => (i * Math.PI) / 36);
  const meridians = Array.from({ length: 24 }, (_, i) => (i * Math.PI) / 12);
  const parallels = Array.from({ length: 6 }, (_, i) => (v.s * i) / 5);
  const around = (z: number, front: boolean) => steps.filter((phi) => seen(phi + Math.PI / 72) === front).map((phi) => line([to(phi, z), to(phi + Math.PI / 36, z)])).join("");
  const axes: [Place, string][] = [
    [[v.R * 1.3, 0, 0], "X"],
    [[0, v.R * 1.3, 0], "Y"],
    [[0, 0, tall + v.R * 0.45], "Z"],
  ];
  const point = to(v.phi, v.z);
  const printed = plane.at(iso(printedPlace(v)));
  const O = plane.at([0, 0]);
  const near = (at: Point): Values => {
    let best = { phi: v.phi, z: v.z, far: Infinity };
    const look = (phi: number, z: number) => {
      const p = to(phi, z);
      const far = Math.hypot(p[0] - at[0], p[1] - at[1]) + (seen(phi) ? 0 : 24);
      if (far < best.far) best = { phi, z, far };
    };
    for (let i = 0; i < 180; i++) for (let k = 0; k <= 25; k++) look((i * Math.PI) / 90, (v.s * k) / 25);
    const { phi, z } = best;
    for (let i = -8; i <= 8; i++) for (let k = -8; k <= 8; k++) look(phi + (i * Math.PI) / 720, Math.min(v.s, Math.max(0, z + (v.s * k) / 200)));
    return { phi: ((best.phi % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI), z: best.z };
  };
  return (
    <>
      <path d={parallels.map((z) => around(z, false)).join("") + meridians.filter((p) => !seen(p)).map((p) => line([to(p, 0), to(p, v.s)])).join("")} class="grid" />
      {axes.map(([end, name]) => (
        <g key={name}>
          <path d={line([O, plane.at(iso(end))])} class="axis" marker-end="url(#tg-arrow)" />
          <Label at={[plane.at(iso(end))[0] + 6, plane.at(iso(end))[1]]} symbol={`s.axis${name}` as Key} />
        </g>
      ))}
      <path d={parallels.map((z) => around(z, true)).join("") + meridians.filter(seen).map((p) => line([to(p, 0), to(p, v.s)])).join("")} class="netline" />
      <path d={line([...steps, 2 * Math.PI].map((phi) => to(phi, 0)))} class="part" />
      <path d={line([to(v.phi, 0), to(v.phi, v.s)])} class="generatrix" />
      <Label at={[to(v.phi, v.s)[0] + 8, to(v.phi, v.s)[1] - 4]} text="1" />
      <Label at={[to(-1.2, 0)[0] - 14, to(-1.2, 0)[1] + 2]} text="2" anchor="end" />
      {c.printed && (
        <g class="badExit">
          <path d={`M${printed[0] - 6} ${printed[1] - 6}l12 12M${printed[0] - 6} ${printed[1] + 6}l12 -12`} />
          <Label at={[printed[0] + 10, printed[1] + 4]} text={word("f51.printed")} class="bad" />
        </g>
      )}
      <Dot at={point} />
      <ScaleBar plane={plane} at={[box.left + 6, box.top + box.height]} />
      <Handle
        at={point}
        name={word("f51.point")}
        value={v.phi}
        min={0}
        max={6.283}
        told={`φ ${c.text("phi")}, z ${c.text("z")}`}
        move={(at) => c.set(near(at))}
        step={(dx, dy) => c.set({ phi: (v.phi + dx * 0.05 + 2 * Math.PI) % (2 * Math.PI), z: v.z + dy })}
      />
    </>
  );
}

function Plan({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const plane = new Plane([-1.15 * v.R, -1.15 * v.R], [1.35 * v.R, 1.35 * v.R], box);
  const O = plane.at([0, 0]);
  const k = plane.scale;
  const [x, y] = place(v);
  const P = plane.at([x, y]);
  const on = plane.at([v.R * Math.cos(v.phi), v.R * Math.sin(v.phi)]);
  const arc = v.R * 0.45;
  const end = plane.at([arc * Math.cos(v.phi), arc * Math.sin(v.phi)]);
  return (
    <>
      <path d={`M${plane.x(-1.1 * v.R)} ${O[1]}H${plane.x(1.3 * v.R)}`} class="axis" marker-end="url(#tg-arrow)" />
      <path d={`M${O[0]} ${plane.y(-1.1 * v.R)}V${plane.y(1.3 * v.R)}`} class="axis" marker-end="url(#tg-arrow)" />
      <circle cx={O[0]} cy={O[1]} r={v.R * k} class="part" />
      <path d={`M${O[0]} ${O[1]}L${on[0]} ${on[1]}`} />
      <path d={`M${O[0] + arc * k} ${O[1]}A${arc * k} ${arc * k} 0 ${v.phi > Math.PI ? 1 : 0} 0 ${end[0]} ${end[1]}`} marker-end="url(#tg-arrow)" />
      <Label at={plane.at([1.2 * arc * Math.cos(v.phi / 2), 1.2 * arc * Math.sin(v.phi / 2)])} symbol="s.phi" />
      <Label at={[(O[0] + on[0]) / 2 - 6, (O[1] + on[1]) / 2 - 6]} symbol="s.R" anchor="end" />
      <Label at={[plane.x(-0.75 * v.R) - 6, plane.y(0.75 * v.R) - 2]} text="2" anchor="end" />
      <Dot at={P} />
      <Label at={[plane.x(1.22 * v.R), O[1] + 18]} symbol="s.axisX" />
      <Label at={[O[0] + 8, plane.y(1.24 * v.R)]} symbol="s.axisY" />
      <Handle
        at={on}
        name={word("q5.phi")}
        value={v.phi}
        min={0}
        max={6.283}
        told={`φ ${c.text("phi")}`}
        move={(at) => {
          const [px, py] = plane.back(at);
          c.set({ phi: (Math.atan2(py, px) + 2 * Math.PI) % (2 * Math.PI) });
        }}
        step={(dx, dy) => c.set({ phi: (v.phi + (dx + dy) * 0.02 + 2 * Math.PI) % (2 * Math.PI) })}
      />
    </>
  );
}

function Section({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const [sin, cos] = [Math.sin(v.alpha), Math.cos(v.alpha)];
  const out = Math.max(v.R, v.R - v.s * sin, c.printed ? v.R + v.s * sin : 0);
  const plane = new Plane([-0.15 * v.R, -0.22 * v.R], [out * 1.25, Math.max(v.s * cos, 0.4 * v.R) + 0.28 * v.R], box);
  const base = plane.at([v.R, 0]);
  const top = plane.at([v.R - v.s * sin, v.s * cos]);
  const P = plane.at([v.R - v.z * sin, v.z * cos]);
  const O = plane.at([0, 0]);
  const wrong = plane.at([v.R + v.s * sin, v.s * cos]);
  const arc = 0.55 * v.s;
  const [a, b] = [plane.at([v.R, arc]), plane.at([v.R - arc * sin, arc * cos])];
  return (
    <>
      <path d={`M${O[0]} ${plane.y(-0.2 * v.R)}V${plane.y(v.s * cos + 0.24 * v.R)}`} class="axis" marker-end="url(#tg-arrow)" />
      <path d={`M${O[0]} ${O[1]}H${base[0]}L${top[0]} ${top[1]}H${O[0]}Z`} class="hatched" />
      <path d={`M${O[0]} ${O[1]}H${base[0]}L${top[0]} ${top[1]}H${O[0]}`} class="part" />
      <path d={`M${base[0]} ${base[1]}L${top[0]} ${top[1]}`} class="generatrix" />
      <path d={`M${base[0]} ${base[1]}V${plane.y(arc * 1.15)}`} class="dashed" />
      {Math.abs(v.alpha) > 0.03 && <path d={`M${a[0]} ${a[1]}A${arc * plane.scale} ${arc * plane.scale} 0 0 ${v.alpha > 0 ? 0 : 1} ${b[0]} ${b[1]}`} marker-end="url(#tg-arrow)" />}
      {c.printed && <path d={`M${base[0]} ${base[1]}L${wrong[0]} ${wrong[1]}`} class="wrongline" />}
      <Label at={[a[0] + 4, a[1] - 4]} symbol="s.alpha" />
      <Dimension from={[O[0], O[1] + 14]} to={[base[0], O[1] + 14]} />
      <Label at={[(O[0] + base[0]) / 2, O[1] + 29]} symbol="s.R" anchor="middle" />
      <Dimension from={[base[0] - 16 * cos, base[1] - 16 * sin + 4]} to={[P[0] - 16 * cos, P[1] - 16 * sin + 4]} />
      <Label at={[(base[0] + P[0]) / 2 - 22, (base[1] + P[1]) / 2 + 4]} symbol="s.zl" anchor="end" />
      <Label at={[top[0] + 8, top[1] - 8]} text="1" />
      <Label at={[O[0] + 6, plane.y(v.s * cos + 0.2 * v.R)]} symbol="s.axisZ" />
      <Dot at={P} />
      <Handle at={base} name={word("q5.R")} value={v.R} min={1} max={300} told={`R ${c.text("R")}`} move={(at) => c.set({ R: plane.back(at)[0] })} step={(dx) => c.set({ R: v.R + dx })} />
      <Handle
        at={top}
        name={word("q5.alphaRad")}
        value={v.alpha}
        min={-1.2}
        max={1.4}
        told={`α ${c.text("alpha")}`}
        move={(at) => {
          const [x, z] = plane.back(at);
          c.set({ alpha: Math.atan2(v.R - x, z) });
        }}
        step={(dx) => c.set({ alpha: v.alpha - dx * 0.01 })}
      />
    </>
  );
}

interface ChainLink {
  digit: string;
  symbol: Key;
  value: number;
  digits: number;
  forming: boolean;
  matrix: number[];
}

/** Motions from the workpiece to the tool, each a matrix by rows. */
export function chain(v: Values): ChainLink[] {
  const [c, s] = [Math.cos(v.phi), Math.sin(v.phi)];
  const [ca, sa] = [Math.cos(v.alpha), Math.sin(v.alpha)];
  return [
    { digit: "6", symbol: "s.phi", value: v.phi, digits: 3, forming: true, matrix: [c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
    { digit: "1", symbol: "s.R", value: v.R, digits: 2, forming: false, matrix: [1, 0, 0, v.R, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
    { digit: "5", symbol: "s.minusAlpha", value: -v.alpha, digits: 3, forming: false, matrix: [ca, 0, -sa, 0, 0, 1, 0, 0, sa, 0, ca, 0, 0, 0, 0, 1] },
    { digit: "3", symbol: "s.zl", value: v.z, digits: 2, forming: true, matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, v.z, 0, 0, 0, 1] },
  ];
}

function Link({ link, box }: { link: ChainLink; box: Box }) {
  const column = (box.width - 12) / 4;
  return (
    <g>
      <rect x={box.left} y={box.top} width={box.width} height={box.height} rx="4" class={`box${link.forming ? "" : " dashed"}`} />
      <Label at={[box.left + 8, box.top + 18]} symbol={`s.A${link.digit}` as Key} />
      <Label at={[box.left + 34, box.top + 18]} symbol={link.symbol} text={num(link.value, link.digits, true)} />
      <text x={box.left + box.width - 6} y={box.top + 18} text-anchor="end" class="tick">
        {word(link.forming ? "f51.forming" : "f51.setting")}
      </text>
      {link.matrix.map((n, i) => (
        <text key={i} x={box.left + column * ((i % 4) + 1)} y={box.top + 42 + 20 * Math.floor(i / 4)} text-anchor="end" class={n === 0 ? "tick" : ""}>
          {num(n, 3, true)}
        </text>
      ))}
    </g>
  );
}

export const fig51: Figure = {
  id: "5.1",
  words: "f51",
  after: "1",
  fields: [
    { key: "R", symbol: "s.R", name: "q5.R", unit: "u.mm", min: 1, max: 300, step: 1, digits: 2 },
    { key: "alpha", symbol: "s.alpha", name: "q5.alphaRad", unit: "u.rad", min: -1.2, max: 1.4, step: 0.01, digits: 4 },
    { key: "s", symbol: "s.s", name: "q5.s", unit: "u.mm", min: 1, max: 300, step: 1, digits: 2 },
    { key: "phi", symbol: "s.phi", name: "q5.phi", unit: "u.rad", min: 0, max: 6.2832, step: 0.05, digits: 3 },
    { key: "z", symbol: "s.zl", name: "q5.zl", unit: "u.mm", min: 0, max: 300, step: 1, digits: 2 },
  ],
  start: { R: 30, alpha: 0.35, s: 50, phi: 1, z: 20 },
  mistake: true,
  wrong: (v) => (v.z > v.s ? "f51.beyond" : v.R - v.s * Math.sin(v.alpha) < 0 ? "f51.apex" : null),
  rows,
  draw,
  toml: (v) => `like = "cone"\nparameters = { R = ${tomlNumber(v.R)}, alpha = ${tomlNumber(v.alpha)} }`,
};
