// Table 1: ways to share the motions of the cone between machine and tool.
import { type Key, word } from "../language";
import { Handle, Label } from "../marks";
import { type Drawing, type Figure, type Point, type Row, type Values, tomlNumber } from "../model";
import { type Box, Plane } from "../plane";

const CHAIN = ["6", "1", "5", "3"];
/** Digits of the machine, from all four to none. */
const CODES = ["6153", "615", "61", "6", ""];

const forming = (digits: string[]) => digits.filter((d) => d === "6" || d === "3").length;

function rows(v: Values): Row[] {
  const machine = CHAIN.slice(0, v.bar);
  const free = v.bar === 4 ? NaN : v.bar >= 2 ? Math.cos(v.alpha) : Math.sin(v.alpha);
  const all: Row[] = [
    { key: "machine", symbol: "s.Nm", name: "q5.machine", value: machine.length, digits: 0 },
    { key: "forming", symbol: "s.Nf", name: "q5.formingCount", value: forming(machine), digits: 0 },
    { key: "setting", symbol: "s.Ns", name: "q5.settingCount", value: machine.length - forming(machine), digits: 0 },
    { key: "edge", symbol: "s.dim", name: "q5.dim", value: v.bar === 4 ? 0 : v.bar === 0 ? 2 : 1, digits: 0 },
  ];
  return Number.isNaN(free) ? all : [...all, { key: "margin", symbol: "s.margin", name: "q5.margin", value: free, digits: 3 }];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const columns = width >= 560 ? 5 : width >= 380 ? 3 : 2;
  const gap = 8;
  const cell = (width - 16 - gap * (columns - 1)) / columns;
  const tall = 256;
  const top = 92;
  const lines = Math.ceil(5 / columns);
  const step = Math.min(110, (width - 60) / 4);
  const first = width / 2 - 1.5 * step;
  const bar: Point = [first + (v.bar - 0.5) * step, 44];
  return {
    height: top + lines * (tall + gap) + 6,
    children: (
      <>
        {CHAIN.map((digit, i) => (
          <g key={digit}>
            <circle cx={first + i * step} cy={44} r="17" class={`box${i < v.bar ? " on" : ""}`} />
            <text x={first + i * step} y={49} text-anchor="middle">
              {digit}
            </text>
            {i < 3 && <path d={`M${first + i * step + 18} 44h${step - 36}`} />}
          </g>
        ))}
        <path d={`M${bar[0]} 18v52`} class="second" />
        {v.bar > 0 && <Label at={[bar[0] - 10, 16]} text={word("f5t.machine")} anchor="end" />}
        {v.bar < 4 && <Label at={[bar[0] + 10, 16]} text={word("f5t.tool")} />}
        {CODES.map((code, i) => (
          <Cell
            key={code}
            v={v}
            code={code}
            on={v.bar === 4 - i}
            printed={c.printed}
            box={{ left: 8 + (i % columns) * (cell + gap), top: top + Math.floor(i / columns) * (tall + gap), width: cell, height: tall }}
          />
        ))}
        <Handle
          at={[bar[0], 70]}
          name={word("f5t.bar")}
          value={v.bar}
          min={0}
          max={4}
          told={word("f5t.told", { machine: CODES[4 - v.bar] || "–", tool: CHAIN.slice(v.bar).join("") || "–" })}
          move={(at) => c.set({ bar: Math.round((at[0] - first) / step + 0.5) })}
          step={(dx, dy) => c.set({ bar: v.bar + Math.sign(dx + dy) })}
        />
      </>
    ),
  };
}

/** One way: the cone in half section, the tool thick, motions as arrows. */
function Cell({ v, code, on, printed, box }: { v: Values; code: string; on: boolean; printed: boolean; box: Box }) {
  const [sin, cos] = [Math.sin(v.alpha), Math.cos(v.alpha)];
  const R = 30;
  const s = Math.min(40, (R - 4) / Math.max(0.05, sin));
  const plane = new Plane([-R * 1.35, -R * 0.6], [R * 1.75, s * cos + R * 0.75], { left: box.left + 4, top: box.top + 26, width: box.width - 8, height: box.height - 108 });
  const at = (x: number, z: number): Point => plane.at([x, z]);
  const on1 = (z: number, off = 0): Point => at(R - z * sin + off * cos, z * cos + off * sin);
  const path = (points: Point[], closed = false) => points.map((p, i) => `${i ? "L" : "M"}${p[0].toFixed(1)} ${p[1].toFixed(1)}`).join("") + (closed ? "Z" : "");
  const top = R - s * sin;
  const tool: Record<string, string> = {
    "6153": path([on1(s * 0.55), on1(s * 0.72, 9), on1(s * 0.72, 20), on1(s * 0.48, 20), on1(s * 0.48, 9)], true),
    "615": path([on1(0), on1(s), on1(s, 13), on1(0, 13)], true),
    "61": path([on1(0), on1(s), at(R * 1.36, s * cos), at(R * 1.36, 0)], true),
    "6": path([on1(0), on1(s), at(R + 10, s * cos + 3), at(R + 10, 0)], true) + path([at(-R, 0), at(-top, s * cos), at(-R - 10, s * cos + 3), at(-R - 10, 0)], true) + path([at(-R - 10, s * cos + 3), at(R + 10, s * cos + 3)]),
    "": path([at(-R, 0), at(-top, s * cos), at(top, s * cos), at(R, 0), at(R + 12, 0), at(R + 12, s * cos + 12), at(-R - 12, s * cos + 12), at(-R - 12, 0)], true),
  };
  const name = (printed && code === "61" ? "f5t.p61" : `f5t.n${code || "0"}`) as Key;
  const words = word(name).split(" ");
  // As many words a line as fit.
  const lines = words.reduce<string[]>((all, w) => {
    const last = all[all.length - 1];
    if (last !== undefined && (last.length + w.length + 1) * 7.2 < box.width - 14) all[all.length - 1] = `${last} ${w}`;
    else all.push(w);
    return all;
  }, []);
  const [ax, az] = at(0, -R * 0.32);
  const P = on1(s * 0.6, 18);
  if (printed && code === "6") {
    return (
      <g>
        <rect x={box.left} y={box.top} width={box.width} height={box.height} rx="4" class="box dashed" />
        <text x={box.left + box.width / 2} y={box.top + box.height / 2} text-anchor="middle" class="tick">
          {word("f5t.missing")}
        </text>
      </g>
    );
  }
  const infeed = code === "615" || code === "61" ? "x" : code === "6" || code === "" ? "z" : null;
  return (
    <g>
      <rect x={box.left} y={box.top} width={box.width} height={box.height} rx="4" class={`box${on ? " on" : ""}`} />
      <text x={box.left + 8} y={box.top + 18} class={on ? "strong" : ""}>
        {code || "–"}
      </text>
      {code === "6" && (
        <text x={box.left + box.width - 6} y={box.top + 18} text-anchor="end" class="tick">
          {word("f5t.missing")}
        </text>
      )}
      <path d={path([at(-R, 0), at(-top, s * cos), at(top, s * cos), at(R, 0)], true)} class="hatched" />
      <path d={path([at(-R, 0), at(-top, s * cos), at(top, s * cos), at(R, 0)], true)} class="part" />
      <path d={path([at(0, -R * 0.5), at(0, s * cos + R * 0.6)])} class="axis" />
      <path d={tool[code]} class="tool" />
      {code !== "" && <path d={`M${ax - 15} ${az}a15 6 0 1 0 30 0`} class="curve" marker-end="url(#tg-arrow)" />}
      {code === "6153" && <path d={path([on1(s * 0.2, 26), on1(s, 26)])} class="curve" marker-end="url(#tg-arrow)" />}
      {(code === "6153" || code === "615") && <path d={`M${at(R * 1.62, s * cos * 0.95)[0]} ${at(0, s * cos * 0.95)[1]}a18 18 0 0 0 -14 -12`} class="third" marker-end="url(#tg-arrow)" />}
      {(code === "6153" || code === "615" || code === "61") && <path d={path([at(R * 1.6, -R * 0.2), at(R * 1.05, -R * 0.2)])} class="third" marker-end="url(#tg-arrow)" />}
      {infeed === "x" && <path d={`M${P[0] + 15} ${P[1] - 2}h-15M${P[0] + 15} ${P[1] + 2}h-15`} marker-end="url(#tg-arrow)" />}
      {infeed === "z" && <path d={`M${at(0, 0)[0] - 2} ${at(0, s * cos + R * 0.7)[1]}v18M${at(0, 0)[0] + 2} ${at(0, s * cos + R * 0.7)[1]}v18`} marker-end="url(#tg-arrow)" />}
      {lines.slice(0, 5).map((line, i) => (
        <text key={i} x={box.left + 8} y={box.top + box.height - 72 + 16 * i} class="tick">
          {line}
        </text>
      ))}
    </g>
  );
}

export const table5t: Figure = {
  id: "5.T",
  words: "f5t",
  after: "1",
  table: true,
  fields: [
    { key: "bar", symbol: "s.Nm", name: "f5t.split", min: 0, max: 4, step: 1, digits: 0, options: ["f5t.c0", "f5t.c6", "f5t.c61", "f5t.c615", "f5t.c6153"] },
    { key: "alpha", symbol: "s.alpha", name: "q5.alphaRad", unit: "u.rad", min: 0.05, max: 1.2, step: 0.01, digits: 4 },
  ],
  start: { bar: 4, alpha: 0.35 },
  mistake: true,
  rows,
  draw,
  toml: (v) => `like = "cone"\nparameters = { R = 30, alpha = ${tomlNumber(v.alpha)} }`,
};
