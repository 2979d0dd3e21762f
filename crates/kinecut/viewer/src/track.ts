// The path as pieces on a time line, and the one cursor on it.
import { type Head, Stream, ofLines } from "./decode";

/** Where the cursor stands: a line, and if that line moves the tool, a piece of path and how far along it. */
export interface Place {
  line: number;
  piece: number;
  part: number;
}

export class Track {
  /** Number of pieces. */
  readonly pieces: number;
  /** Program line, role, tool, axis of each piece. */
  readonly line: Int32Array;
  readonly role: Uint8Array;
  readonly tool: Uint32Array;
  readonly axis: Uint32Array;
  /** First point of each piece; one more entry at the end. */
  readonly first: Uint32Array;
  /** x, y, z of the axes. */
  readonly axes: Float32Array;
  /** x, y, z of all points [mm]. */
  readonly points: Float32Array;
  /** Time [s] and length [mm] at the end of each piece. */
  readonly timeEnd: Float64Array;
  readonly lengthEnd: Float64Array;
  /** Part of the way of all cutting moves that is done at the end of each piece, from 0 to 1. */
  readonly doneEnd: Float64Array;
  /** Runs of engagement: first of each piece, one more entry at the end; fraction of the piece at the end of each, arc of contact
   * [degrees], greatest thickness of a chip [mm], NaN where it is not known. */
  readonly firstEngaged: Uint32Array;
  readonly engagedEnd: Float32Array;
  readonly arc: Float32Array;
  readonly chip: Float32Array;
  /** Time [s] and length [mm] of each program line, as the program gives them. */
  readonly lineTime: Float64Array;
  readonly lineLength: Float64Array;
  /** Whether times are known; if not, the time line counts millimetres. */
  readonly timed: boolean;
  /** Position of each joint at each point [mm or rad]. */
  private readonly jointColumns: Float32Array[];
  private readonly firstPiece: Int32Array;

  constructor(readonly head: Head) {
    const n = (this.pieces = head.path.pieces);
    this.line = new Int32Array(n);
    this.role = new Uint8Array(n);
    this.tool = new Uint32Array(n);
    this.axis = new Uint32Array(n);
    this.first = new Uint32Array(n + 1);
    const stream = new Stream("kc-path");
    this.line.set(stream.column(n));
    this.role.set(stream.column(n));
    this.tool.set(stream.column(n));
    this.axis.set(stream.column(n));
    const counts = stream.column(n);
    const columns = [0, 1, 2].map(() => stream.column(head.path.points));
    this.axes = new Float32Array(3 * head.path.axes);
    for (let k = 0; k < 3; k++) stream.column(head.path.axes).forEach((v, i) => (this.axes[3 * i + k] = v * head.path.axis_step));
    this.doneEnd = stream.column(n).map((v) => v * head.path.done_step);
    this.firstEngaged = new Uint32Array(n + 1);
    stream.column(n).forEach((count, p) => (this.firstEngaged[p + 1] = this.firstEngaged[p] + count));
    const runs = head.path.runs;
    this.engagedEnd = Float32Array.from(stream.column(runs), (v) => v * head.path.run_step);
    this.arc = Float32Array.from(stream.column(runs));
    this.chip = Float32Array.from(stream.column(runs), (v) => (v === 0 ? NaN : (v - 1) / 1000));
    const positions = (head.machine?.joints ?? []).map(() => stream.column(head.path.points));
    // A piece that goes on from the end of the one before has that point too.
    for (let p = 0; p < n; p++) this.first[p + 1] = this.first[p] + (counts[p] >> 1) + (counts[p] & 1);
    this.points = new Float32Array(3 * this.first[n]);
    this.jointColumns = positions.map(() => new Float32Array(this.first[n]));
    let [from, to] = [0, 0];
    for (let p = 0; p < n; p++) {
      if (counts[p] & 1) {
        this.points.copyWithin(3 * to, 3 * to - 3, 3 * to);
        for (const q of this.jointColumns) q[to] = q[to - 1];
        to++;
      }
      for (let i = counts[p] >> 1; i > 0; i--, from++, to++) {
        for (let k = 0; k < 3; k++) this.points[3 * to + k] = columns[k][from] * head.path.step;
        this.jointColumns.forEach((q, k) => (q[to] = positions[k][from] * head.path.joint_step));
      }
    }

    let lines = head.lines;
    for (let p = 0; p < n; p++) lines = Math.max(lines, this.line[p] + 1);
    this.lineTime = ofLines("kc-times", head, lines);
    this.lineLength = ofLines("kc-lengths", head, lines);
    this.firstPiece = new Int32Array(lines).fill(-1);
    const drawn = new Float64Array(lines);
    for (let p = n - 1; p >= 0; p--) {
      this.firstPiece[this.line[p]] = p;
      drawn[this.line[p]] += this.pieceLength(p);
    }
    // A line's time belongs to its pieces by length; time of lines without motion (dwells) passes when the program
    // goes over them.
    const still = new Float64Array(lines + 1);
    for (let l = 0; l < lines; l++) still[l + 1] = still[l] + (this.firstPiece[l] < 0 ? this.lineTime[l] : 0);
    this.timeEnd = new Float64Array(n);
    this.lengthEnd = new Float64Array(n);
    this.timed = this.lineTime.some((t) => t > 0);
    let time = 0;
    let length = 0;
    let before = 0;
    for (let p = 0; p < n; p++) {
      const l = this.line[p];
      const share = drawn[l] > 0 ? this.pieceLength(p) / drawn[l] : p === this.firstPiece[l] ? 1 : 0;
      if (l > before) time += still[l] - still[before];
      before = l;
      time += this.timed ? this.lineTime[l] * share : this.pieceLength(p);
      length += this.lineLength[l] > 0 ? this.lineLength[l] * share : this.pieceLength(p);
      this.timeEnd[p] = time;
      this.lengthEnd[p] = length;
    }
  }

  get lines(): number {
    return this.firstPiece.length;
  }

  get totalTime(): number {
    return this.pieces > 0 ? this.timeEnd[this.pieces - 1] : 0;
  }

  pieceLength(p: number): number {
    let sum = 0;
    for (let i = this.first[p] + 1; i < this.first[p + 1]; i++) sum += this.gap(i);
    return sum;
  }

  /** Distance of a point from the one before. */
  private gap(i: number): number {
    const a = this.points;
    return Math.hypot(a[3 * i] - a[3 * i - 3], a[3 * i + 1] - a[3 * i - 2], a[3 * i + 2] - a[3 * i - 1]);
  }

  /** The place at the start of a line. */
  ofLine(line: number): Place {
    return { line, piece: this.firstPiece[line] ?? -1, part: 0 };
  }

  /** The next line in direction `by` (1 or -1) that moves the tool; the same when there is none. */
  step(from: Place, by: 1 | -1): Place {
    let piece = from.piece;
    if (piece < 0) {
      for (let l = from.line + by; l >= 0 && l < this.lines; l += by) {
        if (this.firstPiece[l] >= 0) return this.ofPiece(this.firstPiece[l], 0);
      }
      return from;
    }
    const line = this.line[piece];
    do piece += by;
    while (piece >= 0 && piece < this.pieces && this.line[piece] === line);
    return piece < 0 || piece >= this.pieces ? from : this.ofPiece(by > 0 ? piece : this.runStart(piece), 0);
  }

  ofPiece(piece: number, part: number): Place {
    return { line: this.line[piece], piece, part };
  }

  /** First piece of the unbroken run of a line. */
  runStart(piece: number): number {
    while (piece > 0 && this.line[piece - 1] === this.line[piece]) piece--;
    return piece;
  }

  /** One past the last piece of the unbroken run of a line. */
  runEnd(piece: number): number {
    do piece++;
    while (piece < this.pieces && this.line[piece] === this.line[piece - 1]);
    return piece;
  }

  /** The place at a time or length from the start. */
  at(value: number, ends: Float64Array): Place {
    if (this.pieces === 0) return { line: 0, piece: -1, part: 0 };
    let lo = 0;
    let hi = this.pieces - 1;
    while (lo < hi) {
      const mid = (lo + hi) >> 1;
      if (ends[mid] > value) hi = mid;
      else lo = mid + 1;
    }
    const start = lo > 0 ? ends[lo - 1] : 0;
    const span = ends[lo] - start;
    return this.ofPiece(lo, span > 0 ? Math.min(1, Math.max(0, (value - start) / span)) : 0);
  }

  /** Part of the way of all cutting moves that is done at a place on the path. */
  done({ piece, part }: Place): number {
    const start = piece > 0 ? this.doneEnd[piece - 1] : 0;
    return start + (this.doneEnd[piece] - start) * part;
  }

  /** Time [s] or length [mm] at a place; NaN off the path. */
  value(place: Place, ends: Float64Array): number {
    if (place.piece < 0) return NaN;
    const start = place.piece > 0 ? ends[place.piece - 1] : 0;
    return start + (ends[place.piece] - start) * place.part;
  }

  /** The point before a place and that after it, and the share of the way between them; null off the path. */
  private between({ piece, part }: Place): { i: number; j: number; t: number } | null {
    if (piece < 0 || piece >= this.pieces) return null;
    let left = this.pieceLength(piece) * part;
    const [a, b] = [this.first[piece], this.first[piece + 1] - 1];
    let i = a;
    while (i < b && this.gap(i + 1) < left) left -= this.gap(++i);
    // On the spot the share is that of the piece.
    const t = i < b ? (this.gap(i + 1) > 0 ? left / this.gap(i + 1) : part) : 0;
    return { i, j: Math.min(i + 1, b), t };
  }

  /** The tool tip at a place; null off the path. */
  tip(place: Place): [number, number, number] | null {
    const at = this.between(place);
    if (!at) return null;
    const p = this.points;
    const mix = (k: number) => p[3 * at.i + k] + (p[3 * at.j + k] - p[3 * at.i + k]) * at.t;
    return [mix(0), mix(1), mix(2)];
  }

  /** Positions of the joints of the machine at a place [mm or rad]; null off the path. */
  joints(place: Place): number[] | null {
    const at = this.between(place);
    return at && this.jointColumns.map((q) => q[at.i] + (q[at.j] - q[at.i]) * at.t);
  }
}

/** The one cursor: who moves it calls `go`, who shows it listens. */
export class Cursor {
  place: Place = { line: -1, piece: -1, part: 0 };
  private readonly listeners: ((place: Place, source: string) => void)[] = [];

  listen(f: (place: Place, source: string) => void): void {
    this.listeners.push(f);
  }

  go(place: Place, source: string): void {
    this.place = place;
    for (const f of this.listeners) f(place, source);
  }
}
