// Inputs that several figures of this paper have.
import type { Field, Values } from "../model";
import { tomlNumber } from "../model";
import { POINTS } from "./geometry";

export const DIAMETER: Field = { key: "D", symbol: "s.D2", name: "q2.D", unit: "u.mm", min: 1, max: 100, step: 1, digits: 2 };
export const POINT: Field = { key: "point", symbol: "s.2phi", name: "q2.point", unit: "u.deg", min: 60, max: 170, step: 1, digits: 2 };
export const SECOND: Field = { key: "second", symbol: "s.2phi1", name: "q2.second", unit: "u.deg", min: 30, max: 170, step: 1, digits: 2, counts: (v) => v.form > 0 };
export const THIRD: Field = { key: "third", symbol: "s.2phi2", name: "q2.third", unit: "u.deg", min: 20, max: 170, step: 1, digits: 2, counts: (v) => v.form === 2 };
export const FORM: Field = { key: "form", symbol: "s.D2", name: "q2.form", min: 0, max: 2, step: 1, digits: 0, options: ["f24.single", "f24.double", "f24.zhirov"] };

/** The point as an input of kinecut. */
export function pointToml(v: Values): string {
  const second = v.form > 0 ? `, second_angle = ${tomlNumber(v.second)}` : "";
  const third = v.form === 2 ? `, third_angle = ${tomlNumber(v.third)}` : "";
  return `point = { ${POINTS[v.form]} = { point_angle = ${tomlNumber(v.point)}${second}${third} } }`;
}
