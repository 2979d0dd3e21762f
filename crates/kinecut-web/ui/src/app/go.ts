// Ways from one panel to a place in another.
import { signal } from "@preact/signals";
import type { Finding } from "../base/api";
import { type Document, pathOf, rangeOf, sameFile } from "../store/document";
import { cursor } from "../store/session";

export type Panel = "form" | "text" | "program" | "findings";

/** The panel that is seen where there is room for one. */
export const panel = signal<Panel>("form");

/** What windows offer to those that lead into them. */
export interface Places {
  /** Shows a stretch of the text and puts the caret there. */
  showText: (from: number, to: number) => void;
  /** Shows a place in space. */
  showPoint: (point: [number, number, number]) => void;
}

export const places: Places = { showText: () => undefined, showPoint: () => undefined };

/** Whether one panel is seen at a time. */
export function isNarrow(): boolean {
  return matchMedia("(max-width: 1279px)").matches;
}

/** The line of all programs at which a finding is; null when it is elsewhere. */
export function programLine(doc: Document, finding: Finding): number | null {
  const { place } = finding;
  if (!place || place.line < 1) return null;
  const program = doc.work.value?.programs.find((p) => sameFile(place.file, p.file));
  return program ? program.first + place.line - 1 : null;
}

/** Shows where a finding is: in the program and in space, or in the text. */
export function goTo(doc: Document, finding: Finding): void {
  const line = programLine(doc, finding);
  const track = doc.shown.value?.track;
  if (line !== null && track && line < track.lines) {
    if (isNarrow()) panel.value = "program";
    cursor.go(track.ofLine(line), "link");
  } else {
    const range = rangeOf(finding, doc.name, doc.text.value, doc.tree.value);
    if (range) {
      if (isNarrow()) panel.value = "text";
      if (finding.key) doc.chosen.value = pathOf(finding.key);
      requestAnimationFrame(() => places.showText(range.from, range.to));
    }
  }
  if (finding.point) places.showPoint(finding.point);
}
