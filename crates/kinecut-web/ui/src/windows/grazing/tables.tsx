// The curves and their spans in numbers; a row that is chosen is marked on the tool and in the plane.
import { Name } from "../../app/verbatim";
import { fixed } from "../../base/format";
import { t } from "../../words";
import { KINDS, type Sheet, type Span } from "./sheet";
import type { Looked } from "./state";

function parameter(sheet: Sheet, span: Span, end: 0 | 1): string {
  const unit = sheet.pieces[span.piece].parameter === "mm" ? " mm" : "°";
  return fixed(end === 0 ? span.from : span.to, 4) + unit;
}

export function Spans({ sheet, looked }: { sheet: Sheet; looked: Looked }) {
  return (
    <section class="panel spans" aria-label={t("grazing.spans")} tabIndex={-1} data-panel="spans">
      <header>
        <h2>{t("grazing.spans")}</h2>
        <span class="q">{t("grazing.spansHow")}</span>
      </header>
      <div class="wide" tabIndex={0} role="region" aria-label={t("grazing.spansTable")}>
        <table data-table="spans">
          <thead>
            <tr>
              <th scope="col">{t("grazing.col.piece")}</th>
              <th scope="col">{t("grazing.col.kind")}</th>
              <th scope="col" class="n">{t("grazing.col.curve")}</th>
              <th scope="col" class="n">{t("grazing.col.from")}</th>
              <th scope="col" class="n">{t("grazing.col.to")}</th>
              <th scope="col" class="n">{t("grazing.col.plus")}</th>
              <th scope="col" class="n">{t("grazing.col.minus")}</th>
            </tr>
          </thead>
          <tbody>
            {sheet.loops.flatMap((loop, l) =>
              sheet.spans.slice(loop.spans[0], loop.spans[1]).map((span, i) => {
                const index = loop.spans[0] + i;
                const on = looked.span.value === index;
                const end = (k: 0 | 1) => (
                  <td class="n">
                    <Name>{parameter(sheet, span, k)}</Name> {span.folds[k] && <span class="tag note">{t("grazing.fold")}</span>}
                  </td>
                );
                return (
                  <tr key={index} aria-selected={on} data-row={index}>
                    <th scope="row">
                      <button class="ghost" aria-pressed={on} onClick={() => (looked.span.value = on ? null : index)}>
                        <Name>{sheet.pieces[span.piece].what}</Name>
                      </button>
                    </th>
                    <td>
                      <svg width="22" height="6" aria-hidden="true">
                        <path class={`curve kind${KINDS.indexOf(span.kind)}`} d="M0 3h22" />
                      </svg>{" "}
                      {t(`grazing.kind.${span.kind}`)}
                    </td>
                    <td class="n" translate={false}>
                      {l + 1}
                    </td>
                    {end(0)}
                    {end(1)}
                    <td class="n" translate={false}>
                      {fixed(span.lengths[0], 6)}
                    </td>
                    <td class="n" translate={false}>
                      {fixed(span.lengths[1], 6)}
                    </td>
                  </tr>
                );
              }),
            )}
          </tbody>
        </table>
      </div>
    </section>
  );
}

export function Loops({ sheet }: { sheet: Sheet }) {
  const sum = sheet.loops.reduce((n, loop) => n + loop.winding, 0);
  return (
    <section class="panel" aria-label={t("grazing.loops")} tabIndex={-1} data-panel="loops">
      <header>
        <h2>{t("grazing.loops")}</h2>
      </header>
      <div class="wide" tabIndex={0} role="region" aria-label={t("grazing.loopsTable")}>
        <table data-table="loops">
          <thead>
            <tr>
              <th scope="col" class="n">{t("grazing.col.curve")}</th>
              <th scope="col">{t("grazing.col.closed")}</th>
              <th scope="col" class="n">{t("grazing.col.winding")}</th>
              <th scope="col" class="n">{t("grazing.col.length")}</th>
              <th scope="col" class="n">{t("grazing.col.spans")}</th>
            </tr>
          </thead>
          <tbody>
            {sheet.loops.map((loop, i) => (
              <tr key={i}>
                <th scope="row" class="n" translate={false}>
                  {i + 1}
                </th>
                <td>{t(loop.closed ? "grazing.yes" : "grazing.no")}</td>
                <td class="n" translate={false}>
                  {loop.winding}
                </td>
                <td class="n" translate={false}>
                  {fixed(loop.length, 6)}
                </td>
                <td class="n" translate={false}>
                  {loop.spans[1] - loop.spans[0]}
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <p class="q pad">
        {sheet.loops.length === 0 ? t("grazing.noCurve") : sheet.twist.velocity[2] !== 0 ? t("grazing.odd", { n: sum }) : t("grazing.sum", { n: sum })}
      </p>
    </section>
  );
}
