// Reads what the page carries: a JSON head and streams of variable-length integers (src/report/encode.rs of the crate).

/** Head of the data; the names are those the crate writes. */
export interface Head {
  part: null | {
    vertices: number;
    triangles: number;
    origin: [number, number, number];
    step: number;
    tolerance: number;
    deviation_step: number;
    relative: boolean;
    edges: number[];
    compared: boolean;
  };
  path: { pieces: number; step: number };
  tools: { number: number; outline: [number, number][]; flutes: number }[];
  axes: [number, number, number][];
  roles: string[];
  lines: number;
}

/** A stream of integers. */
export class Stream {
  private readonly bytes: Uint8Array;
  private at = 0;

  /** Takes the text of an element; the element then gives its memory back. */
  constructor(id: string) {
    const element = document.getElementById(id);
    const text = atob((element?.textContent ?? "").trim());
    this.bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) this.bytes[i] = text.charCodeAt(i);
    element?.remove();
  }

  /** Whether all was read. */
  get done(): boolean {
    return this.at >= this.bytes.length;
  }

  /** The next integer that is not negative; exact up to 2^53. */
  unsigned(): number {
    let byte = this.bytes[this.at++];
    if (byte < 128) return byte;
    let value = byte & 127;
    let weight = 128;
    do {
      byte = this.bytes[this.at++];
      value += (byte & 127) * weight;
      weight *= 128;
    } while (byte >= 128);
    return value;
  }

  /** The next integer in zigzag code. */
  signed(): number {
    const n = this.unsigned();
    return n % 2 === 0 ? n / 2 : -(n + 1) / 2;
  }
}

export function json<T>(id: string): T {
  return JSON.parse(document.getElementById(id)?.textContent ?? "null") as T;
}

/** The cut part as it comes: shared vertices. */
export interface PartData {
  positions: Float32Array;
  indices: Uint32Array;
  /** Deviation [mm] at each vertex; NaN where nothing was compared; null without any. */
  deviation: Float32Array | null;
}

export function part(head: NonNullable<Head["part"]>): PartData {
  const positions = new Float32Array(head.vertices * 3);
  const coordinates = new Stream("kc-positions");
  const last = [0, 0, 0];
  for (let i = 0; i < positions.length; i++) {
    const k = i % 3;
    last[k] += coordinates.signed();
    positions[i] = head.origin[k] + last[k] * head.step;
  }
  const indices = new Uint32Array(head.triangles * 3);
  const corners = new Stream("kc-indices");
  let index = 0;
  for (let i = 0; i < indices.length; i++) indices[i] = index += corners.signed();
  let deviation: Float32Array | null = null;
  const codes = new Stream("kc-deviation");
  if (head.compared) {
    deviation = new Float32Array(head.vertices);
    for (let i = 0; i < deviation.length; i++) {
      const code = codes.unsigned();
      const n = code - 1;
      deviation[i] = code === 0 ? NaN : (n % 2 === 0 ? n / 2 : -(n + 1) / 2) * head.deviation_step;
    }
  }
  return { positions, indices, deviation };
}

/** Numbers of the program lines in thousandths. */
export function thousandths(id: string, count: number): Float64Array {
  const stream = new Stream(id);
  const out = new Float64Array(count);
  for (let i = 0; i < count && !stream.done; i++) out[i] = stream.unsigned() / 1000;
  return out;
}
