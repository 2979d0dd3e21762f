// The pseudo-language: each letter is marked, so that a text that did not come from the catalogue is seen; and it is longer, as other
// languages are.

/** Put behind each letter. */
export const MARK = "\u0323";

/** Marks the letters outside braces. */
export function marked(text: string): string {
  let depth = 0;
  let letters = 0;
  let out = "";
  for (const c of text) {
    if (c === "{") depth++;
    out += c;
    if (c === "}") depth--;
    if (depth === 0 && /\p{L}/u.test(c)) {
      out += MARK;
      letters++;
    }
  }
  return letters > 3 ? out + "~".repeat(Math.ceil(letters * 0.4)) : out;
}
