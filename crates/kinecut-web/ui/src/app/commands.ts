// What can be done by a key or by name.
import { signal } from "@preact/signals";
import type { Key } from "../words/en";

export interface Command {
  id: Key;
  /** Keys that do it, as they are shown. */
  keys: string[];
  run: () => void;
}

/** Commands of the windows and of the shell; later ones of the same name replace earlier ones. */
const all = new Map<Key, Command>();

export function offer(...commands: Command[]): void {
  for (const command of commands) all.set(command.id, command);
}

export function commands(): Command[] {
  return [...all.values()];
}

export function run(id: Key): void {
  all.get(id)?.run();
}

const LETTERS = "kinecut-letters";
/** Whether single letters are keys. */
export const letters = signal(localStorage.getItem(LETTERS) !== "off");

export function setLetters(on: boolean): void {
  letters.value = on;
  localStorage.setItem(LETTERS, on ? "on" : "off");
}

export const dialog = signal<"keys" | "commands" | "go" | "both" | null>(null);

function pressed(e: KeyboardEvent): string {
  const key = e.key === " " ? "Space" : e.key.length === 1 ? e.key.toUpperCase() : e.key;
  const control = e.ctrlKey || e.metaKey ? "Ctrl+" : "";
  const shift = e.shiftKey && (key.length > 1 || /[A-Z]/.test(key)) ? "Shift+" : "";
  return control + shift + key;
}

/** Whether an element takes letters itself. */
function types(target: EventTarget | null): boolean {
  return target instanceof Element && target.closest("input:not([type=checkbox]):not([type=range]), select, textarea, .cm-editor, dialog[open]") !== null;
}

export function startKeys(): void {
  document.addEventListener("keydown", (e) => {
    if (e.defaultPrevented || e.altKey) return;
    const key = pressed(e);
    const single = key.length === 1 || key === "Space" || /^Shift\+[A-Z]$/.test(key);
    if (single && (!letters.value || types(e.target))) return;
    // A button is pressed by the blank key itself.
    if (key === "Space" && e.target instanceof Element && e.target.closest("button, summary, input, [role=radio], [role=option]")) return;
    if (key === "Escape" && document.querySelector("dialog[open]")) return;
    const command = commands().find(({ keys }) => keys.includes(key));
    if (!command) return;
    e.preventDefault();
    command.run();
  });
}
