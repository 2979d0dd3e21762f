// Buttons and commands of the window: back and on, the least placement, a walk, what is seen of the part.
import { useEffect } from "preact/hooks";
import { offer } from "../../app/commands";
import { t } from "../../words";
import { LARGER, fit } from "./hands";
import { face as shown, facing, showFacing, use } from "./open";
import type { Face } from "./state";
import { zoomed } from "./view";

/** Does something with the face that is on the screen. */
function withFace(act: (of: Face) => void): () => void {
  return () => {
    if (facing.peek() && shown.peek()) act(shown.peek() as Face);
  };
}

offer({ id: "command.facing", keys: [], run: () => showFacing() });
offer({ id: "command.least", keys: [], run: withFace(goLeast) });
offer({ id: "command.walk", keys: [], run: withFace((of) => void of.walkFrom()) });

function goLeast(of: Face): void {
  const { optimum } = of;
  if (optimum.value) of.go(of.handOf(optimum.value.placement));
}

/** Takes back or does again; a field that is being typed into shows what there is then. */
function back(of: Face, by: -1 | 1): void {
  const field = document.activeElement instanceof HTMLInputElement ? document.activeElement : null;
  field?.blur();
  of.back(by);
  field?.focus();
}

export function Acts({ face }: { face: Face }) {
  const { hand, optimum, history } = face;
  useEffect(() => {
    offer(
      { id: "command.undo", keys: ["Ctrl+Z"], run: withFace((of) => back(of, -1)) },
      { id: "command.redo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"], run: withFace((of) => back(of, 1)) },
    );
  }, []);
  return (
    <div class="acts">
      <Pressed name={t("command.undo")} sign="↶" off={!history.hasBefore.value} run={() => face.back(-1)} data="undo" />
      <Pressed name={t("command.redo")} sign="↷" off={!history.hasAfter.value} run={() => face.back(1)} data="redo" />
      <button onClick={() => document.querySelector<HTMLElement>(".weights input, .weights button")?.focus()}>{t("face.weights")}</button>
      <button disabled={!optimum.value} onClick={() => goLeast(face)}>
        {t("face.goLeast")}
      </button>
      <button class="primary" disabled={!hand.value || !face.placed.value?.answer} onClick={() => use(face)}>
        {t("face.use")}
      </button>
    </div>
  );
}

/** Larger, smaller, the whole drawing. */
export function Looks({ face }: { face: Face }) {
  const { view } = face;
  const zoom = (by: number) => () => (view.value = zoomed(view.value, by));
  return (
    <span class="looks" title={t("face.viewHow")}>
      <Pressed name={t("face.zoomOut")} sign="−" off={zoomed(view.value, 1 / LARGER).zoom === view.value.zoom} run={zoom(1 / LARGER)} data="out" />
      <Pressed name={t("face.zoomIn")} sign="+" off={zoomed(view.value, LARGER).zoom === view.value.zoom} run={zoom(LARGER)} data="in" />
      <button class="ghost" data-do="fit" onClick={() => fit(face)} title={t("face.fitWhole")}>
        {t("face.fit")}
      </button>
    </span>
  );
}

/** A button with a sign; one that does nothing now keeps the focus. */
function Pressed({ name, sign, off, run, data }: { name: string; sign: string; off: boolean; run: () => void; data: string }) {
  return (
    <button class="ghost icon" data-do={data} aria-label={name} title={name} aria-disabled={off || undefined} onClick={() => !off && run()}>
      <span aria-hidden="true" translate={false}>
        {sign}
      </span>
    </button>
  );
}
