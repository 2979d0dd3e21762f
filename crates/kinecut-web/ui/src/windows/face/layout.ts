// Places of the drawing on the screen: the turned part, the cutter, the ring by which the part is turned.
import type { FaceAnswer } from "./answer";
import { type Frame, type Point, middle, round, turned } from "./shape";
import type { Hand } from "./state";
import type { View } from "./view";

/** Room between the ring and the border [px]. */
const BORDER = 14;
/** Least distance of the ring from what the part turns about, where the border is near [px]. */
const NEAREST = 30;

export interface Layout {
  width: number;
  height: number;
  /** Pixels for a mm. */
  scale: number;
  /** The middle of the whole drawing, on the cutter's line. */
  centre: Point;
  /** The centre of the cutter. */
  cutter: Point;
  frame: Frame;
  /** Place of the ring. */
  ring: Point;
  /** About what the part turns. */
  pivot: Point;
}

export function layout(answer: FaceAnswer, hand: Hand, along: number, view: View, width: number): Layout {
  const { outline, cutter } = answer;
  const height = Math.round(width < 420 ? width * 0.95 : Math.min(560, width * 0.85));
  const { centre: own, radius } = round(outline);
  const half = Math.max(cutter.radius, radius) * 1.14;
  const scale = (Math.min(width / 2, height / 2) / half) * view.zoom;
  const centre: Point = [width / 2 - view.x * scale, height / 2 + view.y * scale];
  const line = middle(outline, hand.turn) + hand.beside;
  const pivotTurned = turned(own, hand.turn);
  const frame: Frame = (p) => {
    const [x, y] = turned(p, hand.turn);
    return [centre[0] + (x - pivotTurned[0] + along) * scale, centre[1] - (y - line) * scale];
  };
  const pivot = frame(own);
  const angle = (hand.turn * Math.PI) / 180;
  const way: Point = [Math.cos(angle), -Math.sin(angle)];
  const room = roomFrom(pivot, way, width, height);
  const full = Math.min(radius * scale + 12, half * scale - BORDER);
  const reach = room < NEAREST ? full : Math.min(full, room);
  const ring: Point = [pivot[0] + reach * way[0], pivot[1] + reach * way[1]];
  return { width, height, scale, centre, cutter: [centre[0] - 0.22 * half * scale, centre[1]], frame, ring, pivot };
}

/** Distance from a place to the border in a direction [px]; below 0 outside. */
function roomFrom([x, y]: Point, [dx, dy]: Point, width: number, height: number): number {
  if (x < 0 || x > width || y < 0 || y > height) return -1;
  const to = (from: number, by: number, size: number) => (by > 1e-9 ? (size - BORDER - from) / by : by < -1e-9 ? (BORDER - from) / by : Infinity);
  return Math.min(to(x, dx, width), to(y, dy, height));
}
