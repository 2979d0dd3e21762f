// The part of the drawing that is seen: enlarged about a place of it, and shifted. It changes no placement.
import type { Point } from "./shape";

/** The place in the middle of what is seen, from the cutter's line and the middle of the drawing [mm], and how much larger than as a whole. */
export interface View {
  x: number;
  y: number;
  zoom: number;
}

export const WHOLE: View = { x: 0, y: 0, zoom: 1 };
/** Least and most enlargement. */
const [LEAST, MOST] = [0.5, 60];

/** Enlarges a view; the place [mm] stays where it is on the screen. */
export function zoomed(view: View, by: number, [x, y]: Point = [view.x, view.y]): View {
  const zoom = Math.min(MOST, Math.max(LEAST, view.zoom * by));
  const keeps = view.zoom / zoom;
  return { x: x + (view.x - x) * keeps, y: y + (view.y - y) * keeps, zoom };
}

/** The drawing as it lies on the screen. */
export interface Sheet {
  width: number;
  height: number;
  /** Pixels for a mm. */
  scale: number;
}

/** The place of a view [mm] under a point of the drawing [px]. */
export function placeAt(view: View, sheet: Sheet, [x, y]: Point): Point {
  return [view.x + (x - sheet.width / 2) / sheet.scale, view.y - (y - sheet.height / 2) / sheet.scale];
}

/** The view shifted by pixels, as if the drawing were taken by the hand. */
export function shifted(view: View, sheet: Sheet, [dx, dy]: Point): View {
  return { ...view, x: view.x - dx / sheet.scale, y: view.y + dy / sheet.scale };
}
