// Texts that no catalogue has: names, program text, and the sentences of the library, which are English.
import type { ComponentChildren } from "preact";

/** A name, a number with its unit, or a piece of a text of the user. */
export function Name({ children, class: c }: { children: ComponentChildren; class?: string }) {
  return (
    <span translate={false} class={c}>
      {children}
    </span>
  );
}

/** For elements of a drawing, which have no property of that name. */
export const untranslated = { translate: "no" } as object;

/** A sentence of the library: words between backquotes are names. */
export function Said({ text }: { text: string }) {
  return (
    <span lang="en">
      {text.split("`").map((part, i) => (i % 2 === 1 ? <code key={i}>{part}</code> : part))}
    </span>
  );
}
