// Light or dark: that of the system, or what was chosen.
import { signal } from "@preact/signals";
import { changed } from "viewer/theme";

const KEY = "kinecut-theme";
const system = matchMedia("(prefers-color-scheme: dark)");
const chosen = localStorage.getItem(KEY);
export const theme = signal<"light" | "dark">(chosen === "light" || chosen === "dark" ? chosen : system.matches ? "dark" : "light");

function apply(): void {
  document.documentElement.dataset.theme = theme.value;
  changed();
}

apply();
system.addEventListener("change", () => {
  if (localStorage.getItem(KEY)) return;
  theme.value = system.matches ? "dark" : "light";
  apply();
});

export function turnTheme(): void {
  theme.value = theme.value === "dark" ? "light" : "dark";
  localStorage.setItem(KEY, theme.value);
  apply();
}
