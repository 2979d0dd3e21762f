// The stock as it is at a moment: all squares of its surface over time are on the graphics card, which draws those that are there.
import { BackSide, BufferAttribute, BufferGeometry, DoubleSide, FrontSide, Group, type Material, Mesh, MeshBasicMaterial, MeshLambertMaterial, type Plane } from "three";
import { type Head, played } from "./decode";
import { cornerNormals } from "./mesh";
import { colour } from "./theme";

const OFFSET = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };

export class Stock {
  readonly group = new Group();
  private readonly outside = new MeshLambertMaterial({ side: DoubleSide, ...OFFSET });
  private readonly inside = new MeshBasicMaterial({ side: BackSide, ...OFFSET });
  private readonly now = { value: 0 };
  private readonly raw = { value: colour("raw") };

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
    const packed = new Int8Array(3 * count);
    for (let i = 0; i < packed.length; i++) packed[i] = Math.round(127 * normals[i]);
    const index = new Uint32Array((count / 4) * 6);
    for (let f = 0, i = 0; i < count; i += 4) {
      for (const k of [0, 1, 2, 0, 2, 3]) index[f++] = i + k;
    }
    const faces = new BufferGeometry();
    faces.setAttribute("position", new BufferAttribute(place, 3));
    faces.setAttribute("normal", new BufferAttribute(packed, 3, true));
    faces.setAttribute("life", new BufferAttribute(life, 2));
    faces.setIndex(new BufferAttribute(index, 1));
    for (const material of [this.outside, this.inside]) this.living(material);
    this.group.add(new Mesh(faces, this.outside), new Mesh(faces, this.inside));
    this.group.children[1].visible = false;
    this.recolour();
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
    this.now.value = tick;
  }

  recolour(): void {
    this.outside.color = colour("milled");
    this.inside.color = colour("cut");
    this.raw.value = colour("raw");
  }

  /** Cuts it open by planes; none: closed. */
  section(planes: Plane[] | null): void {
    for (const material of [this.outside, this.inside]) material.clippingPlanes = planes;
    this.group.children[1].visible = planes !== null;
    // Closed, the back of its faces shows in small gaps beside the tool only, and fills them.
    this.outside.side = planes === null ? DoubleSide : FrontSide;
    this.outside.needsUpdate = true;
  }
}
