// Figure 4: triangles that make the length of a drill point.
import { type Key, word } from "../language";
import { Dot, Handle, Label, ScaleBar, Words } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { Plane } from "../plane";
import { DIAMETER, FORM, POINT, SECOND, THIRD, pointToml } from "./fields";
import { pointLength, profile } from "./geometry";

const LETTERS: Key[] = ["s.pC", "s.pE", "s.pG"];
const FEET: Key[] = ["s.pB", "s.pD", "s.pF"];
const TERMS: Key[] = ["s.AB", "s.CD", "s.EF"];

function terms(v: Values): number[] {
  const corners = profile(v);
  return corners.slice(1).map(([, z], i) => z - corners[i][1]);
}

function rows(v: Values): Row[] {
  const single = v.D / 2 / Math.tan((v.point * Math.PI) / 360);
  return [
    ...terms(v).map((value, i): Row => ({ key: `term${i}`, symbol: TERMS[i], name: `q2.term${i}` as Key, unit: "u.mm", value, digits: 3 })),
    { key: "L1", symbol: "s.Lvr1", name: "q2.L1", unit: "u.mm", value: pointLength(v), digits: 3 },
    { key: "single", symbol: "s.Lsingle", name: "q2.single", unit: "u.mm", value: single, digits: 3 },
    { key: "limit", symbol: "s.alphaMax", name: "q2.limit", unit: "u.deg", value: 90 - v.point / 2, digits: 2 },
  ];
}

/** A second edge that is too long for the diameter leaves nothing of the first. */
function wrong(v: Values): Key | null {
  return profile(v).some(([r], i, all) => i > 0 && r <= all[i - 1][0]) ? "f24.tooLong" : v.form > 0 && v.second > v.point ? "f24.blunter" : v.form === 2 && v.third > v.second ? "f24.blunter" : null;
}

function draw(c: Drawing) {
  const { v, width } = c;
  const corners = profile(v);
  const L1 = Math.max(1, pointLength(v));
  const R = v.D / 2;
  const tall = 380;
  const plane = new Plane([-R * 1.15, -L1 * 0.15 - R * 0.1], [R * 1.4, L1 + R * 0.55], { left: 8, top: 8, width: width - 100, height: tall });
  const A = plane.at([0, 0]);
  const half = (side: 1 | -1) => corners.map(([r, z]) => plane.at([side * r, z]));
  const top = plane.y(L1 + R * 0.45);
  const line = (points: Point[]) => points.map((p, i) => `${i ? "L" : "M"}${p[0].toFixed(2)} ${p[1].toFixed(2)}`).join("");
  const right = half(1);
  const rim = right[right.length - 1];
  const ok = wrong(v) === null;
  const styles = ["second", "third", "fourth"];
  return {
    height: tall + (ok ? 84 : 20),
    children: (
      <>
        <path d={`${line([...half(-1).reverse(), ...right.slice(1)])}V${top}H${half(-1)[half(-1).length - 1][0]}Z`} class="cutter" />
        <path d={`M${A[0]} ${plane.y(-L1 * 0.12)}V${top - 10}`} class="axis" />
        <path d={line(right)} class="part" />
        {ok &&
          corners.slice(1).map(([r, z], i) => {
            const [r0, z0] = corners[i];
            // The foot: above the corner before, at the height of this one.
            const foot = plane.at([r0, z]);
            const before = plane.at([r0, z0]);
            const corner = plane.at([r, z]);
            return (
              <g key={i}>
                <path d={line([before, foot])} class={styles[i]} />
                <path d={line([foot, corner])} />
                <path d={`M${foot[0] + 8} ${foot[1]}v8h-8`} />
                <Dot at={foot} symbol={FEET[i]} dx={-8} dy={-6} anchor="end" />
                <Dot at={corner} symbol={LETTERS[i]} dx={10} dy={-6} />
                <Label at={[before[0] - 8, (before[1] + foot[1]) / 2 + 4]} symbol={TERMS[i]} row={`term${i}`} c={c} anchor="end" />
              </g>
            );
          })}
        <Dot at={A} symbol="s.pA" dx={-8} dy={16} anchor="end" />
        <path d={`M${plane.x(R * 1.3)} ${A[1]}V${rim[1]}M${A[0]} ${A[1]}H${plane.x(R * 1.36)}M${rim[0]} ${rim[1]}H${plane.x(R * 1.36)}`} class="dotted" />
        <Label at={[plane.x(R * 1.3) + 6, (A[1] + rim[1]) / 2]} symbol="s.Lvr1" row={ok ? "L1" : undefined} c={c} />
        <Label at={[plane.x(0) + 30, A[1] - 34]} symbol="s.halfPhi" />
        <ScaleBar plane={plane} at={[14, tall + 8]} />
        {ok && <Formula c={c} y={tall + 40} />}
        <Handle at={rim} name={word("q2.D")} value={v.D} min={1} max={100} told={`${c.text("D")}`} move={(to) => c.set({ D: 2 * Math.abs(plane.back(to)[0]) })} step={(dx) => c.set({ D: v.D + dx })} />
        <Handle
          at={right[1].map((n, i) => (corners.length === 2 ? (n + A[i]) / 2 : n)) as Point}
          name={word("q2.point")}
          value={v.point}
          min={60}
          max={170}
          told={`2φ ${c.text("point")}°`}
          move={(to) => {
            const [x, z] = plane.back(to);
            c.set({ point: (Math.atan2(Math.abs(x), Math.max(0.001, z)) * 360) / Math.PI });
          }}
          step={(dx, dy) => c.set({ point: v.point + dx - dy })}
        />
      </>
    ),
  };
}

/** The formula, a term a leg, each in the line of its leg. */
function Formula({ c, y }: { c: Drawing; y: number }) {
  const all = terms(c.v);
  const styles = ["second", "third", "fourth"];
  return (
    <>
      <Label at={[14, y + 4]} symbol="s.Lvr1" text="=" />
      {all.map((_, i) => (
        <g key={i}>
          <path d={`M${64 + i * 96} ${y + 12}h62`} class={styles[i]} />
          <text x={64 + i * 96} y={y + 4} class="label" data-row={`term${i}`}>
            {c.text(`term${i}`)}
          </text>
          <text x={64 + i * 96 + 72} y={y + 4} class="label">
            {i + 1 < all.length ? "+" : "="}
          </text>
        </g>
      ))}
      <text x={64 + all.length * 96} y={y + 4} class="label strong" data-row="L1">
        {c.text("L1")}
      </text>
      <Words at={[14, y + 34]} text={word(`f24.formula${c.v.form}` as Key)} />
    </>
  );
}

export const fig24: Figure = {
  id: "2.4",
  words: "f24",
  after: "4",
  fields: [FORM, DIAMETER, POINT, SECOND, THIRD],
  start: { form: 1, D: 20, point: 118, second: 70, third: 55 },
  wrong,
  rows,
  draw,
  toml: (v) => `diameter = ${tomlNumber(v.D)}\n${pointToml(v)}`,
};
