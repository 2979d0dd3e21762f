// The window of the figures: the place of their pages.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { language, t } from "../../words";
import { mountFigures } from "./open";

export function FiguresWindow() {
  const into = useRef<HTMLDivElement>(null);
  const state = useSignal<"loading" | "there" | "failed">("loading");
  useEffect(() => {
    let away: (() => void) | null = null;
    let gone = false;
    if (!into.current) return;
    mountFigures(into.current, language.value.pseudo ? "pseudo" : language.value.tag).then(
      (end) => {
        if (gone) return end();
        away = end;
        state.value = "there";
      },
      () => (state.value = "failed"),
    );
    return () => {
      gone = true;
      away?.();
    };
  }, []);
  return (
    <div class="teaching" data-panel tabIndex={-1}>
      {state.value === "loading" && <p class="empty q">{t("figures.loading")}</p>}
      {state.value === "failed" && <p class="empty">{t("figures.notLoaded")}</p>}
      <div ref={into} />
    </div>
  );
}
