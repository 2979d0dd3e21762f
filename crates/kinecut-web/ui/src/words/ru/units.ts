// Russian symbols of units.
import type { Unit } from "../units";

export const units: Record<Unit, string> = {
  mm: "мм",
  "mm/rev": "мм/об",
  "mm/min": "мм/мин",
  "rev/min": "об/мин",
  "m/min": "м/мин",
  s: "с",
  ms: "мс",
  min: "мин",
  in: "дюйм",
  "in/min": "дюйм/мин",
  "in/rev": "дюйм/об",
  "ft/min": "фут/мин",
  "°/min": "°/мин",
  "m/s²": "м/с²",
  "m/s³": "м/с³",
  "in/s²": "дюйм/с²",
  "in/s³": "дюйм/с³",
  "N m": "Н·м",
  kW: "кВт",
  MB: "МБ",
  Hz: "Гц",
  pitches: "шагов",
  "cm³/min": "см³/мин",
};
