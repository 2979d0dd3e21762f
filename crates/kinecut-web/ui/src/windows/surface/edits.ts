// Texts of files that are being edited: they lie over what is on disk.
import { documents } from "../../store/session";

export function edits(): { file: string; text: string }[] {
  return documents.peek().filter((d) => d.dirty.peek() && !d.isNew).map((d) => ({ file: d.id, text: d.text.peek() }));
}
