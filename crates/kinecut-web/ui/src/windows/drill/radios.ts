// Pictures as one choice: the arrow keys go from one to the next and choose it.

export interface Grid {
  count: number;
  /** Pictures in a row. */
  columns: number;
  chosen: number;
  choose: (index: number) => void;
}

/** Takes a key; whether it was one of these. */
export function arrows(e: KeyboardEvent, { count, columns, chosen, choose }: Grid): void {
  const at = Math.max(0, chosen);
  const next = { ArrowRight: at + 1, ArrowLeft: at - 1, ArrowDown: at + columns, ArrowUp: at - columns, Home: 0, End: count - 1 }[e.key];
  if (next === undefined || e.ctrlKey || e.metaKey || e.altKey) return;
  e.preventDefault();
  if (next < 0 || next >= count) return;
  choose(next);
  const group = e.currentTarget as HTMLElement;
  requestAnimationFrame(() => group.querySelectorAll<HTMLElement>('[role="radio"]')[next]?.focus());
}
