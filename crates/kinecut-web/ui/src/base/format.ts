// Numbers as a person reads them: a real minus, only the digits that are known, in the form of the language.
import { numeral } from "../words";

/** A number with so many decimals, and a real minus. */
export function fixed(n: number, decimals: number): string {
  const text = n.toFixed(decimals);
  return numeral(/^-0\.?0*$/.test(text) ? text.slice(1) : text.replace("-", "\u2212"));
}

/** A number with so many digits and no zeros at its end. */
export function short(n: number, digits = 4): string {
  return numeral(digitsOf(n, digits).replace("-", "\u2212"));
}

/** The same as it is written in a file. */
export function digitsOf(n: number, digits = 4): string {
  return String(Number(n.toPrecision(digits)));
}

/** A time as minutes and seconds, from an hour on with hours. */
export function clock(seconds: number): string {
  const whole = Math.max(0, Math.round(seconds));
  const two = (n: number) => String(n).padStart(2, "0");
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

/** The time of day. */
export function timeOfDay(date: Date): string {
  const two = (n: number) => String(n).padStart(2, "0");
  return `${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`;
}

/** Round ticks from 0 to a bound, some so many. */
export function ticks(bound: number, about: number): number[] {
  if (!(bound > 0)) return [0];
  const raw = bound / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find((n) => n * power >= raw) ?? 10) * power;
  return Array.from({ length: Math.floor(bound / step + 1e-9) + 1 }, (_, i) => Number((i * step).toPrecision(12)));
}

/** Round ticks of a time [s]. */
export function timeTicks(bound: number, about: number): number[] {
  const steps = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 28_800];
  const step = steps.find((n) => bound / n <= about) ?? Math.ceil(bound / about / 86_400) * 86_400;
  return Array.from({ length: Math.floor(bound / step + 1e-9) + 1 }, (_, i) => i * step);
}
