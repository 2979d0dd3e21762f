// The width of an element, so that a drawing is laid out for it and its text keeps its size.
import { type Signal, useSignal } from "@preact/signals";
import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";

export function useWidth(least: number): [RefObject<HTMLDivElement | null>, Signal<number>] {
  const box = useRef<HTMLDivElement>(null);
  const width = useSignal(least);
  useEffect(() => {
    const sizes = new ResizeObserver(([entry]) => (width.value = Math.max(least, Math.floor(entry.contentRect.width))));
    sizes.observe(box.current as HTMLDivElement);
    return () => sizes.disconnect();
  }, []);
  return [box, width];
}
