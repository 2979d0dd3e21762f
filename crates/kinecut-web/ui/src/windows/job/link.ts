// Who goes to a line, a place or a time has chosen its operation in the form too.
import { keyOf, pathOf } from "../../store/document";
import { active, cursor } from "../../store/session";
import { runAt } from "../../store/runs";
import { chosenPath } from "./items";

/** Sources of the cursor that are no choice of a person: the form stays what it is. */
const BY_ITSELF = ["play", "load", "tab", "form"];

cursor.listen((place, source) => {
  const doc = active.peek();
  if (!doc || doc.kind === "program" || BY_ITSELF.includes(source)) return;
  const run = runAt(doc.work.peek()?.operations, place.line);
  if (run && keyOf(chosenPath(doc)) !== run.key && doc.value(pathOf(run.key)) !== undefined) doc.chosen.value = pathOf(run.key);
});
