// The answer to a drilling, with the text it is of.
import type { DrillSheet } from "../../base/drillsheet";
import type { Document } from "../../store/document";
import type { Answered } from "../../store/questions";

export interface Drilled extends Answered {
  answer: DrillSheet;
}

export function drilled(doc: Document): Drilled | null {
  return doc.answered.value as Drilled | null;
}
