// Colours come from the style sheet, so that page, charts and 3-D view agree in both themes.
import { Color } from "three";

const listeners: (() => void)[] = [];

export function onTheme(f: () => void): void {
  listeners.push(f);
}

export function changed(): void {
  for (const f of listeners) f();
}

export function colour(name: string): Color {
  const text = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return new Color().setStyle(text || "#888888");
}

export function startTheme(): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  document.getElementById("kc-theme")?.addEventListener("click", () => {
    const now = root.dataset.theme ?? (dark.matches ? "dark" : "light");
    root.dataset.theme = now === "dark" ? "light" : "dark";
    changed();
  });
  dark.addEventListener("change", changed);
}
