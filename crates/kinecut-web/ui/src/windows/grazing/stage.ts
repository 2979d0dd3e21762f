// A picture in three dimensions with the camera of the part's view: parallel, Z up, turned about what lies in its middle. It is drawn
// when something has changed and rests otherwise.
import { AmbientLight, Box3, DirectionalLight, type Object3D, OrthographicCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Overlay } from "viewer/overlay";
import { onTheme } from "viewer/theme";
import type { Vec } from "./sheet";

/** Directions from the middle to the eye. */
const VIEWS: Record<string, Vec> = { iso: [0.9, -1.2, 1.05], top: [0, -1e-5, 1], front: [0, -1, 0], right: [1, 0, 0], below: [0, -1e-5, -1] };
/** Turned by a key of an arrow [rad], shifted [px]. */
const TURN = Math.PI / 24;
const SHIFT = 40;

export class Stage {
  readonly scene = new Scene();
  readonly camera = new OrthographicCamera();
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly overlay: Overlay;
  private readonly bounds = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  private readonly sizes: ResizeObserver;
  private waiting = false;
  private direction: Vec = VIEWS.iso;
  private ended = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly around: { drawn: () => void; recolour: () => void },
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    const light = new DirectionalLight(0xffffff, 2.1);
    light.position.set(-0.5, 0.8, 1);
    light.target.position.set(0, 0, -1);
    this.camera.add(light, light.target);
    this.scene.add(new AmbientLight(0xffffff, 1.25), this.camera);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.overlay = new Overlay(canvas.parentElement as HTMLElement);
    onTheme(() => {
      if (this.ended) return;
      this.around.recolour();
      this.draw();
    });
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(canvas.parentElement as HTMLElement);
  }

  end(): void {
    this.ended = true;
    this.sizes.disconnect();
    this.controls.dispose();
    for (const old of this.canvas.parentElement?.querySelectorAll(":scope > svg.rings, :scope > svg.overlay") ?? []) old.remove();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  draw(): void {
    if (this.waiting || this.ended) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.ended) return;
      this.renderer.render(this.scene, this.camera);
      const { clientWidth, clientHeight } = this.canvas;
      this.overlay.update(this.camera, this.scale, clientWidth, clientHeight);
      this.around.drawn();
    });
  }

  /** Pixels for a millimetre. */
  get scale(): number {
    return (this.canvas.clientHeight / (this.camera.top - this.camera.bottom)) * this.camera.zoom;
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement as HTMLElement;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    const half = this.camera.top;
    this.camera.left = (-half * width) / height;
    this.camera.right = (half * width) / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The box that is fitted into the picture. */
  holds(min: Vec, max: Vec): void {
    this.bounds.set(new Vector3(...min), new Vector3(...max));
  }

  /** Turns to a named direction, or to one from the middle to the eye, and fits all into the picture. */
  look(from: string | Vec): void {
    this.direction = typeof from === "string" ? (VIEWS[from] ?? VIEWS.iso) : from;
    const direction = new Vector3(...this.direction).normalize();
    const centre = this.bounds.getCenter(new Vector3());
    const radius = this.bounds.getSize(new Vector3()).length() / 2 || 1;
    this.camera.position.copy(centre).addScaledVector(direction, 20 * radius);
    this.camera.near = 0;
    this.camera.far = 40 * radius;
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
    const toCamera = this.camera.matrixWorld.clone().invert();
    let [x, y] = [0, 0];
    const { min, max } = this.bounds;
    for (let i = 0; i < 8; i++) {
      const v = new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z).applyMatrix4(toCamera);
      x = Math.max(x, Math.abs(v.x));
      y = Math.max(y, Math.abs(v.y));
    }
    const aspect = this.canvas.clientWidth / (this.canvas.clientHeight || 1) || 1;
    const half = 1.16 * Math.max(y, x / aspect);
    Object.assign(this.camera, { top: half, bottom: -half, left: -half * aspect, right: half * aspect, zoom: 1 });
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    this.draw();
  }

  /** Keys of the picture; true when one was meant. */
  key(e: KeyboardEvent): boolean {
    if (e.ctrlKey || e.metaKey || e.altKey) return false;
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const way = arrows[e.key];
    if (way && e.shiftKey) this.pan(SHIFT * way[0], SHIFT * way[1]);
    else if (way) this.turn(TURN * way[0], TURN * way[1]);
    else if (e.key === "+" || e.key === "=") this.zoom(1.2);
    else if (e.key === "-") this.zoom(1 / 1.2);
    else if (e.key === "0") this.look(this.direction);
    else return false;
    return true;
  }

  private turn(side: number, up: number): void {
    const arm = this.camera.position.clone().sub(this.controls.target);
    const length = arm.length();
    const around = Math.atan2(arm.y, arm.x) + side;
    const above = Math.min(Math.PI / 2 - 1e-5, Math.max(1e-5 - Math.PI / 2, Math.asin(arm.z / length) + up));
    arm.set(Math.cos(above) * Math.cos(around), Math.cos(above) * Math.sin(around), Math.sin(above)).multiplyScalar(length);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.draw();
  }

  private pan(right: number, up: number): void {
    const shift = new Vector3(...this.across(-right, up));
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.controls.update();
    this.draw();
  }

  private zoom(by: number): void {
    this.camera.zoom *= by;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Place on the canvas [px] of a point [mm]. */
  project(point: Vec): [number, number] {
    const v = new Vector3(...point).project(this.camera);
    return [((v.x + 1) / 2) * this.canvas.clientWidth, ((1 - v.y) / 2) * this.canvas.clientHeight];
  }

  /** A way on the canvas [px] as one in the plane of the picture [mm]. */
  across(right: number, down: number): Vec {
    return new Vector3(right / this.scale, -down / this.scale, 0).applyQuaternion(this.camera.quaternion).toArray();
  }

  private ray(x: number, y: number): Raycaster {
    const ray = new Raycaster();
    this.camera.updateMatrixWorld();
    ray.setFromCamera(new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight), this.camera);
    return ray;
  }

  /** The nearest place of some objects at a place of the canvas [px]. */
  hit(objects: Object3D[], x: number, y: number): Vec | null {
    return this.ray(x, y).intersectObjects(objects, false)[0]?.point.toArray() ?? null;
  }

  /** Whether a point [mm] is behind some objects by more than a distance [mm]. */
  hides(objects: Object3D[], point: Vec, by: number): boolean {
    const [x, y] = this.project(point);
    const ray = this.ray(x, y);
    const depth = new Vector3(...point).sub(ray.ray.origin).dot(ray.ray.direction);
    const first = ray.intersectObjects(objects, false)[0];
    return first !== undefined && first.distance < depth - by;
  }
}
