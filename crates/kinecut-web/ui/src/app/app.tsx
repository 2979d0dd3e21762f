// The shell: bar, outcome, the window of what is open, and what goes across all.
import { useSignal } from "@preact/signals";
import * as api from "../base/api";
import example from "./example.toml";
import { active, begin, documents, notice, open, project, save, serverGone, takeTheirs, tell, worker } from "../store/session";
import { beginnings } from "../store/questions";
import "../windows/questions";
import { holder } from "../windows/job/change";
import { JobWindow } from "../windows/job/window";
import { face, facing, saveFace } from "../windows/face/open";
import { FaceWindow } from "../windows/face/window";
import { figuresShown, showFigures } from "../windows/teaching/open";
import { FiguresWindow } from "../windows/teaching/window";
import { surfacing } from "../windows/surface/open";
import { SurfaceWindow } from "../windows/surface/window";
import { t } from "../words";
import { Bar } from "./bar";
import { dialog, offer, run } from "./commands";
import { Dialogs } from "./dialogs";
import { DropZone, Offered } from "./drop";
import { type Panel, panel } from "./go";
import { Outcome, outcome } from "./outcome";
import { take } from "./take";
import { turnTheme } from "./theme";
import { Name } from "./verbatim";

const PANELS: Panel[] = ["form", "text", "program", "findings"];

offer(
  { id: "command.save", keys: ["Ctrl+S"], run: saveShown },
  { id: "command.all", keys: ["Ctrl+K"], run: () => (dialog.value = "commands") },
  { id: "command.keys", keys: ["?"], run: () => (dialog.value = "keys") },
  { id: "command.go", keys: ["G"], run: () => (dialog.value = "go") },
  { id: "command.panelOn", keys: ["F6"], run: () => nextPanel(1) },
  { id: "command.panelBack", keys: ["Shift+F6"], run: () => nextPanel(-1) },
  { id: "command.theme", keys: [], run: turnTheme },
  { id: "command.report", keys: [], run: () => void saveReport() },
  ...beginnings().map((kind) => ({ id: kind.begin.command, keys: [], run: () => begin(kind.begin) })),
  { id: "command.figures", keys: [], run: showFigures },
);

function saveShown(): void {
  if (figuresShown.value || surfacing.value) return;
  if (facing.value) face.value && void saveFace(face.value);
  else if (active.value) void save(active.value);
}

/** Gives the keyboard to the next panel that is seen. */
function nextPanel(by: 1 | -1): void {
  const all = [...document.querySelectorAll<HTMLElement>("[data-panel]")].filter((p) => p.offsetParent !== null);
  if (all.length === 0) return;
  const at = all.findIndex((p) => p.contains(document.activeElement));
  all[(at + by + all.length) % all.length]?.focus();
}

async function saveReport(): Promise<void> {
  const doc = active.value;
  const result = doc?.simulated.value?.result;
  if (!doc || !result) return;
  try {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await api.report(result));
    link.download = `${doc.name.replace(/^.*\//, "").replace(/\.\w+$/, "")}-report.html`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  } catch (error) {
    tell(error instanceof Error ? error.message : String(error));
  }
}

export function App() {
  const figures = figuresShown.value;
  const doc = facing.value || figures || surfacing.value ? null : active.value;
  const Asked = doc?.question?.Window;
  return (
    <div class={`wb${Asked ? " long" : ""}`}>
      {serverGone.value && <ServerGone />}
      <Bar />
      {doc && !Asked && <Outcome />}
      {doc?.conflict.value && <Conflict />}
      {notice.value && <Notice />}
      <Offered />
      {doc && !Asked && <Tabs />}
      {figures ? (
        <FiguresWindow />
      ) : surfacing.value ? (
        <SurfaceWindow />
      ) : facing.value ? (
        <FaceWindow />
      ) : !doc ? (
        <Empty />
      ) : Asked ? (
        <Asked key={doc.id} doc={doc} />
      ) : (
        <JobWindow doc={doc} />
      )}
      <Dialogs />
      <DropZone />
      <p class="sr" aria-hidden="true" data-outcome={Asked ? "" : (outcome.value?.word ?? "")} />
    </div>
  );
}

function Tabs() {
  return (
    <nav class="panels" aria-label={t("panel.tabs")}>
      <div role="tablist" aria-label={t("panel.tabs")}>
      {PANELS.map((name) => (
        <button
          key={name}
          role="tab"
          aria-selected={panel.value === name}
          tabIndex={panel.value === name ? 0 : -1}
          onClick={() => (panel.value = name)}
          onKeyDown={(e) => {
            const by = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
            if (by === undefined) return;
            panel.value = PANELS[(PANELS.indexOf(name) + by + PANELS.length) % PANELS.length];
            requestAnimationFrame(() => document.querySelector<HTMLElement>('.panels [aria-selected="true"]')?.focus());
          }}
        >
          {t(`panel.${name}`)}
        </button>
      ))}
      </div>
    </nav>
  );
}

function ServerGone() {
  const copied = useSignal(false);
  const text = (facing.value ? face.value : active.value)?.text.value;
  return (
    <div class="across gone" role="alert">
      {t("gone.sentence")}
      {text !== undefined && (
        <button
          onClick={() => {
            void navigator.clipboard.writeText(text).then(() => (copied.value = true));
          }}
        >
          {copied.value ? t("gone.copied") : t("gone.copy")}
        </button>
      )}
    </div>
  );
}

function Conflict() {
  const doc = active.value;
  const disk = doc?.conflict.value;
  if (!doc || !disk) return null;
  return (
    <div class="across" role="alert">
      {t(disk.sha256 === null ? "conflict.gone" : "conflict.sentence", { name: doc.name })}
      <span class="sp" />
      <span class="acts">
        {disk.text !== null && <button onClick={() => (dialog.value = "both")}>{t("conflict.both")}</button>}
        <button onClick={() => void save(doc, { sha256: disk.sha256 })}>{t("conflict.mine")}</button>
        {disk.text !== null && (
          <button
            onClick={() => {
              const text = takeTheirs(doc);
              if (text !== null && holder.editor) holder.editor.replace(text);
              else if (text !== null) worker(doc).changed();
            }}
          >
            {t("conflict.theirs")}
          </button>
        )}
      </span>
    </div>
  );
}

function Notice() {
  return (
    <div class="across" role="status">
      <span>{notice.value?.text}</span>
      <span class="sp" />
      {notice.value?.undo && (
        <button
          onClick={() => {
            run("command.undo");
            notice.value = null;
          }}
        >
          {t("form.undo")}
        </button>
      )}
      <button class="ghost icon" aria-label={t("notice.close")} onClick={() => (notice.value = null)}>
        <span aria-hidden="true">×</span>
      </button>
    </div>
  );
}

/** Makes a file of the folder and opens it; a name that is taken is opened as it is. */
async function made(name: string, text: string): Promise<void> {
  try {
    const { id } = await api.create(name, text);
    project.value = await api.project();
    await open(id);
  } catch (error) {
    const known = project.value?.files.find((f) => f.name === name);
    if (error instanceof api.Refused && error.reason === "exists" && known) await open(known.id);
    else tell(error instanceof Error ? error.message : String(error));
  }
}

function Empty() {
  const files = project.value?.files.filter((f) => f.kind === "job" || f.kind === "program") ?? [];
  if (!project.value) return <main class="empty q">{t("empty.reading")}</main>;
  return (
    <main class="empty">
      <h1 class="sr" translate={false}>
        kinecut
      </h1>
      <p>{t("empty.sentence")}</p>
      <div class="acts">
        <button class="primary" onClick={() => void made("example.toml", example)}>
          {t("empty.example")}
        </button>
        {beginnings().map(({ name, begin: first }) => (
          <button key={name} onClick={() => begin(first)}>
            {t(first.command)}
          </button>
        ))}
        <label class="drop">
          {t("empty.drop")}
          <input type="file" class="sr" multiple onChange={(e) => e.currentTarget.files && void take(e.currentTarget.files)} />
        </label>
      </div>
      <p class="q">{t("empty.what")}</p>
      {documents.value.length === 0 && files.length > 0 && (
        <div class="files">
          {files.slice(0, 12).map((f) => (
            <button key={f.id} class="ghost" onClick={() => void open(f.id)}>
              <Name>{f.name}</Name>
            </button>
          ))}
        </div>
      )}
    </main>
  );
}
