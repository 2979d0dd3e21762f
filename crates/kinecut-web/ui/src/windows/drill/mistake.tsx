// A mistake: its sentence, and the way to its field.
import { Said } from "../../app/verbatim";
import type * as api from "../../base/api";
import { type Document, keyOf } from "../../store/document";
import { t } from "../../words";
import { fieldsOf } from "./strip";

/** The sentence above all numbers; the same sentence is at the field. */
export function Wrong({ doc, place }: { doc: Document; place: [number, number] }) {
  const wrong = doc.wrong.value as api.Finding;
  const keys = fieldsOf(doc, place).map(({ path }) => keyOf(path));
  const atField = wrong.key !== undefined && keys.includes(wrong.key);
  return (
    <div class="across wrong" role="alert" data-at={wrong.key ?? ""}>
      <div>
        {t("drill.noPlan")} <Said text={wrong.message} />
        {wrong.help && (
          <p class="q">
            <Said text={wrong.help} />
          </p>
        )}
      </div>
      {atField && (
        <button onClick={() => document.getElementById(`f-${wrong.key}`)?.focus()}>{t("drill.toField")}</button>
      )}
    </div>
  );
}
