// Changes of the form, written into the text: only what is meant, with undo.
import type { Document } from "../../store/document";
import { edited } from "../../store/session";
import { type Change, type Value, remove, set } from "../../toml/edit";
import type { Path } from "../../toml/parse";
import type { Editor } from "../../editor/editor";

/** The editor that shows the active text; it keeps the undo of all changes. */
export const holder: { editor: Editor | null } = { editor: null };

export function apply(doc: Document, changes: Change[]): void {
  if (holder.editor) {
    holder.editor.apply(changes);
    return;
  }
  let text = doc.text.value;
  for (const { from, to, insert } of [...changes].sort((a, b) => b.from - a.from)) text = text.slice(0, from) + insert + text.slice(to);
  edited(doc, text);
}

/** Gives a key its value; `raw` as it shall be written. */
export function change(doc: Document, path: Path, value: Value, raw?: string): void {
  const made = set(doc.text.value, path, value);
  if (!made) return;
  const known = doc.text.value.slice(made.from, made.to);
  const insert = raw !== undefined && made.to > made.from ? raw : made.insert;
  if (known !== insert) apply(doc, [{ ...made, insert }]);
}

export function drop(doc: Document, path: Path): void {
  const made = remove(doc.text.value, path);
  if (made) apply(doc, [made]);
}
