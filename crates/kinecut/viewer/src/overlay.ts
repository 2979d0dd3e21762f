// Axes and a scale bar over the 3-D view.
import { type Camera, Vector3 } from "three";

const NS = "http://www.w3.org/2000/svg";
const ARM = 24;
/** Longest scale bar [px]. */
const BAR = 140;

function element(name: string, attributes: Record<string, string | number>, parent: Element): SVGElement {
  const e = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, String(value));
  parent.append(e);
  return e;
}

export class Overlay {
  private readonly axes: { arm: SVGElement; word: SVGElement; unit: Vector3 }[];
  private readonly bar: SVGElement;
  private readonly length: SVGElement;
  private readonly rings: SVGElement;
  private readonly ring: SVGElement;
  /** Place in space to point at, as that of a finding. */
  point: Vector3 | null = null;

  constructor(stage: HTMLElement) {
    this.rings = element("svg", { class: "rings", "aria-hidden": "true" }, stage);
    this.ring = element("g", { visibility: "hidden" }, this.rings);
    element("circle", { class: "halo", r: 11 }, this.ring);
    element("circle", { class: "ring", r: 11 }, this.ring);
    const svg = element("svg", { class: "overlay", width: 220, height: 84, "aria-hidden": "true", translate: "no" }, stage);
    this.axes = ["X", "Y", "Z"].map((name, k) => {
      const arm = element("line", { class: "arm", x1: 40, y1: 44 }, svg);
      const word = element("text", { "text-anchor": "middle", "dominant-baseline": "central" }, svg);
      word.textContent = name;
      return { arm, word, unit: new Vector3().setComponent(k, 1) };
    });
    this.bar = element("path", { class: "scale" }, svg);
    this.length = element("text", { x: 84, y: 62 }, svg);
  }

  /** Shows the place that is pointed at as one behind the part. */
  fade(behind: boolean): void {
    this.ring.classList.toggle("behind", behind);
  }

  /** Follows the camera; `pixels` for a millimetre on a canvas of this size [px]. */
  update(camera: Camera, pixels: number, width: number, height: number): void {
    // The picture for paper has another size: the view box makes the ring follow it.
    this.rings.setAttribute("viewBox", `0 0 ${width} ${height}`);
    if (this.point) {
      const v = this.point.clone().project(camera);
      this.ring.setAttribute("transform", `translate(${((v.x + 1) / 2) * width} ${((1 - v.y) / 2) * height})`);
    }
    this.ring.setAttribute("visibility", this.point ? "visible" : "hidden");
    const turn = camera.quaternion.clone().invert();
    for (const { arm, word, unit } of this.axes) {
      const v = unit.clone().applyQuaternion(turn);
      arm.setAttribute("x2", String(40 + ARM * v.x));
      arm.setAttribute("y2", String(44 - ARM * v.y));
      // An axis that points at the eye needs no word.
      word.setAttribute("visibility", Math.hypot(v.x, v.y) > 0.2 ? "visible" : "hidden");
      word.setAttribute("x", String(40 + (ARM + 9) * v.x));
      word.setAttribute("y", String(44 - (ARM + 9) * v.y));
    }
    if (!(pixels > 0)) return;
    const power = 10 ** Math.floor(Math.log10(BAR / pixels));
    const mm = [5, 2, 1].map((n) => n * power).find((n) => n * pixels <= BAR) ?? power;
    this.bar.setAttribute("d", `M84 68v6h${mm * pixels}v-6`);
    this.length.textContent = mm < 1 ? `${Number((mm * 1000).toPrecision(3))} µm` : `${mm} mm`;
  }
}
