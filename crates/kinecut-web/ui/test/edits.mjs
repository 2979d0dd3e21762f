// Changes of texts, for edits.py: reads {text, ops: [{do, path, value}]} from standard input, writes the texts after each change.
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const built = await build({ stdin: { contents: 'export * from "../src/toml/edit"; export * from "../src/toml/parse";', resolveDir: here }, bundle: true, format: "esm", write: false });
const toml = await import(`data:text/javascript;base64,${Buffer.from(built.outputFiles[0].text).toString("base64")}`);
const apply = (text, change) => change && text.slice(0, change.from) + change.insert + text.slice(change.to);
const out = [];
for (const { text, ops } of JSON.parse(readFileSync(0, "utf8"))) {
  out.push({
    values: toml.plain(toml.parse(text)),
    after: ops.map(({ what, path, value }) => {
      if (what === "set") return apply(text, toml.set(text, path, value));
      if (what === "remove") return apply(text, toml.remove(text, path));
      return apply(text, toml.append(text, path, value)?.change);
    }),
  });
}
process.stdout.write(JSON.stringify(out));
