// Questions of `kinecut hole`, in their window.
import * as api from "../../base/api";
import type { QuestionKind } from "../../store/questions";
import { parse, plain } from "../../toml/parse";
import { type Plan, planOf } from "./answer";
import { BEGIN } from "./begin";
import { type Table, isHole, table } from "./question";
import { lookedAt } from "./state";
import { HoleWindow } from "./window";

export const hole: QuestionKind = {
  name: "hole",
  isOf: isHole,
  async ask(question, signal) {
    const { operation } = plain(parse(question.text)) as Table;
    const samples = lookedAt(question.file ?? question.new ?? "", table(operation));
    const answer = await api.verb<Plan>("hole", { ...question, samples }, signal);
    return planOf(answer) ? { answer } : { wrong: answer as api.Finding };
  },
  findings: (answer) => planOf(answer)?.findings ?? [],
  Window: HoleWindow,
  begin: { command: "command.hole", stem: "hole", text: BEGIN },
};
