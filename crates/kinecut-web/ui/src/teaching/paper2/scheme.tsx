// The section of a drilling between two surfaces, with the drill at some heights.
import { lineOf } from "../../windows/drill/faces";
import type { Point, Values } from "../model";
import { type Box, Plane } from "../plane";
import { outline, profile } from "./geometry";
import { SURFACES } from "./plan";

interface Surface {
  height: (u: number) => number;
  from: number;
  to: number;
}

/** Entry and exit of the inputs in the section through the drill's axis. */
export function surfacesOf(v: Values): { above: Surface; below: Surface } {
  const face = (kind: number, radius: number, offset: number, inclination: number) => ({ surface: SURFACES[kind], radius, offset, inclination });
  const flat = (z: number): Surface => ({ height: () => z, from: -Infinity, to: Infinity });
  return {
    above: lineOf(face(v.kindIn ?? 0, v.RSin ?? 100, v.xIn ?? 0, v.alphaIn ?? 0), "entry", [0, 0], 0) ?? flat(0),
    below: lineOf(face(v.kindOut ?? 0, v.RSout ?? 100, v.xOut ?? 0, v.alphaOut ?? 0), "exit", [0, 0], v.L) ?? flat(-v.L),
  };
}

/** A plane that shows all heights at which the drill is drawn. */
export function planeOf(v: Values, heights: number[], box: Box): Plane {
  const { above, below } = surfacesOf(v);
  const R = v.D / 2;
  const corners = profile(v);
  const L1 = corners[corners.length - 1][1];
  const us = [-2 * R, -R, 0, R, 2 * R];
  const clamp = (s: Surface, u: number) => Math.min(s.to, Math.max(s.from, u));
  const all = [...heights, ...heights.map((z) => z + L1), ...us.map((u) => above.height(clamp(above, u))), ...us.map((u) => below.height(clamp(below, u)))];
  return new Plane([-2 * R, Math.min(...all) - 0.4 * R], [2 * R, Math.max(...all) + 0.5 * R], box);
}

export function Scheme({ v, plane, at }: { v: Values; plane: Plane; at: { z: number; kind: string }[] }) {
  const { above, below } = surfacesOf(v);
  const R = v.D / 2;
  const corners = profile(v);
  const top = plane.max[1];
  const reach = (u: number) => Math.min(above.to, below.to, Math.max(above.from, below.from, u));
  const run = (s: Surface, from: number, to: number): Point[] => Array.from({ length: 33 }, (_, i) => reach(from + ((to - from) * i) / 32)).map((u) => [u, s.height(u)]);
  const side = (from: number, to: number): Point[] => [...run(above, from, to), ...run(below, to, from).map(([u, z]): Point => [u, Math.min(z, above.height(u))])];
  return (
    <>
      <path d={plane.line(side(-2 * R, -R), true)} class="hatched" />
      <path d={plane.line(side(R, 2 * R), true)} class="hatched" />
      {[above, below].map((s, i) => (
        <g key={i}>
          <path d={plane.line(run(s, -2 * R, -R))} class="part" />
          <path d={plane.line(run(s, -R, R))} class="dashed" />
          <path d={plane.line(run(s, R, 2 * R))} class="part" />
        </g>
      ))}
      <path d={`M${plane.x(0)} ${plane.box.top}V${plane.box.top + plane.box.height}`} class="axis" />
      {at.map(({ z, kind }, i) => (
        <path key={i} d={plane.line(outline(corners, 0, z, Math.max(top, z)), true)} class={kind} />
      ))}
    </>
  );
}
