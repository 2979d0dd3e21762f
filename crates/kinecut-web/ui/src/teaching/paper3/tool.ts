// A tool of revolution in motion as `kinecut grazing` answers: what the figures keep of the answer.
import type { Band, Kind, Piece, Sheet, Vec } from "../../windows/grazing/sheet";
import { Told, type Question, short } from "../asked";

/** A place of the curve: where it is, its normal, and its place on the tool. */
export type Place = [x: number, y: number, z: number, nx: number, ny: number, nz: number, piece: number, theta: number, span: number, branch: number, u: number];

export interface Tool {
  pieces: Pick<Piece, "what" | "role" | "fan" | "start" | "end" | "centre" | "radius" | "from" | "to" | "parameter" | "outcome">[];
  /** Piece, both parameters, both places, both normals, and, where it enters on a part, both intervals of angles. */
  bands: number[][];
  loops: { winding: number; length: number; places: Place[] }[];
  spans: { kind: Kind; piece: number }[];
  folds: { piece: number; u: number; theta: number; point: Vec }[];
  ends: Sheet["ends"];
  twist: Sheet["twist"];
  entering: Sheet["entering"];
  whole: number;
}

/** Bands are joined up to this turn of the normal, and of where they enter [deg], and curves thinned to this distance [mm]: finer is not seen. */
const [TURN, WANDER, THIN] = [7, 9, 0.04];

function joined(bands: Band[], size: number): Band[] {
  const all: Band[] = [];
  for (const band of bands) {
    const last = all[all.length - 1];
    const turn = last ? Math.abs(Math.atan2(band.normals[1][1], band.normals[1][0]) - Math.atan2(last.normals[0][1], last.normals[0][0])) * (180 / Math.PI) : 0;
    const gone = last ? Math.hypot(band.places[1][0] - last.places[0][0], band.places[1][1] - last.places[0][1]) : 0;
    const wander = last?.enters && band.enters ? Math.max(...[0, 1].map((k) => Math.abs((band.enters as [number, number][])[1][k] - (last.enters as [number, number][])[0][k]))) : 0;
    if (last && last.piece === band.piece && (last.enters === null) === (band.enters === null) && turn < TURN && gone < 0.08 * size && wander < WANDER) {
      last.u = [last.u[0], band.u[1]];
      last.places = [last.places[0], band.places[1]];
      last.normals = [last.normals[0], band.normals[1]];
      if (last.enters && band.enters) last.enters = [last.enters[0], band.enters[1]];
    } else all.push({ ...band });
  }
  return all;
}

function packed({ piece, u, places, normals, enters }: Band): number[] {
  const all = [...u.map((x) => short(x)), ...places.flat().map((x) => short(x)), ...normals.flat().map((x) => short(x, 4))];
  return [piece, ...all, ...(enters ? enters.flat().map((x) => short(x, 2)) : [])];
}

const unpacked = new WeakMap<Tool, Band[]>();

/** The bands of a tool, without those of edges, which have no area. */
export function bandsOf(tool: Tool): Band[] {
  let all = unpacked.get(tool);
  if (!all) {
    all = tool.bands.map(([piece, u0, u1, r0, z0, r1, z1, nr0, nz0, nr1, nz1, ...e]): Band => ({ piece, u: [u0, u1], places: [[r0, z0], [r1, z1]], normals: [[nr0, nz0], [nr1, nz1]], enters: e.length ? [[e[0], e[1]], [e[2], e[3]]] : null }));
    unpacked.set(tool, all);
  }
  return all;
}

/** Leaves out places that are on the line between their neighbours. */
function thinned(places: Place[]): Place[] {
  const stays = new Set<number>();
  const [low, high] = [0, places.length - 1];
  const between = (a: number, b: number): void => {
    let [most, at] = [0, -1];
    const [p, q] = [places[a], places[b]];
    const d = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    const square = d[0] ** 2 + d[1] ** 2 + d[2] ** 2;
    for (let i = a + 1; i < b; i++) {
      const r = places[i];
      const w = [r[0] - p[0], r[1] - p[1], r[2] - p[2]];
      const t = square > 0 ? Math.min(1, Math.max(0, (w[0] * d[0] + w[1] * d[1] + w[2] * d[2]) / square)) : 0;
      const away = Math.hypot(w[0] - t * d[0], w[1] - t * d[1], w[2] - t * d[2]);
      if (away > most) [most, at] = [away, i];
    }
    if (at < 0 || most < THIN) return;
    stays.add(at);
    between(a, at);
    between(at, b);
  };
  stays.add(low).add(high);
  let from = low;
  for (let i = 1; i <= high; i++) {
    const [p, q] = [places[i - 1], places[i]];
    // Ends of spans and turns on an edge, where the place rests, stay.
    if (q[8] !== p[8] || q[9] !== p[9] || Math.abs(q[7] - p[7]) > 6 || i === high) {
      stays.add(i - 1).add(i);
      between(from, i - 1);
      from = i;
    }
  }
  return places.filter((_, i) => stays.has(i));
}

export function keepTool(sheet: Sheet): Tool {
  if (!("bands" in sheet)) throw new Told(JSON.stringify(sheet));
  const size = Math.max(...sheet.bands.flatMap((b) => b.places.map((p) => p[0])), sheet.ends[1].z - sheet.ends[0].z);
  return {
    pieces: sheet.pieces.map(({ what, role, fan, start, end, centre, radius, from, to, parameter, outcome }) => ({ what, role, fan, start, end, centre, radius, from, to, parameter, outcome })),
    bands: joined(
      sheet.bands.filter((b) => !sheet.pieces[b.piece].fan),
      size,
    ).map(packed),
    loops: sheet.loops.map(({ winding, length, points }) => ({
      winding,
      length,
      places: thinned(
        points.map((p): Place => [short(p.point[0], 2), short(p.point[1], 2), short(p.point[2], 2), short(p.normal[0], 2), short(p.normal[1], 2), short(p.normal[2], 2), p.piece, short(p.theta, 2), p.span, p.branch, short(p.u, 2)]),
      ),
    })),
    spans: sheet.spans.map(({ kind, piece }) => ({ kind, piece })),
    folds: sheet.folds.map(({ piece, u, theta, point }) => ({ piece, u, theta, point })),
    ends: sheet.ends,
    twist: sheet.twist,
    entering: sheet.entering,
    whole: sheet.whole.length,
  };
}

/** Levels of the profile: piece, way along the profile [mm], radius, height, normal, and between which angles the circle enters. */
export interface Level {
  piece: number;
  way: number;
  place: [number, number];
  normal: [number, number];
  enters: [number, number] | null;
}

export interface Profile {
  pieces: Tool["pieces"];
  levels: Level[];
  ends: Sheet["ends"];
  twist: Sheet["twist"];
}

/** Levels of a profile are at least so far apart [share of its size]. */
const APART = 0.006;

/** The profile with the two grazing points of each of its circles. */
export function keepProfile(sheet: Sheet): Profile {
  const { pieces, ends, twist } = keepTool(sheet);
  const size = ends[1].z - ends[0].z;
  const levels: Level[] = [];
  let way = 0;
  let before: [number, number] | null = null;
  for (const band of sheet.bands) {
    if (sheet.pieces[band.piece].fan) continue;
    for (const k of [0, 1] as const) {
      const place = band.places[k];
      if (before) way += Math.hypot(place[0] - before[0], place[1] - before[1]);
      before = place;
      const last = levels[levels.length - 1];
      if (last && last.piece === band.piece && way - last.way < APART * size) continue;
      levels.push({ piece: band.piece, way: short(way), place, normal: band.normals[k], enters: band.enters && band.enters[k] });
    }
  }
  return { pieces, levels, ends, twist };
}

/** A sheet of what is kept, for the lines of the parameter plane. */
export function linesOf(tool: Tool): Pick<Sheet, "bands" | "loops" | "spans"> {
  const loops = tool.loops.map(({ winding, length, places }) => ({
    closed: true,
    winding,
    length,
    spans: [0, 0] as [number, number],
    points: places.map((p) => ({ point: [p[0], p[1], p[2]] as Vec, normal: [p[3], p[4], p[5]] as Vec, piece: p[6], theta: p[7], span: p[8], branch: p[9] as 1 | -1, u: p[10] })),
  }));
  return { bands: bandsOf(tool), loops, spans: tool.spans as Sheet["spans"] };
}

export function asking(text: string): Question {
  return { verb: "grazing", text, as: "tool", keep: keepTool };
}

/** Velocity of a place fixed to the tool [mm/min]. */
export function velocityAt({ twist }: Pick<Tool, "twist">, [x, y, z]: Vec): Vec {
  const [a, b, c] = twist.turn.map((n) => (n * Math.PI) / 180);
  const [u, v, w] = twist.velocity;
  return [u + b * z - c * y, v + c * x - a * z, w + a * y - b * x];
}
