// Figure 5: entry under an angle and on a cylinder; first and last contact, beside those of the paper's formulas.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { Plane } from "../plane";
import { DIAMETER, FORM, POINT, SECOND, THIRD, pointToml } from "./fields";
import { type Surface, contact, height, outline, pointLength, printed, profile } from "./geometry";

const rad = (degrees: number) => (degrees * Math.PI) / 180;

function surface(v: Values): Surface {
  return v.kind === 0 ? { kind: "plane", slope: Math.tan(rad(v.alpha)), x: v.x } : { kind: v.kind === 1 ? "ridge" : "valley", radius: v.RS, x: v.x };
}

function rows(v: Values): Row[] {
  const corners = profile(v);
  const s = surface(v);
  const own = contact(s, corners);
  const paper = printed(s, corners);
  const L1 = pointLength(v);
  return [
    { key: "L1", symbol: "s.Lvr1", name: "q2.L1", unit: "u.mm", value: L1, digits: 3 },
    { key: "L2", symbol: "s.Lvr2", name: "q2.L2", unit: "u.mm", value: own.first - own.last - L1, digits: 3, printed: paper.added },
    { key: "Z1", symbol: "s.Zin1", name: "q2.Z1", unit: "u.mm", value: own.first + v.approach, digits: 3, printed: paper.first + v.approach },
    { key: "Z2", symbol: "s.Zin2", name: "q2.Z2", unit: "u.mm", value: own.last, digits: 3, printed: paper.last },
    { key: "L", symbol: "s.Lvr", name: "q2.Lin", unit: "u.mm", value: own.first - own.last + v.approach, digits: 3, printed: paper.first - paper.last + v.approach },
    { key: "radius", symbol: "s.rFirst", name: "q2.radius", unit: "u.mm", value: own.radius, digits: 3, printed: 0 },
    { key: "short", symbol: "s.short", name: "q2.short", unit: "u.mm", value: Math.max(0, own.first - paper.first), digits: 3 },
    { key: "limit", symbol: "s.alphaMax", name: "q2.limit", unit: "u.deg", value: 90 - v.point / 2, digits: 2 },
  ];
}

function wrong(v: Values) {
  return profile(v).some(([r], i, all) => i > 0 && r <= all[i - 1][0]) ? ("f24.tooLong" as const) : v.kind !== 0 && Math.abs(v.x) + v.D / 2 > v.RS ? ("f25.beside" as const) : null;
}

function draw(c: Drawing) {
  const { v, width } = c;
  const s = surface(v);
  const corners = profile(v);
  const R = v.D / 2;
  const L1 = corners[corners.length - 1][1];
  const tall = 440;
  const ok = wrong(v) === null;
  const own = ok ? contact(s, corners) : { first: 0, last: 0, radius: 0 };
  const paper = ok ? printed(s, corners) : own;
  const reach = 2.1 * R;
  const top = Math.max(own.first, height(s, 0)) + v.approach + L1 + 0.7 * R;
  const low = Math.min(own.last, paper.last) - 0.5 * R;
  const plane = new Plane([-reach, low], [reach, top], { left: 8, top: 56, width: width - 116, height: tall - 64 });
  const us = Array.from({ length: 81 }, (_, i) => -reach + (i * reach) / 40).filter((u) => s.kind === "plane" || Math.abs(u + s.x) <= s.radius);
  const face = us.map((u): Point => [u, height(s, u)]);
  const body: Point[] = [...face, [us[us.length - 1], low], [us[0], low]];
  const drill = (tip: number) => plane.line(outline(corners, 0, tip, top), true);
  // The highest side of the surface is met by the lip on that side.
  const side = s.kind === "plane" ? Math.sign(s.slope) || 1 : s.kind === "ridge" ? -Math.sign(s.x) || 1 : Math.sign(s.x) || 1;
  const touch = plane.at([side * own.radius, height(s, side * own.radius)]);
  const levels: [number, "s.Zin1" | "s.Zin2", string][] = [
    [own.first + v.approach, "s.Zin1", "Z1"],
    [own.last, "s.Zin2", "Z2"],
  ];
  return {
    height: tall + 20,
    children: (
      <>
        <path d={plane.line(body, true)} class="hatched" />
        <path d={plane.line(face)} class="part" />
        <path d={`M${plane.x(0)} ${plane.y(low)}V${plane.y(top)}`} class="axis" />
        {ok && (
          <>
            <path d={drill(own.first)} class="ghost" />
            <path d={drill(own.last)} class="cutter" />
            {c.printed && Math.abs(paper.last - own.last) + Math.abs(paper.first - own.first) > 1e-6 && <path d={drill(Math.abs(paper.first - own.first) > 1e-6 ? paper.first : paper.last)} class="wrongline" />}
            <Dot at={touch} />
            {levels.map(([z, symbol, row]) => (
              <g key={row}>
                <path d={`M${plane.x(0)} ${plane.y(z)}H${plane.x(reach * 0.98)}`} class="dotted" />
                <Label at={[plane.x(reach * 0.98) + 4, plane.y(z) + 4]} symbol={symbol} row={row} c={c} />
              </g>
            ))}
            <Label at={[14, 24]} text={word(own.radius < 1e-9 ? "f25.tip" : own.radius > R - 1e-9 ? "f25.corner" : "f25.lip")} class={own.radius > 0 ? "strong" : ""} />
            {c.printed && own.first - paper.first > 1e-6 && <Label at={[14, 44]} text={word("f25.late", { short: c.text("short") })} class="bad" />}
          </>
        )}
        <ScaleBar plane={plane} at={[14, tall + 10]} />
        {v.kind === 0 ? (
          <Handle
            at={plane.at([reach * 0.8, height(s, reach * 0.8)])}
            name={word("q2.alpha")}
            value={v.alpha}
            min={-60}
            max={60}
            told={`α ${c.text("alpha")}°`}
            move={(to) => {
              const [u, z] = plane.back(to);
              c.set({ alpha: (Math.atan2(z, Math.max(0.1, u + v.x)) * 180) / Math.PI });
            }}
            step={(dx, dy) => c.set({ alpha: v.alpha + dx + dy })}
          />
        ) : (
          <Handle
            at={plane.at([0, height(s, 0)])}
            name={word("q2.RS")}
            value={v.RS}
            min={5}
            max={500}
            told={`RS ${c.text("RS")}`}
            move={(to) => c.set({ RS: Math.hypot(v.x, plane.back(to)[1]) })}
            step={(dx, dy) => c.set({ RS: v.RS + dy, x: v.x + dx * 0.5 })}
          />
        )}
      </>
    ),
  };
}

export const fig25: Figure = {
  id: "2.5",
  words: "f25",
  after: "5",
  fields: [
    { key: "kind", symbol: "s.RS", name: "q2.surface", min: 0, max: 2, step: 1, digits: 0, options: ["f25.plane", "f25.outer", "f25.inner"] },
    { key: "alpha", symbol: "s.alpha", name: "q2.alpha", unit: "u.deg", min: -60, max: 60, step: 1, digits: 2, counts: (v) => v.kind === 0 },
    { key: "RS", symbol: "s.RS", name: "q2.RS", unit: "u.mm", min: 5, max: 500, step: 1, digits: 2, counts: (v) => v.kind !== 0 },
    { key: "x", symbol: "s.x", name: "q2.x", unit: "u.mm", min: -100, max: 100, step: 0.5, digits: 2 },
    { key: "approach", symbol: "s.Lpod", name: "q2.approach", unit: "u.mm", min: 0, max: 20, step: 0.5, digits: 2 },
    FORM,
    DIAMETER,
    POINT,
    SECOND,
    THIRD,
  ],
  start: { kind: 0, alpha: 20, RS: 30, x: 0, approach: 2, form: 0, D: 20, point: 118, second: 70, third: 55 },
  mistake: true,
  wrong,
  rows,
  draw,
  toml: (v) => {
    const entry = v.kind === 0 ? `surface = "plane", inclination = ${tomlNumber(v.alpha)}` : `surface = "${v.kind === 1 ? "outer" : "inner"}-cylinder", radius = ${tomlNumber(v.RS)}`;
    return `diameter = ${tomlNumber(v.D)}\n${pointToml(v)}\n\nentry = { ${entry}, offset = ${tomlNumber(v.x)} }\napproach = ${tomlNumber(v.approach)}`;
  },
};
