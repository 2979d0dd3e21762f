// The bar: open texts as tabs, what is done now, save.
import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { short } from "../base/format";
import type { Document } from "../store/document";
import { beginnings } from "../store/questions";
import { active, begin, close, documents, project, save, worker } from "../store/session";
import { closeFace, face, facing, leave, saveFace, showFacing } from "../windows/face/open";
import { FaceStatus } from "../windows/face/window";
import { FiguresItem, FiguresTab } from "../windows/teaching/bar";
import { figuresShown } from "../windows/teaching/open";
import { leaveSurfaces, showSurfaces, surfacing } from "../windows/surface/open";
import { t } from "../words";
import { dialog } from "./commands";
import { Languages } from "./languages";
import { Menu } from "./menu";
import { take } from "./take";
import { turnTheme } from "./theme";
import { Name } from "./verbatim";

export function Bar() {
  const doc = facing.value || figuresShown.value || surfacing.value ? null : active.value;
  return (
    <header class="top">
      <span class="mark">
        <svg viewBox="0 0 20 20" aria-hidden="true">
          <path d="M3 17V3M3 11c3-1 5-4 5-8M3 11c5 0 8 2 9 6" fill="none" stroke="var(--accent)" stroke-width="2.4" stroke-linecap="round" />
          <circle cx="15" cy="6" r="2.6" fill="none" stroke="var(--ink)" stroke-width="1.8" />
        </svg>
        <Name class="wide">kinecut</Name>
      </span>
      <nav class="tabs" aria-label={t("bar.jobs")}>
        {documents.value.map((d) => (
          <Tab key={d.id} doc={d} on={d === doc} />
        ))}
        <FaceTab />
        <FiguresTab />
        <SurfaceTab />
      </nav>
      <Files />
      <New />
      <span class="sp" />
      {doc && <Status doc={doc} />}
      {facing.value && !figuresShown.value && face.value && (
        <div class="status">
          <FaceStatus of={face.value} />
        </div>
      )}
      <div class="acts">
        <button class="ghost icon desk" aria-label={t("bar.keys")} title={t("bar.keys")} onClick={() => (dialog.value = "keys")}>
          <span aria-hidden="true">?</span>
        </button>
        <Languages />
        <button class="ghost icon" aria-label={t("bar.theme")} title={t("bar.theme")} onClick={turnTheme}>
          <span aria-hidden="true">◐</span>
        </button>
        {doc && (
          <button class="primary" disabled={!doc.dirty.value} title={t("bar.saveName", { name: doc.name })} onClick={() => void save(doc)}>
            {t("bar.save")}
          </button>
        )}
        {facing.value && !figuresShown.value && face.value && (
          <button class="primary" disabled={!face.value.dirty.value} title={t("bar.saveName", { name: face.value.name })} onClick={() => face.value && void saveFace(face.value)}>
            {t("bar.save")}
          </button>
        )}
      </div>
    </header>
  );
}

/** Leaves the windows that are no files for a file. */
function to(id: string): void {
  leaveSurfaces();
  void leave(id);
}

function Tab({ doc, on }: { doc: Document; on: boolean }) {
  const last = (of: Document) => of.name.split("/").at(-1) ?? of.name;
  // Two files of one name are told apart by their folders.
  const name = documents.value.some((d) => d !== doc && last(d) === last(doc)) ? doc.name : last(doc);
  return (
    <span class={`tab${on ? " on" : ""}`}>
      <button aria-current={on ? "page" : undefined} title={doc.name} onClick={() => to(doc.id)}>
        <Name>{name}</Name>
        {doc.dirty.value && <i class="dot" title={t("bar.unsaved")} />}
        {doc.dirty.value && <span class="sr">{t("bar.unsaved")}</span>}
      </button>
      <button class="close" aria-label={t("bar.close", { name })} title={t("bar.close", { name })} onClick={() => close(doc)}>
        <span aria-hidden="true">×</span>
      </button>
    </span>
  );
}

/** The window of face milling. */
function FaceTab() {
  const on = facing.value && !figuresShown.value;
  const open = face.value;
  return (
    <span class={`tab window${on ? " on" : ""}`}>
      <button aria-current={on ? "page" : undefined} title={t("face.title")} onClick={() => showFacing()} data-open="facing">
        {t("face.tab")}
        {open?.dirty.value && <i class="dot" title={t("bar.unsaved")} />}
        {open?.dirty.value && <span class="sr">{t("bar.unsaved")}</span>}
      </button>
      {on && open && (
        <button class="close" aria-label={t("bar.close", { name: open.name })} title={t("bar.close", { name: open.name })} onClick={() => closeFace()}>
          <span aria-hidden="true">×</span>
        </button>
      )}
    </span>
  );
}

/** The window of surfaces and machines. */
function SurfaceTab() {
  const on = surfacing.value;
  return (
    <span class={`tab window${on ? " on" : ""}`}>
      <button aria-current={on ? "page" : undefined} title={t("surface.title")} onClick={showSurfaces} data-open="surfaces">
        {t("surface.tab")}
      </button>
    </span>
  );
}

/** The questions that can be begun. */
function New() {
  const shown = useSignal(false);
  return (
    <span class="holdsMenu wide">
      <button class="ghost" aria-haspopup="menu" aria-expanded={shown.value} onClick={() => (shown.value = !shown.value)} data-open="new">
        {t("bar.new")}
      </button>
      <Menu open={shown} label={t("bar.new")}>
        {beginnings().map(({ name, begin: first }) => (
          <button
            key={name}
            role="menuitem"
            data-new={name}
            onClick={() => {
              shown.value = false;
              begin(first);
            }}
          >
            {t(first.command)}
          </button>
        ))}
      </Menu>
    </span>
  );
}

/** The files of the folder that can be opened. */
function Files() {
  const shown = useSignal(false);
  const chooser = useRef<HTMLInputElement>(null);
  const files = project.value?.files.filter((f) => ["job", "program", "question", "surface"].includes(f.kind)) ?? [];
  return (
    <span class="holdsMenu">
      <button class="ghost" aria-haspopup="menu" aria-expanded={shown.value} onClick={() => (shown.value = !shown.value)} data-open="files">
        {t("bar.open")}
      </button>
      <Menu open={shown} label={t("file.open")}>
        {beginnings().map(({ name, begin: first }) => (
          <button
            key={name}
            role="menuitem"
            onClick={() => {
              shown.value = false;
              begin(first);
            }}
          >
            {t(first.command)}
          </button>
        ))}
        <FiguresItem menu={shown} />
        <h2>{t("file.kinds", { name: project.value?.folder ?? "" })}</h2>
        {files.map((f) => (
          <button
            key={f.id}
            role="menuitem"
            onClick={() => {
              shown.value = false;
              to(f.id);
            }}
          >
            <Name>{f.name}</Name>
          </button>
        ))}
        {files.length === 0 && <p class="q">{t("file.none")}</p>}
        <button
          role="menuitem"
          onClick={() => {
            shown.value = false;
            chooser.current?.click();
          }}
        >
          <span>{t("file.add")}</span>
        </button>
      </Menu>
      <input type="file" hidden multiple ref={chooser} onChange={(e) => e.currentTarget.files && void take(e.currentTarget.files)} />
    </span>
  );
}

function Status({ doc }: { doc: Document }) {
  const ms = doc.drawnIn.value;
  const run = doc.running.value;
  const planned = doc.planning.value ? t("bar.planning") : ms === null ? "" : t("bar.planned", { ms: Math.round(ms) });
  const told = simulating(doc);
  const share = run?.share ?? null;
  return (
    <div class="status">
      <span class="opt" data-status="planned">
        {planned}
      </span>
      <span class="opt" data-status="simulated">
        {told}
      </span>
      {run && (
        <span class="bar" role="progressbar" aria-label={t("bar.progress")} aria-valuemin={0} aria-valuemax={100} aria-valuenow={share === null ? undefined : Math.round(100 * share)}>
          <i style={{ width: `${Math.round(100 * (share ?? 0.1))}%` }} />
        </span>
      )}
      {run && (
        <button class="ghost opt" onClick={() => worker(doc).stop()}>
          {t("outcome.stop")}
        </button>
      )}
    </div>
  );
}

/** What is simulated, or was. */
function simulating(doc: Document): string {
  const run = doc.running.value;
  const simulated = doc.simulated.value;
  if (run && run.step === null) return t("bar.simulatingAlone");
  if (run && simulated) return t("bar.refining", { coarse: short(simulated.step), step: short(run.step ?? 0) });
  if (run) return t("bar.simulating", { step: short(run.step ?? 0) });
  if (doc.stopped.value) return t("bar.stopped");
  return simulated ? t("bar.simulated", { step: short(simulated.step) }) : "";
}
