// What is said beside a program of others: its control, stock, tools; what nobody gives is guessed.
import type { Document, Given } from "../../store/document";
import type { Guess } from "../../store/guess";
import { open, project, tell, worker } from "../../store/session";
import { named, t } from "../../words";
import { placed } from "../../store/placed";
import { Name, Said } from "../../app/verbatim";
import { NumberInput } from "./field";

/** The guessed tools, and a job of the guess in which all of it can be corrected. */
function Guessed({ doc, guess }: { doc: Document; guess: Guess }) {
  const job = async () => {
    const name = `${(doc.name.split("/").at(-1) ?? doc.name).replace(/\.[^.]*$/, "")}.toml`;
    try {
      await open(await placed(name, new TextEncoder().encode(guess.job), doc.id));
    } catch (error) {
      tell(error instanceof Error && error.message ? error.message : String(error));
    }
  };
  return (
    <section class="part" data-guess="tools">
      <h3>{t("form.guessedTools")}</h3>
      {guess.tools.length === 0 && <p class="q">{t("form.noGuessedTools")}</p>}
      {guess.tools.length > 0 && (
        <ul class="guessed">
          {guess.tools.map((tool) => (
            <li key={tool.number}>
              <Name>{`T${tool.number}`}</Name> {named(tool.type)} <Name>{`⌀${tool.diameter} mm`}</Name>
            </li>
          ))}
        </ul>
      )}
      <button onClick={() => void job()}>{t("form.guessedJob")}</button>
    </section>
  );
}

const CONTROLS = ["fanuc", "sinumerik-840d", "heidenhain", "linuxcnc", "grbl"];

export function ProgramForm({ doc }: { doc: Document }) {
  const given = doc.given.value;
  const work = doc.work.value;
  const set = (part: Partial<Given>) => {
    const next = { ...given, ...part };
    for (const key of Object.keys(next) as (keyof Given)[]) if (next[key] === undefined) delete next[key];
    doc.given.value = next;
    worker(doc).changed();
  };
  const jobs = project.value?.files.filter((f) => f.kind === "job") ?? [];
  const guess = doc.guess.value;
  const guessed = guess?.stock ?? null;
  const corner = (label: string, from: number) => (
    <div class="row">
      <span class="label">{label}</span>
      <span class="numbers">
        {["X", "Y", "Z"].map((axis, i) => (
          <NumberInput
            key={axis}
            value={given.stock?.[from + i]}
            standard={guessed ? String(guessed[from + i]) : null}
            standardIs="form.guessedField"
            unit={axis}
            whole={false}
            id={`stock-${from + i}`}
            name={t("form.axis", { name: label, axis })}
            set={(n) => set({ stock: Array.from({ length: 6 }, (_, k) => (k === from + i ? n : (given.stock?.[k] ?? guessed?.[k] ?? 0))) })}
            clear={() => set({ stock: undefined })}
            invalid={() => undefined}
            told={false}
          />
        ))}
      </span>
    </div>
  );
  return (
    <section class="panel pform" aria-label={t("panel.form")} tabIndex={-1} data-panel="form">
      <header>
        <h2>{t("form.program")}</h2>
      </header>
      <div class="scrolls">
        <div class="form">
          <div class="row">
            <label for="g-control">{t("form.control")}</label>
            <span class={`f${given.control ? "" : " def"}`}>
              <select id="g-control" translate={false} value={given.control ?? ""} onChange={(e) => set({ control: e.currentTarget.value || undefined })}>
                <option value="">{work?.programs[0]?.control ?? "\u2013"}</option>
                {CONTROLS.map((c) => (
                  <option key={c}>{c}</option>
                ))}
              </select>
            </span>
          </div>
          <div class="row">
            <label for="g-job">{t("form.jobOf")}</label>
            <span class={`f${given.job ? "" : " def"}`}>
              <select id="g-job" translate={false} value={given.job ?? ""} onChange={(e) => set({ job: e.currentTarget.value || undefined })}>
                <option value="">–</option>
                {jobs.map((f) => (
                  <option key={f.id} value={f.id}>
                    {f.name}
                  </option>
                ))}
              </select>
            </span>
          </div>
          {corner(t("form.stockMin"), 0)}
          {corner(t("form.stockMax"), 3)}
          <div class="row">
            <label for="g-tool">{t("form.toolAtStart")}</label>
            <NumberInput value={given.tool} standard={null} unit="" whole id="g-tool" name={t("form.toolAtStart")} set={(n) => set({ tool: n })} clear={() => set({ tool: undefined })} invalid={() => undefined} told={false} />
          </div>
          <label class="check">
            <input type="checkbox" checked={given.tolerant ?? false} onChange={(e) => set({ tolerant: e.currentTarget.checked || undefined })} />
            {t("form.tolerant")}
          </label>
          {guess && <Guessed doc={doc} guess={guess} />}
          {(work?.guessed?.length ?? 0) > 0 && (
            <section class="part">
              <h3>{t("form.guessed")}</h3>
              <ul class="guessed">
                {work?.guessed?.map((words) => (
                  <li key={words}>
                    <Said text={words} />
                  </li>
                ))}
              </ul>
            </section>
          )}
        </div>
      </div>
    </section>
  );
}
