// Figure 7: the window of the paper's program, with three columns: exact, by the paper's formulas, and as its program prints.
import { type Key, num, word } from "../language";
import { Handle, Label, ScaleBar } from "../marks";
import type { Drawing, Field, Figure, Row, Values } from "../model";
import { DIAMETER, FORM, POINT, SECOND, THIRD } from "./fields";
import { APPROACH, FEEDS, LENGTH, OVERRUN, type Plan, askPlan, drillToml } from "./plan";
import { Scheme, planeOf } from "./scheme";

interface Line {
  key: string;
  symbol: Key;
  name: Key;
  unit: Key;
  exact: number | null;
  formula: number | null;
  printed: number | null;
}

function linesOf(plan: Plan): Line[] {
  const { lengths: l, coordinates: z, paper, zones } = plan;
  const shown = paper?.printed_lengths ?? {};
  const length = (key: string, symbol: Key, name: Key, of: keyof Plan["lengths"]): Line => ({ key, symbol, name, unit: "u.mm", exact: l[of], formula: paper?.lengths[of] ?? null, printed: shown[of] ?? null });
  const height = (key: string, symbol: Key, name: Key, of: "Z_nvr1" | "Z_nvr2" | "Z_kvyh1" | "Z_kvyh2" | "Z_nvyh1" | "Z_nvyh2"): Line => ({ key, symbol, name, unit: "u.mm", exact: z[of], formula: paper?.coordinates[of] ?? null, printed: shown[of] ?? null });
  // Stretches of one name are one time of the paper's window.
  const time = (stage: string): number | null => {
    const all = zones.filter((zone) => zone.stage === stage);
    return all.length ? all.reduce((sum, zone) => sum + zone.time, 0) : null;
  };
  const times = paper?.times ?? null;
  const onWindow = paper?.printed_times ?? null;
  const plain = zones.every((zone) => ["entry", "steady", "exit"].includes(zone.stage));
  const at = (key: string, symbol: Key, name: Key, exact: number | null, i: number): Line => ({ key, symbol, name, unit: "u.s", exact: plain || i === 3 ? exact : null, formula: i < 3 ? (times?.[i] ?? null) : times ? times[0] + times[1] + times[2] : null, printed: onWindow?.[i] ?? null });
  return [
    length("L1", "s.Lvr1", "q2.L1", "L_vr1"),
    length("L2", "s.Lvr2", "q2.L2", "L_vr2"),
    length("L3", "s.Lvyh2", "q2.L2out", "L_vyh2"),
    height("Z1", "s.Zin1", "q2.Z1", "Z_nvr1"),
    height("Z2", "s.Zin2", "q2.Z2", "Z_nvr2"),
    height("Z3", "s.Zh3", "q2.Zout1", "Z_nvyh1"),
    height("Z4", "s.Zh4", "q2.Zout2", "Z_nvyh2"),
    height("K4", "s.Zk4", "q2.Zk2", "Z_kvyh2"),
    at("t1", "s.tIn", "q2.tIn", time("entry"), 0),
    at("t2", "s.tFull", "q2.tFull", time("steady"), 1),
    at("t3", "s.tOut", "q2.tOut", time("exit"), 2),
    at("t", "s.tAll", "q2.timeAll", plan.time, 3),
  ];
}

function rows(_: Values, data: unknown[]): Row[] {
  return linesOf(data[0] as Plan)
    .filter((line) => line.exact !== null)
    .map(({ key, symbol, name, unit, exact, printed }) => ({ key, symbol, name, unit, value: exact as number, digits: 3, ...(printed !== null && { printed }) }));
}

/** How many numbers differ between the columns, as they are shown. */
function differing(plan: Plan): number {
  return linesOf(plan).filter((line) => line.exact !== null && line.printed !== null && line.exact.toFixed(3) !== line.printed.toFixed(3)).length;
}

function draw(c: Drawing) {
  const { v, width } = c;
  const plan = c.data[0] as Plan;
  const { coordinates: z } = plan;
  const wide = width >= 560;
  const box = wide ? { left: 24, top: 30, width: width * 0.34, height: 400 } : { left: 60, top: 30, width: width - 120, height: 380 };
  const heights = [z.Z_nvr1, z.Z_nvr2, z.Z_nvyh1, z.Z_end].filter((h): h is number => h !== null);
  const plane = planeOf(v, heights, box);
  const kinds = ["thin", "second", "third", "cutter"];
  const table = wide ? { left: width * 0.34 + 70, top: 30 } : { left: 10, top: 470 };
  const room = width - table.left - 10;
  const columns = [table.left, table.left + room * 0.46, table.left + room * 0.73, table.left + room];
  const line = 28;
  const lines = linesOf(plan);
  return {
    height: Math.max(wide ? 480 : 0, table.top + (lines.length + 1) * line + 20),
    children: (
      <>
        <Label at={[8, 18]} text={word("f27.section")} />
        <Scheme v={v} plane={plane} at={heights.map((h, i) => ({ z: h, kind: kinds[i] }))} />
        <ScaleBar plane={plane} at={[14, box.top + box.height + 26]} />
        {[word("f27.exact"), word("f27.formula"), word("printed.yes")].map((text, i) => (
          <Label key={text} at={[columns[i + 1], table.top + 14]} text={text} anchor="end" />
        ))}
        {lines.map(({ key, symbol, exact, formula, printed }, i) => {
          const y = table.top + (i + 1) * line + 14;
          const off = (n: number | null) => n !== null && exact !== null && n.toFixed(3) !== exact.toFixed(3);
          return (
            <g key={key} data-line={key}>
              <path d={`M${table.left} ${y - 18}H${table.left + room}`} class="grid" />
              <Label at={[columns[0], y]} symbol={symbol} />
              {exact === null ? <Label at={[columns[1], y]} text="–" anchor="end" /> : <Label at={[columns[1], y]} row={key} c={c} anchor="end" />}
              <Label at={[columns[2], y]} text={formula === null ? "–" : num(formula, 3)} class={off(formula) ? "bad" : ""} anchor="end" />
              <Label at={[columns[3], y]} text={printed === null ? "–" : num(printed, 3)} class={off(printed) ? "bad" : ""} anchor="end" />
            </g>
          );
        })}
        <Handle at={plane.at([0, -v.L])} name={word("q2.Lface")} value={v.L} min={1} max={150} told={`L ${v.L}`} move={(to) => c.set({ L: -plane.back(to)[1] })} step={(dx, dy) => c.set({ L: c.now().L - dy + dx })} />
      </>
    ),
  };
}

const surface = (side: "In" | "Out"): Field[] => [
  { key: `kind${side}`, symbol: "s.RS", name: side === "In" ? "f27.entry" : "f27.exit", min: 0, max: 2, step: 1, digits: 0, options: ["f27.plane", "f27.shaft", "f27.bore"] },
  { key: `RS${side.toLowerCase()}`, symbol: "s.RS", name: "q2.RS", unit: "u.mm", min: 5, max: 500, step: 1, digits: 2, saved: [26, 50, 200], counts: (v) => v[`kind${side}`] > 0 },
  { key: `x${side}`, symbol: "s.x", name: "q2.x", unit: "u.mm", min: -100, max: 100, step: 0.5, digits: 2, saved: [5, 12], counts: (v) => v[`kind${side}`] > 0 },
  { key: `alpha${side}`, symbol: "s.alpha", name: "q2.alpha", unit: "u.deg", min: -60, max: 60, step: 1, digits: 2, saved: [20, 40], counts: (v) => v[`kind${side}`] === 0 },
];

function Program({ data }: { data: unknown[] }) {
  const { program, findings } = data[0] as Plan;
  return (
    <>
      <h3>{word("f27.program")}</h3>
      <pre class="program" tabIndex={0} role="region" aria-label={word("f27.program")} translate={false} data-program>
        {program}
      </pre>
      {findings.length > 0 && (
        <ul class="claims" lang="en" translate={false}>
          {findings.map((finding) => (
            <li key={finding}>{finding}</li>
          ))}
        </ul>
      )}
    </>
  );
}

export const fig27: Figure = {
  id: "2.7",
  words: "f27",
  after: "7",
  fields: [
    { ...DIAMETER, saved: [10, 16, 25] },
    FORM,
    { ...POINT, saved: [90, 130, 140] },
    SECOND,
    THIRD,
    ...surface("In"),
    ...surface("Out"),
    LENGTH,
    APPROACH,
    OVERRUN,
    { key: "vc", symbol: "s.vc", name: "q2.vc", unit: "u.mMin", min: 1, max: 500, step: 1, digits: 2, saved: [15, 40, 80] },
    ...FEEDS,
  ],
  start: { D: 20, form: 1, point: 118, second: 70, third: 55, kindIn: 0, RSin: 100, xIn: 0, alphaIn: 0, kindOut: 1, RSout: 100, xOut: 0, alphaOut: 0, L: 50, approach: 2, overrun: 2, vc: 25, fIn: 0.6, fFull: 0.8, fOut: 0.2 },
  mistake: true,
  asks: (v) => [askPlan(v)],
  more: (_, data) => {
    const plan = data[0] as Plan;
    const entry = linesOf(plan).find((line) => line.key === "t1");
    const short = entry && entry.exact !== null && entry.printed !== null && entry.printed < entry.exact - 0.0005;
    return { off: String(differing(plan)), entry: short ? word("f27.short", { a: num(entry.printed as number, 3), b: num(entry.exact as number, 3) }) : "" };
  },
  rows,
  draw,
  below: (data) => <Program data={data} />,
  toml: drillToml,
};
