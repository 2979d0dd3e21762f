// All layouts of a code or of letters of axes: filters, weights, and a gallery in the order of the scores.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { theme } from "../../../app/theme";
import { Name, Said } from "../../../app/verbatim";
import { fixed } from "../../../base/format";
import { t } from "../../../words";
import type { Key } from "../../../words/en";
import { showMachine } from "../open";
import { CELL, image } from "./drawings";
import { type Filters, type Layout, NONE, filter, filters, found, of, pictures, show, shown, stale, unread, waits, weigh, weightOf, weights, wrong } from "./state";

const KINDS = ["table-table", "head-table", "head-head", "table", "head", "linear"] as const;
const SPINDLES = ["vertical", "horizontal", "both"] as const;
const MORE = 24;
const MOST = 240;

export function LayoutsTab() {
  useEffect(() => void (shown.value = true), []);
  return (
    <div class="cols layoutCols">
      <div class="stack">
        <Asked />
        <Weights />
      </div>
      <div class="stack">
        {wrong.value && (
          <p class="across" role="alert" data-wrong>
            <Said text={wrong.value.message} /> {wrong.value.help && <Said text={wrong.value.help} />}
          </p>
        )}
        <Gallery />
      </div>
    </div>
  );
}

function Asked() {
  const f = filters.value;
  const draft = useSignal(of.value);
  return (
    <section class="panel" aria-label={t("layouts.asked")} tabIndex={-1} data-panel="filters">
      <header>
        <h2>{t("layouts.asked")}</h2>
        <span class="sp" />
        <button class="ghost" disabled={JSON.stringify(f) === JSON.stringify(NONE)} onClick={() => (filters.value = NONE)}>
          {t("layouts.clear")}
        </button>
      </header>
      <div class="pad">
        <label class="field">
          <span>{t("layouts.of")}</span>
          <input
            value={draft.value}
            spellcheck={false}
            onInput={(e) => {
              draft.value = e.currentTarget.value;
              of.value = e.currentTarget.value.trim();
            }}
            data-layouts="of"
          />
          <small class="q">{t("layouts.ofHow")}</small>
        </label>
        {(["full", "regular", "quarter-turns"] as const).map((name) => (
          <label key={name} class="box">
            <input type="checkbox" checked={f[name]} onChange={(e) => filter(name, e.currentTarget.checked)} data-layouts={name} />
            {t(`layouts.${name}`)}
          </label>
        ))}
        <fieldset>
          <legend>{t("layouts.kinds")}</legend>
          {KINDS.map((kind) => (
            <label key={kind} class="box">
              <input type="checkbox" checked={f.kind.includes(kind)} onChange={(e) => filter("kind", e.currentTarget.checked ? [...f.kind, kind] : f.kind.filter((k) => k !== kind))} data-kind={kind} />
              {t(`layouts.kind.${kind}`)}
            </label>
          ))}
        </fieldset>
        <label class="field">
          <span>{t("layouts.spindle")}</span>
          <select value={f.spindle} onChange={(e) => filter("spindle", e.currentTarget.value)} data-layouts="spindle">
            {SPINDLES.map((s) => (
              <option key={s} value={s}>
                {t(`layouts.spindle.${s}`)}
              </option>
            ))}
          </select>
        </label>
        <Text name="work-links" />
        <Text name="work-axes" />
        <Text name="tool-axes" />
        <Text name="tilt" unit="°" />
        <Text name="stroke" unit="mm" />
        <Text name="part" unit="mm" />
        <Text name="tool-length" unit="mm" />
        <Text name="stacking" />
      </div>
    </section>
  );
}

type Typed = "work-links" | "work-axes" | "tool-axes" | "tilt" | "stroke" | "part" | "tool-length" | "stacking";

/** A condition that is typed. */
function Text({ name, unit }: { name: Typed & keyof Filters; unit?: string }) {
  const bad = unread.value.has(name);
  return (
    <div class={`field${bad ? " wrong" : ""}`}>
      <label for={`lay-${name}`}>{t(`layouts.${name}`)}</label>
      <span class="f">
        <input id={`lay-${name}`} value={filters.value[name]} placeholder={t(`layouts.${name}.like`)} spellcheck={false} autocomplete="off" aria-invalid={bad || undefined} aria-describedby={bad ? `lay-${name}-told` : undefined} onInput={(e) => filter(name, e.currentTarget.value)} data-layouts={name} />
        {unit && <small translate={false}>{unit}</small>}
      </span>
      {bad && (
        <p class="told" id={`lay-${name}-told`}>
          {t("layouts.unread", { like: t(`layouts.${name}.like`) })}
        </p>
      )}
    </div>
  );
}

function Weights() {
  const all = found.value?.found.weights ?? [];
  if (all.length === 0) return null;
  return (
    <section class="panel" aria-label={t("layouts.weights")} tabIndex={-1} data-panel="weights">
      <header>
        <h2>{t("layouts.weights")}</h2>
        <span class="sp" />
        <button class="ghost" disabled={weights.value === null} onClick={() => (weights.value = null)} data-usual>
          {t("layouts.usual")}
        </button>
      </header>
      <div class="pad sliders">
        {all.map(([name]) => (
          <label key={name}>
            <span>{t(`layouts.weight.${name}` as Key)}</span>
            <input type="range" min="0" max="3" step="0.1" value={weightOf(name)} onInput={(e) => weigh(name, Number(e.currentTarget.value))} data-weight={name} />
            <output translate={false}>{fixed(weightOf(name), 1)}</output>
          </label>
        ))}
      </div>
    </section>
  );
}

function Gallery() {
  const told = found.value?.found;
  return (
    <section class="panel" aria-label={t("layouts.gallery")} tabIndex={-1} data-panel="gallery" data-aged={stale.value || undefined}>
      <header>
        <h2>{t("layouts.gallery")}</h2>
        {told && <span class="q" data-left={told.left}>{t("layouts.left", { left: told.left, of: told.enumerated, classes: told.classes })}</span>}
        {stale.value && <span class="tag np">{t("surface.older")}</span>}
        {waits.value && <span class="waits" />}
      </header>
      {told && told.left_out.length > 0 && (
        <p class="q hintLine" lang="en">
          {told.left_out.map(([what, n]) => `${what}: \u2212${n}`).join("; ")}
        </p>
      )}
      {told && told.layouts.length === 0 && <p class="pad">{t("layouts.empty")}</p>}
      <div class="gallery">{told?.layouts.map((l, i) => <Card key={`${l.code}${l.spindle}`} of={l} picture={pictures.value.of === found.value?.of ? pictures.value.all[i] : undefined} rank={i + 1} />)}</div>
      {told && told.left > told.layouts.length && show.value < MOST && (
        <div class="pad">
          <button onClick={() => (show.value = Math.min(MOST, show.value + MORE))} data-more>
            {t("layouts.more", { n: Math.min(MORE, told.left - told.layouts.length) })}
          </button>
        </div>
      )}
      {told?.findings.map((f, i) => (
        <p key={i} class="pad q">
          <Said text={f.message} />
        </p>
      ))}
      <p class="q hintLine">{t("layouts.how")}</p>
    </section>
  );
}

function Card({ of: l, picture, rank }: { of: Layout; picture: string | undefined; rank: number }) {
  const fact = (label: string, value: string) => (
    <span>
      {label} <b translate={false}>{value}</b>
    </span>
  );
  return (
    <button class="layout" onClick={() => showMachine({ layout: l.code, spindle: l.spindle, stroke: l.stroke })} data-layout={l.code} data-rank={rank} data-cost={l.cost}>
      {picture ? <img src={image(picture, theme.value)} width={CELL[0]} height={CELL[1]} alt={t("layouts.picture", { code: l.code })} /> : <span class="room" style={{ height: CELL[1] }} />}
      <span class="title">
        <b translate={false}>
          {rank}. {l.code}
          {l.pareto ? " \u2605" : ""}
        </b>
        {l.pareto && <span class="sr">{t("layouts.pareto")}</span>}
        <small translate={false}>{l.iso}</small>
      </span>
      <span class="told">
        <Name>{l.kind}</Name>
        {fact(t("layouts.cost"), fixed(l.cost, 3))}
        {fact(t("layouts.rank"), String(l.rank))}
        {l.tilt_deg !== null && fact(t("layouts.tiltIs"), `${fixed(l.tilt_deg, 0)}°`)}
        {l.cover !== null && fact(t("layouts.cover"), `${fixed(100 * l.cover, 0)} %`)}
        {fact(t("layouts.moved"), fixed(l.moved_mass, 0))}
        {fact(t("layouts.overhang"), `${fixed(l.overhang, 0)} mm`)}
      </span>
    </button>
  );
}
