// The window of a job: form, text, part, program and findings, and time below.
import { signal } from "@preact/signals";
import type { Document } from "../../store/document";
import { panel } from "../../app/go";
import { Splitter } from "../../app/splitter";
import { foreign, t } from "../../words";
import { FindingsPanel } from "./findings";
import { FormPanel } from "./form";
import { PartPanel } from "./part";
import { ProgramPanel } from "./program";
import "./link";
import { TextPanel } from "./text";
import { TimePanel } from "./time";

const widths = { form: signal(252), text: signal(318), right: signal(318), time: signal(172), findings: signal(0) };

export function JobWindow({ doc }: { doc: Document }) {
  const style = {
    "--form": `${widths.form.value}px`,
    "--text": `${widths.text.value}px`,
    "--right": `${widths.right.value}px`,
    "--time": `${widths.time.value}px`,
    "--findings": widths.findings.value > 0 ? `${widths.findings.value}px` : "fit-content(44%)",
  };
  return (
    <main class="work" lang={foreign("form.stock")} style={style} data-panel-shown={panel.value}>
      <h1 class="sr" translate={false}>
        {doc.name} {typeof doc.values.value.title === "string" ? doc.values.value.title : ""}
      </h1>
      <FormPanel doc={doc} />
      <Splitter size={widths.form} way="x" sense={1} least={200} most={520} standard={252} name={t("panel.form")} />
      <TextPanel doc={doc} />
      <Splitter size={widths.text} way="x" sense={1} least={200} most={720} standard={318} name={t("panel.text")} />
      <PartPanel doc={doc} />
      <Splitter size={widths.right} way="x" sense={-1} least={200} most={620} standard={318} name={t("panel.program")} />
      <div class="rcol">
        <ProgramPanel doc={doc} />
        <Splitter size={widths.findings} way="y" sense={-1} least={80} most={600} standard={0} name={t("panel.findings")} />
        <FindingsPanel doc={doc} />
      </div>
      <Splitter size={widths.time} way="y" sense={-1} least={110} most={420} standard={172} name={t("panel.time")} />
      <TimePanel doc={doc} />
    </main>
  );
}
