// The path in colours of the tool's engagement: its pieces cut where the engagement changes.
import { Color } from "three";
import { colour } from "./theme";
import type { Track } from "./track";

/** Steps of the scale of colours. */
const STEPS = 16;
/** What the path may be coloured by. */
export type Quantity = "arc" | "chip";

export interface EngagedLines {
  /** x, y, z of both ends of each segment [mm]. */
  xyz: number[];
  /** r, g, b of both. */
  rgb: number[];
  /** Piece of each segment, rising. */
  piece: number[];
}

/** The end of the scale: of arcs half a turn, as plunges have more; the thickest chip. */
export function greatest(track: Track, quantity: Quantity): number {
  return quantity === "arc" ? 180 : track.chip.reduce((a, b) => (b > a ? b : a), 0);
}

/** The segments of all pieces that are no rapids, in colours; air is quiet. */
export function engagedLines(track: Track, quantity: Quantity): EngagedLines {
  const lines: EngagedLines = { xyz: [], rgb: [], piece: [] };
  const scale = Array.from({ length: STEPS }, (_, i) => colour(`scale${i}`));
  const air = colour("rule");
  const most = greatest(track, quantity) || 1;
  const rapid = track.head.roles.indexOf("rapid");
  const of = (run: number): Color => {
    const value = track[quantity][run];
    if (!(track.arc[run] > 0) || Number.isNaN(value)) return air;
    return scale[Math.min(STEPS - 1, Math.floor((value / most) * STEPS))];
  };
  const { first, points, firstEngaged, engagedEnd } = track;
  for (let p = 0; p < track.pieces; p++) {
    if (track.role[p] === rapid) continue;
    const length = track.pieceLength(p);
    let run = firstEngaged[p];
    let done = 0;
    for (let i = first[p]; i + 1 < first[p + 1]; i++) {
      const [a, b] = [3 * i, 3 * i + 3];
      const gap = Math.hypot(points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]);
      for (let from = 0; from < 1; ) {
        // Up to the end of the run, or of the segment.
        const has = run < firstEngaged[p + 1];
        const last = !has || run + 1 === firstEngaged[p + 1] || gap === 0;
        const to = last ? 1 : Math.min(1, (engagedEnd[run] * length - done) / gap);
        if (to > from || last) {
          for (const t of [from, to]) for (let k = 0; k < 3; k++) lines.xyz.push(points[a + k] + (points[b + k] - points[a + k]) * t);
          const { r, g, b: blue } = has ? of(run) : air;
          lines.rgb.push(r, g, blue, r, g, blue);
          lines.piece.push(p);
        }
        if (to < 1) run++;
        from = Math.max(from, to);
      }
      done += gap;
    }
  }
  return lines;
}
