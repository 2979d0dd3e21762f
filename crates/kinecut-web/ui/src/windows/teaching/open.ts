// The figures of the papers: pages of their own, loaded when they are opened.
import { effect, signal } from "@preact/signals";
import * as api from "../../base/api";
import { activeId } from "../../store/session";
import { t } from "../../words";

/** Whether the figures were opened, and whether they are what is shown. */
export const figuresOpen = signal(false);
export const figuresShown = signal(false);

export function showFigures(): void {
  figuresOpen.value = true;
  figuresShown.value = true;
}

export function closeFigures(): void {
  figuresOpen.value = false;
  figuresShown.value = false;
}

// A tab that is shown takes the place of the figures.
effect(() => {
  void activeId.value;
  figuresShown.value = false;
});

export function figuresTitle(): string | null {
  return figuresShown.value ? t("command.figures") : null;
}

interface Parts {
  script: string;
  style: string;
}

interface Pages {
  mount: (into: HTMLElement, language: string | null, parts: () => Promise<Parts>, ask: Ask) => () => void;
}

type Ask = (verb: string, flags: Record<string, unknown>, text: string, name: string) => Promise<unknown>;

let asked = 0;

/** A question of a figure; figures give up none themselves. */
const ask: Ask = (verb, flags, text, name) => api.verb(verb, { ...flags, generation: ++asked, new: name, text }, new AbortController().signal);

const asset = (name: string) => new URL(`assets/${name}`, document.baseURI).href;

async function text(name: string): Promise<string> {
  const answer = await fetch(asset(name));
  if (!answer.ok) throw new Error(t("figures.notLoaded"));
  return answer.text();
}

let styled: Promise<void> | null = null;

function style(): Promise<void> {
  styled ??= new Promise((done) => {
    const link = document.createElement("link");
    link.rel = "stylesheet";
    link.href = asset("teaching.css");
    link.onload = link.onerror = () => done();
    document.head.append(link);
  });
  return styled;
}

/** Puts the pages into an element; gives back what takes them away. */
export async function mountFigures(into: HTMLElement, language: string | null): Promise<() => void> {
  const [pages] = await Promise.all([import(asset("teaching.js")) as Promise<Pages>, style()]);
  return pages.mount(into, language, async () => {
    const [script, sheet] = await Promise.all([text("teaching.js"), text("teaching-alone.css")]);
    return { script, style: sheet };
  }, ask);
}
