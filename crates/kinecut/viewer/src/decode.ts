// Reads what the page carries: a JSON head and packed streams of integers (src/job/report/encode of the crate).

export interface BodyHead {
  name: string;
  vertices: number;
  triangles: number;
}

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
  playback: null | { step: number; ticks: number; vertices: number; faces: number; unit: number };
  fixtures: (BodyHead & { lines: [number, number] })[];
  machine: null | {
    /** From the work to the tool; the first `bed` carry the work. */
    joints: { rotary: boolean; direction: [number, number, number]; point: [number, number, number] }[];
    bed: number;
    /** Part coordinates at home: columns of the rotation, then the translation [mm]. */
    setups: { lines: [number, number]; part: number[] }[];
    /** Each with the joint that moves its link; null: the bed. */
    bodies: (BodyHead & { link: number | null })[];
  };
  path: { pieces: number; points: number; step: number; axes: number; axis_step: number; done_step: number; runs: number; run_step: number; joint_step: number };
  /** `holder`: height above the tip [mm] at which the outline becomes that of the holder. */
  tools: { number: number; outline: [number, number][]; flutes: number; holder?: number | null }[];
  roles: string[];
  lines: number;
  line_step: number;
  /** File, first line and the line after the last of programs whose text is packed. */
  listing: [string, number, number][];
}

/** What the packed elements hold, by their names. */
let streams = new Map<string, Uint8Array>();

/** Unpacks streams, which come by their names in base64. Fails in a browser that cannot. */
export async function unpacked(packed: [string, string][]): Promise<Map<string, Uint8Array>> {
  const all = packed.map(async ([id, text]): Promise<[string, Uint8Array]> => {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return [id, new Uint8Array(await new Response(stream).arrayBuffer())];
  });
  return new Map(await Promise.all(all));
}

/** Lets streams be read: those of the page, or of data that has come since. Gives back what was to be read before. */
export function use(all: Map<string, Uint8Array>): Map<string, Uint8Array> {
  const before = streams;
  streams = all;
  return before;
}

/** Unpacks all data of the page; the elements then give their memory back. */
export async function unpack(): Promise<void> {
  const elements = [...document.querySelectorAll<HTMLElement>("script[data-packed]")];
  use(await unpacked(elements.map((element) => [element.id, element.textContent ?? ""])));
  for (const element of elements) element.remove();
}

/** The bytes of a stream, which is then forgotten; none where the page has no such stream. */
export function taken(id: string): Uint8Array {
  const bytes = streams.get(id) ?? new Uint8Array();
  streams.delete(id);
  return bytes;
}

/** A stream of integers. */
export class Stream {
  private readonly bytes: Uint8Array;
  private at = 0;

  constructor(id: string) {
    this.bytes = taken(id);
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

  /** A column of integers: the order of its differences, then they. */
  column(count: number): Float64Array {
    const order = this.unsigned();
    const last = new Float64Array(order);
    const out = new Float64Array(count);
    for (let i = 0; i < count; i++) {
      let n = this.signed();
      for (let k = order - 1; k >= 0; k--) n = last[k] += n;
      out[i] = n;
    }
    return out;
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
  for (let k = 0; k < 3; k++) {
    const column = coordinates.column(head.vertices);
    for (let i = 0; i < head.vertices; i++) positions[3 * i + k] = head.origin[k] + column[i] * head.step;
  }
  const indices = new Uint32Array(head.triangles * 3);
  const corners = new Stream("kc-indices");
  let first = 0;
  for (let i = 0; i < indices.length; i += 3) {
    indices[i] = first += corners.unsigned();
    indices[i + 1] = first + corners.signed();
    indices[i + 2] = indices[i + 1] + corners.signed();
  }
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

/** The stock over time: squares, each there from one tick to another. */
export interface PlayedData {
  positions: Float32Array;
  /** Four corners of each face. */
  corners: Uint32Array;
  /** From the end of this tick of each face, up to that of the other. */
  lives: Uint16Array;
}

/** The tick of what remains. */
const REMAINS = 65535;

export function played(head: NonNullable<Head["playback"]>): PlayedData {
  const stream = new Stream("kc-playback");
  const positions = new Float32Array(3 * head.vertices);
  for (let k = 0; k < 3; k++) {
    const column = stream.column(head.vertices);
    for (let i = 0; i < head.vertices; i++) positions[3 * i + k] = column[i] * head.unit;
  }
  const lives = new Uint16Array(2 * head.faces);
  const [from, life] = [stream.column(head.faces), stream.column(head.faces)];
  for (let f = 0; f < head.faces; f++) {
    lives[2 * f] = from[f];
    lives[2 * f + 1] = life[f] === 0 ? REMAINS : from[f] + life[f];
  }
  // Corners count back from the next one that no face has had yet.
  const columns = [0, 1, 2, 3].map(() => stream.column(head.faces));
  const corners = new Uint32Array(4 * head.faces);
  for (let f = 0, next = 0; f < head.faces; f++) {
    for (let k = 0; k < 4; k++) {
      const back = columns[k][f];
      corners[4 * f + k] = next - back;
      if (back === 0) next++;
    }
  }
  return { positions, corners, lives };
}

/** A body: corners [mm] and triangles. */
export interface BodyData {
  positions: Float32Array;
  indices: Uint32Array;
}

/** The bodies of a stream in the order of the head. */
export function bodies(id: string, head: BodyHead[]): BodyData[] {
  const stream = new Stream(id);
  if (stream.done) return [];
  const sum = (of: (f: BodyHead) => number) => head.reduce((n, f) => n + of(f), 0);
  const read = (count: number) => [0, 1, 2].map(() => stream.column(count));
  const places = read(sum((f) => f.vertices));
  const corners = read(sum((f) => f.triangles));
  let [vertex, triangle] = [0, 0];
  return head.map((f) => {
    const positions = new Float32Array(3 * f.vertices).map((_, i) => places[i % 3][vertex + Math.floor(i / 3)] / 1000);
    const indices = new Uint32Array(3 * f.triangles).map((_, i) => corners[i % 3][triangle + Math.floor(i / 3)]);
    vertex += f.vertices;
    triangle += f.triangles;
    return { positions, indices };
  });
}

/** Numbers of the program lines, which are in steps. */
export function ofLines(id: string, head: Head, count: number): Float64Array {
  const out = new Float64Array(count);
  const stream = new Stream(id);
  if (!stream.done) stream.column(Math.min(count, stream.unsigned())).forEach((n, i) => (out[i] = n * head.line_step));
  return out;
}
