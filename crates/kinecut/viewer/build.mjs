// Bundles the report's script and style into src/page/assets of the crate, and records from which sources: a test
// of the crate compares the record, so a forgotten build is noticed without Node.
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = join(here, "../src/page/assets");

for (const [source, target] of [["main.ts", "report.js"], ["report.css", "report.css"]]) {
  const result = await build({
    entryPoints: [join(here, "src", source)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "inline",
    write: false,
  });
  writeFileSync(join(out, target), result.outputFiles[0].text.trimEnd());
}

// The same walk as in the test: names in byte order, each file as its name, a zero byte, its bytes, a zero byte.
const hash = createHash("sha256");
const names = readdirSync(join(here, "src")).map((name) => `src/${name}`).concat("package-lock.json").sort();
for (const name of names) {
  hash.update(name).update("\0").update(readFileSync(join(here, name))).update("\0");
}
writeFileSync(join(out, "sources.sha256"), `${hash.digest("hex")}\n`);
