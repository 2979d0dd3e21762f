// Findings, each with its way to the place; what was not checked and what is to ensure.
import { goTo, programLine } from "../../app/go";
import { Said } from "../../app/verbatim";
import type { Document } from "../../store/document";
import { rangeOf } from "../../store/document";
import { t } from "../../words";

const CLASS: Record<string, string> = { error: "bad", doubt: "np", warning: "np", note: "note" };

export function FindingsPanel({ doc }: { doc: Document }) {
  const all = doc.findings.value;
  const judged = doc.judged.value;
  const verdict = judged && judged.text === doc.text.value && !doc.wrong.value ? judged.verdict : null;
  const worst = all.some((f) => f.severity === "error") ? "bad" : all.some((f) => f.severity === "doubt" || f.severity === "warning") ? "np" : "note";
  return (
    <section class="panel pfind" aria-label={t("panel.findings")} tabIndex={-1} data-panel="findings">
      <header>
        <h2>{t("panel.findings")}</h2>
        <span class={`tag ${worst}`}>{all.length}</span>
      </header>
      <ul class="findings scrolls" tabIndex={0} aria-label={t("panel.findings")}>
        {all.map((finding, i) => {
          const line = programLine(doc, finding);
          const inText = line === null && rangeOf(finding, doc.name, doc.text.value, doc.tree.value) !== null;
          const go = () => {
            doc.finding.value = i;
            goTo(doc, finding);
          };
          const word = line !== null ? t("findings.go", { n: finding.place?.line ?? 0 }) : inText && finding.place?.line ? t("findings.goJob", { n: finding.place.line }) : t("findings.show");
          return (
            <li key={i} class={CLASS[finding.severity]} aria-current={doc.finding.value === i ? "true" : undefined}>
              {(line !== null || inText || finding.point) && (
                <button class="go" onClick={go}>
                  {word}
                </button>
              )}
              <p class="t">
                <b class="no" translate={false}>
                  {i + 1}
                </b>{" "}
                <span class="sr">{t(`findings.severity.${finding.severity}`)}: </span>
                <Said text={finding.message} />
              </p>
              {finding.help && (
                <p class="cure">
                  <Said text={finding.help} />
                </p>
              )}
              <p class="code-of" translate={false}>
                {finding.code}
              </p>
            </li>
          );
        })}
        {all.length === 0 && <li class="note">{t("findings.none")}</li>}
        {verdict && verdict.not_checked.length > 0 && (
          <li class="note">
            <p class="t">{t("findings.notChecked", { n: verdict.not_checked.length })}</p>
            {verdict.not_checked.map((group) => (
              <p class="cure" key={group.heading}>
                <Said text={`${group.heading}: ${group.items.map((i) => i.what).join("; ")}`} />
              </p>
            ))}
          </li>
        )}
        {verdict && verdict.to_ensure.length > 0 && (
          <li class="note">
            <p class="t">{t("findings.ensure")}</p>
            <dl class="ensure" lang="en">
              {verdict.to_ensure.map(({ what, value }) => [<dt key={what}>{what}</dt>, <dd key={`${what}-v`}>{value}</dd>])}
            </dl>
          </li>
        )}
        {verdict && verdict.proven.length > 0 && (
          <li class="note">
            <details>
              <summary>{t("findings.proven", { n: verdict.proven.length })}</summary>
              {verdict.proven.map(({ claim, bound }) => (
                <p class="cure" key={claim}>
                  <Said text={`${claim}. ${bound}`} />
                </p>
              ))}
            </details>
          </li>
        )}
      </ul>
    </section>
  );
}
