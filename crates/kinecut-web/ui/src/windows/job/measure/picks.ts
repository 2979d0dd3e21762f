// What is picked on the part: a place with its face, or two places with what lies between them.
import { effect, signal } from "@preact/signals";
import type { PartData } from "viewer/decode";
import type { Hit, Point } from "viewer/scene";
import * as api from "../../../base/api";
import type { Document } from "../../../store/document";
import { active } from "../../../store/session";
import { type Face, faceAt } from "./face";

export interface Pick {
  point: Point;
  face: Face | null;
}

/** The part that is in the view. */
export interface InView {
  /** The text that it is of. */
  text: string;
  /** Distance of the lines of its stock [mm]; null: it is the raw stock, of a plan. */
  step: number | null;
}

export const inView = signal<InView | null>(null);
export const measuring = signal(false);
export const picks = signal<Pick[]>([]);
/** What the server says of the line between the two places: of the finished part that it has. */
export const inspected = signal<api.Inspection | null>(null);

export function toggleMeasure(): void {
  measuring.value = !measuring.value;
  picks.value = [];
}

effect(() => {
  // Another part has other faces.
  void inView.value;
  picks.value = [];
});

effect(() => {
  inspected.value = null;
  const doc = active.peek();
  const [a, b] = picks.value;
  if (doc && a && b) void inspect(doc, a.point, b.point);
});

export function pick(data: PartData, hit: Hit): void {
  const one = { point: hit.point, face: faceAt(data, hit.triangle, inView.value?.step ?? 0) };
  picks.value = picks.value.length === 1 ? [picks.value[0], one] : [one];
}

/** Asks about the line between two places, where the server has the part that is shown. */
async function inspect(doc: Document, a: Point, b: Point): Promise<void> {
  const simulated = doc.simulated.value;
  if (!simulated || simulated.drawn_step !== null || inView.value?.text !== doc.text.value || inView.value.step === null) return;
  const asked = picks.value;
  try {
    const found = await api.inspect(simulated.result, [[...a, ...b]]);
    if (picks.value === asked) inspected.value = found;
  } catch (error) {
    // What the server no longer has it does not tell: the distance of the places is known without it.
    if (!(error instanceof api.Refused || error instanceof api.Gone)) throw error;
  }
}
