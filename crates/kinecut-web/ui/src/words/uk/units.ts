// Ukrainian symbols of units.
import type { Unit } from "../units";

export const units: Record<Unit, string> = {
  mm: "мм",
  "mm/rev": "мм/об",
  "mm/min": "мм/хв",
  "rev/min": "об/хв",
  "m/min": "м/хв",
  s: "с",
  ms: "мс",
  min: "хв",
  in: "дюйм",
  "in/min": "дюйм/хв",
  "in/rev": "дюйм/об",
  "ft/min": "фут/хв",
  "°/min": "°/хв",
  "m/s²": "м/с²",
  "m/s³": "м/с³",
  "in/s²": "дюйм/с²",
  "in/s³": "дюйм/с³",
  "N m": "Н·м",
  kW: "кВт",
  MB: "МБ",
  Hz: "Гц",
  pitches: "кроків",
  "cm³/min": "см³/хв",
};
