// The cut part for the graphics card: sharp edges stay sharp, colours change exactly at the borders of the bands.
import { BufferAttribute, BufferGeometry, DataTexture, NearestFilter, SRGBColorSpace } from "three";
import type { PartData } from "./decode";
import { colour } from "./theme";

/** Faces that meet at a greater angle keep an edge: 30 degrees. */
const CREASE = Math.cos(Math.PI / 6);
/** The texture spans this many times the outermost border of the bands. */
const SPAN = 1.2;
const TEXELS = 1024;

/** Normals for each corner of faces with so many sides: averaged over neighbours that are nearly in one plane. */
export function cornerNormals(positions: Float32Array, indices: Uint32Array, sides: 3 | 4): Float32Array {
  const faces = indices.length / sides;
  const unit = new Float32Array(3 * faces);
  const area = new Float32Array(faces);
  // Of a triangle two sides, of a square its diagonals.
  const [p, q, r, s] = sides === 3 ? [0, 1, 0, 2] : [0, 2, 1, 3];
  for (let f = 0, i = 0; f < faces; f++, i += sides) {
    const [a, b, c, d] = [3 * indices[i + p], 3 * indices[i + q], 3 * indices[i + r], 3 * indices[i + s]];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[d] - positions[c];
    const vy = positions[d + 1] - positions[c + 1];
    const vz = positions[d + 2] - positions[c + 2];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const size = Math.sqrt(nx * nx + ny * ny + nz * nz);
    area[f] = size;
    const by = size > 0 ? 1 / size : 0;
    unit[3 * f] = nx * by;
    unit[3 * f + 1] = ny * by;
    unit[3 * f + 2] = nz * by;
  }
  // Faces around each vertex, by counting.
  const start = new Uint32Array(positions.length / 3 + 1);
  for (const v of indices) start[v + 1]++;
  for (let v = 1; v < start.length; v++) start[v] += start[v - 1];
  const fill = start.slice();
  const around = new Uint32Array(indices.length);
  for (let i = 0; i < indices.length; i++) around[fill[indices[i]]++] = Math.floor(i / sides);

  const normal = new Float32Array(indices.length * 3);
  for (let i = 0; i < indices.length; i++) {
    const v = indices[i];
    const f = 3 * Math.floor(i / sides);
    let [x, y, z] = [0, 0, 0];
    for (let j = start[v]; j < start[v + 1]; j++) {
      const g = 3 * around[j];
      if (unit[f] * unit[g] + unit[f + 1] * unit[g + 1] + unit[f + 2] * unit[g + 2] < CREASE) continue;
      const w = area[around[j]];
      x += unit[g] * w;
      y += unit[g + 1] * w;
      z += unit[g + 2] * w;
    }
    const size = Math.sqrt(x * x + y * y + z * z) || 1;
    normal[3 * i] = x / size;
    normal[3 * i + 1] = y / size;
    normal[3 * i + 2] = z / size;
  }
  return normal;
}

/** Triangles with their own corners. */
export function geometry(part: PartData, tolerance: number, edges: number[]): BufferGeometry {
  const { positions, indices, deviation } = part;
  const corner = new Float32Array(indices.length * 3);
  const uv = deviation ? new Float32Array(indices.length * 2) : null;
  const limit = tolerance * edges[edges.length - 1] * SPAN;
  for (let i = 0; i < indices.length; i++) {
    const v = indices[i];
    const f = 3 * Math.floor(i / 3);
    corner.set(positions.subarray(3 * v, 3 * v + 3), 3 * i);
    if (uv && deviation) {
      // A triangle was compared when all its corners were: a face beside the wanted surface shares corners with it.
      const known = [0, 1, 2].every((k) => !Number.isNaN(deviation[indices[f + k]]));
      uv[2 * i] = known ? Math.min(1, Math.max(0, 0.5 + deviation[v] / limit / 2)) : 0.5;
      uv[2 * i + 1] = known ? 0.75 : 0.25;
    }
  }
  const out = new BufferGeometry();
  out.setAttribute("position", new BufferAttribute(corner, 3));
  out.setAttribute("normal", new BufferAttribute(cornerNormals(positions, indices, 3), 3));
  if (uv) out.setAttribute("uv", new BufferAttribute(uv, 2));
  return out;
}

/** Two rows: what was not compared, and the bands from the deepest gouge to the most stock left. */
export function bandTexture(edges: number[]): DataTexture {
  const pixels = new Uint8Array(TEXELS * 2 * 4);
  const put = (i: number, name: string) => {
    const c = colour(name).convertLinearToSRGB();
    pixels.set([c.r * 255, c.g * 255, c.b * 255, 255].map(Math.round), 4 * i);
  };
  const limit = edges[edges.length - 1] * SPAN;
  for (let i = 0; i < TEXELS; i++) {
    const d = ((i + 0.5) / TEXELS - 0.5) * 2 * limit;
    put(i, "part");
    put(TEXELS + i, `band${edges.filter((e) => e < d).length}`);
  }
  const texture = new DataTexture(pixels, TEXELS, 2);
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.colorSpace = SRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}
