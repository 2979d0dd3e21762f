// Places in space on paper: an orthographic view, and what of a mesh is seen there.

export type P3 = [number, number, number];
export type P2 = [number, number];

export interface View {
  /** Direction from which is looked, about the vertical and above the level [rad]. */
  yaw: number;
  pitch: number;
}

export const VIEWS = {
  iso: { yaw: -1.05, pitch: 0.5 },
  top: { yaw: -Math.PI / 2, pitch: Math.PI / 2 },
  front: { yaw: -Math.PI / 2, pitch: 0 },
  right: { yaw: 0, pitch: 0 },
} satisfies Record<string, View>;

export const dot = (a: P3, b: P3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: P3, b: P3): P3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const plus = (a: P3, b: P3, by = 1): P3 => [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]];
export const less = (a: P3, b: P3): P3 => plus(a, b, -1);
export const size = (a: P3): number => Math.hypot(...a);
export const unit = (a: P3): P3 => (size(a) > 0 ? (a.map((c) => c / size(a)) as P3) : [0, 0, 0]);

/** A view that fits points into a box. */
export class Paper {
  private readonly right: P3;
  private readonly up: P3;
  readonly viewer: P3;
  readonly scale: number;
  private readonly middle: P2;

  constructor(view: View, points: P3[], readonly width: number, readonly height: number, margin: number) {
    const [cy, sy, cp, sp] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
    this.right = [-sy, cy, 0];
    this.up = [-sp * cy, -sp * sy, cp];
    this.viewer = [cp * cy, cp * sy, sp];
    // The size is that of the sphere about all, so that turning changes no scale.
    const low = [0, 1, 2].map((k) => Math.min(...points.map((p) => p[k]))) as P3;
    const high = [0, 1, 2].map((k) => Math.max(...points.map((p) => p[k]))) as P3;
    const centre = plus(low, less(high, low), 0.5);
    const radius = Math.max(1e-9, ...points.map((p) => size(less(p, centre))));
    this.scale = (Math.min(width, height) / 2 - margin) / radius;
    this.middle = [dot(this.right, centre), dot(this.up, centre)];
  }

  px(p: P3): P2 {
    return [this.width / 2 + (dot(this.right, p) - this.middle[0]) * this.scale, this.height / 2 - (dot(this.up, p) - this.middle[1]) * this.scale];
  }

  /** How near a place is to the viewer [mm]. */
  near(p: P3): number {
    return dot(this.viewer, p);
  }
}

export const line = (points: P2[]): string => points.map(([x, y], i) => `${i === 0 ? "M" : "L"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

export interface Quad {
  d: string;
  near: number;
  /** Share of light, 0 to 1. */
  light: number;
}

/** The quads of a mesh, the farthest first; `by` lines at a time. */
export function quads(mesh: P3[][], paper: Paper, by: number): Quad[] {
  const found: Quad[] = [];
  const lamp = unit([-0.3, -0.5, 0.9]);
  for (let i = 0; i + by < mesh.length; i += by) {
    for (let j = 0; j + by < mesh[i].length; j += by) {
      const corners = [mesh[i][j], mesh[i + by][j], mesh[i + by][j + by], mesh[i][j + by]];
      const normal = unit(cross(less(corners[2], corners[0]), less(corners[3], corners[1])));
      const facing = Math.sign(dot(normal, paper.viewer)) || 1;
      found.push({
        d: `${line(corners.map((c) => paper.px(c)))}Z`,
        near: corners.reduce((sum, c) => sum + paper.near(c), 0) / 4,
        light: Math.min(1, Math.max(0, 0.5 + 0.5 * facing * dot(normal, lamp))),
      });
    }
  }
  return found.sort((a, b) => a.near - b.near);
}

/** The place of a mesh under a pointer as shares of its two ways, the nearest to the viewer; beside the mesh its nearest corner. */
export function under(mesh: P3[][], paper: Paper, [x, y]: P2): P2 {
  const flat = mesh.map((row) => row.map((p) => paper.px(p)));
  let best: { near: number; at: P2 } | null = null;
  let corner: { far: number; at: P2 } = { far: Infinity, at: [0, 0] };
  const inside = (a: P2, b: P2, c: P2): P3 | null => {
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if (Math.abs(area) < 1e-9) return null;
    const s = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / area;
    const t = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / area;
    return s < -1e-9 || t < -1e-9 || s + t > 1 + 1e-9 ? null : [1 - s - t, s, t];
  };
  for (let i = 0; i < mesh.length; i++) {
    for (let j = 0; j < mesh[i].length; j++) {
      const far = Math.hypot(flat[i][j][0] - x, flat[i][j][1] - y);
      if (far < corner.far) corner = { far, at: [i, j] };
      if (i + 1 >= mesh.length || j + 1 >= mesh[i].length) continue;
      const triangles: [P2, P2, P2][] = [
        [[i, j], [i + 1, j], [i + 1, j + 1]],
        [[i, j], [i + 1, j + 1], [i, j + 1]],
      ];
      for (const three of triangles) {
        const parts = inside(...(three.map(([k, l]) => flat[k][l]) as [P2, P2, P2]));
        if (!parts) continue;
        const near = parts.reduce((sum, w, n) => sum + w * paper.near(mesh[three[n][0]][three[n][1]]), 0);
        if (best && best.near >= near) continue;
        best = { near, at: [0, 1].map((k) => parts.reduce((sum, w, n) => sum + w * three[n][k], 0)) as P2 };
      }
    }
  }
  const { at } = best ?? corner;
  return [at[0] / (mesh.length - 1), at[1] / (mesh[0].length - 1)];
}
