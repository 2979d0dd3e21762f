// Dropping files on the page, and what a drawing or a mesh can be in the open job.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { active, jobSchema } from "../store/session";
import { Form } from "../schema/schema";
import { at } from "../toml/parse";
import { change, drop } from "../windows/job/change";
import { setupOf } from "../windows/job/measure/make";
import { addOperation } from "../windows/job/newoperation";
import { named, t } from "../words";
import { offered, take } from "./take";

/** Kinds of operations along an outline that needs nothing but the drawing. */
const OUTLINED = ["face", "contour", "pocket"];

/** Shows while files are dragged that they can be dropped; takes them. */
export function DropZone() {
  const over = useSignal(false);
  useEffect(() => {
    /** Entered elements that were not left again. */
    let depth = 0;
    const has = (e: DragEvent) => e.dataTransfer?.types.includes("Files") ?? false;
    const enter = (e: DragEvent) => {
      if (has(e)) over.value = ++depth > 0;
    };
    const leave = (e: DragEvent) => {
      if (has(e)) over.value = --depth > 0;
    };
    const move = (e: DragEvent) => e.preventDefault();
    const end = (e: DragEvent) => {
      e.preventDefault();
      depth = 0;
      over.value = false;
      if (e.dataTransfer?.files.length) void take(e.dataTransfer.files);
    };
    addEventListener("dragenter", enter);
    addEventListener("dragleave", leave);
    addEventListener("dragover", move);
    addEventListener("drop", end);
    return () => {
      removeEventListener("dragenter", enter);
      removeEventListener("dragleave", leave);
      removeEventListener("dragover", move);
      removeEventListener("drop", end);
    };
  }, []);
  if (!over.value) return null;
  return (
    <div class="dropzone" aria-hidden="true">
      <p>{t(active.value?.kind === "job" ? "drop.hereJob" : "drop.here")}</p>
    </div>
  );
}

/** What the file that was dropped can be in the job. */
export function Offered() {
  const file = offered.value;
  const doc = active.value;
  if (!file || !doc || doc.kind !== "job") return null;
  const own = file.name.slice(file.name.lastIndexOf("/") + 1);
  const done = (act: () => void) => () => {
    act();
    offered.value = null;
  };
  const design = () => {
    if (doc.value(["design"]) !== undefined) return change(doc, ["design", "mesh"], own);
    const schema = jobSchema.value;
    const tolerance = schema && new Form(schema, schema).key("design")?.of({}).key("tolerance")?.example;
    change(doc, ["design"], { mesh: own, ...(typeof tolerance === "number" ? { tolerance } : {}) });
  };
  const stock = () => {
    const known = at(doc.tree.value, ["stock"]);
    // A table of lines of its own gives way to one in a line.
    if (known?.kind === "table" && known.form !== "inline") drop(doc, ["stock"]);
    change(doc, ["stock"], { mesh: own });
  };
  return (
    <div class="across" role="status">
      <span>{t("drop.beside", { name: file.name, job: doc.name })}</span>
      <span class="sp" />
      <span class="acts">
        {file.kind === "mesh" && <button onClick={done(design)}>{t("drop.design")}</button>}
        {file.kind === "mesh" && <button onClick={done(stock)}>{t("drop.stock")}</button>}
        {file.kind === "outline" &&
          OUTLINED.map((kind) => (
            <button key={kind} onClick={done(() => addOperation(doc, setupOf(doc), kind, [["outline", own]]))}>
              {t("drop.operation", { kind: named(kind) })}
            </button>
          ))}
        <button class="ghost icon" aria-label={t("notice.close")} onClick={() => (offered.value = null)}>
          <span aria-hidden="true">×</span>
        </button>
      </span>
    </div>
  );
}
