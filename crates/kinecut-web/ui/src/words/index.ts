// All texts of the workbench: one catalogue a language, by keys; what a language lacks is English.
import { effect, signal } from "@preact/signals";
import { type Catalogue, type Key, en } from "./en";
import { plurals } from "./plurals";
import { marked } from "./pseudo";
import type { Unit } from "./units";

/** What a language brings along; its file is loaded when it is chosen. */
export interface Words {
  words: Partial<Catalogue>;
  /** Names of the keys of jobs and questions. */
  keys: Record<string, string>;
  units: Record<Unit, string>;
  /** Symbols of quantities by their names in JSON; what is behind `_` is written below. */
  symbols: Record<string, string>;
}

interface Language extends Partial<Words> {
  /** For the page and for plural forms. */
  tag: string;
  pseudo?: boolean;
}

/** The languages by the word that chooses them: their names, in full and short. */
export const NAMES = { en: ["English", "EN"], uk: ["Українська", "УКР"], ru: ["Русский", "РУС"], de: ["Deutsch", "DE"] } as const;
export type Choice = keyof typeof NAMES;

const STORED = "kinecut-language";
const ENGLISH: Language = { tag: "en" };
const PSEUDO: Language = { tag: "en-x-pseudo", pseudo: true };

export const language = signal<Language>(ENGLISH);
effect(() => {
  document.documentElement.lang = language.value.tag;
});

function isChoice(word: string | null): word is Choice {
  return word !== null && word in NAMES;
}

/** Brings a language onto the page; the one chosen last counts. */
let wanted = "";
async function bring(choice: string): Promise<void> {
  wanted = choice;
  if (choice === "pseudo") {
    language.value = PSEUDO;
    return;
  }
  const words = choice === "en" ? {} : ((await import(new URL(`words/${choice}.js`, import.meta.url).href)) as Words);
  if (wanted === choice) language.value = { tag: choice, ...words };
}

/** The language of the address, else the one chosen before, else that of the browser; English where its file cannot be had. */
export const ready: Promise<void> = (() => {
  const asked = [new URLSearchParams(location.search).get("lang"), localStorage.getItem(STORED), navigator.language.split("-")[0]];
  return bring(asked.find((word) => word === "pseudo" || isChoice(word)) ?? "en").catch(() => undefined);
})();

/** Chooses a language, for this browser; one in the address would come before it, so it goes. */
export async function choose(choice: Choice): Promise<void> {
  await bring(choice);
  localStorage.setItem(STORED, choice);
  const address = new URL(location.href);
  if (!address.searchParams.has("lang")) return;
  address.searchParams.delete("lang");
  history.replaceState(history.state, "", address);
}

export type Arguments = Record<string, string | number>;

/** The blank between a number and its unit: no line ends there. */
const UNIT = /\} (?=(?:%|мм|мс|с|mm|ms|s|об|м\/|m\/|1\/)(?!\p{L}))/gu;

/** Isolates: what stands between them is no text of the catalogue. */
const [OPEN, CLOSE] = ["\u2068", "\u2069"];

/**
 * The text of a key. `{name}` is replaced by an argument, `{name#one|other}` by the form for a number of it, in the order of the forms of
 * the language.
 */
export function t(key: Key, values: Arguments = {}): string {
  const { tag, words, pseudo } = language.value;
  const own = words?.[key];
  const { select, order } = plurals(own === undefined ? "en" : tag);
  const filled = (text: string): string =>
    text.replace(/\{(\w+)(?:#([^}]*))?\}/g, (_, name: string, forms: string | undefined) => {
      const value = values[name] ?? "";
      if (forms !== undefined) {
        const all = forms.split("|");
        const form = all[order.indexOf(select(Number(value)))] ?? all[all.length - 1];
        return pseudo ? marked(form) : form;
      }
      const shown = typeof value === "number" ? numeral(String(value)) : value;
      return pseudo ? OPEN + shown + CLOSE : shown;
    });
  const pattern = own?.replace(UNIT, "}\u00a0") ?? en[key];
  return pseudo ? filled(marked(pattern)) : filled(pattern);
}

/** The language of a window whose texts begin with a key; nothing where it is that of the page. */
export function foreign(key: Key): "en" | undefined {
  const { tag, words } = language.value;
  return tag === "en" || language.value.pseudo || words?.[key] !== undefined ? undefined : "en";
}

/** Words made of a key of a job or question: `plunge_feed` is "Plunge feed". */
export function named(key: string): string {
  const own = language.value.keys?.[key];
  if (own !== undefined) return own;
  const known = `key.${key}` as Key;
  if (known in en) return t(known);
  const spaced = key.replaceAll("_", " ");
  const text = spaced.charAt(0).toUpperCase() + spaced.slice(1);
  return language.value.pseudo ? marked(text) : text;
}

/** A unit in the form of the language. */
export function unit(symbol: string): string {
  return language.value.units?.[symbol as Unit] ?? symbol;
}

/** The symbol of a quantity: letters, and those written below; that of JSON where the language has none of its own. */
export function symbol(name: string): [string, string] {
  const [letters, below = ""] = (language.value.symbols?.[name] ?? name).split("_");
  return [letters, below];
}

/** Whether the language writes a comma in numbers. */
function comma(): boolean {
  return language.value.units !== undefined;
}

/** A number that is shown, from its English digits: decimal comma, and narrow spaces from five digits on. */
export function numeral(text: string): string {
  if (!comma()) return text;
  const [, sign, whole, rest] = /^([-\u2212]?)(\d+)(.*)$/.exec(text) ?? ["", "", "", text];
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, "\u202f") : whole;
  return sign + grouped + rest.replace(".", ",");
}

/** A number in a field, where digits are typed: the decimal sign alone. */
export function typed(text: string): string {
  return comma() ? text.replace(".", ",") : text;
}
