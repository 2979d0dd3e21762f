// The cut part for the graphics card: sharp edges stay sharp, colours change exactly at the borders of the bands.
import { BufferAttribute, BufferGeometry, DataTexture, NearestFilter, SRGBColorSpace } from "three";
import type { PartData } from "./decode";
import { colour } from "./theme";

/** Faces that meet at a greater angle keep an edge: 30 degrees. */
const CREASE = Math.cos(Math.PI / 6);
/** The texture spans this many times the outermost border of the bands. */
const SPAN = 1.2;
const TEXELS = 1024;

/** Triangles with their own corners: normals averaged over neighbours that are nearly in one plane. */
export function geometry(part: PartData, tolerance: number, edges: number[]): BufferGeometry {
  const { positions, indices, deviation } = part;
  const faces = indices.length / 3;
  const unit = new Float32Array(indices.length);
  const area = new Float32Array(faces);
  for (let f = 0; f < faces; f++) {
    const [a, b, c] = [3 * indices[3 * f], 3 * indices[3 * f + 1], 3 * indices[3 * f + 2]];
    const [ux, uy, uz] = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]);
    const [vx, vy, vz] = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const size = Math.hypot(n[0], n[1], n[2]);
    area[f] = size;
    for (let k = 0; k < 3; k++) unit[3 * f + k] = size > 0 ? n[k] / size : 0;
  }
  // Faces around each vertex, by counting.
  const start = new Uint32Array(positions.length / 3 + 1);
  for (const v of indices) start[v + 1]++;
  for (let v = 1; v < start.length; v++) start[v] += start[v - 1];
  const fill = start.slice();
  const around = new Uint32Array(indices.length);
  for (let i = 0; i < indices.length; i++) around[fill[indices[i]]++] = Math.floor(i / 3);

  const corner = new Float32Array(indices.length * 3);
  const normal = new Float32Array(indices.length * 3);
  const uv = deviation ? new Float32Array(indices.length * 2) : null;
  const limit = tolerance * edges[edges.length - 1] * SPAN;
  for (let i = 0; i < indices.length; i++) {
    const v = indices[i];
    const f = 3 * Math.floor(i / 3);
    let [x, y, z] = [0, 0, 0];
    for (let j = start[v]; j < start[v + 1]; j++) {
      const g = 3 * around[j];
      if (unit[f] * unit[g] + unit[f + 1] * unit[g + 1] + unit[f + 2] * unit[g + 2] < CREASE) continue;
      const w = area[around[j]];
      x += unit[g] * w;
      y += unit[g + 1] * w;
      z += unit[g + 2] * w;
    }
    const size = Math.hypot(x, y, z) || 1;
    corner.set(positions.subarray(3 * v, 3 * v + 3), 3 * i);
    normal[3 * i] = x / size;
    normal[3 * i + 1] = y / size;
    normal[3 * i + 2] = z / size;
    if (uv && deviation) {
      // A triangle was compared when all its corners were: a face beside the wanted surface shares corners with it.
      const known = [0, 1, 2].every((k) => !Number.isNaN(deviation[indices[f + k]]));
      uv[2 * i] = known ? Math.min(1, Math.max(0, 0.5 + deviation[v] / limit / 2)) : 0.5;
      uv[2 * i + 1] = known ? 0.75 : 0.25;
    }
  }
  const out = new BufferGeometry();
  out.setAttribute("position", new BufferAttribute(corner, 3));
  out.setAttribute("normal", new BufferAttribute(normal, 3));
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
