// Clamps and fixtures, each there in the lines of its setup.
import { BufferAttribute, BufferGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial } from "three";
import { type Head, fixtures } from "./decode";
import { colour } from "./theme";

/** Faces that meet at a greater angle show their edge [degrees]. */
const EDGE = 25;

export class Fixtures {
  readonly group = new Group();
  private readonly surface = new MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.7 });

  constructor(private readonly head: Head["fixtures"]) {
    for (const { positions, indices } of fixtures(head)) {
      const shared = new BufferGeometry();
      shared.setAttribute("position", new BufferAttribute(positions, 3));
      shared.setIndex(new BufferAttribute(indices, 1));
      // Flat faces.
      const flat = shared.toNonIndexed();
      flat.computeVertexNormals();
      const body = new Group();
      body.add(new Mesh(flat, this.surface), new LineSegments(new EdgesGeometry(shared, EDGE), this.edge));
      this.group.add(body);
    }
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
