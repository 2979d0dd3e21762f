// Plural forms of the languages.

const rules = new Map<string, { select: (n: number) => string; order: string[] }>();

/** Plural forms of a language, in the order of its catalogue. */
export function plurals(tag: string): { select: (n: number) => string; order: string[] } {
  let known = rules.get(tag);
  if (!known) {
    const of = new Intl.PluralRules(tag);
    const used: string[] = of.resolvedOptions().pluralCategories;
    known = { select: (n) => of.select(n), order: ["zero", "one", "two", "few", "many", "other"].filter((form) => used.includes(form)) };
    rules.set(tag, known);
  }
  return known;
}
