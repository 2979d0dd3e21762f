// The chain of motions with the bar between machine and tool: what is left of the bar the machine has, what is right of it the tool.
import { computed } from "@preact/signals";
import { useRef } from "preact/hooks";
import { fixed } from "../../base/format";
import { t } from "../../words";
import { type Split, type Surface, elements, letter, part, pretty } from "./answer";
import { answer, chosen, split } from "./state";

/** The elements as they are shown: those of the redistribution that is looked at, in its order. */
const order = computed(() => (split.value ? [...elements(split.value.machine), ...elements(split.value.tool)] : []));

const sorted = (all: string[]): string => [...all].sort().join(" ");

/** The redistribution with the bar after so many elements of the order that is shown; null where the tool would not be rigid. */
function splitAt(surface: Surface, all: string[], n: number): Split | null {
  const machine = sorted(all.slice(0, n));
  const found = surface.splits.filter((s) => sorted(elements(s.machine)) === machine);
  return found.find((s) => s.valid) ?? found[0] ?? null;
}

/** The exponent of a motion: 6 is \u2076. */
const raised = (digit: string): string => "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(digit)] ?? digit;

export function Chain() {
  const surface = answer.value?.surface;
  const row = useRef<HTMLDivElement>(null);
  const dragged = useRef(false);
  if (!surface || !split.value) return null;
  const all = order.value;
  const now = elements(split.value.machine).length;
  const go = (n: number) => {
    const next = splitAt(surface, all, Math.min(all.length, Math.max(0, n)));
    if (next) chosen.value = [next.machine_code, next.tool_code];
  };
  const follow = (e: PointerEvent) => {
    const chips = [...(row.current?.querySelectorAll<HTMLElement>("[data-chip]") ?? [])];
    // Where the chain is broken into rows, the row under the pointer counts.
    const middles = chips.map((c) => c.getBoundingClientRect());
    const rowOf = middles.reduce((best, r) => (Math.abs(r.top + r.height / 2 - e.clientY) < Math.abs(best - e.clientY) ? r.top + r.height / 2 : best), Infinity);
    go(middles.filter((r) => r.bottom < rowOf || (Math.abs(r.top + r.height / 2 - rowOf) < r.height / 2 && r.left + r.width / 2 < e.clientX)).length);
  };
  const key = (e: KeyboardEvent) => {
    const to = { ArrowLeft: now - 1, ArrowRight: now + 1, ArrowDown: now - 1, ArrowUp: now + 1, Home: 0, End: all.length }[e.key];
    if (to === undefined) return;
    e.preventDefault();
    go(to);
  };
  const values = new Map(surface.place?.motions.map((m) => [`${m.digit}(${m.law})`, m]));
  const chip = (element: string, i: number) => {
    const [digit, law] = [element.slice(0, element.indexOf("(")), element.slice(element.indexOf("(") + 1, -1)];
    const motion = values.get(element);
    return (
      <span key={`${i}${element}`} class={`chip ${motion?.forming ? "forming" : "setting"}`} data-chip={digit} title={t(motion?.forming ? "surface.chipForming" : "surface.chipSetting", { axis: letter(digit) })}>
        <b translate={false}>
          {"A"}
          {raised(digit)}({pretty(law)})
        </b>
        <small translate={false}>{motion ? `${letter(digit)} ${fixed(motion.value, 3)}` : letter(digit)}</small>
      </span>
    );
  };
  const bar = (
    <span
      key="bar"
      class="divider"
      role="slider"
      tabIndex={0}
      aria-label={t("surface.bar")}
      aria-valuemin={0}
      aria-valuemax={all.length}
      aria-valuenow={now}
      aria-valuetext={t("surface.barAt", { machine: part(split.value.machine_code), tool: part(split.value.tool_code) })}
      onKeyDown={key}
      onPointerDown={(e) => {
        if (e.button !== 0) return;
        e.currentTarget.setPointerCapture(e.pointerId);
        e.currentTarget.focus();
        dragged.current = true;
      }}
      onPointerMove={(e) => dragged.current && follow(e)}
      onPointerUp={() => (dragged.current = false)}
      onPointerCancel={() => (dragged.current = false)}
      data-bar={now}
    >
      <i aria-hidden="true" />
    </span>
  );
  return (
    <div class="chain" ref={row}>
      <span class="side">{t("surface.machineSide")}</span>
      <span class="word machineWord">{all.slice(0, now).map(chip)}</span>
      {bar}
      <span class="word toolWord">{all.slice(now).map((e, i) => chip(e, now + i))}</span>
      <span class="side">{t("surface.toolSide")}</span>
    </div>
  );
}

/** The matrices, symbols and numbers, folded away at first. */
export function Matrices() {
  const surface = answer.value?.surface;
  const motions = surface?.place?.motions;
  if (!surface || !motions) return null;
  return (
    <details class="numbers">
      <summary>{t("surface.matrices")}</summary>
      <div class="matrices">
        {motions.map((m, i) => (
          <figure key={i} data-matrix={m.digit}>
            <figcaption translate={false}>
              <b>
                A{raised(String(m.digit))}({pretty(m.law)})
              </b>{" "}
              = A{raised(String(m.digit))}({fixed(m.value, 4)})
            </figcaption>
            <pre translate={false}>{surface.matrices[i]?.map(pretty).join("\n")}</pre>
            <pre translate={false} class="filled">
              {m.matrix.map((row) => row.map((n) => fixed(n, 4).padStart(9)).join(" ")).join("\n")}
            </pre>
          </figure>
        ))}
      </div>
      <p class="formula" translate={false}>
        r₀ = {pretty(surface.point)}
      </p>
    </details>
  );
}
