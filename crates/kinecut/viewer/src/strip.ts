// The greatest thickness of a chip over the program, as a strip under the slider.
import { colour, onTheme } from "./theme";
import type { Track } from "./track";

export function startStrip(track: Track): void {
  const canvas = document.getElementById("kc-load") as HTMLCanvasElement | null;
  if (!canvas || track.pieces === 0 || !(track.totalTime > 0)) return;
  const greatest = track.chip.reduce((a, b) => (b > a ? b : a), 0);
  if (greatest === 0) return;
  canvas.hidden = false;
  const told = `Chips along the program: up to ${greatest.toFixed(3)} mm thick`;
  canvas.title = told;
  canvas.setAttribute("aria-label", told);
  const draw = () => {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((n) => Math.round(n * devicePixelRatio));
    if (width === 0 || height === 0) return;
    Object.assign(canvas, { width, height });
    const columns = new Float32Array(width);
    for (let p = 0; p < track.pieces; p++) {
      const from = p > 0 ? track.timeEnd[p - 1] : 0;
      const column = (share: number) => {
        const time = from + (track.timeEnd[p] - from) * share;
        return Math.min(width - 1, Math.floor((time / track.totalTime) * width));
      };
      for (let run = track.firstEngaged[p], before = 0; run < track.firstEngaged[p + 1]; before = track.engagedEnd[run++]) {
        const chip = track.chip[run];
        if (!(chip > 0)) continue;
        for (let x = column(before); x <= column(track.engagedEnd[run]); x++) columns[x] = Math.max(columns[x], chip);
      }
    }
    const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
    pen.fillStyle = `#${colour("accent").getHexString()}`;
    for (let x = 0; x < width; x++) {
      const high = Math.ceil((columns[x] / greatest) * height);
      if (high > 0) pen.fillRect(x, height - high, 1, high);
    }
  };
  new ResizeObserver(draw).observe(canvas);
  onTheme(draw);
}
