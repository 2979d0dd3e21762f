// Ways of a hole to elsewhere: its operation, a job.
import { useSignal } from "@preact/signals";
import type { Document } from "../../store/document";
import { make, open, project, tell } from "../../store/session";
import { t } from "../../words";
import type { Plan } from "./answer";
import { jobText, operationText } from "./export";

export function Acts({ doc, plan }: { doc: Document; plan: Plan | null }) {
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
    if (!plan) return;
    const taken = new Set(project.value?.files.map((f) => f.name));
    let name = `${stem}-job.toml`;
    for (let n = 2; taken.has(name); n++) name = `${stem}-job-${n}.toml`;
    const id = await make(name, jobText(doc.values.value, stem));
    if (id === null) return;
    await open(id);
    tell(t("hole.guessedStock", { name }));
  };
  return (
    <>
      <button data-act="copy" onClick={copy}>
        {copied.value ? t("drill.copied") : t("drill.copyOperation")}
      </button>
      <button data-act="job" disabled={!plan} onClick={() => void saveJob()}>
        {t("drill.saveJob")}
      </button>
    </>
  );
}
