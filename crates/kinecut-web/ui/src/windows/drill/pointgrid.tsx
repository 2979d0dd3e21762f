// The point of the drill by pictures.
import { useMemo } from "preact/hooks";
import type { Document } from "../../store/document";
import { t } from "../../words";
import { NUMBERS, POINTS, type PointKind, begin, heightOf, lipOf, outline, silhouette } from "./points";
import { choosePoint, questionOf } from "./question";
import { arrows } from "./radios";

/** Diameter in which the pictures are drawn [px], and the height of the body. */
const [WIDE, BODY] = [44, 34];
const COLUMNS = 4;

function Picture({ kind }: { kind: PointKind }) {
  return useMemo(() => picture(kind), [kind]);
}

function picture(kind: PointKind) {
  const value = begin(kind, WIDE, {});
  const numbers = typeof value === "object" && !Array.isArray(value) ? (Object.values(value)[0] as Record<string, unknown>) : {};
  const half = outline({ kind, numbers }, WIDE);
  if (!half) return null;
  const lip = lipOf({ kind, numbers }, WIDE, BODY);
  const up = Math.max(BODY, heightOf(half) + 8);
  const scale = BODY / up;
  const path = (places: [number, number][]) => places.map(([r, z], i) => `${i ? "L" : "M"}${(28 + scale * r).toFixed(1)} ${(40 - scale * z).toFixed(1)}`).join("");
  const rings = lip ? [lip] : silhouette(kind, half, up);
  return (
    <svg viewBox="0 0 56 44" aria-hidden="true">
      {rings.map((ring, i) => (
        <path key={i} d={`${path(ring)}Z`} class="point" />
      ))}
      {(kind === "auger" || kind === "ejector") && <path d={kind === "auger" ? "M6 20L50 8M6 27L50 15" : "M20 6V25M36 6V25"} class="flutes" />}
      <path d="M28 3V43" class="axis" />
    </svg>
  );
}

export function PointGrid({ doc }: { doc: Document }) {
  const { point } = questionOf(doc.values.value);
  const chosen = point ? POINTS.indexOf(point.kind) : -1;
  const pick = (index: number) => choosePoint(doc, POINTS[index]);
  return (
    <section class="panel points" aria-label={t("drill.point")} tabIndex={-1} data-panel="point">
      <header>
        <h2>{t("drill.point")}</h2>
        <span class="q sp">{t("drill.pointKinds", { n: POINTS.length })}</span>
      </header>
      <div class="pad">
        <div class="grid" role="radiogroup" aria-label={t("drill.point")} onKeyDown={(e) => arrows(e, { count: POINTS.length, columns: COLUMNS, chosen, choose: pick })}>
          {POINTS.map((kind, i) => (
            <button
              key={kind}
              class={i === chosen ? "on" : ""}
              role="radio"
              aria-checked={i === chosen}
              tabIndex={i === chosen || (chosen < 0 && i === 0) ? 0 : -1}
              data-point={kind}
              title={NUMBERS[kind].map((key) => t(`drill.number.${key}` as "drill.number.point_angle")).join(", ")}
              onClick={() => pick(i)}
            >
              <Picture kind={kind} />
              <span>{t(`drill.kind.${kind}`)}</span>
              <small class="q">{t("drill.numbers", { n: NUMBERS[kind].length })}</small>
            </button>
          ))}
        </div>
      </div>
    </section>
  );
}
