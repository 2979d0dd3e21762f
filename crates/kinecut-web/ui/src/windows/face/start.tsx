// The window before a face is open: the questions and drawings of the folder, and room to drop one.
import { useSignal } from "@preact/signals";
import { Name } from "../../app/verbatim";
import { project } from "../../store/session";
import { t } from "../../words";
import { takeDrawing, openDrawing, openQuestion, questions } from "./open";

export function Start() {
  const over = useSignal(false);
  const drawings = project.value?.files.filter((f) => f.kind === "outline") ?? [];
  const asked = questions.value;
  return (
    <main class="empty">
      <h1>{t("face.title")}</h1>
      <p>{t("face.startSentence")}</p>
      <label class={`drop${over.value ? " over" : ""}`} onDragOver={(e) => { e.preventDefault(); over.value = true; }} onDragLeave={() => (over.value = false)}>
        {t("face.drop")}
        <input type="file" class="sr" accept=".dxf,.svg" onChange={(e) => e.currentTarget.files?.[0] && void takeDrawing(e.currentTarget.files[0])} />
      </label>
      {asked === null && <p class="q">{t("empty.reading")}</p>}
      {asked !== null && asked.length > 0 && (
        <div class="files">
          <h2>{t("face.questions")}</h2>
          {asked.map((f) => (
            <button key={f.id} class="ghost" onClick={() => void openQuestion(f.id)}>
              <Name>{f.name}</Name>
            </button>
          ))}
        </div>
      )}
      {drawings.length > 0 && (
        <div class="files">
          <h2>{t("face.drawings")}</h2>
          {drawings.slice(0, 20).map((f) => (
            <button key={f.id} class="ghost" onClick={() => openDrawing(f.id)}>
              <Name>{f.name}</Name>
            </button>
          ))}
        </div>
      )}
    </main>
  );
}
