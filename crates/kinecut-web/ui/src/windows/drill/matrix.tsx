// Entry and exit by pictures: seven surfaces into the part, seven out of it, and the hole that ends in it.
import { useSignal } from "@preact/signals";
import { useMemo } from "preact/hooks";
import type { Document } from "../../store/document";
import { t } from "../../words";
import { KINDS, type Kind, NEEDS, type Side } from "./faces";
import { choose, kinds, questionOf } from "./question";
import { arrows } from "./radios";

const EXITS: (Kind | "blind")[] = [...KINDS, "blind"];

/** Radius of the cylinders on the pictures [px]. */
const ROUND = 27;

/** Height of a surface on a picture of 40 px, from its middle up. */
function rise(kind: Kind, side: Side, u: number): number {
  const arc = (offset: number) => ROUND - Math.sqrt(ROUND * ROUND - (u + offset) ** 2);
  const ridge = side === "entry" ? -1 : 1;
  switch (kind) {
    case "square":
      return 0;
    case "falling":
      return -0.3 * u;
    case "rising":
      return 0.3 * u;
    case "shaft":
      return ridge * arc(0) + ridge * -3;
    case "shaftBeside":
      return ridge * arc(7) + ridge * -4;
    case "bore":
      return -ridge * arc(0) - ridge * -3;
    case "boreBeside":
      return -ridge * arc(7) - ridge * -4;
  }
}

function line(kind: Kind, side: Side, middle: number): string[] {
  return Array.from({ length: 17 }, (_, i) => -16 + 2 * i).map((u) => `${20 + u} ${(middle - rise(kind, side, u)).toFixed(1)}`);
}

function Alone({ kind, side }: { kind: Kind | "blind"; side: Side }) {
  return useMemo(() => alone(kind, side), [kind, side]);
}

function alone(kind: Kind | "blind", side: Side) {
  if (kind === "blind") {
    return (
      <svg viewBox="0 0 40 40" aria-hidden="true">
        <path d="M4 6H12V24L20 30L28 24V6H36V36H4Z" class="met" />
      </svg>
    );
  }
  const edge = line(kind, side, side === "entry" ? 20 : 22);
  const back = side === "entry" ? "L36 38L4 38Z" : "L36 4L4 4Z";
  return (
    <svg viewBox="0 0 40 40" aria-hidden="true">
      <path d={`M${edge.join("L")}${back}`} class="ground" />
      <path d={`M${edge.join("L")}`} class="surface" />
    </svg>
  );
}

function Pair({ entry, exit }: { entry: Kind; exit: Kind | "blind" }) {
  return useMemo(() => pairPicture(entry, exit), [entry, exit]);
}

function pairPicture(entry: Kind, exit: Kind | "blind") {
  const above = line(entry, "entry", 12);
  const below = exit === "blind" ? ["4 36", "36 36"] : line(exit, "exit", 29);
  return (
    <svg viewBox="0 0 40 40" aria-hidden="true">
      <path d={`M${above.join("L")}L${[...below].reverse().join("L")}Z`} class="met" />
      <path d={exit === "blind" ? "M20 2V26" : "M20 2V38"} class="axis" />
      {exit === "blind" && <path d="M16 24L20 28L24 24" class="axis whole" />}
    </svg>
  );
}

function faceName(kind: Kind | "blind" | null): string {
  return kind === null ? t("drill.face.none") : t(`drill.face.${kind}`);
}

/** A surface in words, with the numbers that it needs. */
function told(kind: Kind | "blind" | null): string {
  const needs = kind === null ? [] : kind === "blind" ? (["depth"] as const) : NEEDS[kind];
  if (needs.length === 0) return faceName(kind);
  return t("drill.needs", { name: faceName(kind), numbers: needs.map((key) => t(`drill.number.${key}`)).join(", ") });
}

/** So many numbers belong to a surface: on its picture, where one sees what one takes on. */
function Count({ kind }: { kind: Kind | "blind" }) {
  const count = kind === "blind" ? 1 : NEEDS[kind].length;
  return (
    <small translate={false} aria-hidden="true">
      {count > 0 ? `+${count}` : "\u00a0"}
    </small>
  );
}

export function Matrix({ doc, place }: { doc: Document; place: [number, number] }) {
  const question = questionOf(doc.values.value);
  const now = kinds(question, place);
  const over = useSignal<[Kind, Kind | "blind"] | null>(null);
  const chosen = now.entry !== null && now.exit !== null ? KINDS.indexOf(now.entry) * EXITS.length + EXITS.indexOf(now.exit) : -1;
  const pick = (index: number) => choose(doc, KINDS[Math.floor(index / EXITS.length)], EXITS[index % EXITS.length], place);
  const [entry, exit] = over.value ?? [now.entry, now.exit];
  return (
    <section class="panel matrix" aria-label={t("drill.surfaces")} tabIndex={-1} data-panel="surfaces">
      <header>
        <h2>{t("drill.surfaces")}</h2>
        <span class="q sp">{t("drill.pairs", { n: KINDS.length * KINDS.length })}</span>
      </header>
      <div class="pad">
        <p class="between" aria-hidden="true">
          <span>↓ {t("drill.entry")}</span>
          <span>{t("drill.exit")} →</span>
        </p>
        <div
          class="grid"
          role="radiogroup"
          aria-label={t("drill.surfaces")}
          onKeyDown={(e) => arrows(e, { count: KINDS.length * EXITS.length, columns: EXITS.length, chosen, choose: pick })}
          onPointerLeave={() => (over.value = null)}
        >
          <span />
          {EXITS.map((kind) => (
            <span key={kind} class={`h${kind === now.exit ? " lit" : ""}`} title={t("drill.exitIs", { name: told(kind) })}>
              <Alone kind={kind} side="exit" />
              <Count kind={kind} />
            </span>
          ))}
          {KINDS.map((row, r) => [
            <span key={row} class={`h${row === now.entry ? " lit" : ""}`} title={t("drill.entryIs", { name: told(row) })}>
              <Alone kind={row} side="entry" />
              <Count kind={row} />
            </span>,
            ...EXITS.map((column, c) => {
              const index = r * EXITS.length + c;
              const isOn = index === chosen;
              return (
                <button
                  key={`${row} ${column}`}
                  class={`c${isOn ? " on" : row === now.entry || column === now.exit ? " lit" : ""}`}
                  role="radio"
                  aria-checked={isOn}
                  tabIndex={isOn || (chosen < 0 && index === 0) ? 0 : -1}
                  data-pair={`${row} ${column}`}
                  aria-label={t("drill.pair", { entry: faceName(row), exit: faceName(column) })}
                  onClick={() => pick(index)}
                  onPointerEnter={() => (over.value = [row, column])}
                >
                  <Pair entry={row} exit={column} />
                </button>
              );
            }),
          ])}
        </div>
        <dl class={`chosen${over.value ? " q" : ""}`}>
          <div>
            <dt>{t("drill.entry")}</dt>
            <dd>{question.ofMesh ? t("drill.ofMesh") : told(entry)}</dd>
          </div>
          <div>
            <dt>{t("drill.exit")}</dt>
            <dd>
              {question.ofMesh && question.exit === undefined ? t("drill.ofMesh") : told(exit)}
              {question.exit === "same" && !over.value ? ` ${t("drill.same")}` : ""}
            </dd>
          </div>
        </dl>
        <p class="q small-print">{t("drill.counts")}</p>
      </div>
    </section>
  );
}
