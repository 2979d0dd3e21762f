// TOML for the editor: words by their kind.
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

interface State {
  /** Depth of brackets of values; keys are words before `=`. */
  depth: string[];
  value: boolean;
  long: string | null;
}

export const toml = StreamLanguage.define<State>({
  name: "toml",
  startState: () => ({ depth: [], value: false, long: null }),
  copyState: (s) => ({ ...s, depth: [...s.depth] }),
  languageData: { commentTokens: { line: "#" }, closeBrackets: { brackets: ["[", "{", '"'] } },
  token(stream, state) {
    if (state.long) {
      while (!stream.eol()) {
        if (stream.match(state.long)) {
          state.long = null;
          break;
        }
        stream.next();
      }
      return "string";
    }
    if (stream.sol() && state.depth.length === 0) state.value = false;
    if (stream.eatSpace()) return null;
    if (stream.match(/^#.*/)) return "comment";
    if (!state.value && state.depth.length === 0 && stream.match(/^\[\[?[^\]]*\]\]?/)) return "heading";
    const long = stream.match(/^("""|''')/) as RegExpMatchArray | null;
    if (long) {
      state.long = long[0];
      return "string";
    }
    if (stream.match(/^"(?:[^"\\]|\\.)*"?/) || stream.match(/^'[^']*'?/)) return state.value ? "string" : "propertyName";
    const next = stream.next() ?? "";
    if (next === "=") {
      state.value = true;
      return "operator";
    }
    if (next === "{" || next === "[") {
      state.depth.push(next);
      state.value = next === "[";
      return "bracket";
    }
    if (next === "}" || next === "]") {
      state.depth.pop();
      state.value = true;
      return "bracket";
    }
    if (next === ",") {
      state.value = state.depth[state.depth.length - 1] === "[";
      return "punctuation";
    }
    stream.eatWhile(/[\w+\-.:]/);
    if (!state.value) return "propertyName";
    return /^(true|false)$/.test(stream.current()) ? "bool" : "number";
  },
});

const style = HighlightStyle.define([
  { tag: tags.propertyName, class: "ck" },
  { tag: [tags.number, tags.bool], class: "cn" },
  { tag: tags.string, class: "cs" },
  { tag: tags.comment, class: "cc" },
  { tag: tags.heading, class: "ch" },
]);

export const tomlColours = syntaxHighlighting(style);
