// All texts of the workbench: one catalogue a language, by keys; what a language lacks is English.
import { signal } from "@preact/signals";
import { type Catalogue, type Key, en } from "./en";
import { marked } from "./pseudo";

interface Language {
  /** For the page and for the forms of numbers. */
  tag: string;
  words: Partial<Catalogue>;
  pseudo?: boolean;
}

/** The languages by the word that chooses them; others come as catalogues beside `en`. */
const LANGUAGES: Record<string, Language> = {
  en: { tag: "en", words: en },
  pseudo: { tag: "en-x-pseudo", words: en, pseudo: true },
};

const asked = new URLSearchParams(location.search).get("lang") ?? navigator.language.split("-")[0];
export const language = signal<Language>(LANGUAGES[asked] ?? LANGUAGES.en);
document.documentElement.lang = language.value.tag;

export type Arguments = Record<string, string | number>;

/** Isolates: what stands between them is no text of the catalogue. */
const [OPEN, CLOSE] = ["\u2068", "\u2069"];

/**
 * The text of a key. `{name}` is replaced by an argument, `{name#one|other}` by the form for a number of it, in the order of the forms of
 * the language.
 */
export function t(key: Key, values: Arguments = {}): string {
  const { tag, words, pseudo } = language.value;
  const pattern = words[key] ?? en[key];
  const rules = new Intl.PluralRules(tag.split("-")[0]);
  const order = ["zero", "one", "two", "few", "many", "other"].filter((form) => rules.resolvedOptions().pluralCategories.includes(form as Intl.LDMLPluralRule));
  const filled = (text: string): string =>
    text.replace(/\{(\w+)(?:#([^}]*))?\}/g, (_, name: string, forms: string | undefined) => {
      const value = values[name] ?? "";
      if (forms !== undefined) {
        const all = forms.split("|");
        const form = all[order.indexOf(rules.select(Number(value)))] ?? all[all.length - 1];
        return pseudo ? marked(form) : form;
      }
      return pseudo ? OPEN + value + CLOSE : String(value);
    });
  return pseudo ? filled(marked(pattern)) : filled(pattern);
}

/** Words made of a key of a job or question: `plunge_feed` is "Plunge feed". */
export function named(key: string): string {
  const known = `key.${key}` as Key;
  if (known in en) return t(known);
  const spaced = key.replaceAll("_", " ");
  const text = spaced.charAt(0).toUpperCase() + spaced.slice(1);
  return language.value.pseudo ? marked(text) : text;
}
