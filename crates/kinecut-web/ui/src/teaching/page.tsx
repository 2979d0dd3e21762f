// The page of a paper: its figures one under another, the language, and the ways out of it.
import { type Signal, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { FigureView, headingOf } from "./figure";
import { LANGUAGES, type Tag, isTag, language, word } from "./language";
import { Definitions } from "./marks";
import { PAPERS } from "./papers";
import { type Parts, alone, download, numbers } from "./save";

/** Languages by their own names. */
const OWN: Record<(typeof LANGUAGES)[number], string> = { en: "English", uk: "Українська", ru: "Русский", de: "Deutsch" };

interface Props {
  paper: Signal<number>;
  /** The files to save a page of; a page that is saved already has none. */
  parts?: () => Promise<Parts>;
}

export function FiguresPage({ paper, parts }: Props) {
  const open = PAPERS.find((p) => p.no === paper.value) ?? PAPERS[0];
  const failed = useSignal("");
  const saving = useSignal("");
  const tag: Tag = language.value;
  useEffect(() => {
    if (!parts) document.title = word(open.title);
  }, [tag, open.no]);
  const save = async (of: () => Promise<Parts>) => {
    try {
      download(`kinecut-figures-${open.no}-${tag}.html`, "text/html", await alone(open, word(open.title), await of(), (n, all) => (saving.value = word("page.saving", { n: String(n), of: String(all) }))));
      failed.value = "";
    } catch (error) {
      failed.value = error instanceof Error ? error.message : String(error);
    }
    saving.value = "";
  };
  return (
    <main class="tg" lang={tag === "pseudo" ? "en-x-pseudo" : tag} data-paper={open.no}>
      <Definitions />
      <header class="head">
        <div>
          <h1>{word(open.title)}</h1>
          <p class="q">{word(open.source)}</p>
        </div>
        <div class="tools">
          {parts && PAPERS.length > 1 && (
            <label>
              <span>{word("page.paper")}</span>
              <select data-choose="paper" value={open.no} onChange={(e) => (paper.value = Number(e.currentTarget.value))}>
                {PAPERS.map((p) => (
                  <option key={p.no} value={p.no} selected={p.no === open.no}>
                    {word(p.title)}
                  </option>
                ))}
              </select>
            </label>
          )}
          <label>
            <span>{word("page.language")}</span>
            <select data-choose="language" value={tag} onChange={(e) => isTag(e.currentTarget.value) && (language.value = e.currentTarget.value)}>
              {LANGUAGES.map((l) => (
                <option key={l} value={l} selected={l === tag} lang={l} translate={false}>
                  {OWN[l]}
                </option>
              ))}
            </select>
          </label>
          {!parts && (
            <button data-theme-button onClick={turnTheme}>
              {word("page.theme")}
            </button>
          )}
          <button data-save="numbers" onClick={() => download(`figures-${open.no}.json`, "application/json", numbers(open))}>
            {word("page.numbers")}
          </button>
          <button data-print onClick={() => print()}>
            {word("page.print")}
          </button>
          {parts && (
            <button class="primary" data-save="alone" onClick={() => void save(parts)}>
              {word("page.save")}
            </button>
          )}
        </div>
      </header>
      {saving.value && (
        <p class="sentence" role="status">
          {saving.value}
        </p>
      )}
      {failed.value && (
        <p class="sentence" role="alert">
          <span lang="en">{failed.value}</span>
        </p>
      )}
      <nav class="contents" aria-label={word("page.contents")}>
        {open.figures.map((f) => (
          <button key={f.id} onClick={() => document.getElementById(`figure-${f.id}`)?.scrollIntoView()}>
            {headingOf(f)}
          </button>
        ))}
      </nav>
      <p class="how q">{word("page.how")}</p>
      {open.figures.map((f) => (
        <FigureView key={f.id} figure={f} />
      ))}
    </main>
  );
}

function turnTheme(): void {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
}
