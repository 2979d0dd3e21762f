// Playing and stepping through the path in machine time.
import { json } from "./decode";
import type { Cursor, Track } from "./track";
import { duration, millimetres } from "./words";

/** At speed "fit" the whole program takes this long [s]. */
const FIT = 25;

export class Player {
  private readonly slider = document.getElementById("kc-time") as HTMLInputElement;
  private readonly clock = document.getElementById("kc-clock") as HTMLOutputElement;
  private readonly button = document.getElementById("kc-play") as HTMLButtonElement;
  private readonly speed = document.getElementById("kc-speed") as HTMLSelectElement;
  private readonly stops = document.getElementById("kc-stops") as HTMLSelectElement;
  /** Lines with findings that are more than notes. */
  private readonly found = new Set<number>();
  private frame = 0;
  private time = 0;

  constructor(private readonly track: Track, private readonly cursor: Cursor) {
    const on = (id: string, f: () => void) => document.getElementById(id)?.addEventListener("click", f);
    on("kc-back", () => this.step(-1));
    on("kc-next", () => this.step(1));
    on("kc-play", () => this.toggle());
    if (!track.timed) this.speed.disabled = true;
    for (const [line, severity] of json<[number, string][]>("kc-marks")) {
      if (severity !== "note") this.found.add(line);
    }
    const to = Number(this.slider.max);
    this.slider.addEventListener("input", () => {
      this.stop();
      cursor.go(track.at((Number(this.slider.value) / to) * track.totalTime, track.timeEnd), "slider");
    });
    cursor.listen((place, source) => {
      const now = track.value(place, track.timeEnd);
      if (source !== "play") this.stop();
      if (Number.isNaN(now)) return;
      this.time = now;
      if (source !== "slider") this.slider.value = String(track.totalTime > 0 ? (now / track.totalTime) * to : 0);
      this.say(now);
    });
    this.say(0);
  }

  private say(now: number): void {
    const show = (v: number) => (this.track.timed ? duration(v) : `${millimetres(v, 1)} mm`);
    this.clock.textContent = `${show(now)} of ${show(this.track.totalTime)}`;
    this.slider.setAttribute("aria-valuetext", this.clock.textContent);
  }

  step(by: 1 | -1): void {
    const { place } = this.cursor;
    const start = place.line < 0 ? this.track.ofPiece(0, 0) : this.track.step(place, by);
    this.cursor.go(start, "step");
  }

  toggle(): void {
    if (this.frame) this.stop();
    else this.play();
  }

  private stop(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.button.textContent = "▶";
    this.button.setAttribute("aria-label", "Play");
  }

  /** The first piece after one and up to another at which the reader wants to stop; -1 for none. */
  private nextStop(from: number, to: number): number {
    const { line, tool } = this.track;
    const kind = this.stops.value;
    if (kind === "") return -1;
    for (let p = Math.max(from, 0) + 1; p <= to; p++) {
      if (kind === "tools" ? tool[p] === tool[p - 1] : line[p] === line[p - 1]) continue;
      if (kind !== "findings" || this.found.has(line[p])) return p;
    }
    return -1;
  }

  private play(): void {
    const { track } = this;
    if (track.pieces === 0) return;
    if (this.time >= track.totalTime) this.time = 0;
    this.button.textContent = "❚❚";
    this.button.setAttribute("aria-label", "Stop");
    let last = performance.now();
    const tick = (now: number) => {
      const rate = Number(this.speed.value) || track.totalTime / FIT;
      const time = this.time + ((now - last) / 1000) * rate;
      last = now;
      const place = track.at(time, track.timeEnd);
      const stop = this.nextStop(this.cursor.place.piece, place.piece);
      this.cursor.go(stop < 0 ? place : track.ofPiece(stop, 0), "play");
      this.time = stop < 0 ? Math.min(time, track.totalTime) : stop > 0 ? track.timeEnd[stop - 1] : 0;
      if (stop >= 0 || time >= track.totalTime) this.stop();
      else this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }
}
