// The text of the job, or of a program of others.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { offer } from "../../app/commands";
import { places } from "../../app/go";
import { Name } from "../../app/verbatim";
import { Editor } from "../../editor/editor";
import type { Mistake } from "../../editor/mistakes";
import { type Document, rangeOf } from "../../store/document";
import { active, edited, jobSchema } from "../../store/session";
import { at, pathAt } from "../../toml/parse";
import { t } from "../../words";
import { holder } from "./change";
import { chosenPath, itemPath } from "./items";
import { keyOf } from "../../store/document";

const knownTools = () => active.value?.tools.value ?? [];

function mistakesOf(doc: Document): Mistake[] {
  const text = doc.text.value;
  return doc.findings.value.flatMap((finding) => {
    const range = rangeOf(finding, doc.name, text, doc.tree.value);
    if (!range) return [];
    return [{ ...range, severity: finding.severity, text: (finding.message + (finding.help ? `; ${finding.help}` : "")).replaceAll("`", "") }];
  });
}

export function TextPanel({ doc }: { doc: Document }) {
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const editor = new Editor(place.current as HTMLElement, () => jobSchema.value, knownTools);
    holder.editor = editor;
    places.showText = (from, to) => editor.select(from, to);
    offer(
      { id: "command.undo", keys: ["Ctrl+Z"], run: () => editor.undo() },
      { id: "command.redo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"], run: () => editor.redo() },
      { id: "command.text", keys: ["Escape"], run: () => editor.view.focus() },
    );
    return () => {
      editor.view.destroy();
      holder.editor = null;
    };
  }, []);
  useEffect(() => {
    const editor = holder.editor;
    if (!editor) return;
    /** The item was chosen by the caret: the text stays where it is. */
    let byCaret = false;
    editor.show(doc.id, doc.name, doc.text.peek(), doc.kind !== "program", {
      changed: (text) => edited(doc, text),
      moved: (caret) => {
        if (doc.kind === "program") return;
        const path = itemPath(pathAt(doc.tree.peek(), caret));
        if (path.length === 0 || keyOf(path) === keyOf(chosenPath(doc))) return;
        byCaret = true;
        doc.chosen.value = path;
        byCaret = false;
      },
    });
    editor.replace(doc.text.peek());
    let before = "";
    const ends = [
      effect(() => editor.setMistakes(mistakesOf(doc))),
      effect(() => {
        if (doc.kind === "program") return;
        const path = chosenPath(doc);
        const node = path.length > 0 ? at(doc.tree.value, path) : undefined;
        const key = keyOf(path);
        editor.setSection(node ? { from: node.from, to: node.kind === "table" && node.form === "header" ? node.end : node.to } : null, key !== before && !byCaret);
        before = key;
      }),
    ];
    return () => ends.forEach((end) => end());
  }, [doc]);
  return (
    <section class="panel ptext" aria-label={t("panel.text")} tabIndex={-1} data-panel="text">
      <header>
        <h2>
          <Name>{doc.name}</Name>
        </h2>
        {doc.dirty.value && <span class="q">{t("bar.unsaved")}</span>}
        <span class="sp" />
        <button class="ghost icon" aria-label={t("text.undo")} title={t("text.undo")} onClick={() => holder.editor?.undo()}>
          <span aria-hidden="true">↶</span>
        </button>
        <button class="ghost icon" aria-label={t("text.redo")} title={t("text.redo")} onClick={() => holder.editor?.redo()}>
          <span aria-hidden="true">↷</span>
        </button>
        {doc.planning.value && <span class="waits" />}
      </header>
      <div class="editor" ref={place} translate={false} />
    </section>
  );
}
