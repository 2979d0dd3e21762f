// Figure 5: the largest exit angle over the turn of the part, and the burr length, which is what is made small.
import { word } from "../language";
import { Axes, Handle, type Scale } from "../marks";
import { type Drawing, type Figure, type Row, type Values, tomlNumber } from "../model";
import type { Box } from "../plane";
import { isWide, lengths, survey } from "./lengths";
import { CUTTER, LEAST } from "./part";

function rows(v: Values): Row[] {
  const here = lengths(v.gamma, v.c, v.psi0, 1440);
  const all = survey(v).filter((p) => !p.wide);
  const best = all.reduce((a, b) => (b.bad < a.bad ? b : a), all[0]);
  const found: Row[] = [
    { key: "bad", symbol: "s.Lbad", name: "q4.badLength", unit: "u.mm", value: here.bad, digits: 2 },
    { key: "largest", symbol: "s.Psimax", name: "q4.largest", unit: "u.deg", value: here.largest, digits: 1 },
    { key: "reach", symbol: "s.reach", name: "q4.reach", unit: "u.mm", value: here.reach, digits: 2 },
    { key: "least", symbol: "s.Lmin", name: "q4.leastLength", unit: "u.mm", value: LEAST.value, digits: 3 },
    { key: "bound", symbol: "s.Lbound", name: "q4.bound", unit: "u.mm", value: LEAST.lower_bound, digits: 4 },
  ];
  if (!best) return found;
  return [...found, { key: "here", symbol: "s.gammaMin", name: "q4.bestTurn", unit: "u.deg", value: best.gamma, digits: 0 }, { key: "hereLength", symbol: "s.Lhere", name: "q4.bestLength", unit: "u.mm", value: lengths(best.gamma, v.c, v.psi0, 1440).bad, digits: 1 }];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const all = survey(v);
  const upper: Box = { left: 56, top: 34, width: width - 76, height: 110 };
  const lower: Box = { left: 56, top: 224, width: width - 76, height: 190 };
  // The least over all placements is in the chart, wherever the curve is.
  const lengthsSeen = [LEAST.value, ...all.filter((p) => !p.wide).map((p) => p.bad)];
  const [low, most] = [Math.min(...lengthsSeen) * 0.9, Math.max(...lengthsSeen) * 1.05];
  // Where the part is too wide there is no curve.
  const line = (of: (p: (typeof all)[number]) => number, s: Scale) => all.map((p, i) => (p.wide ? "" : `${i === 0 || all[i - 1].wide ? "M" : "L"}${s.x(p.gamma).toFixed(1)} ${s.y(of(p)).toFixed(1)}`)).join("");
  const wide = (s: Scale, box: Box) => all.filter((p) => p.wide).map((p) => `M${s.x(p.gamma - 0.5).toFixed(1)} ${box.top}H${s.x(Math.min(360, p.gamma + 0.5)).toFixed(1)}V${box.top + box.height}H${s.x(p.gamma - 0.5).toFixed(1)}Z`).join("");
  const here = c.rows.get("bad")?.value ?? 0;
  return {
    height: 466,
    children: (
      <>
        <Axes box={upper} x={[0, 360]} y={[0, 200]} xName="" yName={word("f45.largest")}>
          {(s) => (
            <>
              <path d={wide(s, upper)} class="hatched" />
              <path d={line((p) => p.largest, s)} class="third" />
              <path d={`M${s.x(v.gamma)} ${upper.top}V${upper.top + upper.height}`} class="dashed" />
            </>
          )}
        </Axes>
        <Axes box={lower} x={[0, 360]} y={[low, most]} xName={word("f45.gamma")} yName={word("f45.length")}>
          {(s) => (
            <>
              <path d={wide(s, lower)} class="hatched" />
              <path d={line((p) => p.bad, s)} class="curve" />
              <path d={`M${s.x(0)} ${s.y(LEAST.value)}H${s.x(360)}`} class="second" />
              <path d={`M${s.x(v.gamma)} ${lower.top}V${lower.top + lower.height}`} class="dashed" />
              <Handle
                at={[s.x(v.gamma), s.y(Math.max(low, Math.min(most, here)))]}
                name={word("q4.gamma")}
                value={v.gamma}
                min={0}
                max={360}
                told={`γ ${c.text("gamma")}°, ${c.text("bad")}`}
                move={(to) => c.set({ gamma: ((to[0] - lower.left) / lower.width) * 360 })}
                step={(dx, dy) => c.set({ gamma: (v.gamma + dx + dy + 360) % 360 })}
              />
            </>
          )}
        </Axes>
      </>
    ),
  };
}

export const fig45: Figure = {
  id: "4.5",
  words: "f45",
  after: "5",
  fields: [
    { key: "gamma", symbol: "s.gamma", name: "q4.gamma", unit: "u.deg", min: 0, max: 360, step: 1, digits: 4 },
    { key: "c", symbol: "s.c", name: "q4.c", unit: "u.mm", min: -60, max: 60, step: 0.25, digits: 4 },
  ],
  start: { gamma: 20, c: 0, psi0: 90 },
  wrong: (v) => (Math.abs(v.c) > CUTTER ? "f45.outside" : null),
  warns: (v) => (isWide(lengths(v.gamma, v.c, v.psi0, 72).reach) ? "f45.wide" : null),
  rows,
  draw,
  toml: (v) => `placement = { angle = ${tomlNumber(v.gamma)}, offset = ${tomlNumber(v.c)} }`,
};
