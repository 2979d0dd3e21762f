// The stock as it is at a moment: all squares of its surface over time are on the graphics card. Those are drawn that may be there, and it
// leaves out what is not.
import { BackSide, BufferAttribute, BufferGeometry, DoubleSide, FrontSide, Group, type Material, Mesh, MeshBasicMaterial, MeshLambertMaterial, type Plane } from "three";
import { hatched, marked } from "./cap";
import { type Head, played } from "./decode";
import { cornerNormals } from "./mesh";
import { colour } from "./theme";

const OFFSET = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };

/** Faces that come in one stretch of time and go in one are drawn together: so many stretches. */
const STRETCHES = 48;

/** Faces of the index that come and go in the same stretches of time. */
interface Bunch {
  from: number;
  to: number;
  start: number;
  end: number;
}

export class Stock {
  readonly group = new Group();
  private readonly outside = new MeshLambertMaterial({ side: DoubleSide, ...OFFSET });
  private readonly inside = new MeshBasicMaterial({ side: BackSide, ...OFFSET });
  private readonly now = { value: -1 };
  private readonly raw = { value: colour("raw") };
  private readonly faces = new BufferGeometry();
  private readonly bunches: Bunch[] = [];
  /** Corners of the triangles of all faces, bunch after bunch; what is drawn is copied from here. */
  private readonly all: Uint32Array;
  private readonly drawn: BufferAttribute;
  private shown = "";

  constructor(head: NonNullable<Head["playback"]>) {
    const { positions, corners, lives } = played(head);
    const count = corners.length;
    const place = new Float32Array(3 * count);
    const life = new Uint16Array(2 * count);
    for (let i = 0; i < count; i++) {
      const [v, f] = [3 * corners[i], i >> 2];
      place[3 * i] = positions[v];
      place[3 * i + 1] = positions[v + 1];
      place[3 * i + 2] = positions[v + 2];
      life[2 * i] = lives[2 * f];
      life[2 * i + 1] = lives[2 * f + 1];
    }
    const normals = cornerNormals(positions, corners, 4);
    const packed = new Int8Array(4 * count);
    for (let i = 0; i < count; i++) {
      for (let k = 0; k < 3; k++) packed[4 * i + k] = Math.round(127 * normals[3 * i + k]);
    }
    this.all = this.bunched(lives, head.ticks);
    this.drawn = new BufferAttribute(new Uint32Array(this.all.length), 1);
    this.faces.setAttribute("position", new BufferAttribute(place, 3));
    this.faces.setAttribute("normal", new BufferAttribute(packed, 4, true));
    this.faces.setAttribute("life", new BufferAttribute(life, 2));
    this.faces.setIndex(this.drawn);
    for (const material of [this.outside, this.inside]) this.living(material);
    hatched(this.inside);
    this.group.add(new Mesh(this.faces, this.outside), new Mesh(this.faces, this.inside));
    // What is drawn changes; it always lies where the part is.
    for (const mesh of this.group.children) mesh.frustumCulled = false;
    this.group.children[1].visible = false;
    this.group.renderOrder = -2;
    this.recolour();
  }

  /** The corners of all triangles, sorted into bunches. */
  private bunched(lives: Uint16Array, ticks: number): Uint32Array {
    const count = lives.length / 2;
    const stretch = (tick: number) => Math.min(STRETCHES, Math.floor((tick / ticks) * STRETCHES));
    const bunch = new Uint16Array(count);
    const starts = new Uint32Array((STRETCHES + 1) ** 2 + 1);
    for (let f = 0; f < count; f++) {
      bunch[f] = stretch(lives[2 * f]) * (STRETCHES + 1) + stretch(lives[2 * f + 1]);
      starts[bunch[f] + 1]++;
    }
    for (let i = 1; i < starts.length; i++) starts[i] += starts[i - 1];
    const next = starts.slice();
    const all = new Uint32Array(6 * count);
    for (let f = 0; f < count; f++) {
      let i = 6 * next[bunch[f]]++;
      for (const k of [0, 1, 2, 0, 2, 3]) all[i++] = 4 * f + k;
    }
    for (let i = 0; i + 1 < starts.length; i++) {
      if (starts[i] === starts[i + 1]) continue;
      const [from, to] = [Math.floor(i / (STRETCHES + 1)), i % (STRETCHES + 1)];
      // From the beginning of the one to the end of the other.
      const bounds = { from: (from / STRETCHES) * ticks - 1, to: to === STRETCHES ? Infinity : ((to + 1) / STRETCHES) * ticks + 1 };
      this.bunches.push({ ...bounds, start: 6 * starts[i], end: 6 * starts[i + 1] });
    }
    return all;
  }

  /** Lets a material draw only what is there now; what is raw in another colour. */
  private living(material: Material): void {
    material.onBeforeCompile = (shader) => {
      shader.uniforms.now = this.now;
      shader.uniforms.raw = this.raw;
      shader.vertexShader = `attribute vec2 life; uniform float now; varying float isRaw;\n${shader.vertexShader}`.replace(
        "#include <project_vertex>",
        `#include <project_vertex>
        isRaw = life.x > 0.0 ? 0.0 : 1.0;
        if (life.x > now || life.y <= now) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);`,
      );
      if (material === this.outside) {
        shader.fragmentShader = `uniform vec3 raw; varying float isRaw;\n${shader.fragmentShader}`.replace(
          "#include <color_fragment>",
          "#include <color_fragment>\nif (isRaw > 0.5) diffuseColor.rgb = raw;",
        );
      }
    };
  }

  /** The moment, as a tick. */
  set tick(tick: number) {
    if (tick === this.now.value) return;
    this.now.value = tick;
    const there = this.bunches.filter(({ from, to }) => from <= tick && tick < to);
    // The same bunches need no new index.
    const shown = there.map(({ start }) => start).join();
    if (shown === this.shown) return;
    this.shown = shown;
    let length = 0;
    for (const { start, end } of there) {
      this.drawn.array.set(this.all.subarray(start, end), length);
      length += end - start;
    }
    this.drawn.clearUpdateRanges();
    this.drawn.addUpdateRange(0, length);
    this.drawn.needsUpdate = true;
    this.faces.setDrawRange(0, length);
  }

  recolour(): void {
    this.outside.color = colour("milled");
    this.inside.color = colour("cut");
    this.raw.value = colour("raw");
  }

  /** Cuts it open by planes; none: closed. */
  section(planes: Plane[] | null): void {
    for (const material of [this.outside, this.inside]) material.clippingPlanes = planes;
    marked(this.outside, this.inside, planes !== null);
    this.group.children[1].visible = planes !== null;
    // Closed, the back of its faces shows in small gaps beside the tool only, and fills them.
    this.outside.side = planes === null ? DoubleSide : FrontSide;
    this.outside.needsUpdate = true;
  }
}
