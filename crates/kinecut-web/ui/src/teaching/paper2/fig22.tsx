// Figure 2: the general scheme. A drill in four positions, all lengths, and Z in the frames of entry and exit.
import { num, word } from "../language";
import { Dimension, Handle, Label, ScaleBar } from "../marks";
import type { Drawing, Figure, Point, Row, Values } from "../model";
import { Plane } from "../plane";
import { DIAMETER, FORM, POINT, SECOND, THIRD } from "./fields";
import { outline, profile } from "./geometry";
import { APPROACH, FEEDS, LENGTH, OVERRUN, type Plan, askPlan, drillToml, shareAt, timeAt } from "./plan";

const rad = (n: number) => (n * Math.PI) / 180;

function place(v: Values, plan: Plan): number {
  const { Z_nvr1, Z_end } = plan.coordinates;
  return Math.max(Z_end, Math.min(Z_nvr1, v.Z));
}

function rows(v: Values, data: unknown[]): Row[] {
  const plan = data[0] as Plan;
  const { lengths: l, coordinates: c } = plan;
  const z = place(v, plan);
  const share = shareAt(plan, c.Z_nvr1 - z);
  const now = timeAt(plan, z);
  const mm = (key: string, symbol: Row["symbol"], name: Row["name"], value: number | null): Row[] => (value === null ? [] : [{ key, symbol, name, unit: "u.mm", value, digits: 3 }]);
  return [
    ...mm("L1", "s.Lvr1", "q2.L1", l.L_vr1),
    ...mm("L2", "s.Lvyh2", "q2.L2out", l.L_vyh2),
    ...mm("Lin", "s.Lvr", "q2.Lin", l.L_vr),
    ...mm("Lfull", "s.Lust", "q2.Lfull", l.L_ust),
    ...mm("Lout", "s.Lvyh", "q2.Lout", l.L_vyh),
    ...mm("Lall", "s.Lrx", "q2.Lall", l.L_rx),
    ...mm("Z1", "s.Zin1", "q2.Z1", c.Z_nvr1),
    ...mm("Z2", "s.Zin2", "q2.Z2", c.Z_nvr2),
    ...mm("Z3", "s.Zh3", "q2.Zout1", c.Z_nvyh1),
    ...mm("Z4", "s.Zh4", "q2.Zout2", c.Z_end),
    ...mm("K3", "s.Zk3", "q2.Zk1", c.Z_kvyh1),
    ...mm("K4", "s.Zk4", "q2.Zk2", c.Z_kvyh2),
    ...mm("Z", "s.Z", "q2.Znow", z),
    ...(share === null ? [] : [{ key: "share", symbol: "s.share2", name: "q2.share", unit: "u.percent", value: 100 * share, digits: 1 } as Row]),
    { key: "feed", symbol: "s.f", name: "q2.feedNow", unit: "u.mmRev", value: now.feed, digits: 3 },
    { key: "time", symbol: "s.t", name: "q2.timeNow", unit: "u.s", value: now.time, digits: 3 },
    { key: "all", symbol: "s.tAll", name: "q2.timeAll", unit: "u.s", value: plan.time, digits: 3 },
    { key: "limit", symbol: "s.alphaMax", name: "q2.limit", unit: "u.deg", value: 90 - v.point / 2, digits: 2 },
  ];
}

/** Whether the tip comes through the exit face first: break-through is at the face on the axis then. */
function tipFirst(v: Values, plan: Plan): boolean {
  return Math.abs((plan.coordinates.Z_nvyh1 ?? 0) + v.L) < 1e-6;
}

function draw(c: Drawing) {
  const { v, width } = c;
  const plan = c.data[0] as Plan;
  const { coordinates: z } = plan;
  const corners = profile(v);
  const R = v.D / 2;
  const L1 = corners[corners.length - 1][1];
  const top = Math.max(z.Z_nvr1 + L1, 0) + 0.5 * R;
  const slope = Math.tan(rad(v.alphaOut));
  const reach = 2.1 * R;
  const low = Math.min(z.Z_end, -v.L - reach * Math.abs(slope)) - 0.4 * R;
  const wide = width >= 560;
  const left = wide ? 150 : 64;
  const right = wide ? 190 : 128;
  const tall = Math.min(620, Math.max(380, ((width - left - right) * (top - low)) / (2 * reach)));
  const plane = new Plane([-reach, low], [reach, top], { left, top: 30, width: width - left - right, height: tall });
  const [x0, x1] = [plane.x(-reach), plane.x(reach)];
  const face = (u: number): Point => [u, -v.L + u * slope];
  const body = (from: number, to: number): Point[] => [[from, 0], [to, 0], face(to), face(from)];
  const levels: [string, string, number | null][] = [
    ["Z1", word("f22.start"), z.Z_nvr1],
    ["Z2", word("f22.full"), z.Z_nvr2],
    ["Z3", word("f22.through"), z.Z_nvyh1],
    ["Z4", word("f22.end"), z.Z_end],
  ];
  const shown = levels.filter((l): l is [string, string, number] => l[2] !== null);
  // Names of heights that are near each other go apart.
  let last = -Infinity;
  const at = [...shown].sort((a, b) => b[2] - a[2]).map(([key, , height]) => {
    last = Math.max(last + 38, plane.y(height));
    return [key, last] as const;
  });
  const heights = new Map<string, number>(at);
  const now = place(v, plan);
  const chain: [string, Row["symbol"], number, number][] = [
    ["Lin", "s.Lvr", z.Z_nvr1, z.Z_nvr2],
    ["Lfull", "s.Lust", z.Z_nvr2, z.Z_nvyh1 ?? z.Z_nvr2],
    ["Lout", "s.Lvyh", z.Z_nvyh1 ?? z.Z_nvr2, z.Z_end],
  ];
  const handleAt: Point = [0.8 * reach, face(0.8 * reach)[1]];
  return {
    height: tall + 62,
    children: (
      <>
        <path d={plane.line(body(-reach, -R), true)} class="hatched" />
        <path d={plane.line(body(R, reach), true)} class="hatched" />
        <path d={`M${x0} ${plane.y(0)}H${x1}`} class="part" />
        <path d={plane.line([face(-reach), face(reach)])} class="part" />
        <path d={`M${plane.x(-R)} ${plane.y(0)}L${plane.at(face(-R)).join(" ")}M${plane.x(R)} ${plane.y(0)}L${plane.at(face(R)).join(" ")}`} class="netline" />
        <path d={`M${plane.x(0)} 22V${plane.y(low) + 10}`} class="axis" />
        {shown.map(([key, , height]) => (
          <path key={key} d={plane.line(outline(corners, 0, height, Math.max(top, height + L1)), true)} class={key === "Z4" ? "fourth" : key === "Z2" ? "second" : key === "Z3" ? "third" : "thin"} />
        ))}
        <path d={plane.line(outline(corners, 0, now, top), true)} class="cutter" />
        {shown.map(([key, name, height]) => (
          <g key={key}>
            <path d={`M${plane.x(0)} ${plane.y(height)}H${x1 + 6}L${x1 + 18} ${heights.get(key)}`} class="dotted" />
            <Label at={[x1 + 22, (heights.get(key) ?? 0) - 2]} symbol="s.Z" row={key} c={c} />
            <Label at={[x1 + 22, (heights.get(key) ?? 0) + 14]} text={name} />
          </g>
        ))}
        {chain.map(([key, symbol, from, to], i) => {
          const x = left - (wide ? 26 : 12) - (to > from ? 16 : 0);
          return (
            <g key={key}>
              <Dimension from={[x, plane.y(from)]} to={[x, plane.y(to)]} />
              <Label at={[x - 8, (plane.y(from) + plane.y(to)) / 2 + (i === 1 ? 4 : i ? 8 : 0)]} symbol={symbol} row={wide ? key : undefined} c={c} anchor="end" />
            </g>
          );
        })}
        <Label at={[x0 + 4, plane.y(0) - 6]} symbol="s.Wh" />
        <Label at={[x0 + 4, plane.at(face(-reach))[1] + 16]} symbol="s.Wk" />
        <ScaleBar plane={plane} at={[14, tall + 52]} />
        <Handle
          at={plane.at([0, now])}
          name={word("f22.drill")}
          value={Number(now.toFixed(2))}
          min={Number(z.Z_end.toFixed(2))}
          max={Number(z.Z_nvr1.toFixed(2))}
          told={`Z ${c.text("Z")}, ${c.text("share")} %`}
          move={(to) => c.set({ Z: plane.back(to)[1] })}
          step={(dx, dy) => c.set({ Z: place(c.now(), plan) + dx + dy })}
        />
        <Handle
          at={plane.at(handleAt)}
          name={word("q2.alphaOut")}
          value={v.alphaOut}
          min={-50}
          max={50}
          told={`α ${num(v.alphaOut, 1, true)}°`}
          move={(to) => {
            const [x, y] = plane.back(to);
            c.set({ alphaOut: (Math.atan2(y + v.L, Math.max(1, x)) * 180) / Math.PI });
          }}
          step={(dx, dy) => c.set({ alphaOut: c.now().alphaOut + dx + dy })}
        />
      </>
    ),
  };
}

export const fig22: Figure = {
  id: "2.2",
  words: "f22",
  after: "2",
  fields: [
    { key: "alphaOut", symbol: "s.alpha", name: "q2.alphaOut", unit: "u.deg", min: -50, max: 50, step: 1, digits: 2, saved: [-40, -35, -30, -20, -10, 0, 5, 10, 15, 25, 30, 31, 32, 35, 40, 45] },
    { key: "Z", symbol: "s.Z", name: "q2.Znow", unit: "u.mm", min: -300, max: 60, step: 1, digits: 3, free: true },
    LENGTH,
    APPROACH,
    OVERRUN,
    ...FEEDS,
    FORM,
    { ...DIAMETER, saved: [10, 16, 25] },
    { ...POINT, saved: [90, 130, 140] },
    SECOND,
    THIRD,
  ],
  start: { alphaOut: 20, Z: -20, L: 50, approach: 2, overrun: 2, fIn: 0.6, fFull: 0.8, fOut: 0.2, form: 0, D: 20, point: 118, second: 70, third: 55 },
  asks: (v) => [askPlan(v)],
  more: (v, data) => {
    const plan = data[0] as Plan;
    return { first: word(tipFirst(v, plan) ? "f22.tip" : "f22.corner"), overlap: plan.lengths.L_ust < 0 ? word("f22.overlap") : "" };
  },
  rows,
  draw,
  toml: drillToml,
};
