// Questions of `kinecut grazing` and `kinecut envelope`, in their windows.
import * as api from "../../base/api";
import type { QuestionKind } from "../../store/questions";
import { EnvelopeWindow } from "./envelope";
import { BEGIN, isOf } from "./question";
import { INTERVALS } from "./scrub";
import { type Growth, type Sheet, answersOf, isGrowth, isSheet } from "./sheet";
import { GrazingWindow } from "./window";

function asFinding(told: unknown): api.Finding | null {
  const table = told as Partial<api.Finding> & { bands?: unknown; moments?: unknown; moves?: unknown };
  return Array.isArray(told) || table.bands || table.moments || table.moves ? null : (table as api.Finding);
}

export const grazing: QuestionKind = {
  name: "grazing",
  isOf: (values) => isOf("grazing", values),
  async ask(question, signal) {
    const answer = await api.verb<Sheet>("grazing", question, signal);
    const wrong = asFinding(answer);
    return wrong ? { wrong } : { answer };
  },
  findings: (answer) => answersOf<Sheet>(answer).flatMap((one) => (isSheet(one) ? one.findings : [one])),
  Window: GrazingWindow,
  begin: { command: "command.grazing", stem: "grazing", text: BEGIN.grazing },
};

export const envelope: QuestionKind = {
  name: "envelope",
  isOf: (values) => isOf("envelope", values),
  async ask(question, signal) {
    const answer = await api.verb<Growth>("envelope", { ...question, moments: INTERVALS }, signal);
    const wrong = asFinding(answer);
    return wrong ? { wrong } : { answer };
  },
  findings: (answer) => answersOf<Growth>(answer).flatMap((one) => (isGrowth(one) ? one.findings : [one])),
  Window: EnvelopeWindow,
  begin: { command: "command.envelope", stem: "envelope", text: BEGIN.envelope },
};
