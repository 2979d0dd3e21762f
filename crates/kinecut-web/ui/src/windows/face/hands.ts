// The hand on the drawing: it shifts and turns the part, picks edges, and shifts and enlarges what is seen; so do the keys.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Layout } from "./layout";
import type { Point } from "./shape";
import type { Face, Hand } from "./state";
import { type View, WHOLE, placeAt, shifted, zoomed } from "./view";

/** Steps of the arrow keys [deg, mm]; with Shift ten times, with Alt a tenth. */
const STEP = { turn: 1, beside: 0.1 };
/** A pointer that moved less clicks [px]. */
const STILL = 4;
/** Enlargement by a key or a button. */
export const LARGER = 1.25;
/** Shift of what is seen by a key [px]. */
const PAN = 40;
/** Height of a line, where a wheel counts in lines [px]. */
const LINE = 16;

const TURNS: Record<string, Partial<Hand>> = {
  ArrowLeft: { turn: STEP.turn },
  ArrowRight: { turn: -STEP.turn },
  ArrowDown: { beside: STEP.beside },
  ArrowUp: { beside: -STEP.beside },
};
const PANS: Record<string, Point> = { ArrowLeft: [PAN, 0], ArrowRight: [-PAN, 0], ArrowUp: [0, PAN], ArrowDown: [0, -PAN] };

interface Grip {
  kind: "turn" | "shift" | "pan";
  x: number;
  y: number;
  hand: Hand;
  along: number;
  view: View;
  moved: boolean;
}

/** Two fingers: their distance [px] and the place between them [mm] at the beginning. */
interface Pinch {
  far: number;
  at: Point;
  view: View;
}

function pointOf(e: MouseEvent): Point {
  const bounds = (e.currentTarget as Element).getBoundingClientRect();
  return [e.clientX - bounds.left, e.clientY - bounds.top];
}

function between(fingers: globalThis.Map<number, Point>): { far: number; middle: Point } {
  const [a, b] = [...fingers.values()];
  return { far: Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1])), middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] };
}

export function useHands(face: Face, hand: Hand, l: Layout, clicked: (p: Point) => void) {
  const grip = useRef<Grip | null>(null);
  const fingers = useRef(new globalThis.Map<number, Point>());
  const pinch = useRef<Pinch | null>(null);
  const pans = useSpace();
  const view = face.view;

  /** Two fingers are for what is seen: what the first one did to the part is taken back. */
  const pinched = () => {
    const g = grip.current;
    grip.current = null;
    if (g?.moved && g.kind !== "pan") {
      face.along.value = g.along;
      face.move(g.hand);
    }
    face.history.hold(false);
    const { far, middle } = between(fingers.current);
    pinch.current = { far, at: placeAt(view.value, l, middle), view: view.value };
  };
  const down = (e: PointerEvent) => {
    const [x, y] = pointOf(e);
    if (e.pointerType === "touch") {
      fingers.current.set(e.pointerId, [x, y]);
      if (fingers.current.size === 2) pinched();
      if (fingers.current.size > 1) return;
    }
    const isPan = e.button === 1 || (e.button === 0 && pans.value);
    if (e.button !== 0 && !isPan) return;
    const isRing = Math.hypot(x - l.ring[0], y - l.ring[1]) < (e.pointerType === "touch" ? 26 : 14);
    const box = e.currentTarget as HTMLElement;
    box.setPointerCapture(e.pointerId);
    // The middle button gives none by itself.
    box.focus({ preventScroll: true });
    grip.current = { kind: isPan ? "pan" : isRing ? "turn" : "shift", x, y, hand, along: face.along.value, view: view.value, moved: false };
    if (!isPan) face.history.hold(true);
  };
  const move = (e: PointerEvent) => {
    const [x, y] = pointOf(e);
    if (fingers.current.has(e.pointerId)) fingers.current.set(e.pointerId, [x, y]);
    if (pinch.current && fingers.current.size === 2) {
      const { far, middle } = between(fingers.current);
      const { at, far: first, view: from } = pinch.current;
      const next = zoomed(from, far / first, at);
      const sheet = { ...l, scale: (l.scale / view.value.zoom) * next.zoom };
      const gone = placeAt(next, sheet, middle);
      view.value = { ...next, x: next.x + at[0] - gone[0], y: next.y + at[1] - gone[1] };
      return;
    }
    const g = grip.current;
    if (!g || (!g.moved && Math.hypot(x - g.x, y - g.y) < STILL)) return;
    g.moved = true;
    if (g.kind === "pan") view.value = shifted(g.view, l, [x - g.x, y - g.y]);
    else if (g.kind === "turn") {
      const turn = (Math.atan2(l.pivot[1] - y, x - l.pivot[0]) * 180) / Math.PI;
      face.move({ turn: Math.round(turn * 100) / 100, beside: g.hand.beside });
    } else {
      face.along.value = g.along + (x - g.x) / l.scale;
      const beside = Math.round((g.hand.beside + (y - g.y) / l.scale) * 1000) / 1000;
      if (beside !== face.hand.value?.beside) face.move({ turn: hand.turn, beside });
    }
  };
  const up = (e: PointerEvent) => {
    fingers.current.delete(e.pointerId);
    pinch.current = null;
    const g = grip.current;
    if (!g) return;
    grip.current = null;
    face.history.hold(false);
    if (!g.moved && g.kind !== "pan" && e.type === "pointerup") clicked(pointOf(e));
  };
  const wheel = (e: WheelEvent) => {
    const lines = e.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1;
    const next = zoomed(view.value, 1.0015 ** (-e.deltaY * lines), placeAt(view.value, l, pointOf(e)));
    // At either end the page scrolls.
    if (next.zoom === view.value.zoom) return;
    e.preventDefault();
    view.value = next;
  };
  const key = (e: KeyboardEvent) => {
    if (keyed(face, hand, l, e)) e.preventDefault();
  };
  return { down, move, up, wheel, key, pans };
}

/** Does what a key asks for; false for keys of others. */
function keyed(face: Face, hand: Hand, l: Layout, e: KeyboardEvent): boolean {
  const { view } = face;
  if (e.ctrlKey || e.metaKey) {
    const by = PANS[e.key];
    if (by) view.value = shifted(view.value, l, by);
    return by !== undefined;
  }
  if (e.key === "+" || e.key === "=") view.value = zoomed(view.value, LARGER);
  else if (e.key === "-" || e.key === "\u2212") view.value = zoomed(view.value, 1 / LARGER);
  else if (e.key === "0") fit(face);
  else {
    const step = TURNS[e.key];
    if (!step) return false;
    const by = (e.shiftKey ? 10 : 1) * (e.altKey ? 0.1 : 1);
    const neat = (n: number) => Number(n.toFixed(6));
    face.move({ turn: neat(hand.turn + by * (step.turn ?? 0)), beside: neat(hand.beside + by * (step.beside ?? 0)) });
  }
  return true;
}

/** Brings the whole drawing into sight. */
export function fit(face: Face): void {
  face.along.value = 0;
  face.view.value = WHOLE;
}

/** Whether the blank key is held over the drawing, or while it has the focus. */
function useSpace() {
  const held = useSignal(false);
  useEffect(() => {
    const down = (e: KeyboardEvent) => {
      if (e.key !== " " || e.ctrlKey || e.metaKey || e.altKey) return;
      const box = document.querySelector(".held");
      const isOn = document.activeElement === box || (box?.matches(":hover") && !document.activeElement?.closest("input, textarea, select, button, summary, [contenteditable], dialog"));
      if (!isOn) return;
      e.preventDefault();
      held.value = true;
    };
    const up = (e: Event) => {
      if (!(e instanceof KeyboardEvent) || e.key === " ") held.value = false;
    };
    // Before the commands of the page, one of which has the same key.
    document.addEventListener("keydown", down, true);
    document.addEventListener("keyup", up, true);
    window.addEventListener("blur", up);
    return () => {
      document.removeEventListener("keydown", down, true);
      document.removeEventListener("keyup", up, true);
      window.removeEventListener("blur", up);
    };
  }, []);
  return held;
}
