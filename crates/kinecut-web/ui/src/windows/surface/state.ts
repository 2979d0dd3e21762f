// The question about a surface, its answer, and what of it is chosen. It has no file: it is kept in the address of the page.
import { batch, computed, effect, signal } from "@preact/signals";
import * as api from "../../base/api";
import { project, serverGone, tell } from "../../store/session";
import { Newest, isFinding } from "./newest";
import type { Known, OnMachine, Split, Surface } from "./answer";
import { edits } from "./edits";
import { VIEWS, type View } from "./space";

/** An answer that is later than this says so [ms]. */
const LATE = 100;

export interface Of {
  /** A surface of the catalogue, or a file of the folder. */
  surface?: string;
  file?: string;
}

export const of = signal<Of>({ surface: "cone" });
/** Parameters and places as they are typed. */
export const set = signal<Record<string, string>>({});
export const at = signal<Record<string, string>>({});
export const reversed = signal(false);
/** Codes of machine and tool of the redistribution that is looked at; null: the first. */
export const chosen = signal<[string, string] | null>(null);
/** Identifier of a machine file, or name of a known machine. */
export const machine = signal<string | null>(null);
export const length = signal(0);
export const alternatives = signal(false);
export const view = signal<View>(VIEWS.iso);

export const catalogue = signal<Known[]>([]);
export const answer = signal<{ of: string; surface: Surface; ms: number } | null>(null);
export const wrong = signal<api.Finding | null>(null);
export const late = signal(false);
export const made = signal<{ of: string; made: OnMachine } | null>(null);
export const madeWrong = signal<api.Finding | null>(null);
export const making = signal(false);

const question = computed(() => ({ ...of.value, set: set.value, at: at.value, reversed: reversed.value }));
/** The question in one word, to tell whether an answer is of it. */
const asked = computed(() => JSON.stringify(question.value));
const askedOfMachine = computed(() => JSON.stringify([of.value, set.value, reversed.value, machine.value, length.value, alternatives.value]));
export const stale = computed(() => answer.value !== null && answer.value.of !== asked.value);
export const madeStale = computed(() => made.value !== null && made.value.of !== askedOfMachine.value);

export function told(error: unknown): void {
  if (error instanceof api.Gone) serverGone.value = true;
  else tell(error instanceof Error ? error.message : String(error));
}

const surfaces = new Newest();
const machines = new Newest();
/** Whether the window has been shown: before that nothing is asked. */
export const shown = signal(false);

async function ask(): Promise<void> {
  const key = asked.peek();
  const begun = performance.now();
  const timer = setTimeout(() => (late.value = true), LATE);
  try {
    const told = await surfaces.ask((signal, generation) => api.ask<Surface>("surface", { ...question.peek(), sketch: true, generation, edits: edits() }, signal));
    if (told === null) return;
    clearTimeout(timer);
    batch(() => {
      late.value = false;
      wrong.value = isFinding(told) ? told : null;
      if (!isFinding(told)) answer.value = { of: key, surface: told, ms: performance.now() - begun };
    });
    document.documentElement.dataset.surface = String(Number(document.documentElement.dataset.surface ?? 0) + 1);
    document.documentElement.dataset.surfaceMs = String(performance.now() - begun);
  } catch (error) {
    // A file that is gone: the catalogue is there all the same.
    late.value = false;
    told(error);
  } finally {
    clearTimeout(timer);
  }
}

async function askMachine(): Promise<void> {
  const key = askedOfMachine.peek();
  making.value = true;
  try {
    const { at: _, ...rest } = question.peek();
    const flags = { ...rest, machine: machine.peek(), length: length.peek(), alternatives: alternatives.peek(), edits: edits() };
    const told = await machines.ask((signal, generation) => api.ask<Surface>("surface", { ...flags, generation }, signal));
    if (told === null) return;
    batch(() => {
      making.value = false;
      madeWrong.value = isFinding(told) ? told : null;
      if (!isFinding(told) && told.on_machine) made.value = { of: key, made: told.on_machine };
    });
  } catch (error) {
    making.value = false;
    told(error);
  }
}

effect(() => {
  void asked.value;
  if (shown.value) void ask();
});
effect(() => {
  void askedOfMachine.value;
  if (!shown.value) return;
  if (machine.value === null) {
    machines.stop();
    batch(() => {
      made.value = null;
      madeWrong.value = null;
      making.value = false;
    });
  } else void askMachine();
});
effect(() => {
  if (!shown.value || catalogue.peek().length > 0) return;
  api.ask<Known[]>("surface", {}, new AbortController().signal).then((list) => {
    if (!isFinding(list)) catalogue.value = list;
  }, told);
});

/** Another surface: its own numbers, its own places. */
export function take(next: Of): void {
  if (JSON.stringify(next) === JSON.stringify(of.value)) return;
  batch(() => {
    of.value = next;
    set.value = {};
    at.value = {};
    chosen.value = null;
    reversed.value = false;
  });
}

/** Puts in or takes out a value by its name. */
export function put(where: typeof set, name: string, text: string): void {
  const { [name]: _, ...rest } = where.value;
  where.value = text.trim() === "" ? rest : { ...rest, [name]: text };
}

/** The redistribution that is looked at. */
export const split = computed<Split | null>(() => {
  const splits = answer.value?.surface.splits ?? [];
  const wanted = chosen.value;
  return splits.find((s) => wanted && s.machine_code === wanted[0] && s.tool_code === wanted[1]) ?? splits[0] ?? null;
});

/** Files of the folder that are surfaces, and those that are machines. */
export const surfaceFiles = computed(() => project.value?.files.filter((f) => f.kind === "surface") ?? []);
export const machineFiles = computed(() => project.value?.files.filter((f) => f.kind === "machine" || f.name.endsWith(".ini")) ?? []);

/** Asks again: a file has changed. */
export function again(): void {
  if (!shown.peek()) return;
  void ask();
  if (machine.peek() !== null) void askMachine();
}
