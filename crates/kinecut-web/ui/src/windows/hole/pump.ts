// Changes by hand, no faster than they are answered: the newest waits for the answer of the one before, those between are left out.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Document } from "../../store/document";

export function usePump(doc: Document): (act: () => void) => void {
  const wanted = useRef<(() => void) | null>(null);
  useEffect(
    () =>
      effect(() => {
        if (doc.planning.value || !wanted.current) return;
        const act = wanted.current;
        wanted.current = null;
        queueMicrotask(act);
      }),
    [doc],
  );
  return (act) => {
    if (doc.planning.peek()) wanted.current = act;
    else act();
  };
}
