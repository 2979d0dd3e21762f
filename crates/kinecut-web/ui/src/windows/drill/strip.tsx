// The numbers of the chosen surfaces and point, and those of the cut.
import { type Document, keyOf } from "../../store/document";
import type { Hole } from "../../base/drillsheet";
import { Form, type Schema } from "../../schema/schema";
import type { Path } from "../../toml/parse";
import { NumberField, RawField, SelectField } from "../job/field";
import { change, drop } from "../job/change";
import { type Key, en } from "../../words/en";
import { named, t } from "../../words";
import { type Kind, NEEDS, offsetOf } from "./faces";
import { NUMBERS, type Point } from "./points";
import { exitFace, kinds, questionOf } from "./question";

interface Shown {
  path: Path;
  label: string;
}

/** The controls that programs are written for. */
const CONTROLS = ["sinumerik-840d", "fanuc", "linuxcnc", "grbl", "heidenhain"];

function label(key: string, words: "number" | "entryNumber" | "exitNumber" = "number"): string {
  const known = `drill.${words}.${key}` as Key;
  return known in en ? t(known) : named(key);
}

/** The numbers of each stage of a stepped point. */
function stages({ numbers }: Point, own: Path): Shown[] {
  const all = Array.isArray(numbers.stages) ? numbers.stages : [];
  return all.flatMap((_, i) =>
    (["diameter", "length", "shoulder_angle"] as const).map((key) => ({ path: [...own, "stages", i, key], label: t(`drill.stageNumber.${key}`, { n: i + 1 }) })),
  );
}

/** A form whose value is another one, where none is given. */
function withStandard(form: Form, value: number): Form {
  return new Form(form.root, { ...form.beside, default: value }, form.outer);
}

/** The fields in their order, by what is chosen. */
export function fieldsOf(doc: Document, place: [number, number]): Shown[] {
  const question = questionOf(doc.values.value);
  const { entry, exit } = kinds(question, place);
  const operation = (doc.values.value.operation ?? {}) as Record<string, unknown>;
  const fields: Shown[] = [{ path: ["tool", "diameter"], label: label("diameter") }];
  const point = question.point;
  if (point) {
    const own = doc.value(["tool", "point"]) === undefined ? ["tool"] : ["tool", ...point.path];
    for (const key of NUMBERS[point.kind]) {
      if (key === "stages") fields.push(...stages(point, own));
      fields.push({ path: [...own, key], label: label(key) });
    }
  }
  fields.push({ path: ["tool", "flute_length"], label: label("flute_length") });
  const needs = (kind: Kind | "blind" | null) => (kind === null || kind === "blind" ? [] : NEEDS[kind]);
  for (const key of needs(entry)) fields.push({ path: ["operation", "entry", key], label: label(key, "entryNumber") });
  if (question.exit !== "same") for (const key of needs(exit)) fields.push({ path: ["operation", "exit", key], label: label(key, "exitNumber") });
  if (entry !== null && needs(entry).includes("inclination")) fields.push({ path: ["operation", "entry", "offset"], label: label("offset", "entryNumber") });
  if (question.exit !== "same" && needs(exit).includes("inclination")) fields.push({ path: ["operation", "exit", "offset"], label: label("offset", "exitNumber") });
  if (exit === "blind") {
    const key = ["tip", "reach_diameter"].find((k) => operation[k] !== undefined) ?? "depth";
    fields.push({ path: ["operation", key], label: label(key) });
  } else if (!question.ofMesh) {
    fields.push({ path: ["operation", "length"], label: label("length") });
  }
  fields.push({ path: ["operation", "approach"], label: label("approach") });
  if (exit !== "blind") fields.push({ path: ["operation", "overrun"], label: label("overrun") });
  const speed = operation.speed !== undefined && operation.cutting_speed === undefined ? "speed" : "cutting_speed";
  fields.push({ path: ["operation", speed], label: label(speed) });
  for (const key of ["entry", "steady", "exit"]) {
    if (key !== "exit" || exit !== "blind") fields.push({ path: ["operation", "feed_per_rev", key], label: t(`drill.feed.${key}` as Key) });
  }
  // A number of a surface that is wrong has its field, also where the kind of the surface needs none.
  const wrong = /^operation\.(entry|exit)\.(inclination|radius|offset)$/.exec(doc.wrong.value?.key ?? "");
  if (wrong && !fields.some(({ path }) => keyOf(path) === wrong[0])) {
    const [, side, key] = wrong;
    const after = fields.findLastIndex(({ path }) => path[0] === "tool" || path[1] === side);
    fields.splice(after + 1, 0, { path: ["operation", side, key], label: label(key, `${side as "entry" | "exit"}Number`) });
  }
  return fields;
}

/** `hole`: the plan of the text as it is, which knows the feeds that nobody gave. */
export function Strip({ doc, schema, place, hole }: { doc: Document; schema: Schema; place: [number, number]; hole: Hole | undefined }) {
  const root = new Form(schema, { $ref: "#/$defs/HoleTable" });
  const question = questionOf(doc.values.value);
  return (
    <section class="panel strip" aria-label={t("drill.numbersOf")} tabIndex={-1} data-panel="numbers">
      {fieldsOf(doc, place).map(({ path, label: words }) => {
        const holder = root.at(path.slice(0, -1), doc.values.value);
        const key = path[path.length - 1] as string;
        const form = holder?.key(key);
        if (!form || !holder) return null;
        const face = path[1] === "entry" ? question.entry : path[1] === "exit" ? exitFace(question) : undefined;
        // The distance that follows from place and direction of the surface.
        const chosen = path[1] === "feed_per_rev" ? hole?.zones.find((z) => z.stage === key && z.feed_from !== "given")?.feed : undefined;
        const standard = key === "offset" && face ? Number(offsetOf({ ...face, offset: undefined }, place).toFixed(6)) : chosen && Number(chosen.toPrecision(3));
        const own = standard === undefined ? form : withStandard(form, standard);
        const of = { doc, path, form: own, label: words };
        const optional = !holder.required(key);
        return form.kind === "list" ? <RawField key={keyOf(path)} of={of} optional={optional} /> : <NumberField key={keyOf(path)} of={of} optional={optional} />;
      })}
    </section>
  );
}

/** The control that the blocks are written for. */
export function Control({ doc, schema }: { doc: Document; schema: Schema }) {
  const path = ["post", "control"];
  const form = new Form(schema, { $ref: "#/$defs/PostTable" }).key("control");
  if (!form) return null;
  const value = doc.value(path);
  const options = CONTROLS.map((word) => ({ value: word, label: word }));
  const others = Object.keys((doc.values.value.post ?? {}) as object).filter((key) => key !== "control").length;
  const set = (word: string) => (word === "" && others === 0 ? drop(doc, ["post"]) : change(doc, path, word || CONTROLS[0]));
  return <SelectField of={{ doc, path, form, label: t("form.control") }} options={options} value={typeof value === "string" ? value : ""} set={set} standard={CONTROLS[0]} />;
}
