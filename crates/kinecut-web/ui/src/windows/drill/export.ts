// A drilling as it goes elsewhere: as an operation with its tool for a job, as a job of its own.
import type { Hole } from "../../base/drillsheet";
import { type Value, write } from "../../toml/edit";
import { exitFace, questionOf } from "./question";
import { lineOf } from "./faces";

type Table = Record<string, unknown>;

function rows(values: Table): string {
  return Object.entries(values)
    .map(([key, value]) => `${key} = ${write(value as Value)}`)
    .join("\n");
}

function parts(values: Table): { tool: Table; operation: Table } {
  const tool = (values.tool ?? {}) as Table;
  const operation = { ...((values.operation ?? {}) as Table) };
  // Without a place the drilling is about the zero of the entry.
  if (operation.points === undefined && operation.pattern === undefined) operation.points = [[0, 0]];
  return { tool, operation };
}

/** Tool and operation as a job has them. */
export function operationText(values: Table): string {
  const { tool, operation } = parts(values);
  return `[[tool]]\n${rows(tool)}\n\n[[setup.operation]]\n${rows(operation)}\n`;
}

/** Width of a guessed stock on each side of the hole, in diameters. */
const BESIDE = 2;
/** Height of the moves above the stock [mm]. */
const SAFE = 20;

/**
 * A job with this drilling. Nobody has given its stock: the text says that it is a guess, a block about the hole between the highest and the
 * lowest place of both surfaces.
 */
export function jobText(values: Table, hole: Hole, name: string): string {
  const { tool, operation } = parts(values);
  const question = questionOf(values);
  const { diameter } = question;
  const wide = Math.ceil(BESIDE * diameter);
  const place = hole.at;
  const through = hole.coordinates.Z_nvyh1 !== null;
  const heights = (line: ReturnType<typeof lineOf>) => (line ? [-diameter / 2, 0, diameter / 2].map((u) => line.height(Math.min(line.to, Math.max(line.from, u)))) : []);
  const top = Math.max(...heights(lineOf(question.entry, "entry", place, 0)), hole.coordinates.Z_nvr1 - question.approach);
  const bottom = through
    ? Math.min(...heights(lineOf(exitFace(question), "exit", place, question.length)), hole.coordinates.Z_nvyh1 ?? 0)
    : hole.coordinates.Z_end - diameter;
  const round = (n: number) => Number(n.toFixed(3));
  const own = typeof operation.top === "number" ? operation.top : 0;
  const points = (operation.points as [number, number][] | undefined) ?? [place];
  const range = (axis: 0 | 1) => [Math.min(...points.map((p) => p[axis])) - wide, Math.max(...points.map((p) => p[axis])) + wide];
  const [[x0, x1], [y0, y1]] = [range(0), range(1)];
  const stock = { box: { min: [x0, y0, round(own + bottom)], max: [x1, y1, round(own + top)] } };
  const post = { control: "sinumerik-840d", ...((values.post ?? {}) as Table) };
  const title = typeof values.title === "string" ? values.title : name;
  return `# From a drilling that was planned by itself. The stock is a guess, a block about the hole: write the real one.
format = 1
title = ${write(title)}
stock = ${write(stock)} # a guess
post = ${write(post as Value)}

[[tool]]
${rows(tool)}

[[setup]]
offset = "G54"
safe_height = ${round(own + top + SAFE)}

[[setup.operation]]
${rows(operation)}
`;
}
