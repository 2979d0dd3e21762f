// A hole as it goes elsewhere: as an operation with its tool for a job, as a job of its own.
import { type Value, write } from "../../toml/edit";
import { type Table, numberOf, pointOf, table } from "./question";

function rows(values: Table): string {
  return Object.entries(values)
    .map(([key, value]) => `${key} = ${write(value as Value)}`)
    .join("\n");
}

/** Tool and operation as a job has them. */
export function operationText(values: Table): string {
  return `[[tool]]\n${rows(table(values.tool))}\n\n[[setup.operation]]\n${rows(table(values.operation))}\n`;
}

/** Width of a guessed stock beside the hole, as a share of its diameter. */
const BESIDE = 0.15;
/** Height of the moves above the stock [mm]. */
const SAFE = 20;

/** A job with this hole. Nobody has given its stock: the text says that it is a guess, a block about the hole down to its depth. */
export function jobText(values: Table, name: string): string {
  const operation = table(values.operation);
  const diameter = numberOf(operation.diameter) ?? 0;
  const [x, y] = pointOf(operation.at) ?? [0, 0];
  const top = numberOf(operation.top) ?? 0;
  const through = numberOf(operation.breakthrough) ?? 0;
  const depth = numberOf(operation.depth) ?? 0;
  const half = Math.ceil((0.5 + BESIDE) * diameter);
  // Under a blind hole a floor as thick as a quarter of its depth.
  const bottom = through > 0 ? top - depth : top - Math.ceil(1.25 * depth);
  const stock = { box: { min: [x - half, y - half, bottom], max: [x + half, y + half, top] } };
  const post = { control: "sinumerik-840d", ...table(values.post) };
  const title = typeof values.title === "string" ? values.title : name;
  return `# From a hole that was planned by itself. The stock is a guess, a block about the hole: write the real one.
format = 1
title = ${write(title)}
stock = ${write(stock)} # a guess
post = ${write(post as Value)}

[[tool]]
${rows(table(values.tool))}

[[setup]]
offset = "G54"
safe_height = ${top + SAFE}

[[setup.operation]]
${rows(operation)}
`;
}
