// Figure 1: what a dialog of a CAM system asks for, and what is computed of the same hole.
import { type Key, num, word } from "../language";
import { Handle, Label, ScaleBar } from "../marks";
import type { Drawing, Figure, Row, Values } from "../model";
import { DIAMETER, FORM, POINT, SECOND, THIRD } from "./fields";
import { APPROACH, FEEDS, LENGTH, type Plan, askPlan, drillToml } from "./plan";
import { Scheme, planeOf } from "./scheme";

/** Without an overrun the exit ends where the last corner leaves. */
const asked = (v: Values): Values => ({ ...v, overrun: 0, kindOut: 1, RSout: v.RS, xOut: v.x });

/** Where the drill ends by what is typed: so far below break-through. */
function typedEnd(v: Values, plan: Plan): number {
  return (plan.coordinates.Z_nvyh1 ?? 0) - v.b;
}

function rows(v: Values, data: unknown[]): Row[] {
  const plan = data[0] as Plan;
  const { lengths: l, coordinates: c } = plan;
  const need = l.L_vyh ?? 0;
  const mm = (key: string, symbol: Key, name: Key, value: number | null): Row[] => (value === null ? [] : [{ key, symbol, name, unit: "u.mm", value, digits: 3 }]);
  return [
    ...mm("Z1", "s.Zin1", "q2.Z1", c.Z_nvr1),
    ...mm("Z2", "s.Zin2", "q2.Z2", c.Z_nvr2),
    ...mm("Z3", "s.Zh3", "q2.Zout1", c.Z_nvyh1),
    ...mm("Z4", "s.Zh4", "q2.Zleast", c.Z_end),
    ...mm("need", "s.bMin", "q2.need", need),
    ...mm("typed", "s.Zb", "q2.Ztyped", typedEnd(v, plan)),
    ...mm("short", "s.shortB", "q2.shortB", Math.max(0, need - v.b)),
    { key: "time", symbol: "s.tAll", name: "q2.timeAll", unit: "u.s", value: plan.time, digits: 3 },
    ...mm("first", "s.rFirst", "q2.radius", plan.first_contact_radius),
    ...mm("last", "s.rLast", "q2.radiusLast", plan.last_contact_radius),
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const plan = c.data[0] as Plan;
  const need = plan.lengths.L_vyh ?? 0;
  const end = typedEnd(v, plan);
  const wide = width >= 560;
  const form = { left: 8, top: 34, width: wide ? width * 0.56 : width - 16 };
  const typed: [Key, string][] = [
    ["q2.D", `${num(v.D, 2, true)} ${word("u.mm")}`],
    ["f21.depth", `${num(v.L, 2, true)} ${word("u.mm")}`],
    ["f21.amount", `${num(v.b, 2, true)} ${word("u.mm")}`],
    ["q2.approach", `${num(v.approach, 2, true)} ${word("u.mm")}`],
    ["f21.feeds", `${[v.fIn, v.fFull, v.fOut].map((f) => num(f, 2, true)).join("; ")}`],
  ];
  const computed: [Key, string][] = [
    ["f22.start", "Z1"],
    ["f22.full", "Z2"],
    ["f22.through", "Z3"],
    ["q2.need", "need"],
    ["q2.Zleast", "Z4"],
    ["q2.timeAll", "time"],
  ];
  const line = 34;
  const formHeight = (typed.length + computed.length) * line + 70;
  const box = wide ? { left: form.left + form.width + 24, top: 34, width: width - form.width - 40, height: formHeight - 20 } : { left: 40, top: formHeight + 90, width: width - 80, height: 380 };
  const plane = planeOf(asked(v), [end, plan.coordinates.Z_end, plan.coordinates.Z_nvr1], box);
  const slider = { left: 24, width: form.width - 48, y: formHeight + 24 };
  const most = Math.max(1.4 * need, v.D * 0.6, v.b);
  const sx = (b: number) => slider.left + (slider.width * b) / most;
  const out = v.b >= need - 1e-9;
  return {
    height: wide ? formHeight + 74 : formHeight + 510,
    children: (
      <>
        <Label at={[form.left, 20]} text={word("f21.byHand")} />
        {typed.map(([name, value], i) => (
          <g key={name}>
            <rect x={form.left + form.width * 0.62} y={form.top + i * line} width={form.width * 0.38} height="26" class="box" />
            <Label at={[form.left + 4, form.top + i * line + 18]} text={word(name)} />
            <Label at={[form.left + form.width - 8, form.top + i * line + 18]} text={value} anchor="end" />
          </g>
        ))}
        <Label at={[form.left, form.top + typed.length * line + 22]} text={word("f21.computed")} />
        {computed.map(([name, row], i) => {
          const y = form.top + typed.length * line + 34 + i * line;
          return (
            <g key={name}>
              <rect x={form.left + form.width * 0.62} y={y} width={form.width * 0.38} height="26" class="box on" />
              <Label at={[form.left + 4, y + 18]} text={word(name)} />
              <Label at={[form.left + form.width - 8, y + 18]} row={row} c={c} anchor="end" />
            </g>
          );
        })}
        <path d={`M${slider.left} ${slider.y}H${slider.left + slider.width}`} class="part" />
        <path d={`M${sx(need)} ${slider.y - 12}v24`} class="second" />
        <Label at={[sx(need), slider.y + 28]} symbol="s.bMin" row="need" c={c} anchor="middle" />
        <Handle at={[sx(v.b), slider.y]} name={word("f21.amount")} value={v.b} min={0} max={60} told={`b ${v.b}, ${word(out ? "f21.out" : "f21.inside")}`} move={(to) => c.set({ b: ((to[0] - slider.left) / slider.width) * most })} step={(dx, dy) => c.set({ b: c.now().b + 0.5 * (dx + dy) })} />
        <Label at={[box.left, 20 + (wide ? 0 : box.top - 34)]} text={word(out ? "f21.out" : "f21.inside")} class={out ? "" : "bad"} />
        <Scheme v={asked(v)} plane={plane} at={[{ z: plan.coordinates.Z_end, kind: "third" }, { z: end, kind: "cutter" }]} />
        {!out && <path d={`M${plane.x(-v.D / 2)} ${plane.y(end + plan.lengths.L_vr1)}H${plane.x(v.D / 2)}`} class="wrongline" />}
        <ScaleBar plane={plane} at={[box.left, box.top + box.height + 24]} />
      </>
    ),
  };
}

export const fig21: Figure = {
  id: "2.1",
  words: "f21",
  after: "1",
  fields: [
    { key: "b", symbol: "s.bAmount", name: "f21.amount", unit: "u.mm", min: 0, max: 60, step: 0.5, digits: 3, free: true },
    { ...LENGTH, saved: [20, 30, 40, 60, 80] },
    { key: "RS", symbol: "s.RS", name: "q2.RS", unit: "u.mm", min: 5, max: 500, step: 1, digits: 2, saved: [20, 26, 30, 50, 200] },
    { key: "x", symbol: "s.x", name: "q2.x", unit: "u.mm", min: -100, max: 100, step: 0.5, digits: 2, saved: [5, 10, 20, 40] },
    { ...APPROACH, saved: [1, 3] },
    ...FEEDS,
    FORM,
    { ...DIAMETER, saved: [10, 16, 25] },
    { ...POINT, saved: [90, 130, 140] },
    SECOND,
    THIRD,
  ],
  start: { b: 6, L: 50, RS: 100, x: 0, approach: 2, fIn: 0.6, fFull: 0.8, fOut: 0.2, form: 1, D: 20, point: 118, second: 70, third: 55 },
  asks: (v) => [askPlan(asked(v))],
  more: (v, data) => ({ out: word(v.b >= ((data[0] as Plan).lengths.L_vyh ?? 0) - 1e-9 ? "f21.out" : "f21.inside"), rule: num(0.3 * v.D, 2, true) }),
  rows,
  draw,
  toml: (v) => drillToml(asked(v)),
};
