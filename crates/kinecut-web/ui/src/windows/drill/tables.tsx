// The numbers of a hole as tables: stretches of one feed, heights from both zeros, and the paper's own beside them.
import type { Signal } from "@preact/signals";
import { Name } from "../../app/verbatim";
import type { Coordinates, Hole, Lengths } from "../../base/drillsheet";
import { fixed, short } from "../../base/format";
import { symbol, t, unit } from "../../words";
import { atWay, stageName } from "./stages";

/** A length as it is printed: three decimals, a minus, and no more. */
const mm = (n: number | null | undefined) => (n === null || n === undefined ? "\u2013" : fixed(n, 3));

export function Zones({ hole, way }: { hole: Hole; way: Signal<number | null> }) {
  const now = way.value === null ? null : atWay(hole.zones, way.value);
  const last = hole.zones[hole.zones.length - 1];
  return (
    <section class="panel" aria-label={t("drill.zones")} tabIndex={-1} data-panel="zones">
      <header>
        <h2>{t("drill.zones")}</h2>
      </header>
      <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t("drill.zones") })}>
        <table data-table="zones">
          <thead>
            <tr>
              <th scope="col">{t("drill.zone")}</th>
              {(["fromZ", "toZ", "length", "feed", "time"] as const).map((key) => (
                <th key={key} scope="col" class="r">
                  {t(`drill.column.${key}`)}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {hole.zones.map((z, i) => (
              <tr key={i} class={now?.index === i ? "on" : ""} data-row={z.stage}>
                <th scope="row">
                  <i class={`swatch zone ${z.stage}`} /> {stageName(z.stage)}
                </th>
                <td class="r">{mm(z.from)}</td>
                <td class="r">{mm(z.to)}</td>
                <td class="r">{mm(z.from - z.to)}</td>
                <td class="r">
                  {short(z.feed)}
                  {z.feed_from !== "given" && (
                    <small class="q" lang="en">
                      {z.feed_from}
                    </small>
                  )}
                </td>
                <td class="r">{fixed(z.time, 3)}</td>
              </tr>
            ))}
          </tbody>
          <tfoot>
            <tr data-row="all">
              <th scope="row">{t("drill.all")}</th>
              <td class="r">{mm(hole.coordinates.Z_nvr1)}</td>
              <td class="r">{mm(last?.to)}</td>
              <td class="r">{mm(hole.lengths.L_rx)}</td>
              <td />
              <td class="r">{fixed(hole.time, 3)}</td>
            </tr>
          </tfoot>
        </table>
      </div>
    </section>
  );
}

/** Heights from the zero of the entry and from that of the exit. */
export function Zeros({ hole }: { hole: Hole }) {
  const { coordinates: c, zones } = hole;
  const through = c.Z_kvyh1 !== null;
  // The zones carry both frames: their difference is the distance of the zeros.
  const between = zones.length > 0 ? zones[0].from_exit_frame - zones[0].from : 0;
  const places: [string, string, number | null, number | null][] = [
    ["start", t("drill.level.start"), c.Z_nvr1, c.Z_nvr1 + between],
    ["full", t("drill.level.full"), c.Z_nvr2, c.Z_nvr2 + between],
    ["through", t("drill.level.through"), c.Z_nvyh1, c.Z_kvyh1],
    ["end", t("drill.level.end"), c.Z_nvyh2 ?? c.Z_end, c.Z_kvyh2],
  ];
  return (
    <section class="panel" aria-label={t("drill.zeros")} tabIndex={-1} data-panel="zeros">
      <header>
        <h2>{t("drill.zeros")}</h2>
      </header>
      <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t("drill.zeros") })}>
        <table data-table="zeros">
          <thead>
            <tr>
              <th scope="col">{t("drill.place")}</th>
              <th scope="col" class="r">
                {t("drill.fromEntry")}
              </th>
              {through && (
                <th scope="col" class="r">
                  {t("drill.fromExit")}
                </th>
              )}
            </tr>
          </thead>
          <tbody>
            {places.filter(([, , h]) => h !== null).map(([key, name, h, k]) => (
              <tr key={key} data-row={key}>
                <th scope="row">{name}</th>
                <td class="r">{mm(h)}</td>
                {through && <td class="r">{mm(k)}</td>}
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

const LENGTHS: (keyof Lengths)[] = ["L_vr1", "L_vr2", "L_nvr", "L_vr", "L_ust", "L_vyh1", "L_vyh2", "L_kvyh", "L_vyh", "L_rx"];
const HEIGHTS: (keyof Coordinates)[] = ["Z_nvr1", "Z_nvr2", "Z_nvyh1", "Z_nvyh2", "Z_kvyh1", "Z_kvyh2"];
/** Lengths that differ by less are the same to the digits shown [mm]. */
const SAME = 5e-4;

function Symbol({ of }: { of: string }) {
  const [letters, below] = symbol(of);
  return (
    <Name class="q">
      {letters}
      {below && <sub>{below}</sub>}
    </Name>
  );
}

/** Beside the exact numbers: those of the paper's formulas, and those that its program prints. */
export function PaperTable({ hole }: { hole: Hole }) {
  const { paper } = hole;
  if (!paper) {
    return (
      <section class="panel" aria-label={t("drill.paper")} tabIndex={-1} data-panel="paper">
        <header>
          <h2>{t("drill.paper")}</h2>
        </header>
        <p class="q pad">{t("drill.noPaper")}</p>
      </section>
    );
  }
  const exact = (stage: string) => hole.zones.filter((z) => z.stage === stage).reduce((sum, z) => sum + z.time, 0);
  const rows: [string, string, number | null, number | null, number | undefined, string][] = [
    ...LENGTHS.map((key): [string, string, number | null, number | null, number | undefined, string] => [key, t(`drill.length.${key}`), hole.lengths[key], paper.lengths[key], paper.printed_lengths[key], "mm"]),
    ...HEIGHTS.map((key): [string, string, number | null, number | null, number | undefined, string] => [key, t(`drill.length.${key as "Z_nvr1"}`), hole.coordinates[key], paper.coordinates[key], paper.printed_lengths[key], "mm"]),
    ...(["entry", "steady", "exit"] as const).map((stage, i): [string, string, number, number, number, string] => [`T_${stage}`, stageName(stage), exact(stage), paper.times[i], paper.printed_times[i], "s"]),
    ["T_all", t("drill.all"), hole.time, paper.times.reduce((a, b) => a + b, 0), paper.printed_times[3], "s"],
  ];
  return (
    <section class="panel" aria-label={t("drill.paper")} tabIndex={-1} data-panel="paper">
      <header>
        <h2>{t("drill.paper")}</h2>
        <Name class="q">Belyakov, Seleznev 2023</Name>
      </header>
      <div class="wide-table" tabIndex={0} role="region" aria-label={t("drill.tableOf", { name: t("drill.paper") })}>
        <table data-table="paper">
          <thead>
            <tr>
              <th scope="col">{t("drill.quantity")}</th>
              <th scope="col" class="r">
                {t("drill.exact")}
              </th>
              <th scope="col" class="r">
                {t("drill.formulas")}
              </th>
              <th scope="col" class="r">
                {t("drill.printed")}
              </th>
              <th scope="col">
                <span class="sr">{t("drill.unit")}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {rows.filter(([, , value]) => value !== null).map(([key, name, value, formula, printed, symbol]) => {
              const differs = (n: number | null | undefined) => n !== null && n !== undefined && value !== null && Math.abs(n - value) >= SAME;
              const cell = (n: number | null | undefined) => (
                <td class={`r${differs(n) ? " differs" : ""}`}>
                  {mm(n)}
                  {differs(n) && <span class="sr"> {t("drill.differs")}</span>}
                </td>
              );
              return (
                <tr key={key} data-row={key}>
                  <th scope="row">
                    {name} {!key.startsWith("T_") && <Symbol of={key} />}
                  </th>
                  <td class="r">{mm(value)}</td>
                  {cell(formula)}
                  {cell(printed)}
                  <td translate={false} class="q">
                    {unit(symbol)}
                  </td>
                </tr>
              );
            })}
          </tbody>
        </table>
      </div>
      <p class="q pad small-print">{t("drill.paperNote")}</p>
    </section>
  );
}
