// The numbers of a pass as the paper has them, and its records.
import type { ComponentChildren } from "preact";
import { Name } from "../../app/verbatim";
import { fixed } from "../../base/format";
import { t } from "../../words";
import type { Key } from "../../words/en";
import type { Pass } from "./answer";

interface Row {
  name: string;
  /** Symbol of the paper. */
  symbol: ComponentChildren;
  value: string;
  unit: string;
  note?: string;
}

const sub = (letter: string, index: string) => (
  <>
    {letter}
    <sub>{index}</sub>
  </>
);

function rowsOf(pass: Pass): Row[] {
  const { figure } = pass;
  const rows: Row[] = [
    { name: "radius", symbol: "R", value: fixed(pass.path_radius, 3), unit: "mm" },
    { name: "turns", symbol: "n", value: fixed(pass.whole_turns, 0), unit: "" },
    { name: "step", symbol: "H", value: fixed(pass.step, 3), unit: "mm" },
  ];
  const r = pass.base_radius > 0 ? pass.base_radius : figure?.base_radius;
  if (r !== undefined && r > 0) rows.push({ name: "base", symbol: "r", value: fixed(r, 6), unit: "mm" });
  if (figure && pass.pass === "finish") {
    const [x, y] = figure.start;
    rows.push(
      { name: "distance", symbol: "ρ", value: fixed(Math.hypot(x, y), 3), unit: "mm" },
      { name: "roll", symbol: sub("φ", "0"), value: fixed(pass.roll, 5), unit: "rad" },
      { name: "psi", symbol: "ψ", value: fixed(figure.psi, 6), unit: "rad" },
      { name: "theta", symbol: sub("θ", "0"), value: fixed(pass.roll + figure.psi, 5), unit: "rad" },
      { name: "touchX", symbol: sub("T", "ψ X"), value: fixed(figure.touch[0], 3), unit: "mm" },
      { name: "touchY", symbol: sub("T", "ψ Y"), value: fixed(figure.touch[1], 3), unit: "mm" },
      { name: "startRadius", symbol: sub("R", "n"), value: fixed(pass.start_curvature_radius, 3), unit: "mm" },
      { name: "visible", symbol: sub("n", "в"), value: fixed(pass.turns, 4), unit: "", note: t("hole.byFormula", { n: fixed(figure.visible_turns_formula, 4) }) },
    );
  }
  rows.push(
    { name: "length", symbol: "L", value: fixed(pass.length, 3), unit: "mm" },
    { name: "circle", symbol: "2πR", value: fixed(pass.circle_length, 3), unit: "mm" },
  );
  return rows;
}

export function Numbers({ pass }: { pass: Pass }) {
  return (
    <section class="panel" aria-label={t("hole.paper")} tabIndex={-1} data-panel="paper">
      <header>
        <h2>{t("hole.paper")}</h2>
      </header>
      <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t("hole.paper") })}>
        <table data-table="paper">
          <thead>
            <tr>
              <th scope="col">{t("drill.quantity")}</th>
              <th scope="col">{t("hole.symbol")}</th>
              <th scope="col" class="r">{t("hole.value")}</th>
              <th scope="col">{t("drill.unit")}</th>
            </tr>
          </thead>
          <tbody>
            {rowsOf(pass).map(({ name, symbol, value, unit, note }) => (
              <tr key={name} data-row={name}>
                <th scope="row">
                  {t(`hole.number.${name}` as Key)}
                  {note && <small>{note}</small>}
                </th>
                <td translate={false}>{symbol}</td>
                <td class="r" translate={false}>{value}</td>
                <td translate={false}>{unit}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <Records pass={pass} />
    </section>
  );
}

/** The curves as records of six numbers. */
function Records({ pass }: { pass: Pass }) {
  const radius = (r: number | null) => (r === null ? "\u221e" : fixed(r, 3));
  return (
    <details class="records">
      <summary>{t("hole.records")}</summary>
      <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t("hole.records") })}>
        <table data-table="records">
          <thead>
            <tr translate={false}>
              <th scope="col">#</th>
              <th scope="col" class="r">L</th>
              <th scope="col" class="r">{sub("x", "0")}</th>
              <th scope="col" class="r">{sub("y", "0")}</th>
              <th scope="col" class="r">{sub("θ", "0")}</th>
              <th scope="col" class="r">{sub("R", "n")}</th>
              <th scope="col" class="r">{sub("R", "k")}</th>
            </tr>
          </thead>
          <tbody translate={false}>
            {pass.curves.map((c, i) => (
              <tr key={i} data-row={i}>
                <th scope="row">{i + 1}</th>
                <td class="r">{fixed(c.length, 3)}</td>
                <td class="r">{fixed(c.start[0], 3)}</td>
                <td class="r">{fixed(c.start[1], 3)}</td>
                <td class="r">{fixed(c.start_angle, 5)}</td>
                <td class="r">{radius(c.start_radius)}</td>
                <td class="r">{radius(c.end_radius)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {pass.curve_count > pass.curves.length && <p class="q pad small-print">{t("hole.moreCurves", { n: pass.curve_count - pass.curves.length })}</p>}
      <p class="q pad small-print">
        {t("hole.recordsNote")} <Name>mm, rad</Name>
      </p>
    </details>
  );
}
