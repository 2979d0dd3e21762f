// Figures 4 a to d: forms of the curve on a torus. Cases of the library's gallery, one's own motion, and a map of forms over two inputs.
import type { Sheet } from "../../windows/grazing/sheet";
import { curvesOf, regionsOf } from "../../windows/grazing/planelines";
import { type Question, Told } from "../asked";
import { type Key, num, word } from "../language";
import { Axes, Handle, Label } from "../marks";
import { type Drawing, type Figure, type Row, type Values, tomlNumber } from "../model";
import type { Box } from "../plane";
import { OUTCOMES, type Outcome, outcomeWord } from "./outcome";
import { Eye, Solid, pathOf, sizeOf } from "./solid";
import { type Tool, asking, keepTool, linesOf } from "./tool";

const n = (x: number) => tomlNumber(x, 4);
/** Steps of the map. */
const VZ = [-600, -450, -300, -150, 0, 150, 300, 450, 600];
const WY = [-6000, -4500, -3000, -1500, 0, 1500, 3000, 4500, 6000];
const BOUND = { vz: 675, wy: 6750 };
const TOOL = "{ shape = { contour = { bottom = 0.5, elements = [{ to = [8.6, 0.5] }, { to = [8.6, 15.5], centre = [6, 8], convex = true }, { to = [0, 15.5] }] } } }";
/** Velocity of the tip across the axis: the same all over the map [mm/min]. */
const ACROSS = [20, 10];

function question(vz: number, wy: number): string {
  return `tool = ${TOOL}\ntwist = { velocity = [${ACROSS.join(", ")}, ${n(vz)}], turn = [0, ${n(wy)}, 0] }\n`;
}

interface Case {
  name: string;
  found: string;
  tool: Tool;
}

interface Gallery {
  cases: Case[];
  claims: { says: string; found: string; verdict: string }[];
  cones: { cones: number; distance: number }[];
}

interface Group {
  title: string;
  cases: { name: string; found: string; sheet: Sheet }[];
  claims: Gallery["claims"];
  cones: Gallery["cones"][];
}

function keepGallery(groups: Group[]): Gallery {
  const torus = groups.find((g) => g.title.includes("outwards"));
  if (!torus) throw new Told(JSON.stringify(groups));
  return {
    cases: torus.cases.map(({ name, found, sheet }) => ({ name, found, tool: keepTool(sheet) })),
    claims: groups.filter((g) => g.title.startsWith("Torus") || g.cones.length > 0).flatMap((g) => g.claims),
    cones: groups.flatMap((g) => g.cones)[0] ?? [],
  };
}

function torusIn(pieces: { fan: boolean; centre?: unknown }[]): number {
  return pieces.findIndex((p) => !p.fan && p.centre);
}

/** Forms on the torus over the map, a row a turning. */
function keepMap(sheets: Sheet[]): (string | null)[] {
  return sheets.map((s) => (s.pieces ? (s.pieces[torusIn(s.pieces)]?.outcome ?? null) : null));
}

const MAP: Question = {
  verb: "grazing",
  text: WY.flatMap((wy) => VZ.map((vz) => `[[grazing]]\ntolerance = 1\n${question(vz, wy)}`)).join("\n"),
  as: "map",
  keep: keepMap,
};
const GALLERY: Question = { verb: "grazing", flags: { gallery: true }, text: "", as: "gallery", keep: keepGallery };

function rows(_: Values, data: unknown[]): Row[] {
  const tool = data[0] as Tool;
  const torus = torusIn(tool.pieces);
  const folds = tool.folds.filter((f) => f.piece === torus).sort((a, b) => a.u - b.u);
  const { cones } = data[1] as Gallery;
  return [
    { key: "folds", symbol: "s.Nfold", name: "q3.foldsTorus", value: folds.length, digits: 0 },
    ...folds.map((f, i): Row => ({ key: `u${i}`, symbol: i ? "s.phi2" : "s.phi1", name: "q3.foldAngle", unit: "u.deg", value: f.u, digits: 3 })),
    { key: "loops", symbol: "s.Nloop", name: "q3.loops", value: tool.loops.length, digits: 0 },
    { key: "winding", symbol: "s.wind", name: "q3.winding", value: tool.loops.reduce((sum, l) => sum + l.winding, 0), digits: 0 },
    { key: "few", symbol: "s.cones4", name: "q3.conesFew", unit: "u.mm", value: cones[0].distance, digits: 3 },
    { key: "many", symbol: "s.cones128", name: "q3.conesMany", unit: "u.mm", value: cones[cones.length - 1].distance, digits: 3 },
  ];
}

function outcomeOf(tool: Tool): string {
  return tool.pieces[torusIn(tool.pieces)]?.outcome ?? "";
}

function draw(c: Drawing) {
  const { width } = c;
  const [own, { cases }, map] = c.data as [Tool, Gallery, (string | null)[]];
  const columns = width >= 560 ? 2 : 1;
  const each = (width - 16 - 12 * (columns - 1)) / columns;
  const tall = 176;
  const tiles = [...cases.map(({ tool }, i) => ({ tool, letter: `f34.case${i}` as Key })), { tool: own, letter: "f34.own" as Key }];
  const lines = Math.ceil(tiles.length / columns);
  const top = lines * (tall + 34) + 40;
  const chart: Box = { left: 62, top, width: Math.min(width - 84, 420), height: 240 };
  return {
    height: top + 240 + 50 + 5 * 20,
    children: (
      <>
        {tiles.map(({ tool, letter }, i) => (
          <Tile key={letter} tool={tool} letter={word(letter)} framed={i === tiles.length - 1} box={{ left: 8 + (i % columns) * (each + 12), top: 26 + Math.floor(i / columns) * (tall + 34), width: each, height: tall }} />
        ))}
        <Map c={c} map={map} box={chart} />
        {OUTCOMES.map((o, i) => (
          <g key={o}>
            <rect x={chart.left} y={top + 240 + 44 + i * 20} width="14" height="12" class={`form form${i}`} />
            <Label at={[chart.left + 22, top + 240 + 55 + i * 20]} text={`${sign(o)} ${outcomeWord(o)}`} />
          </g>
        ))}
      </>
    ),
  };
}

/** A mark of a form, so that the map is read without colours. */
function sign(outcome: string | null): string {
  return { nothing: "–", "two through-branches": "‖", "one U": "∪", "two U": "⊍", "one closed loop": "○" }[outcome as Outcome] ?? "?";
}

function Map({ c, map, box }: { c: Drawing; map: (string | null)[]; box: Box }) {
  const { v } = c;
  return (
    <Axes box={box} x={[-BOUND.vz, BOUND.vz]} y={[-BOUND.wy, BOUND.wy]} xName={`${word("q3.vz")}, ${word("u.mmMinute")}`} yName={`${word("q3.wy")}, ${word("u.degMinute")}`}>
      {(s) => (
        <>
          {map.map((outcome, i) => {
            const [vz, wy] = [VZ[i % VZ.length], WY[Math.floor(i / VZ.length)]];
            const [x, y] = [s.x(vz - 75), s.y(wy + 750)];
            const at = OUTCOMES.findIndex((o) => o === outcome);
            return (
              <g key={i}>
                <rect x={x} y={y} width={s.x(vz + 75) - x} height={s.y(wy - 750) - y} class={at < 0 ? "form" : `form form${at}`} />
                <text x={s.x(vz)} y={s.y(wy) + 5} text-anchor="middle" class="formSign" data-form={`${vz} ${wy}`}>
                  {sign(outcome)}
                </text>
              </g>
            );
          })}
          <Handle
            at={[s.x(v.vz), s.y(v.wy)]}
            name={word("f34.handle")}
            value={v.vz}
            min={-BOUND.vz}
            max={BOUND.vz}
            told={`${num(v.vz, 1, true)}; ${num(v.wy, 1, true)}: ${outcomeWord(outcomeOf(c.data[0] as Tool))}`}
            move={([x, y]) => c.set({ vz: (2 * (x - box.left) / box.width - 1) * BOUND.vz, wy: (1 - (2 * (y - box.top)) / box.height) * BOUND.wy })}
            step={(dx, dy) => c.set({ vz: c.now().vz + 25 * dx, wy: c.now().wy + 250 * dy })}
          />
        </>
      )}
    </Axes>
  );
}

/** The tool with the curve on its torus, and the parameter plane of the torus. */
function Tile({ tool, letter, framed, box }: { tool: Tool; letter: string; framed: boolean; box: Box }) {
  const torus = torusIn(tool.pieces);
  const { radius, low, high } = sizeOf(tool);
  const eye = new Eye(-40, -24, [-1.15 * radius, low - 0.6 * radius], [1.15 * radius, high + 0.6 * radius], { left: box.left + 4, top: box.top + 4, width: box.width * 0.44, height: box.height - 8 });
  const piece = tool.pieces[torus];
  const plane: Box = { left: box.left + box.width * 0.5, top: box.top + 10, width: box.width * 0.48, height: box.height - 40 };
  const x = (theta: number) => plane.left + (plane.width * theta) / 360;
  const [from, to] = [Math.min(piece.from, piece.to), Math.max(piece.from, piece.to)];
  const y = (_: number, u: number) => plane.top + plane.height - (plane.height * (u - from)) / (to - from);
  const lines = linesOf(tool);
  const only = { ...lines, bands: lines.bands.filter((b) => b.piece === torus), loops: lines.loops.map((l) => ({ ...l, points: l.points.filter((p) => p.piece === torus) })) };
  const clip = `tg-clip-${letter.replace(/\W/g, "")}-${Math.round(box.left)}-${Math.round(box.top)}`;
  return (
    <g>
      <rect x={box.left} y={box.top} width={box.width} height={box.height} class={framed ? "box on" : "box"} />
      <Label at={[box.left, box.top - 7]} text={`${letter} ${outcomeWord(piece.outcome)}`} />
      <Solid eye={eye} tool={tool} piece={torus} />
      {tool.folds
        .filter((f) => f.piece === torus)
        .map((f, i) => (
          <path key={i} d={pathOf([eye.at([0, 0, f.point[2]]), eye.at(f.point)])} class="dashed" />
        ))}
      <clipPath id={clip}>
        <rect x={plane.left} y={plane.top} width={plane.width} height={plane.height} />
      </clipPath>
      <g clip-path={`url(#${clip})`}>
        <rect x={plane.left} y={plane.top} width={plane.width} height={plane.height} class="leaves" />
        <path d={regionsOf(only, x, y)} class="enters" />
        {curvesOf(only, x, y).map((line, i) => (
          <path key={i} d={line.d} class="graze" />
        ))}
      </g>
      <path d={`M${plane.left} ${plane.top}v${plane.height}h${plane.width}`} class="zero" />
      <text x={plane.left} y={plane.top + plane.height + 16} class="tick">
        0°
      </text>
      <text x={plane.left + plane.width} y={plane.top + plane.height + 16} class="tick" text-anchor="end">
        {word("s.theta")} 360°
      </text>
    </g>
  );
}

/** What the paper says of the torus, with the verdicts of the library, in its words. */
function Claims({ data }: { data: unknown[] }) {
  const { claims } = data[1] as Gallery;
  return (
    <ul class="claims" lang="en" translate={false}>
      {claims.map((claim) => (
        <li key={claim.found}>
          <b>{claim.verdict}:</b> “{claim.says}” {claim.found}
        </li>
      ))}
    </ul>
  );
}

export const fig34: Figure = {
  id: "3.4",
  words: "f34",
  after: "4",
  fields: [
    { key: "vz", symbol: "s.vz", name: "q3.vz", unit: "u.mmMinute", min: -675, max: 675, step: 25, digits: 1 },
    { key: "wy", symbol: "s.wy", name: "q3.wy", unit: "u.degMinute", min: -6750, max: 6750, step: 250, digits: 1 },
  ],
  start: { vz: 300, wy: 3000 },
  series: () => WY.flatMap((wy) => VZ.map((vz) => ({ vz, wy }))),
  asks: (v) => [asking(question(v.vz, v.wy)), GALLERY, MAP],
  more: (_, data) => ({ outcome: outcomeWord(outcomeOf(data[0] as Tool)) }),
  rows,
  draw,
  below: (data) => <Claims data={data} />,
  toml: (v) => question(v.vz, v.wy),
};
