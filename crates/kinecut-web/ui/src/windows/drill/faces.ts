// The seven kinds of surfaces that a drill enters or leaves: their names, their numbers, their heights over the tool axis.
import type { Value } from "../../toml/edit";

export type Side = "entry" | "exit";
export const KINDS = ["square", "falling", "rising", "shaft", "shaftBeside", "bore", "boreBeside"] as const;
export type Kind = (typeof KINDS)[number];

/** A surface as the text has it. */
export interface Face {
  surface?: string;
  radius?: number;
  inclination?: number;
  offset?: number;
  at?: [number, number];
  direction?: number;
}

/** Keys of the numbers that a kind needs. */
export const NEEDS: Record<Kind, ("inclination" | "radius" | "offset")[]> = {
  square: [],
  falling: ["inclination"],
  rising: ["inclination"],
  shaft: ["radius"],
  shaftBeside: ["radius", "offset"],
  bore: ["radius"],
  boreBeside: ["radius", "offset"],
};

const isNumber = (v: unknown): v is number => typeof v === "number" && Number.isFinite(v);

/** Direction in which a surface rises or falls [degrees from X]: a plane along its direction, a cylinder across its axis. */
export function across(face: Face): number {
  return (face.direction ?? 0) + (face.surface === "plane" ? 0 : 90);
}

/** Distance of the tool axis from the origin of a surface's frame, with the rule of the library for a place and a direction. */
export function offsetOf(face: Face, place: [number, number]): number {
  if (isNumber(face.offset)) return face.offset;
  const [x, y] = Array.isArray(face.at) ? face.at : [0, 0];
  const angle = (across(face) * Math.PI) / 180;
  const along = (place[0] - x) * Math.cos(angle) + (place[1] - y) * Math.sin(angle);
  return Math.abs(along) < 1e-12 ? 0 : along;
}

/** The kind of a surface; null for another surface. */
export function kindOf(face: Face | undefined, place: [number, number]): Kind | null {
  if (!face) return null;
  const beside = offsetOf(face, place) !== 0;
  switch (face.surface) {
    case "plane": {
      const angle = face.inclination ?? 0;
      return angle === 0 ? "square" : angle < 0 ? "falling" : "rising";
    }
    case "outer-cylinder":
      return beside ? "shaftBeside" : "shaft";
    case "inner-cylinder":
      return beside ? "boreBeside" : "bore";
    default:
      return null;
  }
}

/** Values to begin with, in diameters of the drill and in degrees. */
const BEGIN = { radius: 1.5, offset: 0.25, inclination: 10 };

/** A surface of a kind; numbers that are known already stay, the others are values to begin with. */
export function faceOf(kind: Kind, known: Face | undefined, other: Face | undefined, diameter: number): { [key: string]: Value } {
  const round = (n: number) => Number(n.toPrecision(3));
  const radius = known?.radius ?? other?.radius ?? round(BEGIN.radius * diameter);
  const angle = Math.abs(known?.inclination ?? 0) || BEGIN.inclination;
  const cylinder = (surface: string) => ({ surface, radius });
  const beside = (surface: string) => ({ surface, radius, offset: known?.offset || round(BEGIN.offset * diameter) });
  switch (kind) {
    case "square":
      return { surface: "plane" };
    case "falling":
      return { surface: "plane", inclination: -angle };
    case "rising":
      return { surface: "plane", inclination: angle };
    case "shaft":
      return cylinder("outer-cylinder");
    case "shaftBeside":
      return beside("outer-cylinder");
    case "bore":
      return cylinder("inner-cylinder");
    case "boreBeside":
      return beside("inner-cylinder");
  }
}

/** A surface in the section through the tool axis: its height at a distance, and how far it reaches to both sides. */
export interface Line {
  height: (u: number) => number;
  from: number;
  to: number;
}

/** The line of a surface in the frame of the entry; null where its numbers make none. */
export function lineOf(face: Face | undefined, side: Side, place: [number, number], below: number): Line | null {
  if (!face) return null;
  const offset = offsetOf(face, place);
  if (face.surface === "plane") {
    const slope = Math.tan(((face.inclination ?? 0) * Math.PI) / 180);
    return { height: (u) => (offset + u) * slope - below, from: -Infinity, to: Infinity };
  }
  const { radius } = face;
  if (!isNumber(radius) || radius <= 0) return null;
  // Seen along the feed the top of a shaft and the roof of a bore are ridges.
  const sign = (face.surface === "outer-cylinder") === (side === "entry") ? 1 : -1;
  const height = (u: number) => sign * Math.sqrt(Math.max(0, (radius - (offset + u)) * (radius + (offset + u)))) - below;
  return { height, from: -radius - offset, to: radius - offset };
}
