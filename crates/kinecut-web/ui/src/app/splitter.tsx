// An edge between panels: drags, steps with arrows, a doubled click restores it.
import type { Signal } from "@preact/signals";
import { t } from "../words";

interface Props {
  size: Signal<number>;
  way: "x" | "y";
  /** 1 where the panel lies before the edge, -1 where it lies behind. */
  sense: 1 | -1;
  least: number;
  most: number;
  standard: number;
  name: string;
}

export function Splitter({ size, way, sense, least, most, standard, name }: Props) {
  const clamp = (n: number) => Math.min(most, Math.max(least, n));
  /** A size of 0 is what the content takes: it is measured. */
  const measured = (edge: HTMLElement) => {
    if (size.value > 0) return size.value;
    const panel = (sense > 0 ? edge.previousElementSibling : edge.nextElementSibling) as HTMLElement;
    return way === "x" ? panel.offsetWidth : panel.offsetHeight;
  };
  return (
    <div
      class={`splitter ${way}`}
      role="separator"
      tabIndex={0}
      aria-orientation={way === "x" ? "vertical" : "horizontal"}
      aria-label={t(way === "x" ? "panel.wider" : "panel.higher", { name })}
      aria-valuemin={least}
      aria-valuemax={most}
      aria-valuenow={clamp(size.value)}
      onDblClick={() => (size.value = standard)}
      onKeyDown={(e) => {
        const by = { ArrowLeft: -16, ArrowUp: -16, ArrowRight: 16, ArrowDown: 16 }[e.key];
        if (by === undefined) return;
        e.preventDefault();
        size.value = clamp(measured(e.currentTarget) + sense * by);
      }}
      onPointerDown={(e) => {
        const edge = e.currentTarget;
        const from = way === "x" ? e.clientX : e.clientY;
        const before = measured(edge);
        edge.setPointerCapture(e.pointerId);
        const move = (to: PointerEvent) => (size.value = clamp(before + sense * ((way === "x" ? to.clientX : to.clientY) - from)));
        const up = () => {
          edge.removeEventListener("pointermove", move);
          edge.removeEventListener("pointerup", up);
          edge.removeEventListener("pointercancel", up);
        };
        edge.addEventListener("pointermove", move);
        edge.addEventListener("pointerup", up);
        edge.addEventListener("pointercancel", up);
      }}
    />
  );
}
