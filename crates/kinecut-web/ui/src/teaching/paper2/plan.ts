// A drilling as a question for `kinecut drill`, and what figures keep of its answer.
import type { DrillSheet, Hole } from "../../base/drillsheet";
import { Told, type Question, short } from "../asked";
import { type Field, type Values, tomlNumber } from "../model";
import { pointToml } from "./fields";

const n = (x: number) => tomlNumber(x, 4);

/** Surfaces by their place in a list of choices: plane, shaft, bore. */
export const SURFACES = ["plane", "outer-cylinder", "inner-cylinder"] as const;

export const FEEDS: Field[] = [
  { key: "fIn", symbol: "s.fIn", name: "q2.fIn", unit: "u.mmRev", min: 0.02, max: 3, step: 0.05, digits: 3, saved: [0.2, 0.4, 0.8] },
  { key: "fFull", symbol: "s.fFull", name: "q2.fFull", unit: "u.mmRev", min: 0.02, max: 3, step: 0.05, digits: 3, saved: [0.4, 0.6, 1] },
  { key: "fOut", symbol: "s.fOut", name: "q2.fOut", unit: "u.mmRev", min: 0.02, max: 3, step: 0.05, digits: 3, saved: [0.1, 0.3, 0.4] },
];
export const APPROACH: Field = { key: "approach", symbol: "s.Lpod", name: "q2.approach", unit: "u.mm", min: 0, max: 20, step: 0.5, digits: 2, saved: [0, 1, 3, 5] };
export const OVERRUN: Field = { key: "overrun", symbol: "s.Lper", name: "q2.overrun", unit: "u.mm", min: 0, max: 20, step: 0.5, digits: 2, saved: [0, 1, 3, 5] };
export const LENGTH: Field = { key: "L", symbol: "s.Lface", name: "q2.Lface", unit: "u.mm", min: 1, max: 150, step: 1, digits: 2, saved: [10, 20, 30, 40, 60, 70, 80, 100] };

function surfaceToml(kind: number, radius: number, offset: number, inclination: number): string {
  const x = offset === 0 ? "" : `, offset = ${n(offset)}`;
  return kind === 0 ? `{ surface = "plane"${inclination === 0 ? "" : `, inclination = ${n(inclination)}`}${x} }` : `{ surface = "${SURFACES[kind]}", radius = ${n(radius)}${x} }`;
}

/** The example of figure 7 with other numbers. Of the entry and the exit: kind, radius, offset, inclination. */
export function drillToml(v: Values): string {
  return `[tool]
number = 1
type = "drill"
diameter = ${n(v.D)}
${pointToml(v)}
flute_length = ${n(Math.max(180, v.L + 150))}

[operation]
type = "drill"
tool = 1
entry = ${surfaceToml(v.kindIn ?? 0, v.RSin ?? 100, v.xIn ?? 0, v.alphaIn ?? 0)}
exit = ${surfaceToml(v.kindOut ?? 0, v.RSout ?? 100, v.xOut ?? 0, v.alphaOut ?? 0)}
length = ${n(v.L)}
approach = ${n(v.approach)}
overrun = ${n(v.overrun)}
cutting_speed = ${n(v.vc ?? 25)}
feed_per_rev = { entry = ${n(v.fIn)}, steady = ${n(v.fFull)}, exit = ${n(v.fOut)} }
`;
}

export type Plan = Pick<Hole, "lengths" | "coordinates" | "zones" | "spindle_speed" | "time" | "first_contact_radius" | "last_contact_radius" | "load" | "paper"> & { program: string; findings: string[] };

function keepPlan(sheet: DrillSheet): Plan {
  const [hole] = sheet.holes ?? [];
  if (!hole) throw new Told(JSON.stringify(sheet));
  if ("error" in hole) throw new Told(`${hole.error.code}: ${hole.error.message}`);
  const { lengths, coordinates, zones, spindle_speed, time, first_contact_radius, last_contact_radius, load, paper, findings } = hole;
  return {
    lengths,
    coordinates,
    zones,
    spindle_speed,
    time,
    first_contact_radius,
    last_contact_radius,
    load: load && { complete: load.complete, way: load.way.map((x) => short(x)), share: load.share.map((x) => short(x, 4)) },
    paper,
    program: sheet.program,
    findings: findings.map((f) => `${f.code}: ${f.message}`),
  };
}

export function askPlan(v: Values): Question {
  return { verb: "drill", flags: { paper: true, load: true }, text: drillToml(v), as: "plan", keep: keepPlan };
}

/** The share of the point in material after a way [mm] from the start: between two places of the answer it grows evenly. */
export function shareAt({ load }: Plan, way: number): number | null {
  if (!load?.complete) return null;
  const i = load.way.findIndex((w) => w >= way);
  if (i < 0) return load.share[load.share.length - 1] ?? null;
  if (i === 0) return load.share[0];
  const t = (way - load.way[i - 1]) / (load.way[i] - load.way[i - 1] || 1);
  return load.share[i - 1] + t * (load.share[i] - load.share[i - 1]);
}

/** Feed at a height, and the time since the start [s]: along a stretch it grows evenly. */
export function timeAt({ zones }: Plan, z: number): { feed: number; time: number; zone: number } {
  let time = 0;
  for (const [i, zone] of zones.entries()) {
    if (z >= zone.to - 1e-9 || i === zones.length - 1) {
      const part = zone.from === zone.to ? 1 : Math.min(1, Math.max(0, (zone.from - z) / (zone.from - zone.to)));
      return { feed: zone.feed, time: time + part * zone.time, zone: i };
    }
    time += zone.time;
  }
  return { feed: 0, time, zone: 0 };
}
