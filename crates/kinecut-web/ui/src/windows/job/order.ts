// The order of fields in a form: from what and where over how deep to how fast; others follow as they come.
const ORDER = [
  "title", "material", "units", "format", "tools", "cutting",
  "type", "number", "name", "tool", "of", "outline", "rectangle", "circle", "slot", "region", "at", "points", "pattern", "grid", "size", "thread", "min", "max", "centre", "box",
  "cylinder", "mesh", "diameter", "bottom_diameter", "long", "short", "width", "height", "length", "top", "depth", "breakthrough", "corner_radius", "flute_length", "teeth", "shank_diameter",
  "stickout", "holder", "gauge_length", "strategy", "direction", "side", "entry", "exit", "cutting_speed", "speed", "feed", "feed_per_tooth", "feed_per_rev", "stepover", "stepdown",
  "engagement", "allowance", "turns", "plunge_feed", "tolerance", "rough", "finish", "offset", "position", "control", "program", "decimals", "step",
];

export function ordered(keys: string[]): string[] {
  const rank = (key: string) => {
    const at = ORDER.indexOf(key);
    return at < 0 ? ORDER.length : at;
  };
  return [...keys].sort((a, b) => rank(a) - rank(b) || (a < b ? -1 : 1));
}
