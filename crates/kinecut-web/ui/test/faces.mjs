// Faces of meshes that are known: node test/faces.mjs. Cylinders of all directions, inside and outside, with noise, as strips, with caps; and
// what is none: planes, cones, balls, rings.
import assert from "node:assert/strict";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const built = await build({ stdin: { contents: 'export * from "../src/windows/job/measure/face";', resolveDir: here }, bundle: true, format: "esm", write: false });
const { faceAt, betweenAxes } = await import(`data:text/javascript;base64,${Buffer.from(built.outputFiles[0].text).toString("base64")}`);

let state = 7;
/** Evenly from -1 to 1, the same each time. */
const random = () => ((state = (state * 1103515245 + 12345) % 2147483648) / 1073741824) - 1;
const add = (a, b, by = 1) => a.map((n, k) => n + by * b[k]);
const dot = (a, b) => a.reduce((sum, n, k) => sum + n * b[k], 0);
const unit = (a) => a.map((n) => n / Math.hypot(...a));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

function across(axis) {
  const u = unit(cross(axis, Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  return [u, cross(axis, u)];
}

/** A grid of places as a mesh; `place` of two shares. Seen from where the first runs right and the second up. */
function sheet(n, m, closed, place, turned = false) {
  const positions = [];
  const columns = closed ? n : n + 1;
  for (let j = 0; j <= m; j++) for (let i = 0; i < columns; i++) positions.push(...place(i / n, j / m));
  const indices = [];
  const at = (i, j) => (i % columns) + j * columns;
  for (let j = 0; j < m; j++) {
    for (let i = 0; i < n; i++) {
      for (const t of [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]) indices.push(...(turned ? t.reverse() : t));
    }
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices), deviation: null };
}

/** Wall of a cylinder from a place along an axis; `part` of a turn, `hollow` seen from inside. */
function wall(axis, from, radius, length, { part = 1, hollow = false, noise = 0, n = 60, m = 12 } = {}) {
  const [u, v] = across(axis);
  return sheet(n, m, part === 1, (a, b) => {
    const angle = 2 * Math.PI * part * a;
    const r = radius + noise * random();
    return add(add(add(from, axis, length * b), u, r * Math.cos(angle)), v, r * Math.sin(angle));
  }, hollow);
}

let count = 0;
function isRound(data, axis, from, radius, length, { hollow = false, tilt = 1e-6, wide = 1e-4, step = 0.2, triangle } = {}) {
  const seed = triangle ?? Math.floor(data.indices.length / 6) ;
  const face = faceAt(data, seed, step);
  assert.equal(face?.kind, "round", `${axis} ${radius} ${JSON.stringify(face)}`);
  assert.equal(face.hollow, hollow);
  assert.ok(1 - Math.abs(dot(face.axis, axis)) <= tilt, `axis ${face.axis} of ${axis}`);
  assert.ok(Math.abs(face.radius - radius) <= wide, `${face.radius} of ${radius}`);
  const way = add(from, face.centre, -1);
  assert.ok(Math.hypot(...add(way, face.axis, -dot(way, face.axis))) <= wide + length * Math.sqrt(2 * tilt), "place of the axis");
  assert.ok(Math.abs(face.top - face.bottom - length) <= 2 * wide + 1e-3, `${face.top - face.bottom} of ${length}`);
  count++;
  return face;
}

for (let k = 0; k < 60; k++) {
  const axis = k < 3 ? [0, 0, 0].map((_, i) => Number(i === k)) : unit([random(), random(), random()]);
  const from = [50 * random(), 50 * random(), 50 * random()];
  const radius = 2 + 20 * Math.abs(random());
  const length = radius * (0.5 + 2 * Math.abs(random()));
  for (const hollow of [false, true]) {
    const face = isRound(wall(axis, from, radius, length, { hollow }), axis, from, radius, length, { hollow });
    // An axis along a coordinate is that coordinate.
    if (k < 3) assert.deepEqual(face.axis.map((n) => n + 0), axis);
    isRound(wall(axis, from, radius, length, { hollow, part: 0.3, n: 24 }), axis, from, radius, length, { hollow, wide: 1e-3, tilt: 1e-5 });
    isRound(wall(axis, from, radius, length, { hollow, noise: 0.004, m: 6 }), axis, from, radius, length, { hollow, wide: 0.01, tilt: 2e-6 });
  }
  const two = [0, 1].map((i) => isRound(wall(axis, add(from, across(axis)[0], 7 * i), radius, length), axis, add(from, across(axis)[0], 7 * i), radius, length));
  assert.ok(Math.abs(betweenAxes(...two) - 7) < 1e-3, `${betweenAxes(...two)}`);
}

// What is no cylinder.
for (let k = 0; k < 20; k++) {
  const axis = k < 3 ? [0, 0, 0].map((_, i) => Number(i === k)) : unit([random(), random(), random()]);
  const [u, v] = across(axis);
  const round = (a, r, h) => add(add(add([0, 0, 0], axis, h), u, r * Math.cos(2 * Math.PI * a)), v, r * Math.sin(2 * Math.PI * a));
  const shapes = {
    cone: sheet(60, 12, true, (a, b) => round(a, 20 - 6 * b, 12 * b)),
    ball: sheet(60, 30, true, (a, b) => round(a, 20 * Math.sin(0.2 + 2.7 * b), -20 * Math.cos(0.2 + 2.7 * b))),
    ring: sheet(80, 40, true, (a, b) => round(a, 30 + 8 * Math.cos(2 * Math.PI * b), 8 * Math.sin(2 * Math.PI * b))),
  };
  for (const [name, data] of Object.entries(shapes)) {
    const triangles = data.indices.length / 3;
    for (const share of [0.2, 0.5, 0.77]) {
      const face = faceAt(data, Math.floor(triangles * share), 0.2);
      assert.ok(face?.kind !== "round", `${name} about ${axis} at ${share}: ${JSON.stringify(face)}`);
      count++;
    }
  }
  const plane = sheet(20, 20, false, (a, b) => add(add([1, 2, 3], u, 40 * a), v, 40 * b));
  const face = faceAt(plane, 300, 0.2);
  assert.equal(face?.kind, "plane");
  assert.ok(Math.abs(dot(face.normal, axis)) > 1 - 1e-9);
  count++;
}
console.log(`faces: ${count} as they should be`);
