// The form of a job: its parts as a list, the fields of the one that is chosen.
import { useSignal } from "@preact/signals";
import { Form } from "../../schema/schema";
import { kinds } from "../../editor/complete";
import { type Document, keyOf } from "../../store/document";
import { jobSchema, tell } from "../../store/session";
import type { Value } from "../../toml/edit";
import type { Path } from "../../toml/parse";
import { named, t } from "../../words";
import { Menu } from "../../app/menu";
import { Name } from "../../app/verbatim";
import { drop } from "./change";
import { Fields } from "./fields";
import { type Item, chosenPath, sectionOf, sections } from "./items";
import { add as addTable, lastTool, rowsOf } from "./newoperation";
import { Picture } from "./picture";
import { ProgramForm } from "./programform";

export function FormPanel({ doc }: { doc: Document }) {
  if (doc.kind === "program") return <ProgramForm doc={doc} />;
  const all = sections(doc);
  const path = chosenPath(doc);
  const section = sectionOf(all, path);
  const schema = jobSchema.value;
  const choose = (next: Path) => (doc.chosen.value = next.length > 0 ? next : ["title"]);
  const root = schema && new Form(schema, schema);
  const form = root?.at(path, doc.values.value);
  const item = section.items.find((i) => keyOf(i.path) === keyOf(path));
  const whole = path[0] === "setup" && path.length === 2 ? section.label : (item?.label ?? "");
  return (
    <section class="panel pform" aria-label={t("panel.form")} tabIndex={-1} data-panel="form">
      <header>
        <h2 class="sr">{t("panel.form")}</h2>
        <select
          class="section"
          aria-label={t("form.section")}
          value={section.id}
          onChange={(e) => {
            const next = all.find((s) => s.id === e.currentTarget.value);
            if (next) choose(next.items[0]?.path ?? ["fixture", 0]);
          }}
        >
          {all.map((s) => (
            <option key={s.id} value={s.id}>
              {s.label}
            </option>
          ))}
        </select>
        {section.adds && <Adds doc={doc} section={section.id} adds={section.adds} />}
      </header>
      <div class="scrolls">
        <List items={section.items} path={path} choose={choose} />
        <div class="form">
          {item && path[0] === "setup" && path.length === 4 && <Picture doc={doc} path={path} />}
          {form && (doc.value(path) !== undefined || path.length === 1) && <Fields key={keyOf(path)} doc={doc} path={path} form={form} without={inner(path)} />}
          {section.items.length === 0 && <p class="q">{t("form.empty")}</p>}
          {item && path.length >= 2 && typeof path.at(-1) === "number" && (
            <button
              class="remove"
              onClick={() => {
                drop(doc, path);
                tell(t("form.removed", { name: whole }), true);
              }}
            >
              {t("form.remove", { name: whole })}
            </button>
          )}
        </div>
      </div>
    </section>
  );
}

/** Keys that are items of their own. */
function inner(path: Path): string[] {
  if (path.length === 0) return ["setup", "tool", "holder", "fixture", "stock", "design", "machine", "post", "simulate", "drilled"];
  return path[0] === "setup" && path.length === 2 ? ["operation"] : [];
}

function List({ items, path, choose }: { items: Item[]; path: Path; choose: (path: Path) => void }) {
  const here = keyOf(path);
  const index = items.findIndex((i) => keyOf(i.path) === here);
  const move = (e: KeyboardEvent) => {
    const to = { ArrowDown: index + 1, ArrowUp: index - 1, Home: 0, End: items.length - 1 }[e.key];
    if (to === undefined) return;
    e.preventDefault();
    const next = items[Math.min(items.length - 1, Math.max(0, to))];
    if (next) choose(next.path);
  };
  if (items.length === 0) return null;
  return (
    <ol class="ops" role="listbox" aria-label={t("form.items")} tabIndex={0} aria-activedescendant={index >= 0 ? `item-${here}` : undefined} onKeyDown={move}>
      {items.map((item) => {
        const key = keyOf(item.path);
        return (
          <li key={key} id={`item-${key}`} role="option" aria-selected={key === here} onClick={() => choose(item.path)}>
            <span class="n" translate={false}>
              {item.number}
            </span>
            <span class="name" translate={!item.verbatim}>
              {item.label}
            </span>
            {item.findings ? (
              <span class={`tag ${item.findings.severity === "error" ? "bad" : "np"}`}>{t("form.findings", { n: item.findings.count })}</span>
            ) : (
              <Name class="q">{item.side}</Name>
            )}
          </li>
        );
      })}
    </ol>
  );
}

interface AddsProps {
  doc: Document;
  section: string;
  adds: "operation" | "tools" | "fixtures";
}

function Adds({ doc, section, adds }: AddsProps) {
  const open = useSignal(false);
  const schema = jobSchema.value;
  const add = (path: Path, rows: [string, Value][]) => {
    if (addTable(doc, path, rows)) open.value = false;
  };
  if (adds === "operation") {
    const setup = Number(section.slice("setup".length));
    const path: Path = ["setup", setup, "operation"];
    return (
      <span class="holdsMenu">
        <button class="ghost" aria-haspopup="menu" aria-expanded={open.value} onClick={() => (open.value = !open.value)}>
          {t("form.addOperation")}
        </button>
        <Menu open={open} label={t("form.kind")} right>
          {schema &&
            kinds(schema).map(({ word, about, form }) => (
              <button key={word} role="menuitem" title={about} onClick={() => add(path, rowsOf(form, word, lastTool(doc, path)))}>
                {named(word)}
              </button>
            ))}
        </Menu>
      </span>
    );
  }
  const one = (key: "tool" | "holder" | "fixture") => {
    const form = schema && new Form(schema, schema).key(key)?.item;
    return () => form && add([key], rowsOf(form.of(form.example), null, undefined));
  };
  if (adds === "fixtures") return <button class="ghost" onClick={one("fixture")}>{t("form.addFixture")}</button>;
  return (
    <>
      <button class="ghost" onClick={one("tool")}>
        {t("form.addTool")}
      </button>
      <button class="ghost" onClick={one("holder")}>
        {t("form.addHolder")}
      </button>
    </>
  );
}
