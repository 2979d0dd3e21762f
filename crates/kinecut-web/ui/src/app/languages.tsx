// The menu of languages.
import { useSignal } from "@preact/signals";
import { tell } from "../store/session";
import { type Choice, NAMES, choose, language, t } from "../words";
import { Menu } from "./menu";

export function Languages() {
  const shown = useSignal(false);
  const now = language.value.tag;
  const [, short] = NAMES[now as Choice] ?? NAMES.en;
  const pick = (choice: Choice) => {
    shown.value = false;
    choose(choice).catch(() => tell(t("language.failed", { name: NAMES[choice][0] })));
  };
  return (
    <span class="holdsMenu">
      <button class="ghost" aria-haspopup="menu" aria-expanded={shown.value} aria-label={t("bar.language")} title={t("bar.language")} data-open="languages" onClick={() => (shown.value = !shown.value)}>
        <span translate={false} aria-hidden="true">
          {short}
        </span>
      </button>
      <Menu open={shown} label={t("bar.language")} right>
        {(Object.keys(NAMES) as Choice[]).map((choice) => (
          <button key={choice} role="menuitemradio" aria-checked={choice === now} lang={choice} translate={false} data-language={choice} onClick={() => pick(choice)}>
            {NAMES[choice][0]}
          </button>
        ))}
      </Menu>
    </span>
  );
}
