// Ways into the window: a question of the folder, a drawing of it, a drawing that is dropped; and saving.
import { batch, effect, signal } from "@preact/signals";
import * as api from "../../base/api";
import { activeId, changedFile, documents, open as openFile, openedElsewhere, project, serverGone, show, tell } from "../../store/session";
import { placed } from "../../store/placed";
import { t } from "../../words";
import { figuresShown } from "../teaching/open";
import { asksFace, fresh, given, used, without } from "./question";
import { middle } from "./shape";
import { Face } from "./state";

/** The face that is open. */
export const face = signal<Face | null>(null);
/** Whether the window is the one that is shown. */
export const facing = signal(false);
/** Files of the folder that ask about a face; null while they are read. */
export const questions = signal<api.FileName[] | null>(null);

function told(error: unknown): void {
  if (error instanceof api.Gone) serverGone.value = true;
  else tell(error instanceof Error ? error.message : String(error));
}

/** Most questions of a folder that are read for the list. */
const MOST = 40;

/** Shows the window. */
export function showFacing(): void {
  figuresShown.value = false;
  facing.value = true;
}

async function listed(known: api.Project): Promise<void> {
  const files = known.files.filter((f) => f.kind === "question" && f.name.endsWith(".toml")).slice(0, MOST);
  const texts = await Promise.all(files.map((f) => api.file(f.id)));
  if (project.peek() === known) questions.value = files.filter((_, i) => asksFace(texts[i].text ?? ""));
}

// The window can be shown before the folder is known.
effect(() => {
  if (facing.value && project.value) listed(project.value).catch(told);
});

function taken(next: Face, text: string, sha256: string | null, saved: string): void {
  face.value?.close();
  batch(() => {
    next.saved.value = { text: saved, sha256 };
    face.value = next;
    facing.value = true;
    figuresShown.value = false;
  });
  next.edited(text);
}

/** Opens a question about a face. */
export async function openQuestion(id: string): Promise<void> {
  try {
    const read = await api.file(id);
    taken(new Face(read.id, read.name, read.id), read.text ?? "", read.sha256, read.text ?? "");
  } catch (error) {
    told(error);
  }
}

/** Asks about a drawing of the folder, with a cutter to begin with; it is not on disk before it is saved. */
export function openDrawing(id: string): void {
  const file = project.value?.files.find((f) => f.id === id);
  if (!file) return;
  const own = file.name.split("/").at(-1) ?? file.name;
  const stem = own.replace(/\.\w+$/, "");
  const folder = file.name.slice(0, file.name.length - own.length);
  taken(new Face(null, `${folder}${stem}-face.toml`, file.id), fresh(own, stem), null, "");
}

/** Puts a drawing from elsewhere into the folder and asks about it. */
export async function takeDrawing(file: File): Promise<void> {
  try {
    openDrawing(await placed(file.name, new Uint8Array(await file.arrayBuffer()), null));
  } catch (error) {
    told(error);
  }
}

// A drawing that is another one now has other exits; a question that another program changed is not overwritten, and that is said.
effect(() => {
  const changed = changedFile.value;
  const open = face.peek();
  if (!changed || !open) return;
  if (changed.id !== open.id) open.again();
  else if (changed.sha256 !== open.saved.peek().sha256) tell(t("conflict.sentence", { name: open.name }));
});

// A tab that is shown takes the place of the window.
effect(() => {
  void activeId.value;
  facing.value = false;
});

openedElsewhere((id, text) => {
  const asks = asksFace(text);
  if (asks) void openQuestion(id);
  return asks;
});

/** The title of the window; null while another one is shown. */
export function faceTitle(): string | null {
  return facing.value ? `${t("face.tab")} ${face.value?.name ?? ""}`.trim() : null;
}

/** Closes the face; the window offers others. */
export function closeFace(): void {
  face.value?.close();
  face.value = null;
}

/** Changes a value of the text; null takes it away. */
export function change(of: Face, path: (string | number)[], value: Parameters<typeof given>[2] | null): void {
  of.edited(value === null ? without(of.text.value, path) : given(of.text.value, path, value));
}

/** Writes the placement under the hand into the text. */
export function use(of: Face): void {
  const { hand, outline } = of;
  of.history.rest();
  if (hand.value && outline.value) of.edited(used(of.text.value, hand.value, middle(outline.value, hand.value.turn)));
}

export async function saveFace(of: Face): Promise<void> {
  const text = of.text.value;
  try {
    if (of.id === null) {
      const own = of.name.split("/").at(-1) ?? of.name;
      const { id, sha256 } = await api.create(own, text, of.beside);
      batch(() => {
        of.id = id;
        of.saved.value = { text, sha256 };
      });
      project.value = await api.project();
      return;
    }
    const { sha256 } = await api.save(of.id, text, of.saved.value.sha256);
    of.saved.value = { text, sha256 };
  } catch (error) {
    told(error);
  }
}

/** Leaves the window for a file. */
export async function leave(id?: string): Promise<void> {
  figuresShown.value = false;
  facing.value = false;
  if (id && documents.value.some((d) => d.id === id)) show(id);
  else if (id) await openFile(id);
}
