// The window of surfaces and machines: three tabs over one question.
import { Name, Said } from "../../app/verbatim";
import { fixed } from "../../base/format";
import { t } from "../../words";
import { letter, pretty } from "./answer";
import { Catalogue } from "./catalogue";
import { Chain, Matrices } from "./chain";
import { LayoutsTab } from "./layouts/tab";
import { MachineTab } from "./machine/tab";
import { TextNumber } from "./number";
import { OnMachine } from "./onmachine";
import { TABS, tab } from "./open";
import { Picture } from "./picture";
import { Facts, Splits } from "./splits";
import { answer, at, late, put, reversed, set, stale, wrong } from "./state";

export function SurfaceWindow() {
  return (
    <main class="surfaces">
      <div class="head">
        <h1>{t("surface.title")}</h1>
        <div class="seg" role="tablist" aria-label={t("surface.tabs")}>
          {TABS.map((name) => (
            <button
              key={name}
              role="tab"
              id={`tab-${name}`}
              aria-selected={tab.value === name}
              aria-controls="surface-tab"
              tabIndex={tab.value === name ? 0 : -1}
              onClick={() => (tab.value = name)}
              data-tab={name}
              onKeyDown={(e) => {
                const by = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
                if (by === undefined) return;
                tab.value = TABS[(TABS.indexOf(name) + by + TABS.length) % TABS.length];
                requestAnimationFrame(() => document.querySelector<HTMLElement>('.surfaces [role="tab"][aria-selected="true"]')?.focus());
              }}
            >
              {t(`surface.tab.${name}`)}
            </button>
          ))}
        </div>
      </div>
      <div id="surface-tab" role="tabpanel" aria-labelledby={`tab-${tab.value}`}>
        {tab.value === "surface" ? <SurfaceTab /> : tab.value === "layouts" ? <LayoutsTab /> : <MachineTab />}
      </div>
    </main>
  );
}

function SurfaceTab() {
  const surface = answer.value?.surface;
  const aged = stale.value && (late.value || wrong.value !== null);
  return (
    <div class="cols">
      <div class="stack">
        <Catalogue />
      </div>
      <div class="stack" data-aged={aged || undefined}>
        {wrong.value && !fieldOf(wrong.value.key) && (
          <p class="across" role="alert" data-wrong>
            <Said text={wrong.value.message} /> {wrong.value.help && <Said text={wrong.value.help} />}
          </p>
        )}
        <section class="panel" aria-label={t("surface.division")} tabIndex={-1} data-panel="chain">
          <header>
            <h2>{surface ? <Name>{surface.title || surface.name}</Name> : t("surface.division")}</h2>
            {surface && <span class="q">{t("surface.codeIs", { code: surface.code, form: surface.form })}</span>}
            {aged && <span class="tag np">{t("surface.older")}</span>}
            {late.value && <span class="waits" />}
          </header>
          <Chain />
          <p class="q hintLine">{t("surface.chainHow")}</p>
          <Matrices />
        </section>
        <Numbers />
        <section class="panel" aria-label={t("surface.sketch")} tabIndex={-1} data-panel="sketch">
          <header>
            <h2>{t("surface.sketch")}</h2>
            <span class="q">{t("surface.sketchHow")}</span>
          </header>
          <Picture />
          <Key />
          <PlaceNumbers />
        </section>
        {surface?.findings?.map((f, i) => (
          <p key={i} class="across np" role="status">
            <Said text={f.message} /> {f.help && <Said text={f.help} />}
          </p>
        ))}
      </div>
      <div class="stack" data-aged={aged || undefined}>
        <Splits />
        <Facts />
        <OnMachine />
      </div>
    </div>
  );
}

/** The field that a finding is about. */
function fieldOf(key: string | undefined): string | null {
  const surface = answer.value?.surface;
  if (!key || !surface) return null;
  return key in surface.parameters || surface.variables.some(([name]) => name === key) ? key : null;
}

/** Parameters, and the place on the surface. */
function Numbers() {
  const surface = answer.value?.surface;
  if (!surface) return null;
  const told = (name: string) => (wrong.value && fieldOf(wrong.value.key) === name ? wrong.value.message : null);
  return (
    <section class="panel" aria-label={t("surface.numbers")} tabIndex={-1} data-panel="numbers">
      <header>
        <h2>{t("surface.numbers")}</h2>
        <span class="q">{t("surface.units")}</span>
      </header>
      <div class="strip">
        {Object.entries(surface.parameters).map(([name, value]) => (
          <TextNumber key={name} id={name} label={<Name>{pretty(name)}</Name>} name={name} value={set.value[name] ?? ""} standard={String(value)} put={(text) => put(set, name, text)} wrong={told(name)} />
        ))}
        {surface.place?.variables.map(([name, value], i) => (
          <TextNumber key={name} id={name} label={<Name>{`${pretty(name)}: ${short(surface.variables[i][1])} \u2026 ${short(surface.variables[i][2])}`}</Name>} name={name} value={at.value[name] ?? ""} standard={short(value)} put={(text) => put(at, name, text)} wrong={told(name)} />
        ))}
      </div>
      <label class="box">
        <input type="checkbox" checked={reversed.value} onChange={(e) => (reversed.value = e.currentTarget.checked)} data-reversed />
        {t("surface.reversed")}
      </label>
    </section>
  );
}

const short = (n: number): string => String(Number(n.toPrecision(5)));

/** The point of the surface in numbers, and the motions of the chain there. */
function PlaceNumbers() {
  const place = answer.value?.surface.place;
  if (!place) return null;
  return (
    <dl class="facts">
      <div data-fact="point">
        <dt>{t("surface.point")}</dt>
        <dd translate={false}>
          <b>({place.point.map((c) => fixed(c, 3)).join(", ")})</b>
          <small>{place.variables.map(([name, value]) => `${pretty(name)} ${fixed(value, 4)}`).join(", ")}</small>
        </dd>
      </div>
      <div data-fact="normal">
        <dt>{t("surface.normal")}</dt>
        <dd translate={false}>
          <b>{place.normal ? `(${place.normal.map((c) => fixed(c, 4)).join(", ")})` : "\u2013"}</b>
        </dd>
      </div>
      {place.motions.filter((m) => m.forming).map((m, i) => (
        <div key={i} data-fact={`motion-${m.digit}`}>
          <dt>{t("surface.runs", { axis: letter(m.digit) })}</dt>
          <dd translate={false}>
            <b>{fixed(m.value, 3)}</b>
            <small>{pretty(m.law)}</small>
          </dd>
        </div>
      ))}
    </dl>
  );
}

/** What the strokes of the sketch mean. */
function Key() {
  const sample = (name: string) => (
    <svg width="34" height="10" aria-hidden="true" class="motions">
      <g class={`motion ${name}`}>
        <path class="shaft" d="M0 5h34" />
        {name === "set-up" && <path class="inner" d="M0 5h34" />}
      </g>
    </svg>
  );
  return (
    <div class="key">
      {(["forming", "setting", "set-up"] as const).map((name) => (
        <span key={name}>
          {sample(name)}
          {t(`surface.key.${name}`)}
        </span>
      ))}
      <span>
        <svg width="34" height="10" aria-hidden="true">
          <path class="edge" d="M0 5h34" />
        </svg>
        {t("surface.key.tool")}
      </span>
    </div>
  );
}
