// Teaching pages: put into a window of the workbench, or alone in a file of their own.
import { effect, signal } from "@preact/signals";
import { render } from "preact";
import { type Tag, isTag, language } from "./language";
import { FiguresPage } from "./page";
import { PAPERS } from "./papers";
import type { Parts } from "./save";
import { type Ask, askedBy } from "./asked";
import { take, takeAnswers } from "./state";

const paper = signal(PAPERS[0].no);

/** Shows the pages in an element; gives back what takes them away. */
export function mount(into: HTMLElement, first: Tag | null, parts: () => Promise<Parts>, ask: Ask): () => void {
  askedBy(ask);
  if (first) language.value = first;
  render(<FiguresPage paper={paper} parts={parts} />, into);
  return () => render(null, into);
}

const own = document.getElementById("kinecut-figures");
if (own) {
  const root = document.documentElement;
  if (!root.dataset.theme) root.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  paper.value = Number(own.dataset.paper);
  if (isTag(own.dataset.language)) language.value = own.dataset.language;
  const open = PAPERS.find((p) => p.no === paper.value);
  if (open) {
    take(open.figures, own.dataset.own ?? "{}");
    takeAnswers(open.figures, document.getElementById("kinecut-answers")?.textContent ?? '{"inputs":{},"answers":{}}');
  }
  effect(() => {
    root.lang = language.value;
  });
  render(<FiguresPage paper={paper} />, own);
}
