// A menu below its button: closes when one goes elsewhere.
import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";

export function Menu({ open, label, right = false, children }: { open: Signal<boolean>; label: string; right?: boolean; children: ComponentChildren }) {
  const box = useRef<HTMLDivElement>(null);
  const shown = open.value;
  useEffect(() => {
    const menu = box.current;
    if (!shown || !menu) return;
    menu.querySelector<HTMLElement>("[role^=menuitem]")?.focus();
    const away = (e: Event) => {
      if (!menu.parentElement?.contains(e.target as Node)) open.value = false;
    };
    const key = (e: KeyboardEvent) => {
      const items = [...menu.querySelectorAll<HTMLElement>("[role^=menuitem]")];
      const at = items.indexOf(document.activeElement as HTMLElement);
      if (e.key === "Escape") {
        open.value = false;
        menu.parentElement?.querySelector("button")?.focus();
      } else if (e.key === "ArrowDown") {
        items[(at + 1) % items.length]?.focus();
      } else if (e.key === "ArrowUp") {
        items[(at + items.length - 1) % items.length]?.focus();
      } else {
        return;
      }
      e.preventDefault();
      e.stopPropagation();
    };
    document.addEventListener("pointerdown", away);
    document.addEventListener("focusin", away);
    menu.parentElement?.addEventListener("keydown", key);
    return () => {
      document.removeEventListener("pointerdown", away);
      document.removeEventListener("focusin", away);
      menu.parentElement?.removeEventListener("keydown", key);
    };
  }, [shown]);
  if (!shown) return null;
  return (
    <div class={`float menu${right ? " right" : ""}`} role="menu" aria-label={label} ref={box}>
      {children}
    </div>
  );
}
