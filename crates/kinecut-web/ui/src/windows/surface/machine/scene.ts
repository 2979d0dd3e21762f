// A machine in space: each body on its link, which the verb moves. It draws when something has changed and rests otherwise.
import { AmbientLight, Box3, BufferAttribute, BufferGeometry, DirectionalLight, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshLambertMaterial, OrthographicCamera, Scene, Vector3, WebGLRenderer } from "three";
import { colour } from "viewer/theme";
import type { Body, Machine, Pose } from "./state";

/** Faces that meet at a greater angle show their edge [degrees]. */
const EDGE = 25;
/** Tints of the palette by the role of a body, as in the drawings of the library. */
const TINTS: Record<Body["role"], string> = { part: "sand", cutter: "steel", bed: "grey", work: "blue", tool: "orange" };

export type Look = "iso" | "top" | "front" | "right";
const LOOKS: Record<Look, [number, number]> = { iso: [-0.92, 0.5], top: [-Math.PI / 2, Math.PI / 2 - 1e-4], front: [-Math.PI / 2, 0], right: [0, 0] };

function facesOf(body: Body): BufferGeometry {
  const triangles = body.faces.flatMap((face) => face.slice(2).flatMap((_, i) => [face[0], face[i + 1], face[i + 2]]));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(body.corners.flat()), 3));
  geometry.setIndex(triangles);
  return geometry;
}

export class MachineScene {
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly renderer: WebGLRenderer;
  private readonly links = new Map<string, Group>();
  private readonly surfaces: { material: MeshLambertMaterial; role: Body["role"] }[] = [];
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
  private readonly upright = new Group();
  private readonly box = new Box3();
  private yaw = LOOKS.iso[0];
  private pitch = LOOKS.iso[1];
  private zoom = 1;
  private wanted = 0;

  /** Throws where the browser has no WebGL. */
  constructor(canvas: HTMLCanvasElement, machine: Machine) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    const key = new DirectionalLight(0xffffff, 2.1);
    key.position.set(-0.4, -0.9, 1.3);
    const fill = new DirectionalLight(0xffffff, 0.9);
    fill.position.set(1, -0.3, 0.4);
    this.scene.add(this.upright, key, fill, new AmbientLight(0xffffff, 1.1));
    // In the picture up is Z, whatever is up in the workshop.
    if (machine.drawn && machine.drawn.up[1] > 0.5) this.upright.matrix.set(-1, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
    this.upright.matrixAutoUpdate = false;
    for (const body of machine.drawn?.bodies ?? []) {
      const shared = facesOf(body);
      const flat = shared.toNonIndexed();
      flat.computeVertexNormals();
      const material = new MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
      this.surfaces.push({ material, role: body.role });
      this.link(body.link).add(new Mesh(flat, material), new LineSegments(new EdgesGeometry(shared, EDGE), this.edge));
    }
    this.recolour();
    this.box.setFromObject(this.upright);
  }

  private link(name: string): Group {
    const known = this.links.get(name);
    if (known) return known;
    const made = new Group();
    made.matrixAutoUpdate = false;
    this.links.set(name, made);
    this.upright.add(made);
    return made;
  }

  recolour(): void {
    for (const { material, role } of this.surfaces) material.color = colour(`${TINTS[role]}-lit`).lerp(colour(`${TINTS[role]}-dim`), 0.5);
    this.edge.color = colour("ink");
    this.draw();
  }

  /** Moves the links. */
  at(pose: Pose): void {
    for (const { link, matrix } of pose.links) {
      const [a, b, c] = matrix;
      this.links.get(link)?.matrix.set(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], c[0], c[1], c[2], c[3], 0, 0, 0, 1);
    }
    this.draw();
  }

  /** Place of the tip of a link's point, for tests: where a corner is now. */
  corner(link: string, point: [number, number, number]): [number, number, number] {
    return new Vector3(...point).applyMatrix4(this.links.get(link)?.matrix ?? new Matrix4()).toArray();
  }

  look(name: Look): void {
    [this.yaw, this.pitch] = LOOKS[name];
    this.zoom = 1;
    this.draw();
  }

  turn(dx: number, dy: number): void {
    this.yaw -= dx;
    this.pitch = Math.min(Math.PI / 2 - 1e-4, Math.max(-Math.PI / 2 + 1e-4, this.pitch + dy));
    this.draw();
  }

  near(by: number): void {
    this.zoom = Math.min(12, Math.max(0.4, this.zoom * by));
    this.draw();
  }

  resize(width: number, height: number): void {
    this.renderer.setSize(width, height, false);
    this.camera.userData.aspect = width / height;
    this.draw();
  }

  private draw(): void {
    cancelAnimationFrame(this.wanted);
    this.wanted = requestAnimationFrame(() => this.now());
  }

  private now(): void {
    const centre = this.box.getCenter(new Vector3());
    const radius = Math.max(1, 0.5 * this.box.getSize(new Vector3()).length());
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const eye = new Vector3(cp * cy, cp * sy, sp);
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(centre).addScaledVector(eye, 6 * radius);
    this.camera.lookAt(centre);
    const aspect = (this.camera.userData.aspect as number | undefined) ?? 1;
    const half = (1.02 * radius) / this.zoom;
    const [wide, high] = aspect > 1 ? [half * aspect, half] : [half, half / aspect];
    Object.assign(this.camera, { left: -wide, right: wide, top: high, bottom: -high, near: 0.1, far: 14 * radius });
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }

  close(): void {
    cancelAnimationFrame(this.wanted);
    this.scene.traverse((o) => o instanceof Mesh && (o.geometry as BufferGeometry).dispose());
    this.renderer.dispose();
  }
}
