// Playing and stepping through the program in machine time.
import { effect, signal } from "@preact/signals";
import { active, cursor } from "../../store/session";
import { programLine } from "../../app/go";
import { bandsOf } from "./bands";

/** At speed "fit" the whole program takes this long [s]. */
const FIT = 25;

export const playing = signal(false);
/** Times as fast as the machine; 0: fit. */
export const speed = signal(10);
/** The time at the cursor [s]. */
export const now = signal(0);

let frame = 0;

const track = () => active.value?.shown.value?.track ?? null;

cursor.listen((place, source) => {
  if (source !== "play") pause();
  const way = track();
  if (!way) return;
  if (place.line < 0) {
    now.value = way.totalTime;
    return;
  }
  // A line that moves nothing stands at the beginning of the next one that does.
  let line = place.line;
  while (place.piece < 0 && line < way.lines && way.ofLine(line).piece < 0) line++;
  const at = place.piece >= 0 ? place : line < way.lines ? way.ofLine(line) : null;
  now.value = at ? way.value(at, way.timeEnd) : way.totalTime;
});

effect(() => {
  // Another text: its time stands still.
  void active.value;
  pause();
});

export function pause(): void {
  cancelAnimationFrame(frame);
  frame = 0;
  playing.value = false;
}

export function toggle(): void {
  if (playing.value) pause();
  else play();
}

function play(): void {
  const way = track();
  if (!way || way.pieces === 0) return;
  let time = cursor.place.line < 0 || now.value >= way.totalTime ? 0 : now.value;
  let last = performance.now();
  playing.value = true;
  const tick = (at: number) => {
    const way = track();
    if (!way) return pause();
    const rate = speed.value || way.totalTime / FIT;
    time = Math.min(way.totalTime, time + ((at - last) / 1000) * rate);
    last = at;
    cursor.go(way.at(time, way.timeEnd), "play");
    now.value = time;
    if (time >= way.totalTime) pause();
    else frame = requestAnimationFrame(tick);
  };
  frame = requestAnimationFrame(tick);
}

export function goTime(seconds: number, source = "slider"): void {
  const way = track();
  if (way && way.pieces > 0) cursor.go(way.at(Math.min(way.totalTime, Math.max(0, seconds)), way.timeEnd), source);
}

export function goLine(line: number, source = "link"): void {
  const way = track();
  if (way && way.lines > 0) cursor.go(way.ofLine(Math.min(way.lines - 1, Math.max(0, line))), source);
}

export function step(by: 1 | -1): void {
  const way = track();
  if (!way || way.pieces === 0) return;
  const { place } = cursor;
  cursor.go(place.line < 0 ? way.ofPiece(by > 0 ? 0 : way.runStart(way.pieces - 1), 0) : way.step(place, by), "step");
}

/** To the beginning of the next operation, or of the one before. */
export function stepOperation(by: 1 | -1): void {
  const doc = active.value;
  const way = track();
  if (!doc || !way) return;
  const starts = bandsOf(way, doc.work.value?.operations).map((band) => band.start);
  const at = cursor.place.line < 0 ? 0 : now.value;
  const next = by > 0 ? starts.find((s) => s > at + 1e-6) : starts.findLast((s) => s < at - 1e-6);
  if (next !== undefined) goTime(next + 1e-9, "step");
}

/** The finding after the cursor, or before it. */
export function findingFrom(by: 1 | -1): number | null {
  const doc = active.value;
  if (!doc) return null;
  const found = doc.findings.value.map((f, i) => ({ i, line: programLine(doc, f) ?? -1 }));
  if (found.length === 0) return null;
  const known = doc.finding.value;
  const at = known === null ? (by > 0 ? -1 : found.length) : known;
  return (at + by + found.length) % found.length;
}
