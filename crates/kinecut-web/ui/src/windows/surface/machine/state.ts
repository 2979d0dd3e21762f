// One machine: a layout, a file of the folder, or one that is known; its axes where the sliders are.
import { batch, computed, effect, signal } from "@preact/signals";
import * as api from "../../../base/api";
import { project, serverGone, tell } from "../../../store/session";
import { edits } from "../edits";
import { Newest, isFinding } from "../newest";

export interface Source {
  machine?: string;
  layout?: string;
  spindle?: string;
  stroke?: [number, number, number];
}

export interface Axis {
  axis: string;
  digit: number;
  work_side: boolean;
  rotary: boolean;
  direction: [number, number, number];
  point: [number, number, number] | null;
  sense: number;
  travel: [number, number] | null;
}

export interface Body {
  name: string;
  link: string;
  role: "part" | "cutter" | "bed" | "work" | "tool";
  corners: [number, number, number][];
  faces: number[][];
}

export interface Pose {
  joints: Record<string, number>;
  tip: [number, number, number];
  axis: [number, number, number];
  links: { link: string; matrix: number[][] }[];
  findings: api.Finding[];
}

export interface Machine {
  name: string;
  code: string;
  iso: string;
  canonical: string;
  axes: Axis[];
  drawn?: { usual: boolean; up: [number, number, number]; bodies: Body[] };
  pose?: Pose;
}

export interface Solution {
  joints: Record<string, number>;
  [more: string]: unknown;
}

export const source = signal<Source | null>(null);
export const joints = signal<Record<string, number>>({});
export const length = signal(0);
export const shown = signal<{ of: string; machine: Machine } | null>(null);
export const pose = signal<{ of: string; pose: Pose; ms: number } | null>(null);
export const wrong = signal<api.Finding | null>(null);
/** Whether the tab has been shown. */
export const open = signal(false);

const which = computed(() => JSON.stringify(source.value));
const place = computed(() => JSON.stringify([source.value, joints.value, length.value]));
export const stale = computed(() => pose.value !== null && pose.value.of !== place.value);
export const name = computed(() => shown.value?.machine.name ?? source.value?.layout ?? "");

function told(error: unknown): void {
  if (error instanceof api.Gone) serverGone.value = true;
  else tell(error instanceof Error ? error.message : String(error));
}

/** Another machine, its axes at home. */
export function take(next: Source): void {
  batch(() => {
    source.value = next;
    joints.value = {};
    wrong.value = null;
  });
}

const machines = new Newest();
const poses = new Newest();
const asked = (more: object) => ({ ...source.peek(), edits: edits(), ...more });

async function read(): Promise<void> {
  const key = which.peek();
  try {
    const answer = await machines.ask((signal, generation) => api.ask<Machine>("machine", asked({ bodies: true, generation }), signal));
    if (answer === null) return;
    batch(() => {
      wrong.value = isFinding(answer) ? answer : null;
      shown.value = isFinding(answer) ? null : { of: key, machine: answer };
      if (isFinding(answer)) pose.value = null;
    });
  } catch (error) {
    told(error);
  }
}

/** Positions of the axes as words. */
export function words(values: Record<string, number>): string {
  return Object.entries(values).map(([axis, value]) => `${axis}${Number(value.toFixed(6))}`).join(" ");
}

async function move(): Promise<void> {
  const key = place.peek();
  const begun = performance.now();
  try {
    // A line without words is no pose: home is that of the first axis.
    const first = shown.peek()?.machine.axes[0]?.axis;
    const at = words(joints.peek()) || (first ? `${first}0` : "");
    if (at === "") return;
    const answer = await poses.ask((signal, generation) => api.ask<Machine>("machine", asked({ at, length: length.peek(), generation }), signal));
    if (answer === null) return;
    batch(() => {
      if (isFinding(answer)) wrong.value = answer;
      else if (answer.pose) {
        wrong.value = null;
        pose.value = { of: key, pose: answer.pose, ms: performance.now() - begun };
      }
    });
    document.documentElement.dataset.pose = String(Number(document.documentElement.dataset.pose ?? 0) + 1);
    document.documentElement.dataset.poseMs = String(performance.now() - begun);
  } catch (error) {
    told(error);
  }
}

effect(() => {
  void which.value;
  if (open.value && source.value) void read();
});
effect(() => {
  void place.value;
  void shown.value;
  if (open.value && source.value && shown.value?.of === which.value) void move();
});

/** Reads the machine again: a file has changed. */
export function again(): void {
  if (open.peek() && source.peek()) void read();
}

export interface Found {
  solutions: Solution[];
}

const inverses = new Newest();

/** Positions of the axes for a pose; null where a newer pose has been asked about since. */
export async function inverse(at: string): Promise<Found | api.Finding | null> {
  try {
    return await inverses.ask((signal, generation) => api.ask<Found>("ik", { machine: source.peek()?.machine, at: [at], length: length.peek(), generation, edits: edits() }, signal));
  } catch (error) {
    told(error);
    return null;
  }
}

/** Puts the machine into the folder as a machine file. */
export async function save(file: string): Promise<void> {
  try {
    const text = await api.ask<string>("machinefile", asked({}), new AbortController().signal);
    if (typeof text !== "string") {
      wrong.value = text;
      return;
    }
    const { id } = await api.create(file, text);
    project.value = await api.project();
    source.value = { machine: id };
  } catch (error) {
    told(error);
  }
}
