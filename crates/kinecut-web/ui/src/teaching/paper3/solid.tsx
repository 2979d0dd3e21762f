// A tool of revolution in a picture: what enters and what leaves apart, the curve dashed where the tool hides it, arrows.
import type { Band, Vec } from "../../windows/grazing/sheet";
import type { Point } from "../model";
import { type Box, Plane } from "../plane";
import { type Place, type Tool, bandsOf } from "./tool";

/** Steps of a circle [deg]. */
const STEP = 8;
const rad = (n: number) => (n * Math.PI) / 180;

/** A view along a direction: without perspective, one scale for all. */
export class Eye {
  readonly to: Vec;
  private readonly right: Vec;
  private readonly up: Vec;
  readonly plane: Plane;

  constructor(
    readonly azimuth: number,
    readonly rise: number,
    min: Point,
    max: Point,
    box: Box,
  ) {
    const [a, e] = [rad(azimuth), rad(rise)];
    this.to = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    this.right = [-Math.sin(a), Math.cos(a), 0];
    this.up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    this.plane = new Plane(min, max, box);
  }

  flat(p: Vec): Point {
    const along = (d: Vec) => p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
    return [along(this.right), along(this.up)];
  }

  at(p: Vec): Point {
    return this.plane.at(this.flat(p));
  }

  /** A move in the picture [px] as one in space [mm], across the view. */
  moved(dx: number, dy: number): Vec {
    const [x, y] = [dx / this.plane.scale, -dy / this.plane.scale];
    return [0, 1, 2].map((k) => x * this.right[k] + y * this.up[k]) as Vec;
  }
}

/** Half the angle of a circle that is seen [deg]: 0 none of it, 180 all. */
function half(eye: Eye, [nr, nz]: [number, number]): number {
  const [c, s] = [Math.cos(rad(eye.rise)), Math.sin(rad(eye.rise))];
  const need = -nz * s;
  const have = Math.abs(nr) * c;
  if (have <= Math.abs(need) + 1e-9) return need < 0 ? 180 : 0;
  return (Math.acos(need / (nr * c)) * 180) / Math.PI;
}

function ring(eye: Eye, [r, z]: [number, number], from: number, to: number): Point[] {
  const steps = Math.max(1, Math.ceil(Math.abs(to - from) / STEP));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const t = rad(from + ((to - from) * i) / steps);
    return eye.at([r * Math.cos(t), r * Math.sin(t), z]);
  });
}

export function pathOf(points: Point[], close = false): string {
  return points.map((p, i) => `${i ? "L" : "M"}${p[0].toFixed(1)} ${p[1].toFixed(1)}`).join("") + (close ? "Z" : "");
}

function sector(eye: Eye, band: Band, [a, b]: [number, number], [c, d]: [number, number]): string {
  return pathOf([...ring(eye, band.places[0], a, b), ...ring(eye, band.places[1], c, d).reverse()], true);
}

function BandView({ eye, band, rim }: { eye: Eye; band: Band; rim: boolean }) {
  const h = band.normals.map((n) => half(eye, n));
  if (h[0] <= 0 && h[1] <= 0) return null;
  const seen = h.map((x): [number, number] => [eye.azimuth - x, eye.azimuth + x]);
  let enters = "";
  if (band.enters) {
    for (const by of [-1080, -720, -360, 0, 360, 720]) {
      const cut = band.enters.map(([p, q], k): [number, number] => {
        const [from, to] = [Math.max(p + by, seen[k][0]), Math.min(q + by, seen[k][1])];
        const middle = Math.min(seen[k][1], Math.max(seen[k][0], (from + to) / 2));
        return from < to ? [from, to] : [middle, middle];
      });
      if (cut.some(([from, to]) => to > from)) enters += sector(eye, band, cut[0], cut[1]);
    }
  }
  const sides = [0, 1].map((side) => pathOf([0, 1].map((k) => ring(eye, band.places[k], seen[k][side], seen[k][side])[0]))).join("");
  return (
    <>
      <path d={sector(eye, band, seen[0], seen[1])} class={enters ? "leaves bare" : "leaves"} />
      {enters && <path d={enters} class="enters" />}
      {h.some((x) => x < 180) && <path d={sides} class="outline" />}
      {rim && <path d={pathOf(ring(eye, band.places[1], seen[1][0], seen[1][1]))} class="outline" />}
    </>
  );
}

/** Largest radius of the tool at a height. */
function radiusAt(bands: Band[], z: number): number {
  let most = 0;
  for (const { places: [[r0, z0], [r1, z1]] } of bands) {
    if (z < Math.min(z0, z1) || z > Math.max(z0, z1)) continue;
    most = Math.max(most, z1 === z0 ? Math.max(r0, r1) : r0 + ((r1 - r0) * (z - z0)) / (z1 - z0));
  }
  return most;
}

/** Whether a place of the surface is seen: it faces the eye, and nothing of the tool is between. */
function isSeen(eye: Eye, tool: Tool, place: Place, size: number): boolean {
  if (place[3] * eye.to[0] + place[4] * eye.to[1] + place[5] * eye.to[2] < 0) return false;
  for (let i = 1; i <= 40; i++) {
    const t = (i / 40) ** 1.5 * size;
    const z = place[2] + t * eye.to[2];
    if (Math.hypot(place[0] + t * eye.to[0], place[1] + t * eye.to[1]) < radiusAt(bandsOf(tool), z) - 0.002 * size - 0.02 * t) return false;
  }
  return true;
}

export function sizeOf(tool: Tool): { radius: number; low: number; high: number; size: number } {
  const radius = Math.max(...bandsOf(tool).flatMap((b) => b.places.map((p) => p[0])), 0.001);
  const [low, high] = [tool.ends[0].z, tool.ends[1].z];
  return { radius, low, high, size: Math.max(2 * radius, high - low) };
}

/** The tool, its curve over it; `thick` only of one piece. */
export function Solid({ eye, tool, piece }: { eye: Eye; tool: Tool; piece?: number }) {
  const { size } = sizeOf(tool);
  const shown = eye.rise < 0 ? [...bandsOf(tool)].reverse() : bandsOf(tool);
  let [seen, hidden] = ["", ""];
  for (const { places } of tool.loops) {
    let before: { place: Place; seen: boolean } | null = null;
    for (const place of places.length ? [...places, places[0]] : []) {
      if (piece !== undefined && place[6] !== piece) {
        before = null;
        continue;
      }
      const now = { place, seen: isSeen(eye, tool, place, size) };
      if (before) {
        const line = pathOf([eye.at([before.place[0], before.place[1], before.place[2]]), eye.at([place[0], place[1], place[2]])]);
        if (now.seen && before.seen) seen += line;
        else hidden += line;
      }
      before = now;
    }
  }
  return (
    <g class="solid">
      {shown.map((band, i) => (
        <BandView key={i} eye={eye} band={band} rim={i === 0 || (eye.rise < 0 ? shown[i - 1] : shown[i + 1])?.piece !== band.piece} />
      ))}
      <path d={hidden} class="hiddenCurve" />
      <path d={seen} class="graze" />
    </g>
  );
}

/** A velocity as an arrow from a place. */
export function Arrow({ eye, from, by, kind = "speed" }: { eye: Eye; from: Vec; by: Vec; kind?: string }) {
  const [a, b] = [eye.at(from), eye.at([from[0] + by[0], from[1] + by[1], from[2] + by[2]])];
  return Math.hypot(b[0] - a[0], b[1] - a[1]) < 3 ? null : <path d={pathOf([a, b])} class={kind} marker-end="url(#tg-arrow)" />;
}
