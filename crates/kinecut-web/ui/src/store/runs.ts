// Operations as the text has them: a hole by its size is one entry of the text and several operations of the job.
import type { Finding, OperationRun, Verdict } from "../base/api";
import { type Table, parse, pathAt } from "../toml/parse";
import { indexOfByte, keyOf } from "./document";

/** What an answer says about operations. */
interface OfOperations {
  operations?: OperationRun[];
  findings: Finding[];
  verdict?: Verdict;
}

const OPERATION = /^setup\[\d+\]\.operation\[\d+\]/;

function keyAt(tree: Table, text: string, run: OperationRun): string {
  if (!run.place || run.place.line < 1 || run.place.start === undefined) return run.key;
  const path = pathAt(tree, indexOfByte(text, run.place.start)).slice(0, 4);
  return path[0] === "setup" && path[2] === "operation" && path.length === 4 ? keyOf(path) : run.key;
}

/** Puts the keys of the text into an answer in the place of those of the job. */
export function keyedByText<T extends OfOperations>(answer: T, text: string): T {
  if (!answer.operations) return answer;
  const tree = parse(text);
  const keys = new Map(answer.operations.map((run) => [run.key, keyAt(tree, text, run)]));
  const own = (key: string) => key.replace(OPERATION, (operation) => keys.get(operation) ?? operation);
  const ofText = (all: Finding[]) => all.map((finding) => (finding.key ? { ...finding, key: own(finding.key) } : finding));
  return {
    ...answer,
    operations: answer.operations.map((run) => ({ ...run, key: own(run.key) })),
    findings: ofText(answer.findings),
    ...(answer.verdict && { verdict: { ...answer.verdict, found: ofText(answer.verdict.found) } }),
  };
}

/** The run of lines that holds one; undefined where no operation has it. */
export function runAt(runs: OperationRun[] | undefined, line: number): OperationRun | undefined {
  return runs?.find((run) => run.from <= line && line < run.to);
}
