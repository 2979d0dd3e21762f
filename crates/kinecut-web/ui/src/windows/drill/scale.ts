// From heights [mm] to the drawing [px], top down: to scale, with breaks where a long hole has nothing to show.

export interface Break {
  /** Heights between which nothing is drawn. */
  high: number;
  low: number;
}

/** Stretches longer than this are broken, and this much stays on either side, in radii of the hole. */
const [LONG, STAYS] = [3, 0.9];
/** Height of a break on the drawing [px]. */
export const GAP = 30;

export class Heights {
  readonly breaks: Break[] = [];
  readonly pixels: number;

  constructor(
    readonly high: number,
    readonly low: number,
    /** Pixels in a millimetre. */
    readonly scale: number,
    readonly top: number,
    shown: number[],
    radius: number,
  ) {
    const all = [...new Set([high, ...shown.filter((z) => z < high && z > low), low])].sort((a, b) => b - a);
    for (let i = 1; i < all.length; i++) {
      if (all[i - 1] - all[i] > LONG * radius) this.breaks.push({ high: all[i - 1] - STAYS * radius, low: all[i] + STAYS * radius });
    }
    this.pixels = this.y(low) - top;
  }

  y(z: number): number {
    let at = this.top + (this.high - z) * this.scale;
    for (const { high, low } of this.breaks) {
      if (z < low) at += GAP - (high - low) * this.scale;
      else if (z < high) at += (GAP / (high - low) - this.scale) * (high - z);
    }
    return at;
  }

  /** The height at a place of the drawing. */
  z(y: number): number {
    let at = this.top;
    let from = this.high;
    for (const { high, low } of this.breaks) {
      const begins = at + (from - high) * this.scale;
      if (y <= begins) break;
      if (y <= begins + GAP) return high - ((y - begins) / GAP) * (high - low);
      [at, from] = [begins + GAP, low];
    }
    return from - (y - at) / this.scale;
  }
}
