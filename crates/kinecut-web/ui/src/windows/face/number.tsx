// A number of the window with its label above.
import { useSignal } from "@preact/signals";
import { Said } from "../../app/verbatim";
import { NumberInput } from "../job/field";

interface Props {
  name: string;
  label: string;
  value: number | null;
  unit: string;
  standard?: string | null;
  whole?: boolean;
  set: (n: number) => void;
  clear?: (() => void) | null;
  /** The sentence of the verb about it. */
  wrong?: string | null;
}

export function Num({ name, label, value, unit, standard = null, whole = false, set, clear = null, wrong = null }: Props) {
  const invalid = useSignal<string | null>(null);
  const id = `face-${name}`;
  const told = invalid.value ?? wrong;
  return (
    <div class={`num${told ? " wrong" : ""}`} data-face={name}>
      <label for={id}>{label}</label>
      <NumberInput id={id} name={label} value={value ?? undefined} standard={standard} unit={unit} whole={whole} set={set} clear={clear} invalid={(text) => (invalid.value = text)} told={told !== null} />
      {told && (
        <p class="told" id={`${id}-told`}>
          {invalid.value ?? <Said text={told} />}
        </p>
      )}
    </div>
  );
}
