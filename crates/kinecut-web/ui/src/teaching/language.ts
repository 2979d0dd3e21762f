// Texts of the teaching pages. A page that is saved works alone: all languages are in it.
import { signal } from "@preact/signals";
import { asked as deAsked } from "../words/de/asked";
import { teaching as deOwn } from "../words/de/teaching";
import { asked as enAsked } from "../words/en/asked";
import { teaching as enOwn } from "../words/en/teaching";
import { marked } from "../words/pseudo";
import { plurals } from "../words/plurals";
import { asked as ruAsked } from "../words/ru/asked";
import { teaching as ruOwn } from "../words/ru/teaching";
import { asked as ukAsked } from "../words/uk/asked";
import { teaching as ukOwn } from "../words/uk/teaching";

const en = { ...enOwn, ...enAsked } as const;
const [uk, ru, de] = [
  { ...ukOwn, ...ukAsked },
  { ...ruOwn, ...ruAsked },
  { ...deOwn, ...deAsked },
];

export type Key = keyof typeof en;

export const LANGUAGES = ["en", "uk", "ru", "de"] as const;
export type Tag = (typeof LANGUAGES)[number] | "pseudo";

const WORDS: Record<Tag, Partial<Record<Key, string>>> = { en, uk, ru, de, pseudo: en };

export const language = signal<Tag>("en");

export function isTag(text: string | null | undefined): text is Tag {
  return text !== null && text !== undefined && text in WORDS;
}

/** Whether a text of this key is in the catalogue. */
export function has(key: string): key is Key {
  return key in en;
}

/**
 * The text of a key in the page's language. `{name}` is replaced by an argument, `{name#one|other}` by the form for a number of it, in the
 * order of the forms of the language.
 */
export function word(key: Key, values: Record<string, string> = {}): string {
  const own = language.value === "pseudo" ? undefined : WORDS[language.value][key];
  const { select, order } = plurals(own === undefined ? "en" : language.value);
  const pattern = own ?? en[key];
  return (language.value === "pseudo" ? marked(pattern) : pattern).replace(/\{(\w+)(?:#([^}]*))?\}/g, (_, name: string, forms: string | undefined) => {
    const value = values[name] ?? "";
    if (forms === undefined) return value;
    const all = forms.split("|");
    const form = all[order.indexOf(select(Number(value.replace(",", "."))))] ?? all[all.length - 1];
    return language.value === "pseudo" ? marked(form) : form;
  });
}

/** A number with so many decimals, a real minus, and the decimal sign of the language. */
export function num(n: number, decimals: number, trim = false): string {
  if (!Number.isFinite(n)) return "\u2013";
  let text = n.toFixed(decimals);
  if (trim && text.includes(".")) text = text.replace(/\.?0+$/, "");
  if (/^-0(\.0*)?$/.test(text)) text = text.slice(1);
  const sign = language.value === "en" || language.value === "pseudo" ? "." : ",";
  return text.replace("-", "\u2212").replace(".", sign);
}

/** A number written as a mantissa and a power of ten. */
export function scientific(n: number, digits: number): string {
  if (n === 0 || !Number.isFinite(n)) return num(n, 0);
  const power = Math.floor(Math.log10(Math.abs(n)));
  const raised = String(power).replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(d)]);
  return `${num(n / 10 ** power, digits - 1)}·10${raised}`;
}
