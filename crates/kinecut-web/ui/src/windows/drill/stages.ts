// The stretches of one feed: their names, and their classes for a colour that is never the only mark.
import type { Stage, Zone } from "../../base/drillsheet";
import { t } from "../../words";

export function stageName(stage: Stage): string {
  return t(`drill.stage.${stage}`);
}

export function zoneClass(stage: Stage): string {
  return `zone ${stage}`;
}

/** The stretch in which a drill is after a way from the start [mm], its height, and the time since the start [s]. */
export function atWay(zones: Zone[], way: number): { index: number; z: number; time: number } | null {
  let time = 0;
  let gone = 0;
  for (let index = 0; index < zones.length; index++) {
    const { from, to, time: whole } = zones[index];
    const length = from - to;
    if (way <= gone + length || index + 1 === zones.length) {
      const inside = Math.min(length, Math.max(0, way - gone));
      return { index, z: from - inside, time: time + (length > 0 ? (whole * inside) / length : 0) };
    }
    gone += length;
    time += whole;
  }
  return null;
}

/** The way at a time since the start. */
export function atTime(zones: Zone[], time: number): number {
  let gone = 0;
  let left = time;
  for (const { from, to, time: whole } of zones) {
    if (left <= whole) return gone + (whole > 0 ? ((from - to) * left) / whole : 0);
    gone += from - to;
    left -= whole;
  }
  return gone;
}
