// Lines of the parameter plane: the angle about the axis across, the profile up.
import { KINDS, type Sheet } from "./sheet";

export type X = (theta: number) => number;
export type Y = (piece: number, u: number) => number;

/** Turns by which what leaves the plane on one side is drawn again on the other. */
const AGAIN = [-720, -360, 0, 360, 720];

/** Where the surface enters, as one filled path. */
export function regionsOf(sheet: Pick<Sheet, "bands">, x: X, y: Y): string {
  let d = "";
  for (const { piece, u, enters } of sheet.bands) {
    if (!enters) continue;
    const [a, b] = [y(piece, u[0]), y(piece, u[1])];
    const [[p, q], [r, s]] = enters;
    for (const by of AGAIN) {
      if (Math.max(q, s) + by < 0 || Math.min(p, r) + by > 360) continue;
      d += `M${x(p + by).toFixed(1)} ${a.toFixed(2)}H${x(q + by).toFixed(1)}L${x(s + by).toFixed(1)} ${b.toFixed(2)}H${x(r + by).toFixed(1)}Z`;
    }
  }
  return d;
}

export interface Line {
  span: number;
  kind: number;
  d: string;
}

/** Each branch of each span as one line, as often as it is seen. */
export function curvesOf(sheet: Pick<Sheet, "loops" | "spans">, x: X, y: Y): Line[] {
  const lines = new Map<string, Line>();
  for (const { points } of sheet.loops) {
    let before: (typeof points)[number] | null = null;
    let theta = 0;
    let way: [number, number][] = [];
    const close = () => {
      if (before && way.length > 1) {
        const key = `${before.span} ${before.branch}`;
        const line = lines.get(key) ?? { span: before.span, kind: KINDS.indexOf(sheet.spans[before.span].kind), d: "" };
        const [low, high] = [Math.min(...way.map((w) => w[0])), Math.max(...way.map((w) => w[0]))];
        for (const by of AGAIN) if (high + by >= 0 && low + by <= 360) line.d += `M${way.map(([a, b]) => `${x(a + by).toFixed(1)} ${b.toFixed(2)}`).join("L")}`;
        lines.set(key, line);
      }
      way = [];
    };
    for (const p of points) {
      // The middle of a disc has no angle; the curve goes on from it as it came.
      if (p.point[0] === 0 && p.point[1] === 0 && p.normal[0] === 0 && p.normal[1] === 0) continue;
      if (before && (before.span !== p.span || before.branch !== p.branch)) close();
      theta = way.length > 0 ? p.theta + Math.round((theta - p.theta) / 360) * 360 : p.theta;
      way.push([theta, y(p.piece, p.u)]);
      before = p;
    }
    close();
  }
  return [...lines.values()];
}
