// The 3-D view. It draws when something has changed and rests otherwise.
import {
  AmbientLight, Box3, DirectionalLight, DoubleSide, BackSide, FrontSide, Group, LatheGeometry, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, MeshPhongMaterial, type Object3D, OrthographicCamera, Plane, Quaternion, Raycaster, Scene, Triangle, Vector2, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { type Head, type PartData, part as readPart } from "./decode";
import { type Quantity, greatest } from "./engaged";
import { Fixtures, Machine } from "./bodies";
import { Cap, hatched, marked } from "./cap";
import { PathLines } from "./lines";
import { onProcessor } from "./processor";
import { bandTexture, geometry } from "./mesh";
import { Overlay } from "./overlay";
import { Probes } from "./probes";
import { Stock } from "./stock";
import { colour, onTheme } from "./theme";
import type { Cursor, Place, Track } from "./track";
import { micrometres, millimetres } from "./words";

/** Up to this number of triangles the deviation is read under the moving pointer, above it on a click. */
const HOVER = 120_000;
/** Sources of the cursor that move it on. */
const MOVING = ["play", "slider", "step"];
/** Pieces of the outline of a tool that meet at a greater angle make an edge [rad]. */
const CORNER = Math.PI / 9;
/** So near to a surface, as a share of the whole, a place counts as in front of it: it is known to the lines of the stock alone. */
const NEAR = 0.006;
/** Directions from the part to the eye. */
const VIEWS: Record<string, [number, number, number]> = {
  iso: [0.9, -1.2, 1.05],
  // Not quite vertical: at the pole the view would have no upward direction.
  top: [0, -1e-5, 1],
  front: [0, -1, 0],
  right: [1, 0, 0],
};

/** What surrounds a view. */
export interface Around {
  /** Takes the words about what lies under the pointer. */
  readout: (text: string) => void;
  /** Words for a place that was not compared, and the unit of relative deviations. */
  notCompared: string;
  tolerances: string;
  /** Told when who plays or steps wants to see material go. */
  nowOn: () => void;
  /** Told of each picture, with the place on the canvas [px] of a point [mm]. */
  drawn?: (project: (point: Point) => [number, number]) => void;
  /** Told which of the marked places the part hides. */
  hidden?: (hidden: boolean[]) => void;
  /** Told where a click meets the part; takes it with true, so that the cursor stays. */
  clicked?: (hit: Hit | null) => boolean;
}

/** x, y, z [mm]. */
export type Point = [number, number, number];

/** A place of the part's surface. */
export interface Hit {
  point: Point;
  /** Triangle of the part. */
  triangle: number;
}

/** Cutting part, shank, holder. */
type ToolShape = (LatheGeometry | null)[];

export class View {
  private readonly renderer: WebGLRenderer;
  /** Whether wide lines take long. */
  private readonly slow: boolean;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly controls: OrbitControls;
  private readonly part = new Group();
  private readonly tool = new Group();
  private lines: PathLines | null = null;
  private readonly overlay: Overlay;
  private fixtures: Fixtures | null = null;
  private machine: Machine | null = null;
  private readonly clip = new Plane(new Vector3(0, 0, -1), 0);
  private readonly cap = new Cap();
  /** Places that are marked over the picture, and the question which of them are hidden. */
  private marked: Vector3[] = [];
  private readonly probes: Probes;
  private readonly bounds = new Box3();
  private data: PartData | null = null;
  private readonly surface = new MeshLambertMaterial({ side: FrontSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  private readonly inside = new MeshBasicMaterial({ side: BackSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
  /** Of the cutting part, the shank and the holder. */
  private readonly steel = ["tool", "shank", "holder"].map((name) => ({ name, material: new MeshPhongMaterial({ side: DoubleSide, shininess: 40, specular: 0x333333 }) }));
  private tools: ToolShape[] = [];
  /** Signs that turn the iso view to the side from which the worst place is seen. */
  private readonly facing = new Vector3(1, 1, 1);
  /** Axis of the section plane: 0, 1, 2; -1 for none. */
  private axis = -1;
  private waiting = false;
  /** What is no longer shown; given back after the next picture, so that its shaders are still there for those that have come. */
  private old: Object3D[] = [];
  private shown = { past: false, tool: true, holder: true, part: true, path: true, rapids: true, fixtures: true, machine: false };
  /** The stock over time; made when it is first shown. */
  private stock: Stock | null = null;
  /** Whether the stock is shown as it is at the cursor instead of the finished part, and whether the reader said so. */
  private now = { on: false, chosen: false };

  private head: Head | undefined;
  private track: Track | undefined;
  /** The head whose part is shown. */
  private partHead: Head["part"] = null;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly cursor: Cursor, private readonly around: Around) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, stencil: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.slow = onProcessor(this.renderer.getContext() as WebGL2RenderingContext);
    this.tool.visible = false;
    hatched(this.inside);
    const light = new DirectionalLight(0xffffff, 2.1);
    light.position.set(-0.5, 0.8, 1);
    this.camera.add(light, light.target);
    light.target.position.set(0, 0, -1);
    this.probes = new Probes(this.renderer.getContext() as WebGL2RenderingContext, (hidden) => this.hide(hidden), () => this.draw());
    this.scene.add(new AmbientLight(0xffffff, 1.25), this.camera, this.part, this.tool, this.cap.mesh, this.probes.group);
    // What is cut open comes first: its face lies before all that comes later.
    this.part.renderOrder = -2;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.overlay = new Overlay(canvas.parentElement as HTMLElement);
    onTheme(() => this.recolour());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
    this.pointer();
    cursor.listen((place, source) => this.follow(place, source));
  }

  /**
   * Shows other data; the camera stays unless `fit`. With `keepPart` the part stays that of the data before, where it had one; with `soon`
   * other data will follow soon: without a graphics card the lines are thin until then.
   */
  load(head: Head, track: Track, { fit = true, keepPart = false, soon = false } = {}): void {
    const first = !this.head;
    this.head = head;
    this.track = track;
    if (!keepPart || this.data === null) this.loadPart(head);
    this.bounds.makeEmpty();
    const mesh = this.part.children[0] as Mesh | undefined;
    if (mesh?.geometry.boundingBox) this.bounds.copy(mesh.geometry.boundingBox);
    this.growByPath(track);
    const size = this.bounds.getSize(new Vector3()).length() || 1;
    for (const gone of [this.lines?.group, this.fixtures?.group, this.machine?.group]) {
      gone?.removeFromParent();
      if (gone) this.old.push(gone);
    }
    this.lines = track.pieces > 0 ? new PathLines(track, size, soon && this.slow) : null;
    if (this.axis >= 0) this.lines?.clip([this.clip]);
    for (const shapes of this.tools) for (const shape of shapes) shape?.dispose();
    this.tools = head.tools.map(shapes);
    this.tool.clear();
    this.fixtures = new Fixtures(head.fixtures);
    this.machine = head.machine ? new Machine(head.machine, track) : null;
    for (const come of [this.lines?.group, this.fixtures.group, this.machine?.group]) if (come) this.scene.add(come);
    this.recolour();
    this.resize();
    this.showAll();
    if (fit || first) this.look("iso");
    this.follow(this.cursor.place, "load");
  }

  private loadPart(head: Head): void {
    freed(this.part.children, false);
    if (this.stock) {
      this.stock.group.removeFromParent();
      this.old.push(this.stock.group);
    }
    this.stock = null;
    this.facing.set(1, 1, 1);
    this.partHead = head.part;
    this.data = head.part && readPart(head.part);
    if (!head.part || !this.data) return;
    const mesh = geometry(this.data, head.part.tolerance, head.part.edges);
    this.part.add(new Mesh(mesh, this.surface), new Mesh(mesh, this.inside));
    this.part.children[1].visible = this.axis >= 0;
    mesh.computeBoundingBox();
    this.face(head.part.tolerance);
  }

  /** Switches everything as it was, on data that has just come. */
  private showAll(): void {
    if (this.lines) this.lines.group.visible = this.shown.path;
    this.lines?.showRapids(this.shown.rapids);
    if (this.fixtures) this.fixtures.group.visible = this.shown.fixtures;
    if (this.machine) this.machine.group.visible = this.shown.machine;
  }

  /** When the part is out of tolerance, its worst triangle shall look at the eye. */
  private face(tolerance: number): void {
    const { positions, indices, deviation } = this.data as PartData;
    if (!deviation) return;
    let [worst, corner] = [tolerance, -1];
    for (let i = 0; i < indices.length; i++) {
      const d = Math.abs(deviation[indices[i]]);
      if (d > worst) [worst, corner] = [d, i];
    }
    if (corner < 0) return;
    const first = corner - (corner % 3);
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromArray(positions, 3 * indices[first + k]));
    const normal = b.sub(a).cross(c.sub(a));
    if (normal.x < 0) this.facing.x = -1;
    if (normal.y > 0) this.facing.y = -1;
  }

  /** Cuts belong to the picture, moves through the air do not: they would make the part small. */
  private growByPath(track: Track): void {
    const add = (names: string[]) => {
      const roles = names.map((name) => track.head.roles.indexOf(name));
      for (let p = 0; p < track.pieces; p++) {
        if (!roles.includes(track.role[p])) continue;
        for (let i = track.first[p]; i < track.first[p + 1]; i++) {
          this.bounds.expandByPoint(new Vector3().fromArray(track.points, 3 * i));
        }
      }
    };
    add(["feed", "rough", "finish"]);
    if (this.bounds.isEmpty()) add(track.head.roles);
    if (this.bounds.isEmpty()) this.bounds.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  }

  private recolour(): void {
    this.surface.map?.dispose();
    this.surface.map = null;
    if (this.partHead?.compared) {
      this.surface.map = bandTexture(this.partHead.edges);
      this.surface.color.set(0xffffff);
    } else {
      this.surface.color = colour("part");
    }
    this.surface.needsUpdate = true;
    this.inside.color = colour("cut");
    this.cap.recolour();
    for (const { name, material } of this.steel) material.color = colour(name);
    this.lines?.recolour();
    this.stock?.recolour();
    this.fixtures?.recolour();
    this.machine?.recolour();
    this.draw();
  }

  draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  private drawNow(): void {
    this.waiting = false;
    if (this.axis >= 0) this.cap.at(this.clip, this.bounds.getCenter(new Vector3()), 2 * this.size());
    this.probes.around(this.camera, NEAR * this.size(), () => this.renderer.render(this.scene, this.camera));
    freed(this.old, true);
    this.old = [];
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.overlay.update(this.camera, this.pixels() * this.camera.zoom, width, height);
    this.around.drawn?.((point) => {
      const v = new Vector3(...point).project(this.camera);
      return [((v.x + 1) / 2) * width, ((1 - v.y) / 2) * height];
    });
  }

  /** Marks places, as those of findings: `hidden` is told which of them the part hides. */
  mark(points: Point[]): void {
    this.marked = points.map((p) => new Vector3(...p));
    this.probe();
  }

  private probe(): void {
    const { point } = this.overlay;
    this.probes.set(point ? [...this.marked, point] : this.marked);
    this.draw();
  }

  private hide(hidden: boolean[]): void {
    this.around.hidden?.(hidden.slice(0, this.marked.length));
    this.overlay.fade(hidden[this.marked.length] ?? false);
  }

  /** Diagonal of what is shown [mm]. */
  private size(): number {
    return this.bounds.getSize(new Vector3()).length() || 1;
  }

  /** Pixels for a millimetre at zoom 1. */
  private pixels(): number {
    return this.canvas.clientHeight / (this.camera.top - this.camera.bottom);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement as HTMLElement;
    if (width === 0 || height === 0) return;
    const ratio = this.renderer.getPixelRatio();
    if (this.canvas.width !== Math.floor(width * ratio) || this.canvas.height !== Math.floor(height * ratio)) this.renderer.setSize(width, height, false);
    const half = this.camera.top;
    this.camera.left = (-half * width) / height;
    this.camera.right = (half * width) / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Turns to a named direction and fits all into the view. */
  look(name: string): void {
    const direction = new Vector3(...(VIEWS[name] ?? VIEWS.iso)).normalize();
    if (name === "iso") direction.multiply(this.facing);
    const bounds = this.bounds.clone();
    if (this.machine?.group.visible) bounds.expandByObject(this.machine.group);
    const centre = bounds.getCenter(new Vector3());
    const radius = bounds.getSize(new Vector3()).length() / 2 || 1;
    this.camera.position.copy(centre).addScaledVector(direction, 20 * radius);
    this.camera.near = 0;
    this.camera.far = 40 * radius;
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
    const toCamera = this.camera.matrixWorld.clone().invert();
    let [x, y] = [0, 0];
    for (let i = 0; i < 8; i++) {
      const { min, max } = bounds;
      const v = new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z).applyMatrix4(toCamera);
      x = Math.max(x, Math.abs(v.x));
      y = Math.max(y, Math.abs(v.y));
    }
    const aspect = this.canvas.clientWidth / (this.canvas.clientHeight || 1) || 1;
    const half = 1.12 * Math.max(y, x / aspect);
    Object.assign(this.camera, { top: half, bottom: -half, left: -half * aspect, right: half * aspect, zoom: 1 });
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    if (this.axis >= 0) this.turnSection();
    this.draw();
  }

  /** What lies between the section plane and the eye goes away. */
  private turnSection(): void {
    const at = this.clip.constant * -this.clip.normal.getComponent(this.axis);
    const side = this.camera.position.getComponent(this.axis) > this.controls.target.getComponent(this.axis) ? -1 : 1;
    this.clip.normal.set(0, 0, 0).setComponent(this.axis, side);
    this.clip.constant = -side * at;
  }

  /** Switches something on or off; `chosen`: by the reader. */
  show(what: string, on: boolean, chosen: boolean): void {
    if (what === "now") {
      this.now = { on, chosen: this.now.chosen || chosen };
      this.showMoment();
    }
    if (what === "part") {
      this.shown.part = on;
      this.showMoment();
    }
    if (what === "path" || what === "fixtures" || what === "rapids") {
      this.shown[what] = on;
      this.showAll();
    }
    if (what === "machine" && this.shown.machine !== on) {
      this.shown.machine = on;
      this.showAll();
      if (this.machine) this.look("iso");
    }
    if (what === "past" || what === "tool" || what === "holder") {
      this.shown[what] = on;
      this.follow(this.cursor.place, "switch");
    }
    this.draw();
  }

  /** Colours the path; tells the end of the scale, 0 where it has none. */
  colourPath(quantity: Quantity | ""): number {
    this.lines?.colourBy(quantity);
    this.draw();
    return quantity === "" || !this.track ? 0 : greatest(this.track, quantity);
  }

  /** Turns the camera about the part [rad]: to the side and up. */
  turn(side: number, up: number): void {
    const arm = this.camera.position.clone().sub(this.controls.target);
    const length = arm.length();
    const around = Math.atan2(arm.y, arm.x) + side;
    // At the poles the view would have no upward direction.
    const above = Math.min(Math.PI / 2 - 1e-5, Math.max(1e-5 - Math.PI / 2, Math.asin(arm.z / length) + up));
    arm.set(Math.cos(above) * Math.cos(around), Math.cos(above) * Math.sin(around), Math.sin(above)).multiplyScalar(length);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.draw();
  }

  /** Shifts the picture [px]. */
  pan(right: number, up: number): void {
    const mm = 1 / (this.pixels() * this.camera.zoom || 1);
    const shift = new Vector3(-right * mm, -up * mm, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.controls.update();
    this.draw();
  }

  zoom(by: number): void {
    this.camera.zoom *= by;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Cuts the part open across an axis; `share` from 0 to 1 through it. Returns the place [mm], null when off. */
  section(axis: string, share: number): number | null {
    const k = "XYZ".indexOf(axis);
    const on = axis !== "" && k >= 0;
    for (const m of [this.surface, this.inside]) m.clippingPlanes = on ? [this.clip] : null;
    marked(this.surface, this.inside, on);
    this.cap.mesh.visible = on;
    this.stock?.section(on ? [this.clip] : null);
    this.lines?.clip(on ? [this.clip] : null);
    this.renderer.localClippingEnabled = on;
    // The inside is only seen through a section; drawing it costs as much as the outside.
    if (this.part.children[1]) this.part.children[1].visible = on;
    this.draw();
    const turned = k !== this.axis;
    this.axis = on ? k : -1;
    if (!on) return null;
    const [min, max] = [this.bounds.min.getComponent(k), this.bounds.max.getComponent(k)];
    const at = min + (max - min) * share;
    if (turned) this.clip.normal.set(0, 0, 0).setComponent(k, 1);
    this.clip.constant = -this.clip.normal.getComponent(k) * at;
    if (turned) this.turnSection();
    return at;
  }

  /** The part as it is finished, or the stock as it is at the cursor. */
  private showMoment(): void {
    if (!this.head) return;
    const { playback } = this.head;
    const { place } = this.cursor;
    const tick = playback && this.track && place.piece >= 0 ? Math.floor(this.track.done(place) * playback.ticks + 0.5) : Infinity;
    const now = this.now.on && playback !== null && tick < playback.ticks;
    if (now && this.stock === null) {
      this.stock = new Stock(playback);
      this.stock.section(this.axis >= 0 ? [this.clip] : null);
      this.scene.add(this.stock.group);
    }
    if (this.stock) {
      this.stock.tick = tick;
      this.stock.group.visible = now && this.shown.part;
    }
    this.part.visible = !now && this.shown.part;
    this.canvas.parentElement?.classList.toggle("now", now);
    this.draw();
  }

  private follow(place: Place, source: string): void {
    const { track, lines } = this;
    if (!track) return;
    // Who plays or steps wants to see material go.
    if (MOVING.includes(source) && !this.now.chosen && this.head?.playback) {
      this.now.on = true;
      this.around.nowOn();
    }
    this.showMoment();
    if (this.overlay.point) {
      this.overlay.point = null;
      this.probe();
    }
    this.fixtures?.at(place.line);
    this.machine?.at(place);
    if (place.piece < 0) {
      lines?.mark(0, 0);
      lines?.upTo(Infinity);
      lines?.dimFrom(Infinity);
      this.tool.visible = false;
    } else {
      lines?.mark(track.runStart(place.piece), track.runEnd(place.piece));
      lines?.upTo(this.shown.past ? place.piece : Infinity);
      lines?.dimFrom(place.piece);
      this.place(place, track);
    }
    this.draw();
  }

  /** Moves tool and holder to a place on the path. */
  private place(place: Place, track: Track): void {
    const tip = track.tip(place);
    const shape = this.tools[track.tool[place.piece]];
    this.tool.visible = tip !== null && (shape?.some((s) => s !== null) ?? false);
    if (!tip || !shape) return;
    const axis = new Vector3().fromArray(track.axes, 3 * track.axis[place.piece]).normalize();
    this.tool.position.set(...tip);
    this.tool.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), axis));
    if (this.tool.userData.shape !== shape) {
      this.tool.clear();
      this.tool.userData.shape = shape;
      shape.forEach((part, i) => this.tool.add(new Mesh(part ?? undefined, this.steel[i].material)));
    }
    this.tool.children.forEach((mesh, i) => {
      mesh.visible = shape[i] !== null && (i < 2 ? this.shown.tool : this.shown.holder);
    });
  }

  /** Shows a place in space, as that of a finding. */
  showPoint(at: [number, number, number]): void {
    this.overlay.point = new Vector3(...at);
    this.probe();
  }

  private pointer(): void {
    const { canvas } = this;
    const { readout } = this.around;
    const place = (e: PointerEvent | MouseEvent): [number, number] => {
      const box = canvas.getBoundingClientRect();
      return [e.clientX - box.left, e.clientY - box.top];
    };
    let down: [number, number] | null = null;
    let frame = 0;
    canvas.addEventListener("pointerdown", (e) => (down = place(e)));
    canvas.addEventListener("pointerup", (e) => {
      const [x, y] = place(e);
      const still = down !== null && Math.hypot(x - down[0], y - down[1]) < 4;
      down = null;
      if (!still || e.button !== 0 || this.around.clicked?.(this.hit(x, y))) return;
      const hit = this.lines?.group.visible ? this.lines.pick(x, y, this.camera, canvas.clientWidth, canvas.clientHeight) : null;
      if (hit && this.track) this.cursor.go(this.track.ofPiece(hit.piece, hit.part), "view");
      readout(this.read(x, y));
    });
    canvas.addEventListener("pointermove", (e) => {
      if (down || (this.partHead?.triangles ?? 0) > HOVER) return;
      cancelAnimationFrame(frame);
      frame = requestAnimationFrame(() => readout(this.read(...place(e))));
    });
    canvas.addEventListener("pointerleave", () => readout(""));
  }

  /** The surface of the part that is shown: corners and triangles. */
  get surfaceData(): PartData | null {
    return this.data;
  }

  /** Presses the middle of the picture, as a click there does. */
  pressMiddle(): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.around.clicked?.(this.hit(clientWidth / 2, clientHeight / 2));
  }

  /** The part's surface at a place of the canvas [px]; null beside it, and on the face of a section. */
  private hit(x: number, y: number): Hit | null {
    const under = this.under(x, y);
    return under && under.triangle >= 0 ? under : null;
  }

  /** What lies at a place of the canvas [px]: the surface of the part, or the face of a section, which has no triangle (-1). */
  private under(x: number, y: number): Hit | null {
    if (!this.data || !this.part.visible) return null;
    const ray = new Raycaster();
    // Also where the camera was turned since the last frame.
    this.camera.updateMatrixWorld();
    ray.setFromCamera(new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight), this.camera);
    const cut = this.axis >= 0;
    const [outside, inside] = this.part.children;
    const hit = ray.intersectObjects(cut ? [outside, inside] : [outside], false).find((h) => !cut || this.clip.distanceToPoint(h.point) >= 0);
    if (!hit || hit.faceIndex == null) return null;
    if (hit.object === outside) return { point: hit.point.toArray(), triangle: hit.faceIndex };
    return { point: (ray.ray.intersectPlane(this.clip, new Vector3()) ?? hit.point).toArray(), triangle: -1 };
  }

  /** Coordinates and deviation of the part under the pointer. */
  private read(x: number, y: number): string {
    const hit = this.under(x, y);
    if (!hit || !this.data) return "";
    const p = new Vector3(...hit.point);
    const text = `X ${millimetres(p.x)}  Y ${millimetres(p.y)}  Z ${millimetres(p.z)}`;
    if (hit.triangle < 0) return text;
    const { positions, indices, deviation } = this.data;
    const corners = [0, 1, 2].map((k) => indices[3 * hit.triangle + k]);
    const [a, b, c] = corners.map((v) => new Vector3().fromArray(positions, 3 * v));
    const weight = Triangle.getBarycoord(p, a, b, c, new Vector3());
    if (!deviation || !weight) return text;
    const d = deviation[corners[0]] * weight.x + deviation[corners[1]] * weight.y + deviation[corners[2]] * weight.z;
    const shown = this.partHead?.relative ? `${d.toFixed(2)} ${this.around.tolerances}` : micrometres(d);
    return `${text}  ·  ${Number.isNaN(d) ? this.around.notCompared : shown}`;
  }

  /** The picture as it is, for paper. */
  still(): string {
    this.drawNow();
    return this.canvas.toDataURL("image/png");
  }
}

/** A tool as bodies of revolution: its outline cut where the flutes end and where the holder begins. */
function shapes({ outline, flutes, holder }: Head["tools"][number]): ToolShape {
  const top = outline.reduce((most, [, h]) => Math.max(most, h), 0);
  const held = Math.min(holder ?? top, top);
  const heights = [0, Math.min(Math.max(flutes, 0), held), held, top];
  return [0, 1, 2].map((i) => {
    const points = between(outline, heights[i], heights[i + 1]);
    return points.length < 2 ? null : new LatheGeometry(creased(points), 40).rotateX(Math.PI / 2);
  });
}

/** An outline whose corners stand twice, so that light does not run round them. */
function creased(points: [number, number][]): Vector2[] {
  const all = points.map(([r, h]) => new Vector2(r, h));
  return all.flatMap((p, i) => {
    if (i === 0 || i + 1 === all.length) return [p];
    const turn = Math.abs(all[i + 1].clone().sub(p).angleTo(p.clone().sub(all[i - 1])));
    return turn > CORNER ? [p, p.clone()] : [p];
  });
}

/** The part of an outline between two heights, closed at both. */
function between(outline: [number, number][], from: number, to: number): [number, number][] {
  if (!(to > from)) return [];
  const points: [number, number][] = [];
  for (let i = 0; i + 1 < outline.length; i++) {
    const [[ra, ha], [rb, hb]] = [outline[i], outline[i + 1]];
    const [low, high] = [Math.min(ha, hb), Math.max(ha, hb)];
    // A step at the lower end belongs to what is above it, one at the upper end to what is below.
    if (high < from || low > to || (high === low && (low <= from ? from > 0 : low >= to && i + 2 < outline.length && rb > ra))) continue;
    for (const [r, h] of [outline[i], outline[i + 1]]) {
      const at = Math.min(to, Math.max(from, h));
      const radius = at === h ? r : ra + ((rb - ra) * (at - ha)) / (hb - ha);
      const last = points[points.length - 1];
      if (!last || last[0] !== radius || last[1] !== at) points.push([radius, at]);
    }
  }
  if (points.length === 0) return points;
  if (points[0][0] > 0) points.unshift([0, points[0][1]]);
  const last = points[points.length - 1];
  if (last[0] > 0) points.push([0, last[1]]);
  return points;
}

/** Takes objects out of their groups and gives back what they have on the graphics card, with `materials` if no other has them. */
function freed(objects: Object3D[], materials: boolean): void {
  for (const object of [...objects]) {
    object.removeFromParent();
    object.traverse((o) => {
      const { geometry, material } = o as Mesh;
      geometry?.dispose();
      if (materials && material) for (const one of [material].flat()) one.dispose();
    });
  }
}
