// Units by their English symbols; a language has its own for each.

export const UNITS = [
  "mm", "mm/rev", "mm/min", "rev/min", "m/min", "s", "ms", "min", "in", "in/min", "in/rev", "ft/min", "°/min", "m/s²", "m/s³", "in/s²", "in/s³",
  "N m", "kW", "MB", "Hz", "pitches", "cm³/min",
] as const;

export type Unit = (typeof UNITS)[number];
