// The parts of a job as the form lists them: sections, and what is in each.
import type { OperationRun } from "../../base/api";
import { clock } from "../../base/format";
import { type Document, keyOf } from "../../store/document";
import type { Path } from "../../toml/parse";
import { named, t } from "../../words";

export interface Item {
  path: Path;
  /** Number before the name. */
  number: string;
  label: string;
  /** Whether the label is a name of the text. */
  verbatim?: boolean;
  /** What stands at the right, quiet. */
  side: string;
  findings: { severity: string; count: number } | null;
}

export interface Section {
  id: string;
  label: string;
  items: Item[];
  /** The lists of tables to which something can be added. */
  adds: "operation" | "tools" | "fixtures" | null;
}

type Values = Record<string, unknown>;

const table = (v: unknown): Values => (typeof v === "object" && v !== null && !Array.isArray(v) ? (v as Values) : {});
const list = (v: unknown): Values[] => (Array.isArray(v) ? v.map(table) : []);

/** The name of an operation: its kind with its size. */
export function operationName(operation: Values): string {
  const kind = String(operation.type ?? "");
  if (typeof operation.name === "string" && operation.name !== "") return t("form.sized", { kind: named(kind), size: ` ${operation.name}` });
  const size = operation.diameter ?? operation.size ?? operation.thread;
  const told = size === undefined || typeof size === "object" ? "" : typeof size === "number" ? ` ⌀${size}` : ` ${String(size)}`;
  const points = Array.isArray(operation.points) && operation.points.length > 1 ? `, ${t("form.holes", { n: operation.points.length })}` : "";
  return t("form.sized", { kind: named(kind), size: told + points });
}

function severest(doc: Document, path: Path): Item["findings"] {
  const key = keyOf(path);
  const own = doc.findings.value.filter((f) => f.severity !== "note" && (f.key === key || f.key?.startsWith(`${key}.`) || f.key?.startsWith(`${key}[`)));
  if (own.length === 0) return null;
  const severity = ["error", "doubt", "warning"].find((s) => own.some((f) => f.severity === s)) ?? "warning";
  return { severity, count: own.length };
}

/** The runs of lines of an operation. */
export function runsOf(runs: OperationRun[] | undefined, path: Path): OperationRun[] {
  const key = keyOf(path);
  return (runs ?? []).filter((run) => run.key === key);
}

function side(doc: Document, path: Path, operation: Values): string {
  const runs = runsOf(doc.work.value?.operations, path);
  const track = doc.shown.value?.track;
  const tools = [...new Set(runs.map((run) => run.tool))];
  const tool = tools.length > 0 ? tools.map((n) => `T${n}`).join(" ") : typeof operation.tool === "number" ? `T${operation.tool}` : "";
  if (!track || runs.length === 0) return tool;
  let seconds = 0;
  for (const { from, to } of runs) for (let l = from; l < Math.min(to, track.lines); l++) seconds += track.lineTime[l];
  return [tool, seconds > 0 ? clock(seconds) : ""].filter(Boolean).join(" · ");
}

function item(doc: Document, path: Path, label: string, number = "", right = ""): Item {
  return { path, number, label, side: right, findings: severest(doc, path) };
}

export function sections(doc: Document): Section[] {
  const values = doc.values.value;
  const out: Section[] = list(values.setup).map((setup, i) => ({
    id: `setup${i}`,
    label: typeof setup.offset === "string" ? t("form.setup", { n: i + 1, offset: setup.offset }) : t("form.setupOnly", { n: i + 1 }),
    adds: "operation",
    items: [
      ...list(setup.operation).map((operation, k) => {
        const path = ["setup", i, "operation", k];
        return item(doc, path, operationName(operation), String(k + 1), side(doc, path, operation));
      }),
      item(doc, ["setup", i], t("form.clamping")),
    ],
  }));
  out.push({
    id: "job",
    label: t("form.job"),
    adds: null,
    items: [item(doc, [], t("form.job")), ...(["stock", "design", "machine", "post", "simulate"] as const).map((key) => item(doc, [key], t(`form.${key}`)))],
  });
  out.push({
    id: "tools",
    label: t("form.tools"),
    adds: "tools",
    items: [
      ...list(values.tool).map((tool, i) => ({ ...item(doc, ["tool", i], String(tool.name ?? ""), `T${String(tool.number ?? "")}`), verbatim: true })),
      ...list(values.holder).map((holder, i) => item(doc, ["holder", i], t("form.holder", { name: String(holder.name ?? i + 1) }))),
    ],
  });
  out.push({
    id: "fixtures",
    label: t("form.fixtures"),
    adds: "fixtures",
    items: list(values.fixture).map((_, i) => item(doc, ["fixture", i], t("form.fixture", { n: i + 1 }), String(i + 1))),
  });
  return out;
}

/** The item of the form to which a path belongs. */
export function itemPath(path: Path): Path {
  const [first, second, third, fourth] = path;
  if (first === "setup" && third === "operation" && typeof fourth === "number") return path.slice(0, 4);
  if ((first === "setup" || first === "tool" || first === "holder" || first === "fixture") && typeof second === "number") return path.slice(0, 2);
  if (typeof first === "string" && ["stock", "design", "machine", "post", "simulate"].includes(first)) return [first];
  return [];
}

export function sectionOf(all: Section[], path: Path): Section {
  const key = keyOf(path);
  return all.find((s) => s.items.some((i) => keyOf(i.path) === key)) ?? all[0];
}

/** The item that is chosen, or the first operation. */
export function chosenPath(doc: Document): Path {
  const path = itemPath(doc.chosen.value);
  if (doc.chosen.value.length > 0 && (path.length === 0 || doc.value(path) !== undefined || path.length === 1)) return path;
  const first: Path = ["setup", 0, "operation", 0];
  return doc.value(first) !== undefined ? first : doc.value(["setup", 0]) !== undefined ? ["setup", 0] : [];
}
