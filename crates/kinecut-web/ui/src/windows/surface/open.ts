// Ways into the window and out of it, and its question in the address of the page.
import { effect, signal } from "@preact/signals";
import { offer } from "../../app/commands";
import { activeId, changedFile, openedElsewhere, project } from "../../store/session";
import { t } from "../../words";
import { facing } from "../face/open";
import { figuresShown } from "../teaching/open";
import * as layouts from "./layouts/state";
import * as moving from "./machine/state";
import * as state from "./state";

export type Tab = "surface" | "layouts" | "machine";
export const TABS: Tab[] = ["surface", "layouts", "machine"];

/** Whether the window is the one that is shown. */
export const surfacing = signal(false);
export const tab = signal<Tab>("surface");

offer({ id: "command.surfaces", keys: [], run: showSurfaces });

export function showSurfaces(): void {
  facing.value = false;
  figuresShown.value = false;
  state.shown.value = true;
  surfacing.value = true;
}

export function leaveSurfaces(): void {
  surfacing.value = false;
}

/** Shows a machine in its tab. */
export function showMachine(source: moving.Source): void {
  moving.take(source);
  tab.value = "machine";
}

// A tab that is shown takes the place of the window; so does another window.
effect(() => {
  void activeId.value;
  surfacing.value = false;
});
effect(() => {
  if (facing.value || figuresShown.value) surfacing.value = false;
});

effect(() => {
  if (!changedFile.value) return;
  state.again();
  moving.again();
});

openedElsewhere((id, text) => {
  const known = project.peek()?.files.find((f) => f.id === id);
  if (known?.kind !== "surface" && !/^\s*(like|directrix)\s*=/m.test(text)) return false;
  // What opens a file shows the window after the tabs have settled.
  queueMicrotask(() => {
    state.take({ file: id });
    tab.value = "surface";
    showSurfaces();
  });
  return true;
});

/** The title of the window; null while another one is shown. */
export function surfaceTitle(): string | null {
  if (!surfacing.value) return null;
  const shown = { surface: state.answer.value?.surface.name ?? "", layouts: layouts.of.value, machine: moving.name.value }[tab.value];
  return `${t("surface.tab")} ${shown}`.trim();
}

/** The question as part of the address. */
function written(): string {
  const words = new URLSearchParams();
  words.set("surfaces", tab.value);
  const { surface, file } = state.of.value;
  if (file) words.set("file", file);
  else if (surface) words.set("surface", surface);
  for (const [name, text] of Object.entries(state.set.value)) words.append("set", `${name}=${text}`);
  for (const [name, text] of Object.entries(state.at.value)) words.append("at", `${name}=${text}`);
  if (state.reversed.value) words.set("reversed", "yes");
  if (state.chosen.value) words.set("split", state.chosen.value.join("|"));
  if (state.machine.value) words.set("on", state.machine.value);
  words.set("layouts", layouts.of.value);
  const source = moving.source.value;
  if (source?.layout) words.set("layout", source.layout);
  if (source?.machine) words.set("machine", source.machine);
  return words.toString();
}

function read(text: string): void {
  const words = new URLSearchParams(text);
  const pairs = (key: string) => Object.fromEntries(words.getAll(key).map((pair) => [pair.slice(0, pair.indexOf("=")), pair.slice(pair.indexOf("=") + 1)]));
  const name = words.get("surfaces") as Tab;
  if (TABS.includes(name)) tab.value = name;
  const [file, surface] = [words.get("file"), words.get("surface")];
  if (file) state.of.value = { file };
  else if (surface) state.of.value = { surface };
  state.set.value = pairs("set");
  state.at.value = pairs("at");
  state.reversed.value = words.get("reversed") === "yes";
  const split = words.get("split")?.split("|");
  if (split?.length === 2) state.chosen.value = [split[0], split[1]];
  state.machine.value = words.get("on");
  layouts.of.value = words.get("layouts") ?? layouts.of.value;
  const [layout, machine] = [words.get("layout"), words.get("machine")];
  if (layout) moving.take({ layout });
  else if (machine) moving.take({ machine });
}

const begun = location.hash.slice(1);
if (begun.startsWith("surfaces=")) {
  read(begun);
}

/** Shows the window that the address tells of, when the folder and its tabs are there. */
export function restoreSurfaces(): void {
  if (begun.startsWith("surfaces=")) showSurfaces();
}

effect(() => {
  if (surfacing.value) history.replaceState(null, "", `#${written()}`);
  else if (location.hash.startsWith("#surfaces=")) history.replaceState(null, "", location.pathname + location.search);
});
