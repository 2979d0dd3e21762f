// Parts that both windows have: undo, the head, mistakes, the form of the tool.
import { type Signal, effect, signal, useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect } from "preact/hooks";
import { offer } from "../../app/commands";
import { Name, Said } from "../../app/verbatim";
import * as api from "../../base/api";
import { timeOfDay } from "../../base/format";
import { Form, type Schema } from "../../schema/schema";
import { type Document, keyOf } from "../../store/document";
import { edited, project, tell } from "../../store/session";
import type { Value } from "../../toml/edit";
import { type Path, parse, plain } from "../../toml/parse";
import { t } from "../../words";
import { Undo } from "../drill/undo";
import { Fields } from "../job/fields";
import { type Verb, withTool } from "./question";
import type { Looked } from "./state";

const schemas: Record<Verb, Signal<Schema | null>> = { grazing: signal(null), envelope: signal(null) };
const TABLES: Record<Verb, string> = { grazing: "GrazingTable", envelope: "EnvelopeTable" };

/** An answer that takes longer makes what is shown old [ms]. */
const LATE = 100;

/** Undo of the text, its schema, and whether what is shown is late. */
export function useWindow(doc: Document, verb: Verb): { schema: Schema | null; late: boolean } {
  const late = useSignal(false);
  useEffect(() => {
    const known = schemas[verb];
    if (!known.value) {
      api.schema(verb).then((schema) => (known.value = schema as Schema)).catch((error: unknown) => tell(error instanceof Error ? error.message : String(error)));
    }
    const undo = Undo.of(doc);
    const back = (by: -1 | 1) => () => {
      const text = undo.go(by);
      if (text !== null) edited(doc, text);
    };
    offer({ id: "command.undo", keys: ["Ctrl+Z"], run: back(-1) }, { id: "command.redo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"], run: back(1) });
    let timer = 0;
    const ends = [
      effect(() => undo.note(doc.text.value)),
      effect(() => {
        clearTimeout(timer);
        if (!doc.planning.value) late.value = false;
        else timer = window.setTimeout(() => (late.value = true), LATE);
      }),
    ];
    return () => {
      clearTimeout(timer);
      for (const end of ends) end();
    };
  }, [doc]);
  return { schema: schemas[verb].value, late: late.value };
}

/** Whether what is shown is older than the text, and that is to be said. */
export function isOld(doc: Document, late: boolean): boolean {
  const known = doc.answered.value;
  return known !== null && known.text !== doc.text.value && (!doc.planning.value || late);
}

export function stateOf(doc: Document): string {
  if (doc.planning.value) return "planning";
  if (doc.wrong.value || doc.refused.value) return "wrong";
  return doc.answered.value?.text === doc.text.value ? "done" : "planning";
}

export function Head({ doc, looked, title, about, children }: { doc: Document; looked: Looked; title: string; about: string; children?: ComponentChildren }) {
  const items = looked.items.value;
  const named = (path: Path, i: number) => {
    const own = doc.value([...path, "title"]);
    return typeof own === "string" && own !== "" ? own : String(i + 1);
  };
  return (
    <div class="head">
      <h1>
        <Name>{title}</Name>
      </h1>
      {about && (
        <span class="q">
          <Said text={about} />
        </span>
      )}
      <div class="acts">
        {items.length > 1 && (
          <select aria-label={t("grazing.which")} value={looked.chosen.value} translate={false} onChange={(e) => (looked.chosen.value = Number(e.currentTarget.value))}>
            {items.map((path, i) => (
              <option key={i} value={i}>
                {named(path, i)}
              </option>
            ))}
          </select>
        )}
        {children}
      </div>
    </div>
  );
}

/** Mistakes in the text or the question, and that older results are shown. */
export function Mistakes({ doc, wrong, late }: { doc: Document; wrong: api.Finding | null; late: boolean }) {
  const known = doc.answered.value;
  const field = wrong?.key !== undefined ? document.getElementById(`f-${wrong.key}`) : null;
  return (
    <>
      {wrong && (
        <div class="across wrong" role="alert" data-at={wrong.key ?? ""}>
          <div>
            {t("grazing.noAnswer")} <Said text={wrong.message} />
            {wrong.help && (
              <p class="q">
                <Said text={wrong.help} />
              </p>
            )}
          </div>
          {field && <button onClick={() => field.focus()}>{t("drill.toField")}</button>}
        </div>
      )}
      {doc.refused.value && (
        <p class="across" role="alert">
          {doc.refused.value}
        </p>
      )}
      {isOld(doc, late) && known && (
        <p class="oldness" role="status">
          {t("drill.old", { time: timeOfDay(known.at) })}
        </p>
      )}
    </>
  );
}

/** Puts the tool of a file into the text, where it can be changed. */
async function put(doc: Document, item: Path, id: string): Promise<void> {
  try {
    const { text } = await api.file(id);
    edited(doc, withTool(doc.text.peek(), item, plain(parse(text ?? "")) as Value));
  } catch (error) {
    tell(error instanceof Error ? error.message : String(error));
  }
}

/** The tool of the question as fields, and further keys. */
export function Settings({ doc, verb, schema, item, keys }: { doc: Document; verb: Verb; schema: Schema; item: Path; keys: string[] }) {
  const root = new Form(schema, { $ref: `#/$defs/${TABLES[verb]}` });
  const value = doc.value(item);
  const file = doc.value([...item, "tool_file"]);
  const folder = doc.name.slice(0, doc.name.lastIndexOf("/") + 1);
  const tool = typeof file === "string" && file.endsWith(".toml") ? project.value?.files.find((f) => f.name === folder + file)?.id : undefined;
  return (
    <section class="panel asked" aria-label={t("grazing.settings")} tabIndex={-1} data-panel="settings">
      <header>
        <h2>{t("grazing.settings")}</h2>
      </header>
      <div class="form">
        {keys.map((key) => {
          const path = [...item, key];
          const form = root.at([key], value);
          if (!form || doc.value(path) === undefined) return null;
          return (
            <section key={key} class="part" role="group" aria-label={t(`grazing.group.${key as "tool"}`)}>
              <h3>{t(`grazing.group.${key as "tool"}`)}</h3>
              <Fields key={keyOf(path)} doc={doc} path={path} form={form} />
            </section>
          );
        })}
        {typeof file === "string" && (
          <p class="file">
            <span class="q">{t("grazing.toolFile", { name: file })}</span>
            {tool !== undefined && (
              <button data-put={file} onClick={() => void put(doc, item, tool)}>
                {t("grazing.putTool")}
              </button>
            )}
          </p>
        )}
        <Fields key={`more ${keyOf(item)}`} doc={doc} path={item} form={root.of(value)} without={["tool", "twist", "moment", "pose", "rate", "move", "joints", "screw", "of", "points"]} />
      </div>
    </section>
  );
}

export function Notes({ notes, findings }: { notes: string[]; findings: api.Finding[] }) {
  if (notes.length + findings.length === 0) return null;
  return (
    <section class="panel" aria-label={t("grazing.notes")}>
      <header>
        <h2>{t("grazing.notes")}</h2>
      </header>
      <ul class="pad">
        {notes.map((note) => (
          <li key={note}>
            <Said text={note} />
          </li>
        ))}
        {findings.map((f, i) => (
          <li key={i}>
            <b>{t(`findings.severity.${f.severity}`)}</b> <Said text={f.message} /> {f.help && <Said text={f.help} />}
          </li>
        ))}
      </ul>
    </section>
  );
}
