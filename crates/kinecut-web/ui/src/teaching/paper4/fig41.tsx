// Figure 1: edge length over the exit angle, with the threshold of the primary burr. No height of a burr is drawn: none was measured.
import { word } from "../language";
import { Axes, Handle, Label, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane, turned } from "../plane";
import { angleAt, isWide, lengths } from "./lengths";
import { COVER, CUTTER, LEAST, along, turnedEdge } from "./part";

const SAMPLES = 1440;

function rows(v: Values): Row[] {
  const all = lengths(v.gamma, v.c, v.psi0, SAMPLES);
  return [
    { key: "bad", symbol: "s.Lbad", name: "q4.badLength", unit: "u.mm", value: all.bad, digits: 2 },
    { key: "good", symbol: "s.Lgood", name: "q4.goodLength", unit: "u.mm", value: all.exits - all.bad, digits: 2 },
    { key: "exits", symbol: "s.Lexit", name: "q4.exitLength", unit: "u.mm", value: all.exits, digits: 2 },
    { key: "entries", symbol: "s.Lentry", name: "q4.entryLength", unit: "u.mm", value: all.entries, digits: 2 },
    { key: "share", symbol: "s.share", name: "q4.share", unit: "u.percent", value: all.exits > 0 ? (100 * all.bad) / all.exits : NaN, digits: 1 },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const wide = width >= 560;
  const side = wide ? width * 0.4 : Math.min(width - 16, 320);
  const map: Box = { left: 8, top: 8, width: side, height: side };
  const box: Box = wide ? { left: side + 62, top: 34, width: width - side - 84, height: side - 70 } : { left: 50, top: side + 60, width: width - 70, height: 200 };
  const all = lengths(v.gamma, v.c, v.psi0, 360);
  const top = Math.max(20, ...all.bins) * 1.1;
  return {
    height: wide ? side + 16 : side + 312,
    children: (
      <>
        <Plan c={c} box={map} />
        <Axes box={box} x={[0, 180]} y={[0, top]} xName={word("f41.x")} yName={word("f41.y")}>
          {(s) => (
            <>
              <path d={`M${s.x(0)} ${box.top}H${s.x(v.psi0)}V${box.top + box.height}H${s.x(0)}Z`} class="hatched" />
              {all.bins.map((n, i) => {
                // Of the bar in which the threshold lies, the part below it is bad.
                const bad = Math.min(n, Math.max(0, all.bad - all.bins.slice(0, i).reduce((sum, m) => sum + m, 0)));
                const bar = (from: number, to: number) => `M${s.x(10 * i) + 1} ${s.y(from)}V${s.y(to)}H${s.x(10 * i + 10) - 1}V${s.y(from)}Z`;
                return (
                  <g key={i}>
                    {bad > 0 && <path d={bar(0, bad)} class="badBar" />}
                    {n > bad && <path d={bar(bad, n)} class="bar" />}
                  </g>
                );
              })}
              <path d={`M${s.x(v.psi0)} ${box.top}V${box.top + box.height}`} class="second" />
              <Label at={[s.x(v.psi0) + (v.psi0 > 120 ? -8 : 8), box.top + 14]} symbol="s.Psi0" anchor={v.psi0 > 120 ? "end" : "start"} />
              <Label at={[s.x(v.psi0 / 2), box.top + 14]} symbol="s.Lbad" row="bad" c={c} anchor="middle" />
              <Handle
                at={[s.x(v.psi0), box.top + box.height * 0.5]}
                name={word("q4.psi0")}
                value={v.psi0}
                min={1}
                max={179}
                told={`Ψ₀ ${c.text("psi0")}°`}
                move={(to) => c.set({ psi0: ((to[0] - box.left) / box.width) * 180 })}
                step={(dx, dy) => c.set({ psi0: v.psi0 + dx + dy })}
              />
            </>
          )}
        </Axes>
      </>
    ),
  };
}

/** The part under the cutter: bad exits thick and red, good ones thin and full, entries dotted. */
function Plan({ c, box }: { c: Drawing; box: Box }) {
  const { v } = c;
  const plane = new Plane([-66, -66], [66, 66], box);
  const gamma = (v.gamma * Math.PI) / 180;
  const kinds: Record<"badEdge" | "curve" | "dotted", string> = { badEdge: "", curve: "", dotted: "" };
  for (const raw of COVER) {
    const edge = turnedEdge(raw, gamma);
    const pieces = edge.centre ? 120 : 60;
    for (let i = 0; i < pieces; i++) {
      const psi = angleAt(edge, along(edge, (i + 0.5) / pieces), v.c);
      const kind = psi <= 0 ? "dotted" : psi < v.psi0 ? "badEdge" : "curve";
      kinds[kind] += plane.line([along(edge, i / pieces), along(edge, (i + 1) / pieces)]);
    }
  }
  const y = plane.y(v.c);
  const ring: Point = plane.at([62 * Math.cos(gamma), 62 * Math.sin(gamma)]);
  return (
    <>
      <path d={kinds.dotted} class="dotted" />
      <path d={kinds.curve} class="curve" />
      <path d={kinds.badEdge} class="badEdge" />
      <path d={`M${plane.x(-65)} ${y}H${plane.x(65)}`} class="axis" marker-end="url(#tg-arrow)" />
      <path d={`M${plane.x(0)} ${plane.y(v.c - CUTTER)}A${CUTTER * plane.scale} ${CUTTER * plane.scale} 0 0 0 ${plane.x(0)} ${plane.y(v.c + CUTTER)}`} class="ghost" />
      <ScaleBar plane={plane} at={[box.left + 6, box.top + box.height]} />
      <Handle
        at={ring}
        name={word("q4.gamma")}
        value={v.gamma}
        min={0}
        max={360}
        told={`γ ${c.text("gamma")}°`}
        move={(to) => {
          const [x, z] = plane.back(to);
          c.set({ gamma: (turned(Math.atan2(z, x)) * 180) / Math.PI });
        }}
        step={(dx, dy) => c.set({ gamma: (v.gamma + dx + dy + 360) % 360 })}
      />
      <Handle
        at={[plane.x(-58), y]}
        name={word("q4.c")}
        value={v.c}
        min={-60}
        max={60}
        told={`c ${c.text("c")}`}
        move={(to) => c.set({ c: plane.back(to)[1] })}
        step={(dx, dy) => c.set({ c: v.c + 0.5 * (dx + dy) })}
      />
    </>
  );
}

export const fig41: Figure = {
  id: "4.1",
  words: "f41",
  after: "1",
  fields: [
    { key: "psi0", symbol: "s.Psi0", name: "q4.psi0", unit: "u.deg", min: 1, max: 179, step: 1, digits: 1 },
    { key: "gamma", symbol: "s.gamma", name: "q4.gamma", unit: "u.deg", min: 0, max: 360, step: 1, digits: 4 },
    { key: "c", symbol: "s.c", name: "q4.c", unit: "u.mm", min: -60, max: 60, step: 0.5, digits: 4 },
  ],
  start: { psi0: 90, gamma: Number(LEAST.placement.turn.toFixed(4)), c: Number(LEAST.placement.offset.toFixed(4)) },
  warns: (v) => (isWide(lengths(v.gamma, v.c, v.psi0, 72).reach) ? "f45.wide" : null),
  rows,
  draw,
  toml: (v) => `placement = { angle = ${tomlNumber(v.gamma)}, offset = ${tomlNumber(v.c)} }`,
};
