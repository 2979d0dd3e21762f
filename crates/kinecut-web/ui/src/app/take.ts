// Files that are dropped on the page or chosen: told apart, put into the folder, opened or offered to the open job.
import { signal } from "@preact/signals";
import type * as api from "../base/api";
import { placed } from "../store/placed";
import { active, open, project, tell } from "../store/session";
import { facing, openDrawing } from "../windows/face/open";
import { t } from "../words";

/** A drawing or a mesh that lies beside the open job now. */
export const offered = signal<api.FileName | null>(null);

/** Endings that the folder lists; other files are programs by their text, or nothing that is read. */
const LISTED = /\.(toml|json|stl|3mf|dxf|svg|nc|ngc|gcode|tap|cnc|mpf|spf|h|i|eia|min|pim|cl|o|tools|csv|ini|hal|tbl|var)$|^[oO]\d+$/i;
/** A body of a request is at most 64 MiB, and base64 makes four bytes of three. */
const MOST = 47 * 1024 * 1024;
/** Bytes of a text that are looked at. */
const LOOKED_AT = 65_536;
/** A block of a program: a number or not, then words of one letter with a number; or the beginning, a comment, a block of Heidenhain. */
const BLOCK = /^\s*(%|\(|;|\/?\s*(N\d+\s*)?([GMXYZABCUVWIJKFSTRDHOPQL]\s*[=+-]?[\d.]+\s*)+|\d+\s+(BEGIN|END|TOOL|L|C|CC|CYCL|BLK|CALL|M\d|;))/i;

/** Whether most lines of a text are blocks of a program. */
function looksLikeProgram(text: string): boolean {
  const lines = text.slice(0, LOOKED_AT).split(/\r?\n/).filter((line) => line.trim() !== "");
  return lines.length > 1 && !text.includes("\0") && lines.filter((line) => BLOCK.test(line)).length > 0.6 * lines.length;
}

/** The name under which a file comes into the folder; null for one that is nothing that is read. */
function nameOf(file: string, bytes: Uint8Array): string | null {
  const name = file.replace(/[\u0000-\u001f/\\:*?"<>|]/g, "_").replace(/^[. -]+|[. ]+$/g, "").slice(-110);
  if (name === "") return null;
  if (LISTED.test(name)) return name;
  return looksLikeProgram(new TextDecoder().decode(bytes.subarray(0, LOOKED_AT))) ? `${name}.nc` : null;
}

/** Whether a file is opened as a tab; others lie beside the open job, which may name them. */
function isOpened(name: string, bytes: Uint8Array): boolean {
  if (!/\.(toml|json|stl|3mf|dxf|svg|tools|csv|ini|hal|tbl|var)$/i.test(name)) return true;
  return /\.toml$/i.test(name) && /^\s*\[\[\s*setup\s*\]\]/m.test(new TextDecoder().decode(bytes));
}

async function one(file: File): Promise<void> {
  if (file.size > MOST) return tell(t("drop.large", { name: file.name }));
  const bytes = new Uint8Array(await file.arrayBuffer());
  const name = nameOf(file.name, bytes);
  if (name === null) return tell(t("drop.unknown", { name: file.name }));
  const doc = active.value;
  const opened = isOpened(name, bytes);
  const id = await placed(name, bytes, opened || !doc ? null : doc.id);
  const known = project.value?.files.find((f) => f.id === id);
  if (!known) return;
  if (["job", "program", "question", "surface"].includes(known.kind)) await open(id);
  else if (known.kind === "outline" && (facing.value || !doc)) openDrawing(id);
  else if ((known.kind === "mesh" || known.kind === "outline") && doc?.kind === "job") offered.value = known;
  else tell(t("drop.kept", { name: known.name }));
}

/** Takes files one after another. */
export async function take(files: Iterable<File>): Promise<void> {
  for (const file of [...files]) {
    try {
      await one(file);
    } catch (error) {
      tell(error instanceof Error && error.message ? error.message : String(error));
    }
  }
}
