// A page that works alone: words, script and style in one file, which asks for nothing.
import { language, word } from "./language";
import { shown } from "./model";
import type { Paper } from "./papers";
import { answersFor, kept, stateOf, viewOf } from "./state";

/** Files of the built page that the single file is made of. */
export interface Parts {
  script: string;
  style: string;
}

async function hash(text: string): Promise<string> {
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text)));
  return btoa(String.fromCharCode(...digest));
}

function attribute(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");
}

/** The page of a paper as one file. Its policy lets this script and this style in by their sums, and no other; nothing is fetched. Answers of
 * kinecut that its figures need are in it. */
export async function alone(paper: Paper, title: string, { script, style }: Parts, told: (done: number, of: number) => void): Promise<string> {
  const answers = (await answersFor(paper.figures, told)).replaceAll("<", "\\u003c");
  const code = script.replaceAll("</script", "<\\/script");
  const policy = `default-src 'none'; script-src 'sha256-${await hash(code)}'; style-src 'sha256-${await hash(style)}'; img-src data:; base-uri 'none'; form-action 'none'`;
  const theme = document.documentElement.dataset.theme;
  return `<!doctype html>
<html lang="${language.value}"${theme ? ` data-theme="${theme}"` : ""}>
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>${attribute(title)}</title>
<style>${style}</style>
</head>
<body>
<div id="kinecut-figures" data-paper="${paper.no}" data-language="${language.value}" data-own="${attribute(kept(paper.figures))}"></div>
<script type="application/json" id="kinecut-answers">${answers}</script>
<script type="module">${code}</script>
</body>
</html>
`;
}

/** Every number of the page, as it is shown now. */
export function numbers(paper: Paper): string {
  const figures = paper.figures.map((figure) => {
    const state = stateOf(figure);
    const { v, data, is } = viewOf(figure, state);
    const rows = (is !== "there" && is !== "older") || figure.wrong?.(v, data) ? [] : figure.rows(v, data);
    return {
      figure: figure.id,
      ...(figure.asks && { answered: is === "there", verb: figure.asks(v)[0].verb }),
      case: state.mode.value,
      inputs: Object.fromEntries(figure.fields.map((f) => [f.key, { value: v[f.key], unit: f.unit ? word(f.unit) : "" }])),
      numbers: Object.fromEntries(rows.map((r) => [r.key, { value: r.value, unit: r.unit ? word(r.unit) : "", shown: shown(r), ...(r.printed === undefined ? {} : { printed: r.printed }) }])),
    };
  });
  return `${JSON.stringify({ paper: paper.no, figures }, null, 1)}\n`;
}

export function download(name: string, type: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
