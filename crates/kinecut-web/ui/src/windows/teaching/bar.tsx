// Ways to the figures in the bar of the workbench.
import type { Signal } from "@preact/signals";
import { t } from "../../words";
import { closeFigures, figuresOpen, figuresShown, showFigures } from "./open";

/** The tab, once the figures were opened. */
export function FiguresTab() {
  const on = figuresShown.value;
  if (!figuresOpen.value) return null;
  const close = t("bar.close", { name: t("command.figures") });
  return (
    <span class={`tab window${on ? " on" : ""}`}>
      <button aria-current={on ? "page" : undefined} title={t("command.figures")} onClick={showFigures} data-open="figures">
        {t("figures.tab")}
      </button>
      {on && (
        <button class="close" aria-label={close} title={close} onClick={closeFigures}>
          <span aria-hidden="true">×</span>
        </button>
      )}
    </span>
  );
}

/** The entry of a menu; the menu is closed. */
export function FiguresItem({ menu }: { menu: Signal<boolean> }) {
  return (
    <button
      role="menuitem"
      data-open-figures
      onClick={() => {
        menu.value = false;
        showFigures();
      }}
    >
      {t("command.figures")}
    </button>
  );
}
