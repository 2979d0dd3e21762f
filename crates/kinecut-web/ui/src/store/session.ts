// What is open: the folder, the texts as tabs, the one cursor.
import { batch, computed, effect, signal } from "@preact/signals";
import { Cursor, type Place } from "viewer/track";
import * as api from "../base/api";
import type { Schema } from "../schema/schema";
import { Asker } from "./asking";
import { Document, type Given } from "./document";
import type { Begin } from "./questions";
import { Worker } from "./work";
import { t } from "../words";

export const project = signal<api.Project | null>(null);
export const documents = signal<Document[]>([]);
export const activeId = signal<string | null>(null);
export const active = computed(() => documents.value.find((d) => d.id === activeId.value) ?? null);
export const serverGone = signal(false);
/** A sentence about something that just went wrong or well. */
export const notice = signal<{ text: string; undo: boolean } | null>(null);

export function tell(text: string, undo = false): void {
  notice.value = { text, undo };
}
export const jobSchema = signal<Schema | null>(null);

/** The one cursor through program, part, time and findings. */
export const cursor = new Cursor();
export const place = signal<Place>(cursor.place);
cursor.listen((now) => (place.value = now));

const workers = new Map<string, Worker | Asker>();

export function worker(doc: Document): Worker | Asker {
  let known = workers.get(doc.id);
  if (!known) workers.set(doc.id, (known = doc.question ? new Asker(doc) : new Worker(doc)));
  return known;
}

/** Windows that are no tabs: each says whether it has opened a question. */
const others: ((id: string, text: string) => boolean)[] = [];

export function openedElsewhere(opens: (id: string, text: string) => boolean): void {
  others.push(opens);
}

/** Opens a file as a tab, or shows its tab. */
export async function open(id: string): Promise<void> {
  if (!documents.value.some((d) => d.id === id)) {
    const read = await api.file(id);
    const doc = new Document(read.id, read.name, read.kind);
    doc.text.value = read.text ?? "";
    if ((doc.kind === "question" && !doc.question) || doc.kind === "surface") {
      if (!others.some((opens) => opens(id, doc.text.value))) tell(t("file.noWindow", { name: doc.name }));
      return;
    }
    batch(() => {
      doc.saved.value = { text: read.text ?? "", sha256: read.sha256 };
      documents.value = [...documents.value, doc];
    });
    if (doc.kind === "program") doc.given.value = besides(doc.name);
    worker(doc).changed();
  }
  show(id);
}

/** Tools and stock of a program are those of the one job that lies beside it. */
function besides(name: string): Given {
  const folder = name.slice(0, name.lastIndexOf("/") + 1);
  const jobs = project.value?.files.filter((f) => f.kind === "job" && f.name.slice(0, f.name.lastIndexOf("/") + 1) === folder) ?? [];
  return jobs.length === 1 ? { job: jobs[0].id } : {};
}

/** Opens a text that is no file yet, under a name that is free. */
export function openNew(stem: string, kind: api.FileKind, text: string): void {
  const taken = new Set([...(project.value?.files ?? []), ...documents.value].map((f) => f.name));
  let name = `${stem}.toml`;
  for (let n = 2; taken.has(name); n++) name = `${stem}-${n}.toml`;
  const doc = new Document(`new ${name}`, name, kind, true);
  doc.text.value = text;
  documents.value = [...documents.value, doc];
  worker(doc).changed();
  show(doc.id);
}

/** Opens a new question. */
export function begin({ stem, text }: Begin): void {
  openNew(stem, "question", text);
}

/** Makes a file of the folder; null, with a notice, when it cannot be made. */
export async function make(name: string, text: string): Promise<string | null> {
  try {
    const { id } = await api.create(name, text);
    project.value = await api.project();
    return id;
  } catch (error) {
    if (error instanceof api.Gone) serverGone.value = true;
    else tell(error instanceof Error ? error.message : String(error));
    return null;
  }
}

/** Shows a tab. */
export function show(id: string): void {
  if (activeId.value === id) return;
  active.value?.leave(cursor);
  activeId.value = id;
  const doc = active.value;
  if (doc) cursor.go(doc.place, "tab");
}

export function close(doc: Document): void {
  worker(doc).close();
  workers.delete(doc.id);
  const rest = documents.value.filter((d) => d !== doc);
  const next = activeId.value === doc.id ? (rest[0]?.id ?? null) : activeId.value;
  batch(() => {
    documents.value = rest;
    if (next !== activeId.value) activeId.value = next;
  });
  if (active.value) cursor.go(active.value.place, "tab");
}

/** The text was changed, by hand or by the form. */
export function edited(doc: Document, text: string): void {
  if (doc.text.value === text) return;
  doc.text.value = text;
  worker(doc).changed();
}

export async function save(doc: Document, over?: { sha256: string | null }): Promise<boolean> {
  // A text that differs on disk is decided first.
  if (doc.conflict.value && !over) return false;
  const text = doc.text.value;
  if (doc.isNew) {
    const id = await make(doc.name, text);
    if (id === null) return false;
    await open(id);
    close(doc);
    return true;
  }
  try {
    const { sha256 } = await api.save(doc.id, text, over ? over.sha256 : doc.saved.value.sha256);
    batch(() => {
      doc.saved.value = { text, sha256 };
      doc.conflict.value = null;
    });
    return true;
  } catch (error) {
    if (error instanceof api.Refused && error.reason === "changed") {
      const { disk } = error.body as { disk: { text: string | null; sha256: string | null } };
      doc.conflict.value = disk;
    } else if (error instanceof api.Refused) {
      tell(error.message);
    } else if (error instanceof api.Gone) {
      serverGone.value = true;
    } else {
      throw error;
    }
    return false;
  }
}

/** Takes the text that is on disk. */
export function takeTheirs(doc: Document): string | null {
  const theirs = doc.conflict.value;
  if (!theirs || theirs.text === null) return null;
  const { text, sha256 } = theirs;
  batch(() => {
    doc.saved.value = { text, sha256 };
    doc.conflict.value = null;
  });
  return text;
}

/** The last word of a file that another program has changed. */
export const changedFile = signal<api.Events["changed"] | null>(null);

async function changedOnDisk(event: api.Events["changed"]): Promise<void> {
  for (const doc of documents.value) {
    if (doc.id !== event.id) {
      // A file that this job reads may be another now.
      if ((doc.kind === "job" || doc.question) && event.sha256 !== null) worker(doc).again();
      continue;
    }
    if (event.sha256 === doc.saved.value.sha256) continue;
    const text = event.sha256 === null ? null : (await api.file(doc.id)).text;
    if (text === doc.text.value) doc.saved.value = { text, sha256: event.sha256 };
    else doc.conflict.value = { text, sha256: event.sha256 };
  }
}

/** Reads the folder and opens what it was started with. */
export async function start(): Promise<void> {
  void api.listen(
    (name, data) => {
      if (name === "progress") {
        const event = data as api.Events["progress"];
        workers.get(event.file)?.progress(event);
      } else if (name === "changed") {
        changedFile.value = data as api.Events["changed"];
        void changedOnDisk(data as api.Events["changed"]).catch(() => undefined);
      } else if (name === "files") {
        void api.project().then((known) => (project.value = known)).catch(() => undefined);
      } else if (name === "bye") {
        serverGone.value = true;
      }
    },
    (on) => (serverGone.value = !on),
  );
  const [known, schema] = await Promise.all([api.project(), api.schema("job")]);
  batch(() => {
    project.value = known;
    jobSchema.value = schema as Schema;
  });
  if (known.open) await open(known.open);
}

/** The window's title is the outcome and the file, or what another window is about. */
export function titled(word: () => string, other: () => string | null): void {
  effect(() => {
    const doc = active.value;
    document.title = other() ?? (doc ? `${word()} ${doc.name}`.trimStart() : "kinecut");
  });
}
