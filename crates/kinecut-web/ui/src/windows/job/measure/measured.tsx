// The strip below the part while one measures: what was picked, and what can be made of it.
import { Name } from "../../../app/verbatim";
import { fixed, short } from "../../../base/format";
import type { Document } from "../../../store/document";
import { t } from "../../../words";
import { type Face, between, betweenAxes, parallel } from "./face";
import { isUpright, kindOf, make } from "./make";
import type { RoundFace } from "./round";
import { type Pick, inView, inspected, measuring, picks, toggleMeasure } from "./picks";

const DIGITS = 3;
const mm = (n: number) => `${fixed(n, DIGITS)} mm`;

/** Height of the stock of a job as its text has it: of a block or bar. */
function stockTop(doc: Document): number | null {
  const stock = doc.values.value.stock as { box?: { max?: number[] }; cylinder?: { top?: number } } | undefined;
  const top = stock?.box?.max?.[2] ?? stock?.cylinder?.top;
  return typeof top === "number" ? top : null;
}

export function Measured({ doc }: { doc: Document }) {
  if (!measuring.value) return null;
  const [a, b] = picks.value;
  const shown = inView.value;
  return (
    <section class="measured" aria-label={t("part.measure")} role="region" tabIndex={0}>
      <div role="status" aria-live="polite" class="told">
        {!a && <p>{t("measure.how")}</p>}
        {a && b && <Between a={a} b={b} />}
        {a && <Place name="A" pick={a} doc={doc} />}
        {b && <Place name="B" pick={b} doc={doc} />}
        {a && !b && <p class="q">{t("measure.second")}</p>}
        {a && shown && (
          <p class="q">
            {shown.step === null ? t("measure.planned") : t("measure.step", { step: short(shown.step) })}
            {shown.text !== doc.text.value && ` ${t("measure.older")}`}
          </p>
        )}
      </div>
      <button class="ghost icon" aria-label={t("measure.end")} title={t("measure.end")} onClick={toggleMeasure}>
        <span aria-hidden="true">×</span>
      </button>
    </section>
  );
}

function Place({ name, pick, doc }: { name: string; pick: Pick; doc: Document }) {
  const [x, y, z] = pick.point.map((n) => fixed(n, DIGITS));
  return (
    <p>
      <b translate={false}>{name}</b> <Name class="xyz">{`X ${x} Y ${y} Z ${z}`}</Name> {told(pick.face)} <Makes doc={doc} face={pick.face} />
    </p>
  );
}

/** A face in words, with how far its corners are from what is said. */
function told(face: Face | null): string {
  if (!face) return t("measure.bent");
  // Rounded up: it is a bound.
  const off = fixed(Math.max(1, Math.ceil(1000 * face.off - 1e-6)) / 1000, DIGITS);
  if (face.kind === "round") {
    if (face.axis[2] < 1) return t(face.hollow ? "measure.holeAlong" : "measure.bossAlong", along(face, off));
    const [x, y] = face.centre.map((n) => fixed(n, DIGITS));
    return t(face.hollow ? "measure.hole" : "measure.boss", { d: fixed(2 * face.radius, DIGITS), x, y, bottom: fixed(face.bottom, DIGITS), top: fixed(face.top, DIGITS), off });
  }
  const axis = face.normal.findIndex((n) => Math.abs(n) > 1 - 1e-4);
  if (axis >= 0) return t("measure.plane", { axis: "XYZ"[axis], at: fixed(face.point[axis], DIGITS), off });
  return t("measure.slant", { x: fixed(face.normal[0], DIGITS), y: fixed(face.normal[1], DIGITS), z: fixed(face.normal[2], DIGITS), off });
}

/** A round wall about an axis of any direction: its axis by a name or a vector, with the middle of the wall. */
function along(face: RoundFace, off: string): Record<string, string> {
  const k = face.axis.findIndex((n) => n === 1);
  const half = (face.bottom + face.top) / 2;
  const [x, y, z] = face.centre.map((c, i) => fixed(c + half * face.axis[i], DIGITS));
  const axis = k >= 0 ? "XYZ"[k] : `(${face.axis.map((n) => fixed(n, DIGITS + 1)).join(", ")})`;
  return { d: fixed(2 * face.radius, DIGITS), axis, x, y, z, length: fixed(face.top - face.bottom, DIGITS), off };
}

function Between({ a, b }: { a: Pick; b: Pick }) {
  const [dx, dy, dz] = [0, 1, 2].map((k) => b.point[k] - a.point[k]);
  const [f, g] = [a.face, b.face];
  const found = inspected.value;
  const material = found?.measures[0]?.stretches.filter((s) => s.material) ?? [];
  const bound = material.reduce<number | null>((sum, s) => (sum === null || s.within === null ? null : sum + s.within), 0);
  const rows: [string, string][] = [
    [t("measure.distance"), mm(Math.hypot(dx, dy, dz))],
    ["dX", mm(dx)],
    ["dY", mm(dy)],
    ["dZ", mm(dz)],
  ];
  if (f?.kind === "plane" && g?.kind === "plane" && parallel(f, g)) rows.push([t("measure.planes"), mm(between(f, g))]);
  if (f?.kind === "round" && g?.kind === "round") rows.push([t("measure.axes"), mm(betweenAxes(f, g))]);
  const inside = material.reduce((n, s) => n + s.length, 0);
  // Less than is known of the surface at both ends says nothing, as of a line along a face.
  const known = found !== null && inside > 2 * found.within;
  if (known) {
    const sum = mm(inside);
    rows.push([t("measure.material"), bound === null ? t("measure.unbound", { sum }) : t("measure.within", { sum, bound: fixed(bound, DIGITS) })]);
  }
  return (
    <dl>
      {rows.map(([name, value], i) => (
        <div key={name}>
          <dt translate={i === 0 || i > 3}>{name}</dt>
          <dd translate={i > 3 && i === rows.length - 1 && known}>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

/** The operation that can be made of a face, or why none. */
function Makes({ doc, face }: { doc: Document; face: Face | null }) {
  const kind = kindOf(face);
  if (doc.kind !== "job" || !face || !kind) return null;
  if (!isUpright(doc)) return <span class="q">{t("measure.turned")}</span>;
  return (
    <button class="small" onClick={() => make(doc, face, stockTop(doc) ?? (face.kind === "plane" ? face.point[2] : 0))}>{t(kind === "face" ? "measure.makeFace" : "measure.makeBore")}</button>
  );
}
