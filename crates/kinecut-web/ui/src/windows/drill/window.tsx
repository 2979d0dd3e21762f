// The window of a drilling: surfaces and point by pictures, numbers, and all that follows from them.
import { effect, signal, useSignal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { offer } from "../../app/commands";
import { Name, Said } from "../../app/verbatim";
import * as api from "../../base/api";
import { isHole } from "../../base/drillsheet";
import { short, timeOfDay } from "../../base/format";
import type { Schema } from "../../schema/schema";
import type { Document } from "../../store/document";
import { edited, tell } from "../../store/session";
import { parse, plain } from "../../toml/parse";
import { t } from "../../words";
import { Acts } from "./acts";
import { drilled } from "./drilled";
import { kindOf } from "./faces";
import { Load } from "./load";
import { Matrix } from "./matrix";
import { Wrong } from "./mistake";
import { drawingsOf } from "./page";
import { PointGrid } from "./pointgrid";
import { exitFace, questionOf } from "./question";
import { Rest } from "./rest";
import { Blocks, Facts, Findings } from "./results";
import { SectionPanel } from "./sectionpanel";
import { Strip } from "./strip";
import { PaperTable, Zeros, Zones } from "./tables";
import { Undo } from "./undo";

const schema = signal<Schema | null>(null);

/** A plan that takes longer makes what is shown old [ms]. */
const LATE = 100;

export function DrillWindow({ doc }: { doc: Document }) {
  const late = useSignal(false);
  const chosen = useSignal(0);
  const way = useSignal<number | null>(null);
  const undo = Undo.of(doc);

  useEffect(() => {
    if (!schema.value) {
      api.schema("drill").then((known) => (schema.value = known as Schema)).catch((error: unknown) => tell(error instanceof Error ? error.message : String(error)));
    }
    const back = (by: -1 | 1) => () => {
      const text = undo.go(by);
      if (text !== null) edited(doc, text);
    };
    offer({ id: "command.undo", keys: ["Ctrl+Z"], run: back(-1) }, { id: "command.redo", keys: ["Ctrl+Y", "Ctrl+Shift+Z"], run: back(1) });
    let timer = 0;
    const ends = [
      effect(() => undo.note(doc.text.value)),
      effect(() => {
        clearTimeout(timer);
        if (!doc.planning.value) late.value = false;
        else timer = window.setTimeout(() => (late.value = true), LATE);
      }),
    ];
    return () => {
      clearTimeout(timer);
      for (const end of ends) end();
    };
  }, [doc]);

  const known = drilled(doc);
  const holes = known?.answer.holes.filter(isHole) ?? [];
  const hole = holes[Math.min(chosen.value, holes.length - 1)];
  const refused = known?.answer.holes.filter((h) => !isHole(h)) ?? [];
  const wrong = doc.wrong.value;
  const isOld = known !== null && known.text !== doc.text.value && (!doc.planning.value || late.value);
  const state = doc.planning.value ? "planning" : wrong || doc.refused.value ? "wrong" : known?.text === doc.text.value ? "done" : "planning";
  const place: [number, number] = hole?.at ?? [0, 0];
  const question = questionOf(doc.values.value);
  const drawings = useMemo(() => (known?.page ? drawingsOf(known.page) : []), [known?.page]);
  // The drawing is of the text that was planned.
  const drawn = useMemo(() => (known ? questionOf(planned(known.text)) : question), [known?.text]);

  return (
    <main class="drilling" data-state={state}>
      <div class="head">
        <h1>{heading(question, place)}</h1>
        {known && (
          <span class="q">
            <span lang="en">{known.answer.point}</span>, <Name>{known.answer.control}</Name>
          </span>
        )}
        <div class="acts">
          {holes.length > 1 && (
            <select aria-label={t("drill.whichHole")} value={chosen.value} onChange={(e) => (chosen.value = Number(e.currentTarget.value))}>
              {holes.map((h, i) => (
                <option key={h.number} value={i}>
                  {t("drill.hole", { n: h.number + 1, of: known?.answer.holes.length ?? 0 })}
                </option>
              ))}
            </select>
          )}
          <Acts doc={doc} hole={isOld || question.ofMesh ? undefined : hole} />
        </div>
      </div>
      {wrong && <Wrong doc={doc} place={place} />}
      {doc.refused.value && <p class="across" role="alert"><Said text={doc.refused.value} /></p>}
      {isOld && known && (
        <p class="oldness" role="status">
          {t("drill.old", { time: timeOfDay(known.at) })}
        </p>
      )}
      {hole && <Facts hole={hole} old={isOld} speed={drawn.speed} diameter={known?.answer.diameter ?? NaN} />}
      {schema.value && <Strip doc={doc} schema={schema.value} place={place} hole={isOld ? undefined : hole} />}
      <div class="cols">
        <div class="stack">
          <Matrix doc={doc} place={place} />
          <PointGrid doc={doc} />
          {schema.value && <Rest doc={doc} schema={schema.value} place={place} />}
        </div>
        {hole && known ? (
          <>
            <div class={`stack${isOld ? " older" : ""}`}>
              <SectionPanel question={drawn} hole={hole} way={way} drawings={holes.length > 1 ? [] : drawings} waits={late.value} />
              <Load hole={hole} way={way} />
              <PaperTable hole={hole} />
            </div>
            <div class={`stack${isOld ? " older" : ""}`}>
              <Zones hole={hole} way={way} />
              <Zeros hole={hole} />
              <Findings hole={hole} refused={refused.flatMap((h) => ("error" in h ? [{ ...h.error, hole: h.number + 1 }] : []))} of={known.answer.holes.length} />
              {schema.value && <Blocks doc={doc} schema={schema.value} text={known.answer.program} control={known.answer.control} />}
            </div>
          </>
        ) : (
          <p class="q hint">{t(wrong ? "drill.nothing" : "drill.planning")}</p>
        )}
      </div>
    </main>
  );
}

function planned(text: string): Record<string, unknown> {
  return plain(parse(text)) as Record<string, unknown>;
}

function heading(question: ReturnType<typeof questionOf>, place: [number, number]): string {
  const diameter = Number.isFinite(question.diameter) ? short(question.diameter, 6) : "\u2013";
  const entry = kindOf(question.entry, place);
  const exit = question.exit === undefined ? null : kindOf(exitFace(question), place);
  if (question.ofMesh || entry === null) return t("drill.title", { diameter });
  const into = t(`drill.into.${entry}`);
  if (exit === null) return t("drill.titleBlind", { diameter, into });
  return t("drill.titleThrough", { diameter, into, out: t(`drill.out.${exit}`) });
}
