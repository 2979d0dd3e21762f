// Bundles the workbench into dist of the crate: page, application, style, and each library as a file of its own that changes only with
// its version. dist/manifest.json records from which sources: a test of the crate compares it, so that a forgotten build is noticed
// without Node.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const crates = join(here, "../..");
const dist = join(here, "../dist");
const palette = join(crates, "kinecut/src/page/draw/palette.rs");
const viewer = join(crates, "kinecut/viewer/src");

/** Files of a library, by the beginnings of the names that are imported. */
const VENDORS = { preact: ["preact", "@preact/"], codemirror: ["@codemirror/", "@lezer/"], three: ["three"] };
/** Languages beside English. */
const LANGUAGES = ["uk", "ru", "de"];
const common = { absWorkingDir: here, bundle: true, minify: true, format: "esm", target: "es2022", charset: "utf8", legalComments: "eof", write: false };

function walk(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? walk(path) : [path];
  });
}

function vendorOf(name) {
  return Object.keys(VENDORS).find((vendor) => VENDORS[vendor].some((begin) => name === begin || name.startsWith(begin.endsWith("/") ? begin : `${begin}/`)));
}

/** The names that the sources import from each module of a library; with types alone none. */
function imports(files) {
  const found = new Map();
  const add = (module, name) => {
    if (!vendorOf(module)) return;
    if (!found.has(module)) found.set(module, new Set());
    if (name) found.get(module).add(name);
  };
  for (const file of files.filter((f) => /\.tsx?$/.test(f))) {
    const text = readFileSync(file, "utf8");
    for (const [, names, module] of text.matchAll(/^import \{([^}]*)\} from "([^"]+)"/gm)) {
      for (const name of names.split(",").map((n) => n.trim())) if (name && !name.startsWith("type ")) add(module, name.split(" as ")[0]);
    }
    if (file.endsWith(".tsx")) for (const name of ["jsx", "jsxs", "Fragment"]) add("preact/jsx-runtime", name);
  }
  return found;
}

function names(files) {
  return files.map((file) => relative(crates, file).replaceAll("\\", "/")).sort();
}

/** Colours of the crate's palette as variables, in light and in dark. */
function tokens() {
  const text = readFileSync(palette, "utf8");
  const colours = [...text.matchAll(/^ {4}\("([\w-]+)", "(#\w+)", "(#\w+)"\),/gm)];
  const scale = [...(/const SCALE[^=]*= \[([^\]]*)\]/.exec(text)?.[1] ?? "").matchAll(/#\w+/g)].map(([c], i) => `--scale${i}:${c}`);
  if (colours.length < 60 || scale.length !== 16) throw new Error("the palette of the crate is not as expected");
  const of = (k) => colours.map((c) => `--${c[1]}:${c[k]}`).join(";");
  return `:root{${of(2)};${scale.join(";")}}:root[data-theme=dark]{${of(3)}}\n`;
}

/** Light colours in print. */
function paper() {
  const light = /^:root\{([^}]*)\}/.exec(tokens())[1];
  return `@media print{:root[data-theme=dark]{color-scheme:light;${light}}}\n`;
}

const sources = walk(join(here, "src"));
const shared = walk(viewer).filter((file) => file.endsWith(".ts"));
const wanted = imports([...sources, ...shared]);
const outside = {
  name: "libraries",
  setup({ onResolve }) {
    onResolve({ filter: /^[@a-z]/ }, ({ path, kind }) => {
      if (kind === "entry-point") return undefined;
      if (path.startsWith("viewer/")) return { path: join(viewer, `${path.slice("viewer/".length)}.ts`) };
      const vendor = vendorOf(path);
      return vendor && { path: `./vendor/${vendor}.js`, external: true };
    });
  },
};
/** Names of one library must differ over its modules: they stand in one file. */
function entry(vendor) {
  const seen = new Set();
  return [...wanted]
    .filter(([module]) => vendorOf(module) === vendor)
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .map(([module, all]) => {
      const fresh = [...all].sort().filter((name) => !seen.has(name));
      for (const name of fresh) seen.add(name);
      return `export { ${fresh.join(", ")} } from "${module}";`;
    })
    .join("\n");
}

rmSync(dist, { recursive: true, force: true });
for (const folder of ["vendor", "words"]) mkdirSync(join(dist, "assets", folder), { recursive: true });
const written = [];
function write(name, text) {
  writeFileSync(join(dist, name), text);
  written.push(name);
}
for (const vendor of Object.keys(VENDORS)) {
  const result = await build({ ...common, stdin: { contents: entry(vendor), resolveDir: here } });
  write(`assets/vendor/${vendor}.js`, `${result.outputFiles[0].text.trimEnd()}\n`);
}
const app = await build({
  ...common,
  entryPoints: [join(here, "src/main.tsx")],
  jsx: "automatic",
  jsxImportSource: "preact",
  plugins: [outside],
  legalComments: "none",
  loader: { ".toml": "text" },
});
write("assets/app.js", `${app.outputFiles[0].text.trimEnd()}\n`);
// Catalogues of other languages, each loaded when it is chosen.
for (const tag of LANGUAGES) {
  const words = await build({ ...common, entryPoints: [join(here, `src/words/${tag}/index.ts`)] });
  write(`assets/words/${tag}.js`, `${words.outputFiles[0].text.trimEnd()}\n`);
}
const style = await build({ ...common, entryPoints: [join(here, "src/app/style.css")], outdir: join(dist, "assets") });
write("assets/app.css", tokens() + style.outputFiles[0].text);
// Teaching pages: one script with all that it needs, so that a page that is saved works alone.
const teaching = await build({ ...common, entryPoints: [join(here, "src/teaching/main.tsx")], jsx: "automatic", jsxImportSource: "preact", legalComments: "none" });
write("assets/teaching.js", `${teaching.outputFiles[0].text.trimEnd()}\n`);
for (const [name, entry] of [["teaching", "style"], ["teaching-alone", "alone"]]) {
  const sheet = await build({ ...common, entryPoints: [join(here, `src/teaching/${entry}.css`)], outdir: join(dist, "assets") });
  // Paper is white, whatever the screen is.
  write(`assets/${name}.css`, (entry === "alone" ? tokens() : "") + sheet.outputFiles[0].text + paper());
}
write("assets/icon.svg", readFileSync(join(here, "src/icon.svg"), "utf8"));
write("index.html", readFileSync(join(here, "index.html"), "utf8"));

// Sources: names below `crates/` in byte order, each file as its name, a zero byte, its bytes, a zero byte.
const all = [...sources, ...shared, palette, ...["package-lock.json", "build.mjs", "index.html"].map((name) => join(here, name))];
const hash = createHash("sha256");
for (const name of names(all)) hash.update(name).update("\0").update(readFileSync(join(crates, name))).update("\0");
const digest = (name) => createHash("sha256").update(readFileSync(join(dist, name))).digest("hex");
const manifest = { sources: hash.digest("hex"), files: Object.fromEntries(written.sort().map((name) => [name, digest(name)])) };
writeFileSync(join(dist, "manifest.json"), `${JSON.stringify(manifest, null, 1)}\n`);
