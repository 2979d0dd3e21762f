// Questions of `kinecut drill`, in their window.
import * as api from "../../base/api";
import { type DrillSheet, isHole } from "../../base/drillsheet";
import type { QuestionKind } from "../../store/questions";
import { BEGIN } from "./start";
import { DrillWindow } from "./window";

export const drilling: QuestionKind = {
  name: "drilling",
  isOf: ({ operation }) => typeof operation === "object" && operation !== null && (operation as Record<string, unknown>).type === "drill",
  async ask(question, signal) {
    const answer = await api.verb<DrillSheet>("drill", { paper: true, load: true, ...question }, signal);
    return "holes" in answer ? { answer } : { wrong: answer };
  },
  page: (question, signal) => api.verbPage("drill", { paper: true, ...question }, signal),
  findings: (answer) => (answer as DrillSheet).holes.flatMap((hole) => (isHole(hole) ? hole.findings : [hole.error])),
  Window: DrillWindow,
  begin: { command: "command.drilling", stem: "drilling", text: BEGIN },
};
