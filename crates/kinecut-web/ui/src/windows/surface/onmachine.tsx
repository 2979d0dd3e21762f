// What a machine says to the surface: the laws of its axes, or why not.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import * as api from "../../base/api";
import { fixed } from "../../base/format";
import { Name, Said } from "../../app/verbatim";
import { t } from "../../words";
import { type Made, part } from "./answer";
import { isFinding } from "./newest";
import { showMachine } from "./open";
import { alternatives, answer, length, machine, machineFiles, made, madeStale, madeWrong, making, split, told } from "./state";
import { PlainNumber } from "./number";

export interface KnownMachine {
  code: string;
  name: string;
  note: string;
}

export const known = signal<KnownMachine[]>([]);

/** Reads the machines that are known by name, once. */
export function useKnown(): void {
  useEffect(() => {
    if (known.value.length > 0) return;
    api.ask<KnownMachine[]>("machine", {}, new AbortController().signal).then((list) => {
      if (!isFinding(list)) known.value = list;
    }, told);
  }, []);
}

/** A choice of the machines of the folder and those that are known. */
export function Machines({ id, value, none, set }: { id: string; value: string; none: string; set: (name: string) => void }) {
  useKnown();
  return (
    <select id={id} value={value} onChange={(e) => set(e.currentTarget.value)}>
      <option value="">{none}</option>
      {machineFiles.value.length > 0 && (
        <optgroup label={t("surface.machinesFolder")}>
          {machineFiles.value.map((f) => (
            <option key={f.id} value={f.id} translate={false}>
              {f.name}
            </option>
          ))}
        </optgroup>
      )}
      <optgroup label={t("surface.machinesKnown")}>
        {known.value.map((m) => (
          <option key={m.name} value={m.name} translate={false}>
            {m.name} ({m.code})
          </option>
        ))}
      </optgroup>
    </select>
  );
}

export function OnMachine() {
  const told = made.value?.made;
  const s = split.value;
  const own = told?.splits.find((m) => m.machine_code === s?.machine_code && m.tool_code === s?.tool_code);
  return (
    <section class="panel" aria-label={t("surface.onMachine")} tabIndex={-1} data-panel="onMachine">
      <header>
        <h2>{t("surface.onMachine")}</h2>
        {told && madeStale.value && <span class="tag np">{t("surface.older")}</span>}
        {making.value && <span class="waits" />}
      </header>
      <div class="pad">
        <div class="asks">
          <label class="pick" for="surface-machine">
            {t("surface.machine")}
          </label>
          <Machines id="surface-machine" value={machine.value ?? ""} none={t("surface.noMachine")} set={(name) => (machine.value = name || null)} />
          {machine.value && (
            <button class="ghost" onClick={() => showMachine({ machine: machine.value as string })}>
              {t("surface.showMachine")}
            </button>
          )}
        </div>
        {machine.value && (
          <div class="asks">
            <PlainNumber id="length" label={t("surface.toolLength")} name={t("surface.toolLength")} value={length.value === 0 ? null : length.value} standard="0" unit="mm" set={(n) => (length.value = n)} />
            <label class="box">
              <input type="checkbox" checked={alternatives.value} onChange={(e) => (alternatives.value = e.currentTarget.checked)} data-alternatives />
              {t("surface.alternatives")}
            </label>
          </div>
        )}
        {madeWrong.value && (
          <p role="alert" class="bad" data-machine-wrong>
            <Said text={madeWrong.value.message} /> {madeWrong.value.help && <Said text={madeWrong.value.help} />}
          </p>
        )}
        {machine.value === null && <p class="q">{t("surface.askMachine")}</p>}
        {own && (
          <div data-aged={madeStale.value || undefined}>
            <Answered of={own} />
          </div>
        )}
        {told && !own && s && <p class="q">{t("surface.notAsked")}</p>}
      </div>
      {told && <Table />}
    </section>
  );
}

function Answered({ of }: { of: Made }) {
  return (
    <div data-made={of.possible ? "yes" : "no"}>
      <p>
        <span class={`tag ${of.possible ? "safe" : "bad"}`}>{t(of.possible ? "surface.can" : "surface.cannot")}</span>{" "}
        <b translate={false}>
          {part(of.machine_code)} | {part(of.tool_code)}
        </b>
      </p>
      {of.laws.length > 0 && (
        <ul class="laws" lang="en">
          {of.laws.map((l) => (
            <li key={l}>{l}</li>
          ))}
        </ul>
      )}
      {of.residual && <p class="q">{t("surface.residual", { least: fixed(of.residual.least_um, 3), most: fixed(of.residual.greatest_um, 3), reached: of.coverage ? fixed(100 * of.coverage.share, 1) : "\u2013" })}</p>}
      {of.obstacle && (
        <p class="bad">
          <Said text={of.obstacle.message} /> {of.obstacle.help && <Said text={of.obstacle.help} />}
        </p>
      )}
      {of.nearest && (
        <ul class="laws">
          {of.nearest.machines.length === 0 && <li>{t("surface.nearestNone", { n: of.nearest.layouts })}</li>}
          {of.nearest.machines.map((m) => (
            <li key={m.code}>
              <button class="ghost" onClick={() => showMachine({ layout: m.code })} data-nearest={m.code}>
                <Name>{m.code}</Name>
              </button>{" "}
              <Said text={m.changes.join(", ")} />
            </li>
          ))}
        </ul>
      )}
    </div>
  );
}

/** All redistributions and envelopes on the machine. */
function Table() {
  const told = made.value?.made;
  if (!told || !answer.value) return null;
  return (
    <div class="wide" tabIndex={0} role="region" aria-label={t("surface.onMachineAll")} data-aged={madeStale.value || undefined}>
      <table>
        <thead>
          <tr>
            <th scope="col">{t("surface.division")}</th>
            <th scope="col">{t("surface.process")}</th>
            <th scope="col">{t("surface.machine")}</th>
          </tr>
        </thead>
        <tbody lang="en">
          {told.splits.map((m) => (
            <tr key={`${m.machine_code}|${m.tool_code}`} aria-selected={m.machine_code === split.value?.machine_code && m.tool_code === split.value?.tool_code}>
              <th scope="row" translate={false}>
                {part(m.machine_code)} | {part(m.tool_code)}
              </th>
              <td>{m.process}</td>
              <td>
                <span class={`tag ${m.possible ? "safe" : "bad"}`}>{t(m.possible ? "surface.can" : "surface.cannot")}</span>
              </td>
            </tr>
          ))}
          {told.envelopes.map((e) => (
            <tr key={e.process}>
              <th scope="row">{e.method}</th>
              <td>
                {e.process}, {e.tool}
              </td>
              <td>
                <span class={`tag ${e.possible ? "safe" : "bad"}`}>{t(e.possible ? "surface.can" : "surface.cannot")}</span>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
