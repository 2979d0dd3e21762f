// Operations over time.
import type { Track } from "viewer/track";
import type { OperationRun } from "../../base/api";

export interface Band {
  run: OperationRun;
  /** [s] */
  start: number;
  end: number;
}

/** The stretches of time in which the lines of each operation run. */
export function bandsOf(track: Track, runs: OperationRun[] | undefined): Band[] {
  if (!runs || runs.length === 0) return [];
  const bands: Band[] = [];
  let at = 0;
  for (let p = 0; p < track.pieces; p++) {
    const line = track.line[p];
    if (!(runs[at] && runs[at].from <= line && line < runs[at].to)) at = runs.findIndex((run) => run.from <= line && line < run.to);
    if (at < 0) {
      at = 0;
      continue;
    }
    const start = p > 0 ? track.timeEnd[p - 1] : 0;
    const last = bands[bands.length - 1];
    if (last && last.run === runs[at]) last.end = track.timeEnd[p];
    else bands.push({ run: runs[at], start, end: track.timeEnd[p] });
  }
  return bands;
}
