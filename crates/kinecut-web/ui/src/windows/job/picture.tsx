// A picture of an operation in its numbers: from above and in section, where the kind has one.
import type { Document } from "../../store/document";
import type { Path } from "../../toml/parse";
import { untranslated } from "../../app/verbatim";
import { t } from "../../words";

const numeric = (v: unknown): number | null => (typeof v === "number" && v > 0 ? v : null);

/** Round holes: bores, drills, holes by their size. */
export function Picture({ doc, path }: { doc: Document; path: Path }) {
  const o = doc.value(path) as Record<string, unknown> | undefined;
  const kind = o?.type;
  if (!o || (kind !== "bore" && kind !== "drill" && kind !== "hole")) return null;
  const diameter = numeric(o.diameter) ?? numeric(o.size);
  const depth = numeric(o.depth) ?? numeric(o.length);
  if (diameter === null) return null;
  const below = numeric(o.bottom_diameter) ?? diameter;
  const high = 44;
  const [top, bottom] = [36, (36 * below) / diameter];
  const rough = o.rough as Record<string, unknown> | undefined;
  const step = numeric(rough?.stepover);
  const rings = step === null ? 0 : Math.min(5, Math.max(1, Math.floor(diameter / 2 / step) - 1));
  return (
    <figure>
      <svg viewBox="0 0 228 92" role="img" aria-label={t("form.picture")} {...untranslated}>
        <rect x="10" y="8" width="88" height="76" fill="var(--sunk)" />
        <circle cx="54" cy="46" r="33" fill="var(--stage)" stroke="var(--ink)" stroke-width="1.6" />
        {Array.from({ length: rings }, (_, i) => (
          <circle key={i} cx="54" cy="46" r={(26 * (i + 1)) / rings} fill="none" stroke="var(--rough)" stroke-width="1.2" />
        ))}
        <path d={`M122 28H${170 - top / 1.4}L${170 - bottom / 1.4} ${28 + high}H122ZM218 28H${170 + top / 1.4}L${170 + bottom / 1.4} ${28 + high}H218Z`} fill="var(--sunk)" stroke="var(--ink)" stroke-width="1.4" />
        <path d={`M${170 - top / 1.4} 20H${170 + top / 1.4}M${170 - top / 1.4} 16v8M${170 + top / 1.4} 16v8`} stroke="var(--quiet)" fill="none" />
        <text x="170" y="13" text-anchor="middle" class="w">
          ⌀ {diameter}
        </text>
        {depth !== null && (
          <text x="170" y={28 + high / 2 + 4} text-anchor="middle" class="w">
            {depth}
          </text>
        )}
      </svg>
    </figure>
  );
}
