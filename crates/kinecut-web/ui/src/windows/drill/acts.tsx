// Ways of a drilling to elsewhere: its sheet, its operation, a job.
import { useSignal } from "@preact/signals";
import type { Hole } from "../../base/drillsheet";
import type { Document } from "../../store/document";
import { make, open, project, tell } from "../../store/session";
import { t } from "../../words";
import { drilled } from "./drilled";
import { jobText, operationText } from "./export";

export function Acts({ doc, hole }: { doc: Document; hole: Hole | undefined }) {
  const copied = useSignal(false);
  const stem = (doc.name.split("/").at(-1) ?? doc.name).replace(/\.\w+$/, "");
  const copy = () => {
    void navigator.clipboard.writeText(operationText(doc.values.value)).then(
      () => {
        copied.value = true;
        setTimeout(() => (copied.value = false), 2000);
      },
      (error: unknown) => tell(String(error)),
    );
  };
  const saveJob = async () => {
    if (!hole) return;
    const taken = new Set(project.value?.files.map((f) => f.name));
    let name = `${stem}-job.toml`;
    for (let n = 2; taken.has(name); n++) name = `${stem}-job-${n}.toml`;
    const id = await make(name, jobText(doc.values.value, hole, stem));
    if (id === null) return;
    await open(id);
    tell(t("drill.guessedStock", { name }));
  };
  const sheet = drilled(doc);
  const saveSheet = () => {
    if (!sheet?.page) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([sheet.page], { type: "text/html" }));
    link.download = `${stem}-drill.html`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  };
  return (
    <>
      <button data-act="sheet" disabled={!sheet?.page || sheet.text !== doc.text.value} onClick={saveSheet}>
        {t("drill.saveSheet")}
      </button>
      <button data-act="copy" onClick={copy}>
        {copied.value ? t("drill.copied") : t("drill.copyOperation")}
      </button>
      <button data-act="job" disabled={!hole} onClick={() => void saveJob()}>
        {t("drill.saveJob")}
      </button>
    </>
  );
}
