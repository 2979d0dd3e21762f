// German symbols of units.
import type { Unit } from "../units";

export const units: Record<Unit, string> = {
  mm: "mm",
  "mm/rev": "mm",
  "mm/min": "mm/min",
  "rev/min": "1/min",
  "m/min": "m/min",
  s: "s",
  ms: "ms",
  min: "min",
  in: "in",
  "in/min": "in/min",
  "in/rev": "in",
  "ft/min": "ft/min",
  "°/min": "°/min",
  "m/s²": "m/s²",
  "m/s³": "m/s³",
  "in/s²": "in/s²",
  "in/s³": "in/s³",
  "N m": "N·m",
  kW: "kW",
  MB: "MB",
  Hz: "Hz",
  pitches: "Steigungen",
  "cm³/min": "cm³/min",
};
