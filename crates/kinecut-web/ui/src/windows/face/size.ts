// The width that a picture has: it is laid out again for it, its text never scales.
import { type Signal, useSignal } from "@preact/signals";
import { type RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";

export function useWidth(first: number): [RefObject<HTMLDivElement | null>, Signal<number>] {
  const box = useRef<HTMLDivElement>(null);
  const width = useSignal(first);
  useEffect(() => {
    const element = box.current as HTMLDivElement;
    const observer = new ResizeObserver(() => (width.value = Math.max(220, Math.floor(element.clientWidth))));
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return [box, width];
}
