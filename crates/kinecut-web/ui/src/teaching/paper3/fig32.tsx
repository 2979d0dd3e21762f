// Figure 2: the sphere that touches the tool along one of its circles, and the two points of that circle that graze.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import type { Drawing, Figure, Point, Row, Values } from "../model";
import { Plane, turned } from "../plane";
import { CORNER, DIAMETER, MOTION, START, millToml } from "./motion";
import { profileOf } from "./profile";
import { type Level, type Profile, keepProfile, velocityAt } from "./tool";

const deg = (n: number) => (n * 180) / Math.PI;
const rad = (n: number) => (n * Math.PI) / 180;

function levelOf(v: Values, { levels }: Profile): Level {
  return levels.reduce((a, b) => (Math.abs(b.way - v.s) < Math.abs(a.way - v.s) ? b : a));
}

/** Whether a circle has grazing points: it enters on a part of it only. */
function grazes({ enters }: Level): boolean {
  return enters !== null && enters[1] - enters[0] < 360 - 1e-6 && enters[1] - enters[0] > 1e-6;
}

function flat({ normal }: Level): boolean {
  return Math.abs(normal[0]) < 1e-6;
}

/** Centre of the sphere, on the axis. */
function centre({ place: [r, z], normal: [nr, nz] }: Level): number {
  return z - (r * nz) / nr;
}

function rows(v: Values, data: unknown[]): Row[] {
  const profile = data[0] as Profile;
  const level = levelOf(v, profile);
  const [r, z] = level.place;
  const [nr, nz] = level.normal;
  const found: Row[] = [
    { key: "r", symbol: "s.r", name: "q3.circle", unit: "u.mm", value: r, digits: 3 },
    { key: "z", symbol: "s.z", name: "q3.height", unit: "u.mm", value: z, digits: 3 },
    { key: "normal", symbol: "s.phi", name: "q3.normal", unit: "u.deg", value: deg(Math.atan2(nz, nr)), digits: 3 },
  ];
  if (!flat(level)) {
    found.push({ key: "zQ", symbol: "s.zQ", name: "q3.zQ", unit: "u.mm", value: centre(level), digits: 3 });
    found.push({ key: "QP", symbol: "s.QP", name: "q3.QP", unit: "u.mm", value: r / Math.abs(nr), digits: 3 });
  }
  if (!grazes(level)) return found;
  const [p, q] = level.enters as [number, number];
  const off = [p, q].map((t) => {
    const V = velocityAt(profile, [r * Math.cos(rad(t)), r * Math.sin(rad(t)), z]);
    return Math.abs(nr * (Math.cos(rad(t)) * V[0] + Math.sin(rad(t)) * V[1]) + nz * V[2]) / Math.hypot(...V);
  });
  return [
    ...found,
    { key: "psi", symbol: "s.psi", name: "q3.psi", unit: "u.deg", value: deg(turned(rad((p + q) / 2))), digits: 3 },
    { key: "half", symbol: "s.alpha", name: "q3.half", unit: "u.deg", value: (q - p) / 2, digits: 3 },
    { key: "first", symbol: "s.theta1", name: "q3.theta1", unit: "u.deg", value: deg(turned(rad(p))), digits: 3 },
    { key: "second", symbol: "s.theta2", name: "q3.theta2", unit: "u.deg", value: deg(turned(rad(q))), digits: 3 },
    { key: "off", symbol: "s.nV", name: "q3.nV", value: Math.max(...off), digits: 2, power: true },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const profile = c.data[0] as Profile;
  const level = levelOf(v, profile);
  const wide = width >= 560;
  const left = wide ? Math.round(width * 0.5) : width - 16;
  const tall = wide ? 430 : 380;
  const small = wide ? width - left - 40 : Math.min(300, width - 40);
  const [low, high] = [profile.ends[0].z, profile.ends[1].z];
  const section = new Plane([-14, low - 10], [24, high + 4], { left: 8, top: 8, width: left, height: tall });
  const [r, z] = level.place;
  const [nr, nz] = level.normal;
  const P = section.at([r, z]);
  const outline = profileOf(profile);
  const Q = flat(level) ? null : section.at([0, centre(level)]);
  const ball = Q && (r / Math.abs(nr)) * section.scale;
  const isNear = Q !== null && ball !== null && Q[1] > -300 && Q[1] < tall + 300;
  const plan = { left: wide ? left + 26 : 20, top: wide ? 40 : tall + 74 };
  const disc = new Plane([-1.45 * r - 0.01, -1.45 * r - 0.01], [1.45 * r + 0.01, 1.45 * r + 0.01], { left: plan.left, top: plan.top, width: small, height: small });
  const onCircle = (t: number): Point => disc.at([r * Math.cos(rad(t)), r * Math.sin(rad(t))]);
  const arc = (from: number, to: number) => disc.curve((t) => [r * Math.cos(rad(t)), r * Math.sin(rad(t))], from, to, 48);
  const some = grazes(level);
  const [p, q] = level.enters ?? [0, 0];
  const middle = velocityAt(profile, [0, 0, Q ? centre(level) : z]);
  const speed = Math.hypot(middle[0], middle[1]);
  const arrow = speed > 1e-9 ? (1.1 * r) / speed : 0;
  const near = (at: Point) => {
    const [x, y] = section.back(at);
    return profile.levels.reduce((a, b) => (Math.hypot(b.place[0] - x, b.place[1] - y) < Math.hypot(a.place[0] - x, a.place[1] - y) ? b : a)).way;
  };
  return {
    height: wide ? tall + 34 : tall + small + 90,
    children: (
      <>
        <path d={section.line([[0, low], ...outline, [0, high]], true)} class="hatched" />
        <path d={section.line(outline)} class="part" />
        <path d={`M${section.x(0)} ${section.y(low - 9)}V${section.y(high + 4)}`} class="axis" />
        <svg x={section.box.left} y={section.box.top} width={section.box.width} height={section.box.height} viewBox={`${section.box.left} ${section.box.top} ${section.box.width} ${section.box.height}`}>
          {isNear && Q && ball && <circle cx={Q[0]} cy={Q[1]} r={ball} class="third" />}
          {Q && <path d={`M${Q[0]} ${Q[1]}L${P[0]} ${P[1]}`} class="second" />}
        </svg>
        <path d={`M${P[0]} ${P[1]}l${nr * 46} ${-nz * 46}`} marker-end="url(#tg-arrow)" />
        <Label at={[P[0] + nr * 46 + 4, P[1] - nz * 46 + (nz < -0.3 ? 14 : -4)]} symbol="s.nvec" />
        {isNear && Q && Q[1] < tall && Q[1] > 8 && <Dot at={Q} symbol="s.Q" dx={-8} anchor="end" />}
        <path d={`M${section.x(0)} ${P[1]}H${P[0]}`} class="dotted" />
        <Label at={[(section.x(0) + P[0]) / 2, P[1] - 5]} symbol="s.r" anchor="middle" />
        <ScaleBar plane={section} at={[14, tall + 22]} />
        <Label at={[plan.left, plan.top - 14]} text={word("f32.plan")} />
        <circle cx={disc.x(0)} cy={disc.y(0)} r={r * disc.scale} class="netline" />
        {some && <path d={arc(p, q)} class="entersArc" />}
        <path d={`M${disc.x(-1.4 * r)} ${disc.y(0)}H${disc.x(1.4 * r)}M${disc.x(0)} ${disc.y(-1.4 * r)}V${disc.y(1.4 * r)}`} class="axis" />
        {some && (
          <>
            <path d={chord(onCircle(p), onCircle(q))} class="second" />
            <Dot at={onCircle(p)} symbol="s.P1" />
            <Dot at={onCircle(q)} symbol="s.P2" />
            <path d={`M${disc.x(0)} ${disc.y(0)}L${onCircle(p).join(" ")}M${disc.x(0)} ${disc.y(0)}L${onCircle(q).join(" ")}`} class="ghost" />
          </>
        )}
        {arrow > 0 && (
          <>
            <path d={`M${disc.x(0)} ${disc.y(0)}L${disc.at([middle[0] * arrow, middle[1] * arrow]).join(" ")}`} class="speed" marker-end="url(#tg-arrow)" />
            <Label at={[disc.x(middle[0] * arrow) + 4, disc.y(middle[1] * arrow) + 18]} symbol="s.VQ" />
          </>
        )}
        <Handle
          at={P}
          name={word("f32.handle")}
          value={Number(z.toFixed(2))}
          min={low}
          max={high}
          told={`z ${c.text("z")}`}
          move={(to) => c.set({ s: near(to) })}
          step={(dx, dy) => {
            const all = profile.levels;
            const at = all.indexOf(levelOf(c.now(), profile)) + Math.sign(dx + dy) * Math.max(1, Math.round(Math.abs(dx + dy)));
            c.set({ s: all[Math.min(all.length - 1, Math.max(0, at))].way });
          }}
        />
      </>
    ),
  };
}

/** The line through two places, beyond both. */
function chord(a: Point, b: Point): string {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const k = Math.min(0.35, 26 / Math.max(1, Math.hypot(dx, dy)));
  return `M${a[0] - k * dx} ${a[1] - k * dy}L${b[0] + k * dx} ${b[1] + k * dy}`;
}

export const fig32: Figure = {
  id: "3.2",
  words: "f32",
  after: "2",
  drawn: "figure.inferred",
  fields: [{ key: "s", symbol: "s.s", name: "q3.s", unit: "u.mm", min: 0, max: 200, step: 1, digits: 3, free: true }, ...MOTION, DIAMETER, CORNER],
  start: { ...START, D: 20, rc: 5, s: 8.5 },
  wrong: (v, data) => {
    if (v.rc >= v.D / 2) return "f31.corner";
    const level = levelOf(v, data[0] as Profile);
    return grazes(level) ? null : level.enters ? "f32.allEnters" : "f32.allLeaves";
  },
  more: (v, data) => ({ far: flat(levelOf(v, data[0] as Profile)) ? word("f32.flat") : "" }),
  asks: (v) => [{ verb: "grazing", text: millToml({ ...v, wz: 0, rc: Math.min(v.rc, v.D / 2 - 0.05) }), as: "profile", keep: keepProfile }],
  rows,
  draw,
  toml: (v) => millToml({ ...v, wz: 0 }),
};
