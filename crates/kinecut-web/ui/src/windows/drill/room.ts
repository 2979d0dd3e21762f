// The size of a drawing on the page, so that it is laid out anew in place of being shrunk.
import { useSignal } from "@preact/signals";
import { type RefObject } from "preact";
import { useEffect } from "preact/hooks";

export function useWidth(box: RefObject<HTMLElement | null>, standard: number): number {
  const width = useSignal(standard);
  useEffect(() => {
    const element = box.current;
    if (!element) return;
    const watch = new ResizeObserver(() => {
      const now = Math.floor(element.clientWidth);
      if (now > 0) width.value = now;
    });
    watch.observe(element);
    return () => watch.disconnect();
  }, []);
  return width.value;
}

/** Moves labels apart: the middle of each of some height, as near as can be to where it would be, within bounds, in their order. */
export function apart(wanted: number[], heights: number[], low: number, high: number): number[] {
  const placed = [...wanted];
  for (let i = 0; i < placed.length; i++) {
    const least = i === 0 ? low + heights[0] / 2 : placed[i - 1] + (heights[i - 1] + heights[i]) / 2;
    placed[i] = Math.max(placed[i], least);
  }
  for (let i = placed.length - 1; i >= 0; i--) {
    const most = i + 1 === placed.length ? high - heights[i] / 2 : placed[i + 1] - (heights[i] + heights[i + 1]) / 2;
    placed[i] = Math.min(placed[i], most);
  }
  return placed;
}
