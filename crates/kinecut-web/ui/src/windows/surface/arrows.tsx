// Arrows of motions: forming solid, setting dashed, set-up double; a turning one goes about its axis.
import { untranslated } from "../../app/verbatim";
import type { Arrow } from "./answer";
import { type P2, type P3, type Paper, cross, dot, less, line, plus, size, unit } from "./space";

/** Length of an arrow and least radius of a turning one, as shares of the picture. */
const LONG = 0.2;
const ROUND = 0.07;
/** Room between two arrows that run along each other, and between two names [px]. */
const ASIDE = 8;
const NAME = 15;
/** Width of a letter of a name, about [px]. */
const LETTER = 6.4;

interface Drawn {
  role: Arrow["role"];
  name: string;
  points: P2[];
  axis: P2[] | null;
}

/** The course of an arrow that begins at a point. */
function course(arrow: Arrow, from: P3, paper: Paper, reach: number): { points: P3[]; axis: P3[] | null } {
  const along = unit(arrow.direction);
  if (!arrow.axis_point) return { points: [plus(from, along, 0.12 * reach), plus(from, along, reach)], axis: null };
  const foot = plus(arrow.axis_point, along, dot(less(from, arrow.axis_point), along));
  const out = less(from, foot);
  const least = (ROUND * Math.min(paper.width, paper.height)) / paper.scale;
  const other: P3 = Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const radial = size(out) > 0.3 * least ? unit(out) : unit(cross(along, other));
  const round = cross(along, radial);
  const radius = Math.max(size(out), least);
  const turn = Math.min(1.7, reach / radius);
  const steps = 24;
  const points = Array.from({ length: steps + 1 }, (_, i) => {
    const angle = turn * (0.12 + (0.88 * i) / steps);
    return plus(plus(foot, radial, radius * Math.cos(angle)), round, radius * Math.sin(angle));
  });
  return { points, axis: [plus(foot, along, -0.8 * reach), plus(foot, along, 0.8 * reach)] };
}

function head([a, b]: [P2, P2], long = 9): string {
  const angle = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const end = (by: number): P2 => [b[0] - long * Math.cos(angle + by), b[1] - long * Math.sin(angle + by)];
  return `${line([end(0.4), b, end(-0.4)])}Z`;
}

/** An arrow beside those before it that run the same way. */
function aside(points: P2[], before: Drawn[]): P2[] {
  const [a, b] = [points[0], points[points.length - 1]];
  const far = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  const same = before.filter((d) => d.points.length === 2 && Math.abs((d.points[1][0] - d.points[0][0]) * (b[1] - a[1]) - (d.points[1][1] - d.points[0][1]) * (b[0] - a[0])) < 0.15 * far * far).length;
  const by = same * ASIDE;
  return points.map(([x, y]) => [x - (by * (b[1] - a[1])) / far, y + (by * (b[0] - a[0])) / far]);
}

export function Arrows({ arrows, from, paper }: { arrows: Arrow[]; from: P3; paper: Paper }) {
  const reach = (LONG * Math.min(paper.width, paper.height)) / paper.scale;
  const drawn: Drawn[] = [];
  for (const arrow of arrows) {
    const { points, axis } = course(arrow, from, paper, reach);
    const flat = points.map((p) => paper.px(p));
    drawn.push({ role: arrow.role, name: arrow.name, points: flat.length === 2 ? aside(flat, drawn) : flat, axis: axis && axis.map((p) => paper.px(p)) });
  }
  const names = drawn.map((d) => {
    const [x, y] = d.points[d.points.length - 1];
    const left = x > paper.width - LETTER * d.name.length - 14 || (x < d.points[0][0] - 4 && x > LETTER * d.name.length + 14);
    return { x: Math.min(Math.max(x + (left ? -7 : 7), left ? LETTER * d.name.length : 2), paper.width - 2), y: Math.min(Math.max(y + 4, 14), paper.height - 6), left, text: d.name };
  });
  // Names that would lie on one another go down.
  const order = [...names].sort((a, b) => a.y - b.y);
  order.forEach((one, i) => {
    for (const above of order.slice(0, i)) if (Math.abs(above.x - one.x) < LETTER * 14 && one.y - above.y < NAME) one.y = above.y + NAME;
  });
  return (
    <g class="motions">
      {drawn.map((d, i) => (
        <g key={i} class={`motion ${d.role}`} data-role={d.role}>
          {d.axis && <path class="axle" d={line(d.axis)} />}
          <path class="halo" d={line(d.points)} />
          <path class="shaft" d={line(d.points)} />
          {d.role === "set-up" && <path class="inner" d={line(d.points.slice(0, -1).concat([between(d.points)]))} />}
          <path class="head" d={head([d.points[d.points.length - 2], d.points[d.points.length - 1]])} />
        </g>
      ))}
      {names.map((n, i) => (
        <text key={i} x={n.x} y={n.y} text-anchor={n.left ? "end" : "start"} class={`name ${drawn[i].role}`} {...untranslated}>
          {n.text}
        </text>
      ))}
    </g>
  );
}

/** A little before the end, where the head begins. */
function between(points: P2[]): P2 {
  const [a, b] = [points[points.length - 2], points[points.length - 1]];
  const far = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  const by = Math.min(1, 8 / far);
  return [b[0] - by * (b[0] - a[0]), b[1] - by * (b[1] - a[1])];
}
