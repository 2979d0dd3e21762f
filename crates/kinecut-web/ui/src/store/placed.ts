// A file that comes from elsewhere as a file of the folder.
import * as api from "../base/api";
import { project } from "./session";

async function sha256(bytes: Uint8Array): Promise<string> {
  const digest = await crypto.subtle.digest("SHA-256", bytes as Uint8Array<ArrayBuffer>);
  return [...new Uint8Array(digest)].map((b) => b.toString(16).padStart(2, "0")).join("");
}

/** The file of the folder with these bytes: one that is there, or a new one under a name that is free. */
export async function placed(name: string, bytes: Uint8Array, beside: string | null): Promise<string> {
  const files = (project.value = await api.project()).files;
  const folder = beside === null ? "" : (files.find((f) => f.id === beside)?.name.replace(/[^/]*$/, "") ?? "");
  const [, stem, ending] = /^(.*?)(\.[^.]*)?$/s.exec(name) ?? ["", name, ""];
  const hash = await sha256(bytes);
  for (let n = 1; ; n++) {
    const own = n === 1 ? name : `${stem}-${n}${ending ?? ""}`;
    const known = files.find((f) => f.name === folder + own);
    if (!known) {
      const { id } = await api.createBytes(own, bytes, beside);
      project.value = await api.project();
      return id;
    }
    if (known.bytes === bytes.length && (await api.file(known.id)).sha256 === hash) return known.id;
  }
}
