// The tool as a body: what enters and what leaves as two meshes whose common border is the grazing curve, edges as circles, the curve by
// its spans: full where it is seen, dashed and thinner behind the tool.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, GreaterDepth, Group, LatheGeometry, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshPhongMaterial, Vector2 } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { colour } from "viewer/theme";
import { type Band, KINDS, type Sheet, type Vec } from "./sheet";

/** Widest column about the axis [deg]. */
const COLUMN = 7.5;
/** Distance of the curve above the surface by the size of the tool: it is not to sink into its facets. */
const ABOVE = 1.5e-3;
const RADIANS = Math.PI / 180;
/** Columns of the coarse body by which it is found what hides what, and points of its outline by the size of the tool. */
const COARSE = 40;
const APART = 0.02;

/** Corners of triangles with their normals. */
class Faces {
  private readonly places: number[] = [];
  private readonly normals: number[] = [];
  private readonly corners: number[] = [];

  /** A part of a band between two angles, at its start and at its end [deg]. */
  add(band: Band, start: [number, number], end: [number, number]): void {
    const wide = Math.max(start[1] - start[0], end[1] - end[0]);
    if (!(wide > 0)) return;
    const columns = Math.max(1, Math.ceil(wide / COLUMN));
    const first = this.places.length / 3;
    for (let i = 0; i <= columns; i++) {
      for (const [k, [from, to]] of [start, end].entries()) {
        const theta = (from + ((to - from) * i) / columns) * RADIANS;
        const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
        const [[r, z], [nr, nz]] = [band.places[k], band.normals[k]];
        this.places.push(r * cos, r * sin, z);
        this.normals.push(nr * cos, nr * sin, nz);
      }
    }
    for (let i = 0; i < columns; i++) {
      const a = first + 2 * i;
      this.corners.push(a, a + 2, a + 1, a + 1, a + 2, a + 3);
    }
  }

  geometry(): BufferGeometry {
    return new BufferGeometry()
      .setAttribute("position", new BufferAttribute(Float32Array.from(this.places), 3))
      .setAttribute("normal", new BufferAttribute(Float32Array.from(this.normals), 3))
      .setIndex(this.corners);
  }
}

/** A colour of bodies: between that of a face in full light and that of one turned away. In the dark bodies stay light. */
export function bodyColour(name: string): Color {
  const dark = document.documentElement.dataset.theme === "dark";
  return colour(`${name}-lit`).lerp(colour(`${name}-dim`), dark ? 0 : 0.5);
}

export function bodyMaterial(): MeshPhongMaterial {
  return new MeshPhongMaterial({ side: DoubleSide, shininess: 24, specular: 0x222222, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
}

export class Body {
  readonly group = new Group();
  private readonly enters = new Mesh(new BufferGeometry(), bodyMaterial());
  private readonly leaves = new Mesh(new BufferGeometry(), bodyMaterial());
  private readonly edges = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.5 }));
  private lines: { span: number; kind: number; seen: LineSegments2; hidden: LineSegments2 }[] = [];
  /** Kept from curve to curve: what is given back takes its shaders with it. */
  private readonly looks = KINDS.map(() => lookOf(3, 1.6));
  private readonly marked = lookOf(5.5, 3);
  /** Circles and ends of faces that graze as a whole. */
  private readonly rings = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 4 }));
  private chosen: number | null = null;

  constructor() {
    this.rings.visible = false;
    this.rings.frustumCulled = false;
    this.rings.renderOrder = 3;
    this.group.add(this.enters, this.leaves, this.edges, this.rings);
    this.recolour();
  }

  /** A coarse body: what is under the pointer, and what hides what. */
  readonly solid = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ side: DoubleSide }));

  /** Shows a tool; `curves`: with its curve. */
  show(sheet: Sheet, curves = true): void {
    const [enters, leaves] = [new Faces(), new Faces()];
    for (const band of sheet.bands) {
      if (sheet.pieces[band.piece].fan) continue;
      if (!band.enters) {
        leaves.add(band, [0, 360], [0, 360]);
        continue;
      }
      const [start, end] = band.enters;
      enters.add(band, start, end);
      leaves.add(band, [start[1], start[0] + 360], [end[1], end[0] + 360]);
    }
    for (const [mesh, faces] of [
      [this.enters, enters],
      [this.leaves, leaves],
    ] as const) {
      mesh.geometry.dispose();
      mesh.geometry = faces.geometry();
    }
    this.solid.geometry.dispose();
    this.solid.geometry = coarse(sheet);
    this.edges.geometry.dispose();
    this.edges.geometry = circles(sheet);
    if (curves) this.curve(sheet);
  }

  private curve(sheet: Sheet): void {
    for (const { seen, hidden } of this.lines) {
      for (const line of [seen, hidden]) {
        line.removeFromParent();
        line.geometry.dispose();
      }
    }
    const size = sheetSize(sheet);
    const spans = new Map<number, number[]>();
    for (const { points } of sheet.loops) {
      for (let i = 0; i + 1 < points.length; i++) {
        const [a, b] = [points[i], points[i + 1]];
        if (a.span !== b.span || a.branch !== b.branch) continue;
        let xyz = spans.get(a.span);
        if (!xyz) spans.set(a.span, (xyz = []));
        for (const p of [a, b]) for (let k = 0; k < 3; k++) xyz.push(p.point[k] + ABOVE * size * p.normal[k]);
      }
    }
    for (const { hidden } of [...this.looks, this.marked]) Object.assign(hidden, { dashSize: 0.014 * size, gapSize: 0.012 * size });
    put(this.rings, ringsOf(sheet));
    this.lines = [...spans].map(([span, xyz]) => {
      const kind = KINDS.indexOf(sheet.spans[span].kind);
      const made = (front: boolean) => {
        const line = new LineSegments2(new LineSegmentsGeometry().setPositions(xyz), front ? this.looks[kind].seen : this.looks[kind].hidden);
        if (!front) line.computeLineDistances();
        line.renderOrder = front ? 3 : 2;
        line.frustumCulled = false;
        this.group.add(line);
        return line;
      };
      return { span, kind, seen: made(true), hidden: made(false) };
    });
    this.choose(this.chosen);
  }

  /** Makes a span thicker. */
  choose(span: number | null): void {
    this.chosen = span;
    for (const line of this.lines) {
      const on = line.span === span;
      const look = on ? this.marked : this.looks[line.kind];
      [line.seen.material, line.hidden.material] = [look.seen, look.hidden];
      if (on) for (const material of [look.seen, look.hidden]) material.color = colour(`k${line.kind}`);
    }
  }

  recolour(): void {
    this.enters.material.color = bodyColour("orange");
    this.leaves.material.color = bodyColour("steel");
    this.edges.material.color = new Color(0x000000);
    this.rings.material.color = colour("k8");
    this.looks.forEach((look, kind) => {
      for (const material of [look.seen, look.hidden]) material.color = colour(`k${kind}`);
    });
    this.choose(this.chosen);
  }
}

/** A line where it is seen, and where the tool hides it. */
interface Look {
  seen: LineMaterial;
  hidden: LineMaterial;
}

function lookOf(seen: number, hidden: number): Look {
  return {
    seen: new LineMaterial({ linewidth: seen }),
    hidden: new LineMaterial({ linewidth: hidden, dashed: true, depthFunc: GreaterDepth, depthWrite: false, transparent: true, opacity: 0.75 }),
  };
}

function coarse(sheet: Sheet): BufferGeometry {
  const least = APART * sheetSize(sheet);
  const outline: Vector2[] = [];
  let piece = -1;
  for (const band of sheet.bands) {
    if (sheet.pieces[band.piece].fan) continue;
    if (band.piece !== piece) outline.push(new Vector2(...band.places[0]));
    piece = band.piece;
    const end = new Vector2(...band.places[1]);
    if (end.distanceTo(outline[outline.length - 1]) >= least) outline.push(end);
  }
  const last = sheet.bands[sheet.bands.length - 1];
  if (last) outline.push(new Vector2(...last.places[1]));
  return new LatheGeometry(outline, COARSE).rotateX(Math.PI / 2);
}

/** Gives a line other segments; without any it is not drawn. */
export function put(line: LineSegments2, xyz: number[]): void {
  line.geometry.dispose();
  line.geometry = new LineSegmentsGeometry();
  line.visible = xyz.length > 0;
  if (xyz.length > 0) line.geometry.setPositions(xyz);
}

function circle(r: number, z: number): number[] {
  const xyz: number[] = [];
  for (let i = 0; i < 72 && r > 0; i++) {
    for (const k of [i, i + 1]) {
      const theta = (k * Math.PI) / 36;
      xyz.push(r * Math.cos(theta), r * Math.sin(theta), z);
    }
  }
  return xyz;
}

function ringsOf(sheet: Sheet): number[] {
  const above = 1 + ABOVE;
  const ends = sheet.whole.filter((piece) => !sheet.pieces[piece].fan).flatMap((piece) => [sheet.pieces[piece].start, sheet.pieces[piece].end]);
  return [...ends, ...sheet.circles.map(({ radius, z }): [number, number] => [radius, z])].flatMap(([r, z]) => circle(r * above, z));
}

/** Circles of the edges. */
function circles(sheet: Sheet): BufferGeometry {
  const xyz = sheet.pieces.filter((piece) => piece.fan).flatMap((piece) => circle(...piece.start));
  return new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(xyz), 3));
}

/** Largest radius, lowest and highest height [mm]. */
export function extentOf(sheet: Sheet): { radius: number; low: number; high: number } {
  const radius = Math.max(...sheet.bands.flatMap((band) => band.places.map((p) => p[0])), 1e-3);
  return { radius, low: sheet.ends[0].z, high: sheet.ends[1].z };
}

export function sheetSize(sheet: Sheet): number {
  const { radius, low, high } = extentOf(sheet);
  return Math.max(2 * radius, high - low);
}

/** The eye at the side of the motion and a little below. */
export function besideMotion(sheet: Sheet): Vec {
  const [tip, top] = sheet.ends.map((end) => end.velocity);
  const way = [0.5 * (tip[0] + top[0]), 0.5 * (tip[1] + top[1])];
  const [x, y] = Math.hypot(way[0], way[1]) > 0 ? way : [tip[0], tip[1]];
  const around = (x === 0 && y === 0 ? 0 : Math.atan2(y, x)) - 0.95;
  return [Math.cos(-0.42) * Math.cos(around), Math.cos(-0.42) * Math.sin(around), Math.sin(-0.42)];
}
