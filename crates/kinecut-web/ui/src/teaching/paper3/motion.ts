// Inputs of the figures of this paper: the tool and its motion.
import { type Twist, rounded, twistOf } from "../../windows/grazing/question";
import type { Vec } from "../../windows/grazing/sheet";
import { type Field, type Values, tomlNumber } from "../model";
import { type Tool, velocityAt } from "./tool";

/** Height of the tool's top: 42 of stickout, 12 of holder [mm]. */
export const TOP = 54;

export const MOTION: Field[] = [
  { key: "vx", symbol: "s.vx", name: "q3.vx", unit: "u.mmMinute", min: -5000, max: 5000, step: 50, digits: 4, saved: [-1200, -600, 0, 600, 1200] },
  { key: "vy", symbol: "s.vy", name: "q3.vy", unit: "u.mmMinute", min: -5000, max: 5000, step: 50, digits: 4, saved: [-1200, -600, 0, 600, 1200] },
  { key: "vz", symbol: "s.vz", name: "q3.vz", unit: "u.mmMinute", min: -5000, max: 5000, step: 50, digits: 4, saved: [-2000, -1000, -500, 0, 500, 1000, 2000] },
  { key: "wx", symbol: "s.wx", name: "q3.wx", unit: "u.degMinute", min: -9000, max: 9000, step: 50, digits: 4, saved: [-1100, 0, 1100] },
  { key: "wy", symbol: "s.wy", name: "q3.wy", unit: "u.degMinute", min: -9000, max: 9000, step: 50, digits: 4, saved: [-2200, -1100, 0, 550, 2200] },
];
export const SPIN: Field = { key: "wz", symbol: "s.wz", name: "q3.wz", unit: "u.degMinute", min: -9000, max: 9000, step: 100, digits: 4, saved: [-1000, 1000] };
export const VIEW: Field = { key: "view", symbol: "s.view", name: "q3.view", unit: "u.deg", min: -180, max: 180, step: 5, digits: 0, free: true };

export const START: Values = { vx: 1200, vy: 150, vz: -220, wx: 180, wy: 1100, wz: 0 };

export const DIAMETER: Field = { key: "D", symbol: "s.D2", name: "q3.D", unit: "u.mm", min: 4, max: 40, step: 1, digits: 2, saved: [16, 30] };
export const CORNER: Field = { key: "rc", symbol: "s.rc", name: "q3.rc", unit: "u.mm", min: 0.2, max: 19.9, step: 0.5, digits: 2, saved: [1, 3, 9] };

const n = (x: number) => tomlNumber(x, 4);

/** The bull-nose end mill of examples/06_five_axis_sweep/tool.toml, with the numbers of a figure. */
export function millToml(v: Values): string {
  return `[tool]
shape.bull-nose = { diameter = ${n(v.D)}, corner_radius = ${n(v.rc)}, flute_length = 24 }
shank_diameter = ${n(Math.min(16, v.D))}
stickout = 42
holder = [{ height = 12, lower_diameter = 34, upper_diameter = 40 }]

${twistToml(v)}`;
}

export function twistToml(v: Values): string {
  return `[twist]
velocity = [${n(v.vx)}, ${n(v.vy)}, ${n(v.vz)}]
turn = [${n(v.wx)}, ${n(v.wy)}, ${n(v.wz ?? 0)}]
`;
}

/** Inputs with the velocity of one end of the axis moved by some [mm/min]; the axis is rigid, so that both ends have one velocity along it. */
export function dragged(tool: Tool, v: Values, which: "tip" | "top", by: Vec): Values {
  const twist0 = { velocity: [v.vx, v.vy, v.vz] as Vec, turn: [v.wx, v.wy, 0] as Vec };
  const [low, high] = tool.ends.map(({ z }) => ({ z, velocity: velocityAt({ twist: twist0 }, [0, 0, z]) }));
  const moved = (e: Vec): Vec => [e[0] + by[0], e[1] + by[1], e[2] + by[2]];
  const [tip, top] = [which === "tip" ? moved(low.velocity) : low.velocity, which === "top" ? moved(high.velocity) : high.velocity];
  const twist: Twist = twistOf(tip, top, [low.z, high.z], v.wz ?? 0, which);
  const [velocity, turn] = [rounded(twist.velocity), rounded(twist.turn)];
  return { vx: velocity[0], vy: velocity[1], vz: velocity[2], wx: turn[0], wy: turn[1] };
}
