// Plans and charts take part in the one cursor: a click finds the line, the cursor shows where it is.
import type { Cursor, Place, Track } from "./track";

const NS = "http://www.w3.org/2000/svg";
/** How near a click must be to a line [px on the screen]. */
const NEAR = 9;

function add(svg: SVGSVGElement, name: string, className: string): SVGElement {
  const e = document.createElementNS(NS, name);
  e.setAttribute("class", className);
  svg.append(e);
  return e;
}

/** Where a click is in the units of a drawing, and pixels of the screen for a unit. */
function inside(svg: SVGSVGElement, e: MouseEvent): { x: number; y: number; scale: number } | null {
  const matrix = svg.getScreenCTM();
  if (!matrix) return null;
  const p = new DOMPoint(e.clientX, e.clientY).matrixTransform(matrix.inverse());
  return { x: p.x, y: p.y, scale: matrix.a };
}

function points(d: string): Float32Array {
  return Float32Array.from(d.split(/[ L]/), Number);
}

interface Stretch {
  block: number;
  d: string;
  xy: Float32Array;
}

/** Squared distance of a point from the polyline `xy` and the place along it, as index with fraction. */
function nearest(xy: ArrayLike<number>, stride: number, from: number, to: number, x: number, y: number): [number, number] {
  let best: [number, number] = [Infinity, from];
  for (let i = from; i + 1 < to; i++) {
    const [ax, ay] = [xy[stride * i], xy[stride * i + 1]];
    const [dx, dy] = [xy[stride * i + stride] - ax, xy[stride * i + stride + 1] - ay];
    const q = dx * dx + dy * dy;
    const t = q > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / q)) : 0;
    const d = (ax + t * dx - x) ** 2 + (ay + t * dy - y) ** 2;
    if (d < best[0]) best = [d, i + t];
  }
  return best;
}

/** The plan of the whole path: drawn from the path itself. */
function wholePlan(svg: SVGSVGElement, track: Track, cursor: Cursor): void {
  const light = add(svg, "path", "highlight");
  const dot = add(svg, "circle", "tip");
  dot.setAttribute("r", "4");
  dot.setAttribute("visibility", "hidden");
  const [scale, x0, y0] = ["scale", "x0", "y0"].map((k) => Number(svg.dataset[k]));
  const { first, points } = track;
  svg.addEventListener("click", (e) => {
    const at = inside(svg, e);
    if (!at) return;
    const [x, y] = [(at.x - x0) / scale, (y0 - at.y) / scale];
    let best = (NEAR / at.scale / scale) ** 2;
    let found = -1;
    // Layers lie over each other: of equally near ones the first after the cursor is taken, so that clicks go deeper.
    const from = Math.max(0, cursor.place.piece + 1);
    for (let n = 0; n < track.pieces; n++) {
      const p = (from + n) % track.pieces;
      const [d] = nearest(points, 3, first[p], first[p + 1], x, y);
      // A micrometre: what rounding may move a layer.
      if (Math.sqrt(d) < Math.sqrt(best) - 1e-3) [best, found] = [d, p];
    }
    if (found >= 0) cursor.go(track.ofPiece(found, 0), "plan");
  });
  cursor.listen((place) => {
    let d = "";
    if (place.piece >= 0) {
      for (let p = track.runStart(place.piece); p < track.runEnd(place.piece); p++) {
        for (let i = first[p]; i < first[p + 1]; i++) {
          d += `${i > first[p] ? "L" : "M"}${x0 + points[3 * i] * scale} ${y0 - points[3 * i + 1] * scale}`;
        }
      }
    }
    light.setAttribute("d", d);
    const tip = track.tip(place);
    dot.setAttribute("visibility", tip ? "visible" : "hidden");
    if (tip) {
      dot.setAttribute("cx", String(x0 + tip[0] * scale));
      dot.setAttribute("cy", String(y0 - tip[1] * scale));
    }
  });
}

/** A plan of a section: its lines know their program lines. */
function plan(svg: SVGSVGElement, track: Track, cursor: Cursor): void {
  const light = add(svg, "path", "highlight");
  let stretches: Stretch[] | null = null;
  const read = (): Stretch[] => {
    if (stretches) return stretches;
    stretches = [];
    for (const path of svg.querySelectorAll<SVGPathElement>("path[data-blocks]")) {
      const names = (path.dataset.blocks ?? "").split(" ");
      (path.getAttribute("d") ?? "").split("M").slice(1).forEach((d, i) => {
        if (names[i] !== "-") stretches?.push({ block: Number(names[i]), d, xy: points(d) });
      });
    }
    return stretches;
  };
  svg.addEventListener("click", (e) => {
    const at = inside(svg, e);
    if (!at) return;
    let best = (NEAR / at.scale) ** 2;
    let found = -1;
    for (const { block, xy } of read()) {
      const [d] = nearest(xy, 2, 0, xy.length / 2, at.x, at.y);
      if (d < best) [best, found] = [d, block];
    }
    if (found >= 0) cursor.go(track.ofLine(found), "plan");
  });
  cursor.listen((place) => {
    const own = place.piece >= 0 ? read().filter((s) => s.block === place.line) : [];
    light.setAttribute("d", own.map((s) => `M${s.d}`).join(""));
  });
}

function chart(svg: SVGSVGElement, track: Track, cursor: Cursor): void {
  const ends = svg.dataset.follows === "time" ? track.timeEnd : track.lengthEnd;
  const [from, x0, kx, y0, ky, left, right] = ["from", "x0", "kx", "y0", "ky", "left", "right"].map((k) => Number(svg.dataset[k]));
  const line = add(svg, "line", "hair");
  line.setAttribute("y1", svg.dataset.top ?? "0");
  line.setAttribute("y2", svg.dataset.bottom ?? "0");
  line.setAttribute("visibility", "hidden");
  // Both widths of a chart say the same.
  const caption = svg.parentElement?.querySelector("figcaption");
  const values = caption?.querySelector(".values") ?? document.createElement("span");
  values.className = "values";
  caption?.append(values);
  const curves = [...svg.querySelectorAll<SVGPathElement>("path.curve")].map((path) => ({
    name: path.dataset.name ?? "",
    runs: (path.getAttribute("d") ?? "").split("M").slice(1).map(points),
  }));
  const show = (place: Place) => {
    const x = x0 + (track.value(place, ends) - from) * kx;
    const seen = x >= left - 0.5 && x <= right + 0.5;
    line.setAttribute("visibility", seen ? "visible" : "hidden");
    values.textContent = "";
    if (!seen) return;
    line.setAttribute("x1", String(x));
    line.setAttribute("x2", String(x));
    values.textContent = curves
      .map(({ name, runs }) => {
        const y = runs.map((xy) => height_at(xy, x)).find((v) => !Number.isNaN(v));
        return y === undefined ? "" : `${name} ${Number(((y - y0) / ky).toPrecision(4))} ${svg.dataset.unit ?? ""}`.trim();
      })
      .filter((t) => t !== "")
      .join(" · ");
  };
  svg.addEventListener("click", (e) => {
    const at = inside(svg, e);
    if (at && at.x >= left && at.x <= right && track.pieces > 0) cursor.go(track.at((at.x - x0) / kx + from, ends), "chart");
  });
  cursor.listen(show);
}

/** y of a polyline at x; NaN beside it. */
function height_at(xy: Float32Array, x: number): number {
  for (let i = 2; i < xy.length; i += 2) {
    if (xy[i - 2] <= x && x <= xy[i]) {
      const t = xy[i] > xy[i - 2] ? (x - xy[i - 2]) / (xy[i] - xy[i - 2]) : 0;
      return xy[i - 1] + t * (xy[i + 1] - xy[i - 1]);
    }
  }
  return NaN;
}

export function startPictures(track: Track, cursor: Cursor): void {
  for (const svg of document.querySelectorAll<SVGSVGElement>("figure.plan > svg[data-scale]")) {
    if (svg.closest("#work")) wholePlan(svg, track, cursor);
    else plan(svg, track, cursor);
  }
  if (track.pieces === 0) return;
  for (const svg of document.querySelectorAll<SVGSVGElement>("figure.chart > svg[data-follows]")) chart(svg, track, cursor);
}
