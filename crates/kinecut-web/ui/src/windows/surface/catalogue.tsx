// The surfaces by pictures, and those that are files of the folder.
import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { Name } from "../../app/verbatim";
import * as api from "../../base/api";
import { t } from "../../words";
import { arrows } from "../drill/radios";
import type { Surface } from "./answer";
import { Newest, isFinding } from "./newest";
import { Paper, VIEWS, quads } from "./space";
import { catalogue, of, surfaceFiles, take, told } from "./state";

const SIZE = 52;
/** Pictures of the catalogue by name. */
const pictures = signal<Record<string, { d: string; light: number }[]>>({});
let begun = false;

/** Draws all of them, one after another. */
async function draw(): Promise<void> {
  if (begun || catalogue.value.length === 0) return;
  begun = true;
  try {
    for (const { name } of catalogue.value) {
      const one = await new Newest().ask((signal) => api.ask<Surface>("surface", { surface: name, sketch: true }, signal));
      if (one === null || isFinding(one) || !one.sketch) continue;
      const paper = new Paper(VIEWS.iso, one.sketch.mesh.flat(), SIZE, SIZE, 3);
      pictures.value = { ...pictures.value, [name]: quads(one.sketch.mesh, paper, 2) };
    }
  } catch (error) {
    told(error);
  }
}

export function Catalogue() {
  const list = catalogue.value;
  useEffect(() => void draw(), [list.length]);
  const at = list.findIndex((s) => s.name === of.value.surface);
  const files = surfaceFiles.value;
  return (
    <section class="panel" aria-label={t("surface.catalogue")} tabIndex={-1} data-panel="catalogue">
      <header>
        <h2>{t("surface.catalogue")}</h2>
      </header>
      <div class="pictures" role="radiogroup" aria-label={t("surface.catalogue")} onKeyDown={(e) => arrows(e, { count: list.length, columns: 4, chosen: at, choose: (i) => take({ surface: list[i].name }) })}>
        {list.map((s, i) => (
          <button key={s.name} role="radio" aria-checked={i === at} tabIndex={i === Math.max(0, at) ? 0 : -1} title={s.title} aria-label={`${s.name}, ${s.title}`} onClick={() => take({ surface: s.name })} data-surface={s.name} translate={false}>
            <svg width={SIZE} height={SIZE} aria-hidden="true">
              {pictures.value[s.name]?.map((q, k) => (
                <path key={k} d={q.d} class={`lit l${Math.round(q.light * 5)}`} />
              ))}
            </svg>
            <span>{s.name}</span>
            <small>{s.code}</small>
          </button>
        ))}
      </div>
      {files.length > 0 && (
        <div class="filesOf">
          <h3>{t("surface.files")}</h3>
          {files.map((f) => (
            <button key={f.id} class="ghost" aria-pressed={of.value.file === f.id} onClick={() => take({ file: f.id })} data-file={f.name}>
              <Name>{f.name}</Name>
            </button>
          ))}
        </div>
      )}
    </section>
  );
}
