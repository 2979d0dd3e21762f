// Figure 6: exit through the underside of a shaft and into a bore, in the paper's section and across it.
import { word } from "../language";
import { Dot, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";
import { DIAMETER, FORM, POINT, SECOND, THIRD, pointToml } from "./fields";
import { type Surface, contact, height, outline, pointLength, printed, profile } from "./geometry";

function surface(v: Values): Surface {
  return { kind: v.kind === 0 ? "valley" : "ridge", radius: v.RS, x: v.x };
}

function rows(v: Values): Row[] {
  const corners = profile(v);
  const s = surface(v);
  const own = contact(s, corners);
  const paper = printed(s, corners);
  const L1 = pointLength(v);
  const end = own.last - v.overrun;
  return [
    { key: "L1", symbol: "s.Lvr1", name: "q2.L1", unit: "u.mm", value: L1, digits: 3 },
    { key: "L2", symbol: "s.Lvyh2", name: "q2.L2out", unit: "u.mm", value: own.first - own.last - L1, digits: 3, printed: paper.added },
    { key: "Z1", symbol: "s.Zout1", name: "q2.Zout1", unit: "u.mm", value: own.first, digits: 3, printed: paper.first },
    { key: "Z2", symbol: "s.Zout2", name: "q2.Zout2", unit: "u.mm", value: end, digits: 3, printed: paper.last - v.overrun },
    { key: "crescent", symbol: "s.crescent", name: "q2.crescent", unit: "u.mm", value: Math.max(0, paper.last - own.last), digits: 3 },
    { key: "left", symbol: "s.left", name: "q2.left", unit: "u.mm", value: Math.max(0, end - own.last), digits: 3, printed: Math.max(0, paper.last - v.overrun - own.last) },
    { key: "half", symbol: "s.yz", name: "q2.half", unit: "u.mm", value: Math.sqrt(Math.max(0, v.D * v.D * 0.25 - v.x * v.x)), digits: 3 },
  ];
}

function wrong(v: Values) {
  return profile(v).some(([r], i, all) => i > 0 && r <= all[i - 1][0]) ? ("f24.tooLong" as const) : Math.abs(v.x) + v.D / 2 > v.RS ? ("f25.beside" as const) : null;
}

function draw(c: Drawing) {
  const { width } = c;
  const wide = width >= 560;
  const each = wide ? (width - 24) / 2 : width - 16;
  const tall = wide ? 380 : 320;
  const ok = wrong(c.v) === null;
  const first: Box = { left: 8, top: 26, width: each, height: tall };
  const second: Box = wide ? { left: each + 16, top: 26, width: each, height: tall } : { left: 8, top: tall + 66, width: each, height: tall };
  return {
    height: wide ? tall + 46 : 2 * tall + 84,
    children: (
      <>
        <Label at={[first.left + 2, 16]} text={word("f26.section")} />
        <View c={c} box={first} across={false} ok={ok} />
        <Label at={[second.left + 2, second.top - 10]} text={word("f26.across")} />
        <View c={c} box={second} across ok={ok} />
      </>
    ),
  };
}

/** Both pictures show the drill where it ends without overrun; printed, where the paper ends it. */
function View({ c, box, across, ok }: { c: Drawing; box: Box; across: boolean; ok: boolean }) {
  const { v } = c;
  const s = surface(v);
  const corners = profile(v);
  const R = v.D / 2;
  const L1 = corners[corners.length - 1][1];
  const own = ok ? contact(s, corners) : { first: height(s, 0), last: height(s, 0) - L1, radius: 0 };
  const paper = ok ? printed(s, corners) : own;
  const end = c.printed ? paper.last : own.last;
  const reach = 2 * R;
  const axis = v.kind === 0 ? -v.RS : height(s, 0);
  const low = Math.min(own.last, paper.last) - 0.5 * R;
  const top = axis + 2 * R;
  const plane = new Plane([-reach, low], [reach, top], box);
  // Across: the section along the cylinder's lowest (highest) line for the shaft, through the drill's axis for the bore.
  const level = v.kind === 0 && Math.abs(v.x) < R ? -v.RS : height(s, 0);
  const us = Array.from({ length: 81 }, (_, i) => -reach + (i * reach) / 40).filter((u) => across || Math.abs(u + v.x) <= v.RS);
  const face = us.map((u): Point => [u, across ? level : height(s, u)]);
  const body: Point[] = [...face, [us[us.length - 1], top], [us[0], top]];
  const gap = Math.max(0, paper.last - own.last);
  const half = Math.sqrt(Math.max(0, R * R - v.x * v.x));
  const bottom = s.kind === "valley" && Math.abs(v.x) < R;
  return (
    <>
      <path d={plane.line(body, true)} class="hatched" />
      <path d={plane.line(face)} class="part" />
      <path d={`M${plane.x(0)} ${plane.y(low)}V${plane.y(top)}`} class="axis" />
      {ok && (
        <>
          <path d={plane.line(outline(corners, 0, end, top), true)} class="cutter" />
          {c.printed && across && gap > 1e-6 && (
            <>
              <path d={`M${plane.x(-half)} ${plane.y(level + gap)}H${plane.x(half)}V${plane.y(level)}H${plane.x(-half)}Z`} class="crescent" />
              <Label at={[plane.x(half) + 8, plane.y(level) + 16]} symbol="s.crescent" row="crescent" c={c} class="bad" />
            </>
          )}
          {across && bottom && [half, -half].map((y) => <Dot key={y} at={plane.at([y, level])} />)}
          {!across && (
            <>
              <path d={`M${plane.x(0)} ${plane.y(end)}H${plane.x(reach * 0.75)}`} class="dotted" />
              <Label at={[plane.x(0) + 10, plane.y(end) + 16]} text={word("f26.tip")} />
            </>
          )}
        </>
      )}
      <ScaleBar plane={plane} at={[box.left + 6, box.top + box.height + 14]} />
      {!across && (
        <Handle
          at={plane.at([0, height(s, 0)])}
          name={word("q2.RS")}
          value={v.RS}
          min={5}
          max={500}
          told={`RS ${c.text("RS")}`}
          // Near the drill a large cylinder is almost flat: the hand moves its radius by shares.
          move={(to) => c.set({ RS: v.RS * Math.exp(((v.kind === 0 ? 1 : -1) * (to[1] - plane.y(height(s, 0)))) / 160), x: v.x })}
          step={(dx, dy) => c.set({ RS: v.RS + dy, x: v.x + dx * 0.5 })}
        />
      )}
    </>
  );
}

export const fig26: Figure = {
  id: "2.6",
  words: "f26",
  after: "6",
  fields: [
    { key: "kind", symbol: "s.RS", name: "q2.surface", min: 0, max: 1, step: 1, digits: 0, options: ["f26.outer", "f26.inner"] },
    { key: "RS", symbol: "s.RS", name: "q2.RS", unit: "u.mm", min: 5, max: 500, step: 1, digits: 2 },
    { key: "x", symbol: "s.x", name: "q2.x", unit: "u.mm", min: -100, max: 100, step: 0.5, digits: 2 },
    { key: "overrun", symbol: "s.Lper", name: "q2.overrun", unit: "u.mm", min: 0, max: 20, step: 0.5, digits: 2 },
    FORM,
    DIAMETER,
    POINT,
    SECOND,
    THIRD,
  ],
  start: { kind: 0, RS: 100, x: 0, overrun: 2, form: 1, D: 20, point: 118, second: 70, third: 55 },
  mistake: true,
  wrong,
  rows,
  draw,
  toml: (v) => `diameter = ${tomlNumber(v.D)}\n${pointToml(v)}\n\nexit = { surface = "${v.kind === 0 ? "outer" : "inner"}-cylinder", radius = ${tomlNumber(v.RS)}, offset = ${tomlNumber(v.x)} }\noverrun = ${tomlNumber(v.overrun)}`,
};
