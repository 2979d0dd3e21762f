// The bad length over all placements, taken from the picture of the verb's page: its cells are the verb's, here they are only laid out again.
import { type FaceAnswer, isOptimum } from "./answer";
import { middle } from "./shape";

export interface Cell {
  /** Ends in turn [deg] and beside the middle [mm]. */
  turn: [number, number];
  beside: [number, number];
}

export interface Map {
  /** Cells by the steps of the scale, from the least. */
  steps: Cell[][];
  /** The offsets reach so far to both sides [mm]. */
  half: number;
  /** Numbers at the scale [mm], and the place of each on it, from 0 to 1. */
  ticks: { text: string; share: number }[];
}

/** The best placement of the picture may be so far from that of the answer [px]: more, and it is not the picture of this answer. */
const NEAR = 1.5;

/** The map of a page; null where the page has none, since no placement is allowed. Throws when the picture is not of this answer. */
export function mapOf(page: string, answer: FaceAnswer): Map | null {
  // The picture alone is read: the page as a whole has styles, which this page does not allow.
  const figure = /<figure[^>]* id="[\w-]*-map"[^>]*>[^]*?<\/figure>/.exec(page)?.[0];
  const text = figure && /<svg viewBox[^]*?<\/svg>/.exec(figure.replaceAll(/<svg class="sample"[^]*?<\/svg>/g, ""))?.[0];
  return text ? laidOut(new DOMParser().parseFromString(text, "image/svg+xml").documentElement, answer) : null;
}

function laidOut(svg: Element, answer: FaceAnswer): Map {
  const area = /^M(\S+) (\S+)H(\S+)V(\S+)H/.exec(svg.querySelector("path")?.getAttribute("d") ?? "");
  const words = [...svg.querySelectorAll("text")].map((e) => ({ x: at(e, "x"), y: at(e, "y"), anchor: e.getAttribute("text-anchor"), text: e.textContent ?? "" }));
  if (!area) throw new Error("the picture has no area");
  const [left, top, right, bottom] = area.slice(1).map(Number);
  // The numbers beside the plot say its range: they lie 4 px below their places.
  const sides = words.filter((w) => w.anchor === "end" && w.x < left && w.y > top - 8 && w.y < bottom + 8).map((w) => ({ y: w.y - 4, value: value(w.text) }));
  const [low, high] = [sides.reduce((a, b) => (b.value < a.value ? b : a)), sides.reduce((a, b) => (b.value > a.value ? b : a))];
  const perPixel = (high.value - low.value) / (high.y - low.y);
  if (!Number.isFinite(perPixel) || perPixel === 0) throw new Error("the picture has no range");
  const turn = (x: number) => (360 * (x - left)) / (right - left);
  const beside = (y: number) => high.value + (y - high.y) * perPixel;
  checked(svg, answer, { turn: (v) => left + ((right - left) * v) / 360, beside: (v) => high.y + (v - high.value) / perPixel });

  const steps: Cell[][] = Array.from({ length: 16 }, () => []);
  let [barFrom, barTo] = [Infinity, -Infinity];
  for (const path of svg.querySelectorAll('path[class^="k-m"]')) {
    const d = path.getAttribute("d") ?? "";
    const step = steps[Number(path.getAttribute("class")?.slice(3))];
    if (!step) throw new Error("the picture has an unknown step");
    for (const [, x, y, to, down] of d.matchAll(/M(\S+) ([^\sH]+)H([^V]+)V([^H]+)H/g)) {
      step.push({ turn: [turn(Number(x)), turn(Number(to))], beside: [beside(Number(y)), beside(Number(down))] });
    }
    // The scale above the plot.
    for (const [, x, wide] of d.matchAll(/M(\S+) [^\sh]+h([^v]+)v/g)) {
      barFrom = Math.min(barFrom, Number(x));
      barTo = Math.max(barTo, Number(x) + Number(wide));
    }
  }
  const ticks = words.filter((w) => w.anchor === "middle" && w.y < top).map((w) => ({ text: w.text, share: (w.x - barFrom) / (barTo - barFrom) }));
  return { steps, half: Math.abs(beside(top) - beside(bottom)) / 2, ticks };
}

const at = (e: Element, name: string) => Number(e.getAttribute(name));
const value = (text: string) => Number(text.replace("\u2212", "-"));

/** The best placement, drawn last of all circles, must lie where the answer has it. */
function checked(svg: Element, answer: FaceAnswer, place: { turn: (v: number) => number; beside: (v: number) => number }): void {
  const circles = svg.querySelectorAll("circle");
  const best = circles[circles.length - 1];
  if (!isOptimum(answer.optimum) || !best) throw new Error("the picture has no best placement");
  const { turn, offset } = answer.optimum.placement;
  const off = Math.hypot(at(best, "cx") - place.turn(turn), at(best, "cy") - place.beside(offset - middle(answer.outline, turn)));
  if (!(off < NEAR)) throw new Error("the picture is of another answer");
}
