// The sixteen points of drills: their names in the text, numbers to begin with, and their outlines as they are drawn. The numbers of a plan
// are the library's; an outline whose height is not the length of the point that the library gives is not drawn.
import type { Value } from "../../toml/edit";

export const POINTS = [
  "twist",
  "double-ground",
  "cast-iron",
  "rounded-lips",
  "corner-radius",
  "thinned-web",
  "slotted-chisel",
  "annular",
  "flat",
  "cannon",
  "gun",
  "auger",
  "ejector",
  "cone",
  "centre",
  "stepped",
] as const;
export type PointKind = (typeof POINTS)[number];

type Numbers = Record<string, unknown>;

export interface Point {
  kind: PointKind;
  numbers: Numbers;
  /** Keys to its numbers in the text, from the tool on. */
  path: string[];
}

/** The point of a tool as the text has it; null where it has none that is known. */
export function pointOf(tool: Record<string, unknown>): Point | null {
  const { point } = tool;
  if (point === undefined) {
    const angle = tool.point_angle ?? 118;
    return angle === 180 ? { kind: "flat", numbers: {}, path: [] } : { kind: "twist", numbers: { point_angle: angle }, path: [] };
  }
  if (point === "flat") return { kind: "flat", numbers: {}, path: ["point"] };
  if (typeof point !== "object" || point === null) return null;
  const [name] = Object.keys(point);
  const kind = POINTS.find((known) => known === name);
  const numbers = (point as Record<string, unknown>)[name ?? ""];
  return kind && typeof numbers === "object" && numbers !== null ? { kind, numbers: numbers as Numbers, path: ["point", kind] } : null;
}

/** Numbers of a point to begin with, for a diameter [mm]; an angle that is known stays. */
export function begin(kind: PointKind, diameter: number, known: Numbers): Value {
  const size = (share: number) => Number((share * diameter).toPrecision(3));
  const angle = typeof known.point_angle === "number" ? known.point_angle : 118;
  const of: Record<PointKind, { [key: string]: Value }> = {
    twist: { point_angle: angle },
    "double-ground": { point_angle: angle, second_angle: 70 },
    "cast-iron": { point_angle: angle, second_angle: 70, third_angle: 55 },
    "rounded-lips": { lip_radius: size(0.7) },
    "corner-radius": { point_angle: angle, corner_radius: size(0.1) },
    "thinned-web": { point_angle: angle, flat: size(0.05) },
    "slotted-chisel": { point_angle: angle, slot: size(0.05) },
    annular: { core_diameter: size(0.6) },
    flat: {},
    cannon: { overlap: size(0.05), edge_angle: 70 },
    gun: { apex: size(0.25), outer_angle: 60, inner_angle: 70 },
    auger: { point_angle: angle },
    ejector: { point_angle: angle },
    cone: { cone_angle: 90 },
    centre: { pilot_diameter: size(0.3), pilot_length: size(0.4), point_angle: 120, cone_angle: 60 },
    stepped: { point_angle: angle, stages: [{ diameter: size(0.6), length: size(0.8), shoulder_angle: 90 }] },
  };
  return kind === "flat" ? "flat" : { [kind]: of[kind] };
}

/** Keys of the numbers of a point, those first that have no default. */
export const NUMBERS: Record<PointKind, string[]> = {
  twist: ["point_angle"],
  "double-ground": ["point_angle", "second_angle"],
  "cast-iron": ["point_angle", "second_angle", "third_angle", "slot"],
  "rounded-lips": ["lip_radius"],
  "corner-radius": ["point_angle", "corner_radius"],
  "thinned-web": ["point_angle", "flat"],
  "slotted-chisel": ["point_angle", "slot"],
  annular: ["core_diameter"],
  flat: [],
  cannon: ["overlap", "edge_angle"],
  gun: ["apex", "outer_angle", "inner_angle"],
  auger: ["point_angle"],
  ejector: ["point_angle"],
  cone: ["cone_angle", "nose_diameter"],
  centre: ["pilot_diameter", "pilot_length", "point_angle", "cone_angle"],
  stepped: ["point_angle", "stages"],
};

type Place = [radius: number, height: number];

/** Chords of an arc. */
const CHORDS = 24;
/** Lengths of the outer edges of the points with several angles, in diameters (Belyakov and Seleznev 2023, table 1). */
const [SECOND_EDGE, THIRD_EDGE] = [0.2, 0.15];

/** Half an outline: radius and height above the lowest cutting point, from the inner end to the outer corner; null where the numbers make no outline. */
export function outline({ kind, numbers }: Pick<Point, "kind" | "numbers">, diameter: number): Place[] | null {
  const radius = diameter / 2;
  const number = (key: string, standard: number) => (typeof numbers[key] === "number" ? (numbers[key] as number) : standard);
  const half = (key: string, standard: number) => (number(key, standard) * Math.PI) / 360;
  const rise = (angle: number) => 1 / Math.tan(angle);
  const lip = rise(half("point_angle", kind === "centre" ? 120 : 118));
  let places: Place[];
  switch (kind) {
    case "twist":
    case "auger":
    case "ejector":
      places = [[0, 0], [radius, radius * lip]];
      break;
    case "double-ground": {
      const second = half("second_angle", 70);
      const b = SECOND_EDGE * diameter;
      const r1 = radius - b * Math.sin(second);
      places = [[0, 0], [r1, r1 * lip], [radius, r1 * lip + b * Math.cos(second)]];
      break;
    }
    case "cast-iron": {
      const [second, third, slot] = [half("second_angle", 70), half("third_angle", 55), number("slot", 0)];
      const [b1, b2] = [SECOND_EDGE * diameter, THIRD_EDGE * diameter];
      const r2 = radius - b2 * Math.sin(third);
      const r1 = r2 - b1 * Math.sin(second);
      const z1 = (r1 - slot) * lip;
      const z2 = z1 + b1 * Math.cos(second);
      places = [[slot, 0], [r1, z1], [r2, z2], [radius, z2 + b2 * Math.cos(third)]];
      break;
    }
    case "rounded-lips": {
      const arc = number("lip_radius", NaN);
      places = chords(0, radius, (r) => arc - Math.sqrt((arc - r) * (arc + r)));
      break;
    }
    case "corner-radius": {
      const [angle, corner] = [half("point_angle", 118), number("corner_radius", NaN)];
      const r = radius - corner + corner * Math.cos(angle);
      const middle = r * lip + corner * Math.sin(angle);
      const arc = chords(0, angle, (turn) => turn).map(([, turn]): Place => [radius - corner + corner * Math.cos(angle - turn), middle - corner * Math.sin(angle - turn)]);
      places = [[0, 0], ...arc];
      break;
    }
    case "thinned-web": {
      const flat = number("flat", NaN);
      places = [[0, 0], [flat, 0], [radius, (radius - flat) * lip]];
      break;
    }
    case "slotted-chisel": {
      const slot = number("slot", NaN);
      places = [[slot, 0], [radius, (radius - slot) * lip]];
      break;
    }
    case "annular":
      places = [[number("core_diameter", NaN) / 2, 0], [radius, 0]];
      break;
    case "flat":
      places = [[0, 0], [radius, 0]];
      break;
    case "cannon": {
      const [e, k] = [number("overlap", NaN), rise((number("edge_angle", NaN) * Math.PI) / 180)];
      places = [[0, e * k], [e, 0], [e, 2 * e * k], [radius, (radius + e) * k]];
      break;
    }
    case "gun": {
      const apex = number("apex", diameter / 4);
      const [outer, inner] = [number("outer_angle", 60), number("inner_angle", 70)].map((angle) => rise((angle * Math.PI) / 180));
      places = [[0, apex * inner], [apex, 0], [radius, (radius - apex) * outer]];
      break;
    }
    case "cone": {
      const nose = number("nose_diameter", 0) / 2;
      places = [[nose, 0], [radius, (radius - nose) * rise(half("cone_angle", NaN))]];
      break;
    }
    case "centre":
      places = stepped(radius, lip, [{ diameter: numbers.pilot_diameter, length: numbers.pilot_length, shoulder_angle: number("cone_angle", 60) }]);
      break;
    case "stepped":
      places = stepped(radius, lip, Array.isArray(numbers.stages) ? numbers.stages : []);
      break;
  }
  return places.every(([r, z]) => Number.isFinite(r) && Number.isFinite(z) && r >= -1e-9 && r <= radius + 1e-9) ? places : null;
}

function chords(from: number, to: number, height: (r: number) => number): Place[] {
  return Array.from({ length: CHORDS + 1 }, (_, i) => from + ((to - from) * i) / CHORDS).map((r) => [r, height(r)]);
}

function stepped(radius: number, tip: number, stages: Numbers[]): Place[] {
  const places: Place[] = [[0, 0]];
  let [inner, top, slope] = [0, 0, tip];
  for (const stage of stages) {
    const [r, length] = [Number(stage.diameter) / 2, Number(stage.length)];
    places.push([r, top + (r - inner) * slope], [r, length]);
    slope = 1 / Math.tan((Number(stage.shoulder_angle ?? 180) * Math.PI) / 360);
    [inner, top] = [r, length];
  }
  places.push([radius, top + (radius - inner) * slope]);
  return places;
}

/** Height of an outline: the length of the point. */
export function heightOf(half: Place[]): number {
  const heights = half.map(([, z]) => z);
  return Math.max(...heights) - Math.min(...heights);
}

/** The whole outline as a ring of places, the body up to a height above the lowest point; two rings where a core stays. */
export function silhouette(kind: PointKind, half: Place[], up: number): Place[][] {
  const inner = half[0][0];
  const outer = half[half.length - 1][0];
  const left = half.map(([r, z]): Place => [-r, z]).reverse();
  if (kind === "annular") {
    return [
      [[-outer, up], ...left, [-inner, up]],
      [[inner, up], ...half, [outer, up]],
    ];
  }
  const isSlot = (kind === "slotted-chisel" || kind === "cast-iron") && inner > 0;
  const roof: Place[] = isSlot ? [[-inner, half[0][1] + inner], [inner, half[0][1] + inner]] : [];
  return [[[-outer, up], ...left, ...roof, ...half, [outer, up]]];
}

/** A single lip, which does not turn yet: of points with one lip. */
export function lipOf({ kind, numbers }: Pick<Point, "kind" | "numbers">, diameter: number, up: number): Place[] | null {
  const radius = diameter / 2;
  const rise = (key: string, standard: number) => 1 / Math.tan((Number(numbers[key] ?? standard) * Math.PI) / 180);
  if (kind === "cannon") {
    const [e, k] = [Number(numbers.overlap), rise("edge_angle", NaN)];
    return [[-e, up], [-e, 0], [radius, (radius + e) * k], [radius, up]];
  }
  if (kind === "gun") {
    const apex = Number(numbers.apex ?? diameter / 4);
    return [[0, up], [0, apex * rise("inner_angle", 70)], [apex, 0], [radius, (radius - apex) * rise("outer_angle", 60)], [radius, up]];
  }
  return null;
}
