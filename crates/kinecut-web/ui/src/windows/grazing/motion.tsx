// The motion in numbers: at both ends of the axis, or as velocity of the tip and turn.
import { useSignal } from "@preact/signals";
import { Said } from "../../app/verbatim";
import type { Document } from "../../store/document";
import { edited } from "../../store/session";
import { t } from "../../words";
import { NumberInput } from "../job/field";
import { rounded, withTwist } from "./question";
import type { Sheet, Vec } from "./sheet";
import type { Looked } from "./state";

const AXES = ["X", "Y", "Z"] as const;
const digits = (n: number) => Number(n.toPrecision(6)) + 0;

interface Row {
  name: "velocity" | "turn" | "tip" | "top";
  value: Vec;
  unit: string;
  set: (v: Vec, axis: number) => void;
}

export function MotionPanel({ doc, looked, sheet, isFixed }: { doc: Document; looked: Looked; sheet: Sheet; isFixed: boolean }) {
  const invalid = useSignal<string | null>(null);
  const write = (twist: { velocity?: Vec; turn?: Vec }) => edited(doc, withTwist(doc.text.peek(), looked.item.peek(), twist));
  const { velocity, turn } = sheet.twist;
  const ends = looked.ends(sheet);
  const rows: Row[] = [
    { name: "velocity", value: velocity, unit: "mm/min", set: (v) => write({ velocity: v, turn: rounded(turn) }) },
    { name: "turn", value: turn, unit: "°/min", set: (v) => write({ velocity: rounded(velocity), turn: v }) },
    { name: "tip", value: ends.tip, unit: "mm/min", set: (v) => looked.drag(sheet, "tip", v, false) },
    { name: "top", value: ends.top, unit: "mm/min", set: (v) => looked.drag(sheet, "top", v, false) },
  ];
  const wrong = doc.wrong.value;
  return (
    <section class="panel motion" aria-label={t("grazing.motion")} tabIndex={-1} data-panel="motion">
      <header>
        <h2>{t("grazing.motion")}</h2>
        <span class="q">
          <Said text={sheet.motion} />
        </span>
      </header>
      {isFixed && <p class="pad q">{t("grazing.fixedMotion")}</p>}
      <div class="vectors">
        {rows.map(({ name, value, unit, set }) => (
          <fieldset key={name} data-vector={name} disabled={isFixed}>
            <legend>{t(`grazing.vector.${name}`, { unit })}</legend>
            {AXES.map((axis, k) => {
              const id = `g-${name}-${axis}`;
              const told = wrong?.key !== undefined && new RegExp(`twist\\.${name}\\[${k}\\]$`).test(wrong.key);
              return (
                <NumberInput
                  key={axis}
                  id={id}
                  name={t("form.axis", { name: t(`grazing.vector.${name}`, { unit }), axis })}
                  value={digits(value[k])}
                  standard={null}
                  unit={axis}
                  whole={false}
                  clear={null}
                  told={told}
                  invalid={(text) => (invalid.value = text)}
                  set={(n) => {
                    const next = value.map(digits) as Vec;
                    next[k] = n;
                    set(next, k);
                  }}
                />
              );
            })}
          </fieldset>
        ))}
      </div>
      {invalid.value && <p class="told pad">{invalid.value}</p>}
    </section>
  );
}
