// The path in three dimensions: one object for each role, the piece under the cursor, and what lies under the pointer.
import {
  BufferAttribute, BufferGeometry, type Camera, Group, InstancedBufferAttribute, LineBasicMaterial, LineDashedMaterial, LineSegments, type Material,
  type Plane, Vector3,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { type Quantity, engagedLines } from "./engaged";
import { colour } from "./theme";
import type { Track } from "./track";

/** Above this number of segments lines are one pixel wide: wide ones would be slow without a graphics card. */
const WIDE = 60_000;
/** How near the pointer must be [px]. */
const NEAR = 8;
/** Width of the piece under the cursor, and where it is so many times longer than wide that it would fill its picture [px]. */
const MARK = 4.5;
const MARK_DENSE = 1.8;
const DENSE = 12;
/** What is still to come is drawn with this share of what is done. */
const TO_COME = 0.38;
const WIDTH: Record<string, number> = { rapid: 1.4, link: 1.4, lead: 1.8, feed: 1.6, rough: 1.6, finish: 2.4 };

interface Role {
  name: string;
  /** The line itself, and its part behind the part, faint. */
  objects: (LineSegments<BufferGeometry, LineBasicMaterial> | LineSegments2)[];
  /** Piece of each segment, rising. */
  piece: Uint32Array;
}

export class PathLines {
  readonly group = new Group();
  private readonly roles: Role[] = [];
  private readonly highlight: LineSegments2;
  /** The path in colours of engagement; made when it is first wanted. */
  private engaged: Role | null = null;
  private by: Quantity | "" = "";
  private last = Infinity;
  /** The last piece that is done. */
  private readonly done = { value: 1e9 };
  private readonly wide: boolean;
  private planes: Plane[] | null = null;

  /** `thin`: lines one pixel wide, however few they are. */
  constructor(private readonly track: Track, size: number, thin = false) {
    const { first, points } = track;
    let segments = 0;
    for (let p = 0; p < track.pieces; p++) segments += first[p + 1] - first[p] - 1;
    const wide = (this.wide = !thin && segments <= WIDE);
    track.head.roles.forEach((name, role) => {
      const xyz: number[] = [];
      const piece: number[] = [];
      for (let p = 0; p < track.pieces; p++) {
        if (track.role[p] !== role) continue;
        for (let i = first[p]; i + 1 < first[p + 1]; i++) {
          for (let k = 0; k < 6; k++) xyz.push(points[3 * i + k]);
          piece.push(p);
        }
      }
      if (piece.length === 0) return;
      const dashed = name === "rapid" || name === "link";
      const dash = { dashSize: size * (name === "rapid" ? 0.02 : 0.006), gapSize: size * 0.012 };
      const objects = [true, false].map((front) => {
        const look = { depthTest: front, transparent: true, opacity: front ? 1 : 0.22, depthWrite: front };
        let line: LineSegments<BufferGeometry, LineBasicMaterial> | LineSegments2;
        if (wide) {
          const material = new LineMaterial({ ...look, linewidth: WIDTH[name], dashed, ...(dashed ? dash : {}) });
          line = new LineSegments2(new LineSegmentsGeometry().setPositions(xyz), material);
        } else {
          const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(xyz), 3));
          line = new LineSegments(geometry, dashed ? new LineDashedMaterial({ ...look, ...dash }) : new LineBasicMaterial(look));
        }
        if (dashed) line.computeLineDistances();
        this.dimmed(line, piece);
        line.renderOrder = front ? 3 : 2;
        line.frustumCulled = false;
        this.group.add(line);
        return line;
      });
      this.roles.push({ name, objects, piece: Uint32Array.from(piece) });
    });
    this.highlight = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: MARK, depthTest: false, transparent: true }));
    this.highlight.renderOrder = 5;
    this.highlight.frustumCulled = false;
    this.highlight.visible = false;
    this.group.add(this.highlight);
    this.recolour();
  }

  recolour(): void {
    for (const role of this.roles) for (const o of role.objects) o.material.color = colour(role.name);
    this.highlight.material.color = colour("accent");
    if (this.by) this.colourBy(this.by);
  }

  /** Colours the path by a quantity of engagement, or by what each move is for. */
  colourBy(quantity: Quantity | ""): void {
    this.by = quantity;
    for (const o of this.engaged?.objects ?? []) {
      this.group.remove(o);
      o.geometry.dispose();
      o.material.dispose();
    }
    this.engaged = quantity ? this.inColours(quantity) : null;
    this.clip(this.planes);
    for (const role of this.roles) if (role.name !== "rapid") for (const o of role.objects) o.visible = !this.engaged;
    this.upTo(this.last);
  }

  private inColours(quantity: Quantity): Role {
    const { xyz, rgb, piece } = engagedLines(this.track, quantity);
    const objects = [true, false].map((front) => {
      const look = { depthTest: front, transparent: true, opacity: front ? 1 : 0.22, depthWrite: front, vertexColors: true };
      let line: Role["objects"][number];
      if (this.wide) {
        line = new LineSegments2(new LineSegmentsGeometry().setPositions(xyz).setColors(rgb), new LineMaterial({ ...look, linewidth: WIDTH.finish }));
      } else {
        const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(xyz), 3));
        line = new LineSegments(geometry.setAttribute("color", new BufferAttribute(Float32Array.from(rgb), 3)), new LineBasicMaterial(look));
      }
      this.dimmed(line, piece);
      line.renderOrder = front ? 3 : 2;
      line.frustumCulled = false;
      this.group.add(line);
      return line;
    });
    return { name: "engaged", objects, piece: Uint32Array.from(piece) };
  }

  /** Dims what comes after a piece; nothing with infinity. */
  dimFrom(last: number): void {
    this.done.value = Math.min(last, 1e9);
  }

  /** Lets a line dim the segments whose `piece` is still to come. */
  private dimmed(line: Role["objects"][number], piece: number[]): void {
    if (line instanceof LineSegments2) line.geometry.setAttribute("order", new InstancedBufferAttribute(Float32Array.from(piece), 1));
    else line.geometry.setAttribute("order", new BufferAttribute(Float32Array.from({ length: 2 * piece.length }, (_, i) => piece[i >> 1]), 1));
    const material: Material = line.material;
    material.onBeforeCompile = (shader) => {
      shader.uniforms.done = this.done;
      shader.vertexShader = `attribute float order; varying float ofOrder;\n${shader.vertexShader}`.replace("void main() {", "void main() {\nofOrder = order;");
      const dims = `(ofOrder > done + 0.5 ? ${TO_COME.toFixed(2)} : 1.0)`;
      shader.fragmentShader = `uniform float done; varying float ofOrder;\n${shader.fragmentShader}`
        .replace("float alpha = opacity;", `float alpha = opacity * ${dims};`)
        .replace("vec4 diffuseColor = vec4( diffuse, opacity );", `vec4 diffuseColor = vec4( diffuse, opacity * ${dims} );`);
    };
  }

  showRapids(on: boolean): void {
    for (const role of this.roles) if (role.name === "rapid") for (const o of role.objects) o.visible = on;
  }

  /** Shows only what lies behind planes; all of it without. */
  clip(planes: Plane[] | null): void {
    this.planes = planes;
    for (const role of this.engaged ? [...this.roles, this.engaged] : this.roles) for (const o of role.objects) o.material.clippingPlanes = planes;
  }

  /** Shows the path up to and with a piece; all of it with infinity. */
  upTo(last: number): void {
    this.last = last;
    for (const role of this.engaged ? [...this.roles, this.engaged] : this.roles) {
      let [lo, hi] = [0, role.piece.length];
      while (lo < hi) {
        const mid = (lo + hi) >> 1;
        if (role.piece[mid] > last) hi = mid;
        else lo = mid + 1;
      }
      for (const o of role.objects) {
        if (o instanceof LineSegments2) o.geometry.instanceCount = lo;
        else o.geometry.setDrawRange(0, 2 * lo);
      }
    }
  }

  /** Marks the pieces from `from` to before `to`. */
  mark(from: number, to: number): void {
    const { first, points } = this.track;
    const xyz: number[] = [];
    for (let p = from; p < to; p++) {
      for (let i = first[p]; i + 1 < first[p + 1]; i++) for (let k = 0; k < 6; k++) xyz.push(points[3 * i + k]);
    }
    this.highlight.visible = xyz.length > 0;
    if (xyz.length === 0) return;
    this.highlight.geometry.dispose();
    this.highlight.geometry = new LineSegmentsGeometry().setPositions(xyz);
    let length = 0;
    for (let i = 0; i < xyz.length; i += 6) length += Math.hypot(xyz[i + 3] - xyz[i], xyz[i + 4] - xyz[i + 1], xyz[i + 5] - xyz[i + 2]);
    this.highlight.geometry.computeBoundingSphere();
    const size = 2 * (this.highlight.geometry.boundingSphere?.radius ?? 0);
    this.highlight.material.linewidth = length > DENSE * size ? MARK_DENSE : MARK;
  }

  /** The piece nearest to a place on the screen [px], and how far along it; null when none is near. */
  pick(x: number, y: number, camera: Camera, width: number, height: number): { piece: number; part: number } | null {
    const { first, points, role } = this.track;
    const hidden = this.roles.filter((r) => !r.objects[0].visible && (!this.engaged || r.name === "rapid")).map((r) => this.track.head.roles.indexOf(r.name));
    const v = new Vector3();
    let best = NEAR * NEAR;
    let found: { piece: number; part: number } | null = null;
    for (let p = 0; p < this.track.pieces; p++) {
      if (hidden.includes(role[p])) continue;
      let [ax, ay] = [NaN, NaN];
      let along = 0;
      let was = false;
      for (let i = first[p]; i < first[p + 1]; i++) {
        v.set(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
        const behind = !this.planes?.some((plane) => plane.distanceToPoint(v) < 0);
        v.project(camera);
        const [bx, by] = [((v.x + 1) / 2) * width, ((1 - v.y) / 2) * height];
        if (i > first[p] && (behind || was)) {
          const [dx, dy] = [bx - ax, by - ay];
          const q = dx * dx + dy * dy;
          const t = q > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / q)) : 0;
          const d = (ax + t * dx - x) ** 2 + (ay + t * dy - y) ** 2;
          if (d < best) {
            best = d;
            found = { piece: p, part: 0 };
            along = i - 1 + t;
          }
        }
        [ax, ay, was] = [bx, by, behind];
      }
      if (found?.piece === p) found.part = this.share(p, along);
    }
    return found;
  }

  /** Share of the length of a piece up to a point given by its index with fraction. */
  private share(p: number, along: number): number {
    const { first, points } = this.track;
    let [before, all] = [0, 0];
    for (let i = first[p] + 1; i < first[p + 1]; i++) {
      const gap = Math.hypot(...[0, 1, 2].map((k) => points[3 * i + k] - points[3 * i - 3 + k]));
      before += gap * Math.min(1, Math.max(0, along - (i - 1)));
      all += gap;
    }
    return all > 0 ? before / all : 0;
  }
}
