// Figure 4: positions of the part one after another, over the turn and over the feed, with the angles at which teeth leave.
import { answerTo, isAlone } from "../asked";
import { num, word } from "../language";
import { Handle, Label, Press, ScaleBar } from "../marks";
import { type Drawing, type Figure, type Row, type Values, bounded } from "../model";
import { type Box, Plane, turned } from "../plane";
import { ASK_LEAST, type Least, type Placed, type Revolution, askPlaced, askWay, placementToml } from "./cover";
import { type Edge, along, turnedEdge, turnedPoint } from "./part";

const CUTTER = 50;
/** Turns of the row of tiles [deg]. */
const TURNS = [0, 30, 60, 90, 120, 150];
const deg = (n: number) => (n * 180) / Math.PI;
const rad = (n: number) => (n * Math.PI) / 180;

function badOf(placed: Placed): Placed["stretches"] {
  return placed.stretches.filter((s) => s[3] === 0 && s[6] > 0);
}

function rows(_: Values, data: unknown[]): Row[] {
  const [own, least] = data as [Placed | null, Least];
  const found: Row[] = [
    { key: "least", symbol: "s.Lmin", name: "q4.leastLength", unit: "u.mm", value: least.value, digits: 3 },
    { key: "bound", symbol: "s.Lbound", name: "q4.bound", unit: "u.mm", value: least.bound, digits: 4 },
  ];
  if (!own) return found;
  const exits = own.stretches.filter((s) => s[3] === 0);
  return [
    { key: "bad", symbol: "s.Lbad", name: "q4.badLength", unit: "u.mm", value: own.bad, digits: 3 },
    { key: "exits", symbol: "s.Lexit", name: "q4.exitLength", unit: "u.mm", value: own.exits, digits: 3 },
    { key: "entries", symbol: "s.Lentry", name: "q4.entryLength", unit: "u.mm", value: own.entries, digits: 3 },
    { key: "count", symbol: "s.Nbad", name: "q4.badStretches", value: badOf(own).length, digits: 0 },
    { key: "smallest", symbol: "s.Psimin", name: "q4.least", unit: "u.deg", value: Math.min(...exits.flatMap((s) => [s[4], s[5]])), digits: 2 },
    { key: "largest", symbol: "s.Psimax", name: "q4.largest", unit: "u.deg", value: Math.max(...exits.flatMap((s) => [s[4], s[5]])), digits: 2 },
    ...found,
    { key: "above", symbol: "s.above", name: "q4.above", unit: "u.mm", value: own.bad - least.value, digits: 3 },
  ];
}

function draw(c: Drawing) {
  const { v, width } = c;
  const [own, least, way, ...tiles] = c.data as [Placed | null, Least, Revolution[] | undefined, ...(Placed | null)[]];
  const columns = width >= 560 ? 3 : 2;
  const each = (width - 16 - 10 * (columns - 1)) / columns;
  const size = each * 0.94;
  const big = Math.min(width - 16, 430);
  const plane = new Plane([-70, -64], [78, 64], { left: 8, top: 8, width: width - 16, height: big * 0.82 });
  const edges = (own ?? (tiles.find((t) => t) as Placed | undefined))?.edges ?? [];
  const [hx, hy] = plane.at([58 * Math.cos(rad(v.gamma)), 58 * Math.sin(rad(v.gamma))]);
  const first = big * 0.82 + 62;
  const lines = Math.ceil(TURNS.length / columns);
  const second = first + lines * (size + 40) + 28;
  const low = each * 0.64;
  const across = Math.max(1, way?.length ?? 1);
  return {
    height: second + Math.ceil(across / columns) * (low + 40) + 8,
    children: (
      <>
        <Part plane={plane} edges={edges} placed={own} turn={v.gamma} />
        <path d={`M${plane.x(-70)} ${plane.y(v.c)}H${plane.x(72)}`} class="axis" marker-end="url(#tg-arrow)" />
        <circle cx={plane.x(0)} cy={plane.y(v.c)} r={CUTTER * plane.scale} class="ghost" />
        {own && <Angles plane={plane} placed={own} turn={v.gamma} most={4} />}
        <ScaleBar plane={plane} at={[14, big * 0.82 + 26]} />
        <Press at={[width - 200, big * 0.82 + 8]} width={190} text={word("f44.best")} mark="best" press={() => c.set({ gamma: least.turn, c: least.offset })} />
        <Label at={[8, first - 12]} text={word("f44.turns")} />
        {TURNS.map((turn, i) => (
          <Tile key={turn} box={{ left: 8 + (i % columns) * (each + 10), top: first + Math.floor(i / columns) * (size + 40), width: each, height: size }} edges={edges} placed={tiles[i] ?? null} turn={turn} c={v.c} name={`${word("s.gamma")} ${turn}°`} />
        ))}
        <Label at={[8, second - 12]} text={word("f44.feed")} />
        {way?.map((revolution, i) => (
          <Way key={i} box={{ left: 8 + (i % columns) * (each + 10), top: second + Math.floor(i / columns) * (low + 40), width: each, height: low }} edges={edges} revolution={revolution} turn={v.gamma} c={v.c} />
        ))}
        {!way && <Label at={[8, second + 20]} text={word(isAlone() ? "figure.notHeld" : "figure.waits")} />}
        {way?.length === 0 && <Label at={[8, second + 20]} text={word("f44.wide")} />}
        <Handle
          at={[hx, hy]}
          name={word("q4.gamma")}
          value={v.gamma}
          min={0}
          max={360}
          told={`γ ${num(v.gamma, 2, true)}°, ${c.text("bad")}`}
          move={(to) => {
            const [x, y] = plane.back(to);
            c.set({ gamma: deg(turned(Math.atan2(y, x))) });
          }}
          step={(dx, dy) => c.set({ gamma: (c.now().gamma + dx + dy + 360) % 360 })}
        />
        <Handle
          at={plane.at([66, v.c])}
          name={word("q4.c")}
          value={v.c}
          min={-60}
          max={60}
          told={`c ${num(v.c, 2, true)}, ${c.text("bad")}`}
          move={(to) => c.set({ c: plane.back(to)[1] })}
          step={(dx, dy) => c.set({ c: c.now().c + 0.25 * (dx + dy) })}
        />
      </>
    ),
  };
}

function whole(plane: Plane, edges: Edge[]): string {
  return edges.map((e) => plane.line(Array.from({ length: e.centre ? 33 : 2 }, (_, i) => along(e, i / (e.centre ? 32 : 1))))).join("");
}

/** The part as it is turned, its edges by how teeth meet them. */
function Part({ plane, edges, placed, turn }: { plane: Plane; edges: Edge[]; placed: Placed | null; turn: number }) {
  const now = edges.map((e) => turnedEdge(e, rad(turn)));
  const kinds = ["badEdge", "goodEdge", "inEdge"];
  const line = (kind: number) =>
    (placed?.stretches ?? [])
      .filter((s) => (s[3] === 0 ? (s[6] > 0 ? 0 : 1) : 2) === kind)
      .map(([edge, from, to]) => {
        const steps = now[edge].centre ? Math.max(2, Math.ceil(40 * (to - from))) : 1;
        return plane.line(Array.from({ length: steps + 1 }, (_, i) => along(now[edge], from + ((to - from) * i) / steps)));
      })
      .join("");
  return (
    <>
      {placed ? [2, 1, 0].map((kind) => <path key={kind} d={line(kind)} class={kinds[kind]} />) : <path d={whole(plane, now)} class="netline" />}
    </>
  );
}

/** Exit angles of the longest bad stretches, beside them. */
function Angles({ plane, placed, turn, most }: { plane: Plane; placed: Placed; turn: number; most: number }) {
  const long = (s: Placed["stretches"][number]) => (s[2] - s[1]) * lengthOf(placed.edges[s[0]]);
  const shown = badOf(placed)
    .sort((a, b) => long(b) - long(a))
    .slice(0, most);
  return (
    <>
      {shown.map((s) => {
        const [x, y] = plane.at(turnedPoint(along(placed.edges[s[0]], (s[1] + s[2]) / 2), rad(turn)));
        const [low, high] = [Math.min(s[4], s[5]), Math.max(s[4], s[5])];
        return <Label key={`${s[0]} ${s[1]}`} at={[x, y - 7]} text={num(low, 0) === num(high, 0) ? `${num(low, 0)}°` : `${num(low, 0)}…${num(high, 0)}°`} anchor="middle" class="bad" />;
      })}
    </>
  );
}

function lengthOf({ start, end, centre, sweep }: Edge): number {
  return centre && sweep !== undefined ? Math.abs(sweep) * Math.hypot(start[0] - centre[0], start[1] - centre[1]) : Math.hypot(end[0] - start[0], end[1] - start[1]);
}

/** A placement in small, its line below. */
function Tile({ box, edges, placed, turn, c, name }: { box: Box; edges: Edge[]; placed: Placed | null; turn: number; c: number; name: string }) {
  const plane = new Plane([-62, -62], [62, 62], box);
  const told = placed ? word("f44.tile", { name, bad: num(placed.bad, 1), n: String(badOf(placed).length) }) : `${name}: ${word("f44.wide")}`;
  return (
    <g data-tile={turn}>
      <circle cx={plane.x(0)} cy={plane.y(c)} r={CUTTER * plane.scale} class="ghost" />
      <path d={`M${plane.x(-60)} ${plane.y(c)}H${plane.x(60)}`} class="axis" />
      <Part plane={plane} edges={edges} placed={placed} turn={turn} />
      {placed && <Angles plane={plane} placed={placed} turn={turn} most={2} />}
      <Label at={[box.left + box.width / 2, box.top + box.height + 16]} text={told} anchor="middle" />
    </g>
  );
}

/** The cutter at one revolution of its way: a tooth's front arc, entries and exits with their angles. */
function Way({ box, edges, revolution, turn, c }: { box: Box; edges: Edge[]; revolution: Revolution; turn: number; c: number }) {
  const x = revolution.m * revolution.feed;
  const plane = new Plane([-142, -62], [62, 62], box);
  const exits = revolution.events.filter((e) => e.exit);
  const arc = plane.curve((t) => [x + CUTTER * Math.cos(t), c + CUTTER * Math.sin(t)], -Math.PI / 2, Math.PI / 2, 40);
  return (
    <g data-revolution={revolution.m}>
      <path d={whole(plane, edges.map((e) => turnedEdge(e, rad(turn))))} class="netline" />
      <circle cx={plane.x(x)} cy={plane.y(c)} r={CUTTER * plane.scale} class="ghost" />
      <path d={arc} class="curve" />
      {revolution.events.map((e, i) => {
        const [px, py] = plane.at(e.at);
        const bad = e.exit && e.angle < 90;
        if (!e.exit) return <circle key={i} cx={px} cy={py} r="3.2" class="entry" />;
        return (
          <g key={i} class={bad ? "badExit" : "goodExit"}>
            {bad ? <path d={`M${px - 4} ${py - 4}l8 8M${px - 4} ${py + 4}l8 -8`} /> : <circle cx={px} cy={py} r="4" class="dot" />}
            {(bad || exits.length < 5) && <Label at={[px + 7, py + 4]} text={`${num(e.angle, 0)}°`} class={bad ? "bad" : ""} />}
          </g>
        );
      })}
      <Label at={[box.left + box.width / 2, box.top + box.height + 16]} text={word("f44.step", { m: num(revolution.m, 0), n: String(exits.filter((e) => e.angle < 90).length), all: String(exits.length) })} anchor="middle" />
    </g>
  );
}

export const fig44: Figure = {
  id: "4.4",
  words: "f44",
  after: "4",
  fields: [
    { key: "gamma", symbol: "s.gamma", name: "q4.gamma", unit: "u.deg", min: 0, max: 360, step: 1, digits: 6, saved: [0, 10, 30, 40, 60, 120, 140, 145, 150, 160, 180, 200, 220, 300, 310, 320, 325, 330, 340] },
    { key: "c", symbol: "s.c", name: "q4.c", unit: "u.mm", min: -60, max: 60, step: 0.25, digits: 6, saved: [-4, -2, -1, 0.5, 1, 2, 4] },
  ],
  start: { gamma: 20, c: 0 },
  series: () => {
    const least = answerTo(ASK_LEAST);
    if (!least || !("kept" in least)) return [];
    const { turn, offset } = least.kept as Least;
    return [bounded(fig44.fields, { gamma: turn, c: offset })];
  },
  asks: (v) => [askPlaced(v.gamma, v.c), ASK_LEAST, askWay(v.gamma, v.c), ...TURNS.map((turn) => askPlaced(turn, v.c))],
  wrong: (_, data) => (data[0] === null ? "f44.tooWide" : null),
  rows,
  draw,
  toml: (v) => placementToml(v.gamma, v.c),
};
