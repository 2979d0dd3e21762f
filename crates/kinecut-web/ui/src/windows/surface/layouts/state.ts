// The question about layouts and its answer.
import { batch, computed, effect, signal } from "@preact/signals";
import * as api from "../../../base/api";
import { serverGone, tell } from "../../../store/session";
import { Newest, isFinding } from "../newest";
import { drawings } from "./drawings";

export interface Layout {
  code: string;
  iso: string;
  class: string;
  kind: string;
  spindle: string;
  rank: number;
  regular: boolean;
  work_links: number;
  moved_mass: number;
  lifted_mass: number;
  overhang: number;
  error_gain: number;
  stroke: [number, number, number];
  cover: number | null;
  tilt_deg: number | null;
  workspace?: { utilisation: number; largest_cube: number | null };
  cost: number;
  pareto: boolean;
}

export interface Found {
  of: string;
  enumerated: number;
  left_out: [string, number][];
  left: number;
  classes: number;
  layouts: Layout[];
  weights: [string, number][];
  findings: api.Finding[];
}

export interface Filters {
  full: boolean;
  regular: boolean;
  "quarter-turns": boolean;
  kind: string[];
  spindle: string;
  /** As they are typed. */
  "work-links": string;
  "work-axes": string;
  "tool-axes": string;
  tilt: string;
  stroke: string;
  part: string;
  "tool-length": string;
  stacking: string;
}

export const NONE: Filters = { full: true, regular: false, "quarter-turns": false, kind: [], spindle: "vertical", "work-links": "", "work-axes": "", "tool-axes": "", tilt: "", stroke: "", part: "", "tool-length": "", stacking: "" };

export const of = signal("XYZAC");
export const filters = signal<Filters>(NONE);
/** Weights by their names; null: the usual. */
export const weights = signal<Record<string, number> | null>(null);
export const show = signal(24);
export const found = signal<{ of: string; found: Found } | null>(null);
/** Drawings of the layouts of an answer, in their order. */
export const pictures = signal<{ of: string; all: string[] }>({ of: "", all: [] });
export const wrong = signal<api.Finding | null>(null);
export const waits = signal(false);
/** Whether the tab has been shown. */
export const shown = signal(false);

/** Numbers with commas between, so many; null where it is something else. */
function numbers(text: string, count: number): number[] | null {
  const all = text.split(/[,;x\s]+/).filter((w) => w !== "").map(Number);
  return all.length === count && all.every(Number.isFinite) ? all : null;
}

/** Filters whose text cannot be read. */
export const unread = computed(() => {
  const f = filters.value;
  const bad = new Set<keyof Filters>();
  for (const [name, count] of [["work-links", 1], ["tilt", 1], ["tool-length", 1], ["stacking", 2], ["stroke", 3], ["part", 3]] as const) if (f[name].trim() !== "" && !numbers(f[name], count)) bad.add(name);
  return bad;
});

const flags = computed(() => {
  const f = filters.value;
  const one = (name: "work-links" | "tilt" | "tool-length") => numbers(f[name], 1)?.[0];
  const word = (name: "work-axes" | "tool-axes") => f[name].trim().toUpperCase() || undefined;
  return {
    of: of.value,
    full: f.full,
    regular: f.regular,
    "quarter-turns": f["quarter-turns"],
    kind: f.kind,
    spindle: f.spindle,
    "work-links": one("work-links"),
    tilt: one("tilt"),
    "tool-length": one("tool-length"),
    "work-axes": word("work-axes"),
    "tool-axes": word("tool-axes"),
    stroke: numbers(f.stroke, 3) ?? undefined,
    part: numbers(f.part, 3) ?? undefined,
    stacking: numbers(f.stacking, 2) ?? undefined,
    weight: weights.value ? Object.entries(weights.value) : [],
    show: show.value,
  };
});
const asked = computed(() => JSON.stringify(flags.value));
export const stale = computed(() => (found.value !== null && found.value.of !== asked.value) || unread.value.size > 0);

const questions = new Newest();
const sheets = new Newest();

async function ask(): Promise<void> {
  const key = asked.peek();
  waits.value = true;
  try {
    const told = await questions.ask((signal, generation) => api.ask<Found>("layouts", { ...flags.peek(), generation }, signal));
    if (told === null) return;
    batch(() => {
      waits.value = false;
      wrong.value = isFinding(told) ? told : null;
      if (!isFinding(told)) found.value = { of: key, found: told };
    });
    if (isFinding(told)) return;
    const sheet = await sheets.ask((signal, generation) => api.drawing("layouts", { ...flags.peek(), generation }, signal));
    if (sheet !== null && asked.peek() === key) pictures.value = { of: key, all: drawings(sheet) };
    document.documentElement.dataset.layouts = String(Number(document.documentElement.dataset.layouts ?? 0) + 1);
  } catch (error) {
    waits.value = false;
    if (error instanceof api.Gone) serverGone.value = true;
    else tell(error instanceof Error ? error.message : String(error));
  }
}

effect(() => {
  void asked.value;
  if (shown.value) void ask();
});

export function filter<K extends keyof Filters>(name: K, value: Filters[K]): void {
  filters.value = { ...filters.value, [name]: value };
}

/** The weight of a score as it counts now. */
export function weightOf(name: string): number {
  return weights.value?.[name] ?? found.value?.found.weights.find(([n]) => n === name)?.[1] ?? 0;
}

export function weigh(name: string, value: number): void {
  const all = Object.fromEntries((found.value?.found.weights ?? []).map(([n]) => [n, weightOf(n)]));
  weights.value = { ...all, [name]: value };
}
