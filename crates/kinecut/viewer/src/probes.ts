// Places that lie behind the part: beside a picture the graphics processor is asked whether a point there would be seen, and tells it a little
// later. Nobody waits for the answer.
import { BufferAttribute, BufferGeometry, type Camera, Group, Points, PointsMaterial, Vector3 } from "three";

/** Size of such a point [px]: it is seen as long as some of it is. */
const SIZE = 7;
/** Behind the part and its section face, before all else: neither tool nor path hides a place. */
const ORDER = -0.5;

interface Probe {
  at: Vector3;
  object: Points;
  query: WebGLQuery;
}

export class Probes {
  readonly group = new Group();
  private readonly geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(3), 3));
  private readonly material = new PointsMaterial({ size: SIZE, sizeAttenuation: false, colorWrite: false, depthWrite: false });
  private probes: Probe[] = [];
  /** Whether the picture that is drawn now asks. */
  private asks = false;
  private waits = false;
  /** Whether a picture came while an answer was waited for. */
  private again = false;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    /** Told for each place whether it is hidden. */
    private readonly told: (hidden: boolean[]) => void,
    private readonly redraw: () => void,
  ) {}

  set(points: Vector3[]): void {
    for (const { object, query } of this.probes) {
      object.removeFromParent();
      this.gl.deleteQuery(query);
    }
    this.waits = false;
    this.probes = points.map((at) => {
      const query = this.gl.createQuery() as WebGLQuery;
      const object = new Points(this.geometry, this.material);
      object.renderOrder = ORDER;
      object.frustumCulled = false;
      object.onBeforeRender = () => this.asks && this.gl.beginQuery(this.gl.ANY_SAMPLES_PASSED, query);
      object.onAfterRender = () => this.asks && this.gl.endQuery(this.gl.ANY_SAMPLES_PASSED);
      this.group.add(object);
      return { at, object, query };
    });
  }

  /** Draws a picture, with the question; `near` to its surface a place counts as in front of it [mm]. */
  around(camera: Camera, near: number, draw: () => void): void {
    const toEye = new Vector3(0, 0, near).applyQuaternion(camera.quaternion);
    for (const { at, object } of this.probes) object.position.copy(at).add(toEye);
    this.asks = this.probes.length > 0 && !this.waits;
    this.again = this.probes.length > 0 && this.waits;
    draw();
    if (this.asks) this.wait(this.probes);
    this.asks = false;
  }

  private wait(asked: Probe[]): void {
    this.waits = true;
    const look = () => {
      if (asked !== this.probes) return;
      const { gl } = this;
      if (!gl.isContextLost() && asked.some(({ query }) => !gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE))) {
        requestAnimationFrame(look);
        return;
      }
      this.waits = false;
      this.told(asked.map(({ query }) => gl.getQueryParameter(query, gl.QUERY_RESULT) === 0));
      if (this.again) this.redraw();
    };
    requestAnimationFrame(look);
  }
}
