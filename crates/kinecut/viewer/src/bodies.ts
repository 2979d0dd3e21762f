// Clamps, fixtures and the machine: each body a group with its faces and edges.
import { BufferAttribute, BufferGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshLambertMaterial } from "three";
import { type BodyData, type Head, bodies } from "./decode";
import { colour } from "./theme";
import type { Place, Track } from "./track";

/** Faces that meet at a greater angle show their edge [degrees]. */
const EDGE = 25;

/** A body with flat faces and its edges. */
function body({ positions, indices }: BodyData, surface: MeshLambertMaterial, edge: LineBasicMaterial): Group {
  const shared = new BufferGeometry();
  shared.setAttribute("position", new BufferAttribute(positions, 3));
  shared.setIndex(new BufferAttribute(indices, 1));
  const flat = shared.toNonIndexed();
  flat.computeVertexNormals();
  return new Group().add(new Mesh(flat, surface), new LineSegments(new EdgesGeometry(shared, EDGE), edge));
}

/** Clamps and fixtures, each there in the lines of its setup. */
export class Fixtures {
  readonly group = new Group();
  private readonly surface = new MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.7 });

  constructor(private readonly head: Head["fixtures"]) {
    for (const data of bodies("kc-fixtures", head)) this.group.add(body(data, this.surface, this.edge));
    this.recolour();
    this.at(-1);
  }

  recolour(): void {
    this.surface.color = colour("fixture");
    this.edge.color = colour("ink");
  }

  /** Shows those of the setup of a line; before the program those of the first one. */
  at(line: number): void {
    const now = Math.max(line, 0);
    this.head.forEach(({ lines }, i) => {
      this.group.children[i].visible = lines[0] <= now && now < lines[1];
    });
  }
}

/** The bodies of the machine about the part, which stays where it is. */
export class Machine {
  readonly group = new Group();
  private readonly surface = new MeshLambertMaterial({ transparent: true, opacity: 0.35, depthWrite: false });
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.5 });

  constructor(private readonly head: NonNullable<Head["machine"]>, private readonly track: Track) {
    for (const data of bodies("kc-machine", head.bodies)) {
      const one = body(data, this.surface, this.edge);
      one.matrixAutoUpdate = false;
      this.group.add(one);
    }
    this.group.visible = false;
    this.group.renderOrder = 3;
    this.recolour();
    this.at({ line: -1, piece: -1, part: 0 });
  }

  recolour(): void {
    this.surface.color = colour("machine");
    this.edge.color = colour("ink");
  }

  /** Moves it to a place of the path; off the path to where that begins. */
  at(place: Place): void {
    const { setups, bodies: all } = this.head;
    const there = place.piece >= 0 ? place : { ...place, piece: 0, part: 0 };
    const joints = this.track.joints(there);
    if (!joints) return;
    const line = Math.max(place.line, 0);
    const setup = setups.find(({ lines }) => lines[0] <= line && line < lines[1]) ?? setups[0];
    const [a, b, c, d, e, f, g, h, i, x, y, z] = setup.part;
    const part = new Matrix4().set(a, d, g, x, b, e, h, y, c, f, i, z, 0, 0, 0, 1);
    // The work stands on the first joint, or on the bed.
    const work = this.link(this.head.bed > 0 ? 0 : null, joints).multiply(part);
    const toPart = work.invert();
    all.forEach(({ link }, k) => {
      const one = this.group.children[k];
      one.matrix.copy(toPart).multiply(this.link(link, joints));
      one.matrixWorldNeedsUpdate = true;
    });
  }

  /** Motion of a link from home, in the frame of the machine. */
  private link(joint: number | null, positions: number[]): Matrix4 {
    const all = new Matrix4();
    if (joint === null) return all;
    const { bed, joints } = this.head;
    const [from, to] = joint < bed ? [joint, bed] : [bed, joint + 1];
    for (let j = from; j < to; j++) {
      const { rotary, direction: [x, y, z], point } = joints[j];
      const q = positions[j];
      if (!rotary) {
        all.multiply(new Matrix4().makeTranslation(x * q, y * q, z * q));
        continue;
      }
      const [s, c] = [Math.sin(q), Math.cos(q)];
      const v = 1 - c;
      const turn = new Matrix4().set(
        x * x * v + c, x * y * v - z * s, x * z * v + y * s, 0,
        x * y * v + z * s, y * y * v + c, y * z * v - x * s, 0,
        x * z * v - y * s, y * z * v + x * s, z * z * v + c, 0,
        0, 0, 0, 1,
      );
      const [px, py, pz] = point;
      all.multiply(new Matrix4().makeTranslation(px, py, pz)).multiply(turn).multiply(new Matrix4().makeTranslation(-px, -py, -pz));
    }
    return joint < bed ? all.invert() : all;
  }
}
