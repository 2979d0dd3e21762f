// An operation of a picked face: of a plane a face, of the wall of a round hole along Z a bore.
import { keyOf, type Document } from "../../../store/document";
import { tell } from "../../../store/session";
import type { Value } from "../../../toml/edit";
import { t } from "../../../words";
import { chosenPath } from "../items";
import { addOperation } from "../newoperation";
import type { Face } from "./face";

/** Least share of Z in the normal of a plane that a tool along Z mills. */
const LEVEL = 1 - 1e-4;

/** The setup to which an operation is added: that of the form. */
export function setupOf(doc: Document): number {
  const [first, second] = chosenPath(doc);
  return first === "setup" && typeof second === "number" ? second : 0;
}

/** The kind of operation that makes a face; null for none. */
export function kindOf(face: Face | null): "face" | "bore" | null {
  if (face?.kind === "plane") return face.normal[2] > LEVEL ? "face" : null;
  return face?.kind === "round" && face.hollow && face.axis[2] > LEVEL ? "bore" : null;
}

/** Whether the coordinates of the setup are those of the part but for its zero. */
export function isUpright(doc: Document): boolean {
  return doc.value(["setup", setupOf(doc), "orient"]) === undefined;
}

const round = (n: number) => Math.round(1000 * n) / 1000 + 0;

/** Adds the operation to the setup of the form; `top` is the height of the stock above the face [mm]. */
export function make(doc: Document, face: Face, stockTop: number): void {
  const setup = setupOf(doc);
  const given = doc.value(["setup", setup, "zero"]);
  const zero = Array.isArray(given) ? given.map(Number) : [0, 0, 0];
  let values: [string, Value][];
  if (face.kind === "plane") {
    const height = face.point[2];
    // On the very top there is nothing to mill off yet: the depth stays the example of the schema.
    const above = round(stockTop - height);
    values = [["top", round(height - zero[2])], ...(above > 0 ? ([["depth", above]] as [string, Value][]) : [])];
  } else {
    values = [
      ["at", face.centre.slice(0, 2).map((c, k) => round(c - zero[k]))],
      ["diameter", round(2 * face.radius)],
      ["top", round(face.top - zero[2])],
      ["depth", round(face.top - face.bottom)],
    ];
  }
  const kind = kindOf(face);
  if (!kind) return;
  if (addOperation(doc, setup, kind, values)) tell(t("measure.made", { key: keyOf(doc.chosen.value) }), true);
  else tell(t("measure.noPlace"));
}
