// The unit of a number, from the words about its key: the first one behind a comma, a colon, a semicolon, a bracket or a default; lengths
// in mm need no word. The rule is that of the library (src/job/forms/unit.rs).

/** A unit, or null for a number without. */
export type Unit = string | null;

const NAMED = [
  "mm/min, of rotary axes rev/min", "m/s2, of rotary axes degrees/s2", "m/s3, of rotary axes degrees/s3", "mm, rotary axes degrees",
  "mm, or degrees", "degrees/min", "mm or rad", "degrees and mm", "mm and degrees", "rev/min and N m", "rev/min", "mm/min", "mm/rev", "m/min", "m/s2", "m/s3",
  "degrees", "seconds", "pitches", "N m", "kW", "MB", "Hz", "mm", "s",
];
const PURE = ["direction", "share", "weight", "radial passes as shares", "-1 when"];

export function unitOf(about: string): Unit {
  const line = about.split("\n\n")[0];
  let found: { at: number; rank: number } | null = null;
  NAMED.forEach((name, rank) => {
    for (let at = line.indexOf(name); at >= 0; at = line.indexOf(name, at + 1)) {
      if (!begins(line.slice(0, at)) || /[\p{L}\p{N}/]/u.test(line[at + name.length] ?? "")) continue;
      if (!found || at < found.at || (at === found.at && rank < found.rank)) found = { at, rank };
    }
  });
  if (found) {
    const name = NAMED[(found as { rank: number }).rank];
    return name === "s" ? "seconds" : name;
  }
  const first = line.split(/[.;]/)[0].toLowerCase();
  return first.includes("no unit") || PURE.some((words) => first.startsWith(words)) ? null : "mm";
}

function begins(text: string): boolean {
  const before = text.trimEnd();
  if (/[,;:([]$/.test(before)) return true;
  return /\bdefault [-+\d.eE]+$/i.test(before);
}

/** A unit as it stands in a field: short. */
export function shown(unit: Unit, inches = false): string {
  const words: Record<string, string> = { degrees: "°", seconds: "s", "degrees/min": "°/min", "m/s2": "m/s²", "m/s3": "m/s³" };
  if (!unit) return "";
  if (inches) return shown(unit).replace(/^mm\b/, "in").replace(/^m\/min/, "ft/min").replace(/^m\/s/, "in/s");
  if (unit.startsWith("mm/min,")) return "mm/min";
  if (unit.startsWith("m/s2,")) return "m/s²";
  if (unit.startsWith("m/s3,")) return "m/s³";
  if (unit.includes(",") || unit.includes(" and ") || unit.includes(" or ")) return "";
  return words[unit] ?? unit;
}
