// Times of calls in WebAssembly: init(), cuts, fifty slices, the cell at a point, the triangles of a cell, validate(); and the size of the module.
//   node tests/package/speed.mjs [N] [runs] [MESH ...]
// By default of the scans that `npm run bench` fetches, which has the times of cuts beside native ones.
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { init } from 'mandoline-wasm';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const withoutDense = { gridCellRegion: false };
const [cells = '50', runs = '9', ...given] = process.argv.slice(2);
const scans = join(root, 'build', 'scans');
const files = given.length > 0 ? given : readdirSync(scans).map((name) => join(scans, name));

const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

async function timed(f) {
  const start = performance.now();
  await f();
  return performance.now() - start;
}

/** Median times of calls on a cut-mesh, of several calls each where one is too short for the clock. */
async function reportCalls(mesh, cutMesh) {
  const many = 100;
  const z = cutMesh.grid.planes[2];
  const heights = Array.from({ length: 50 }, (_, i) => z[0] + ((z.at(-1) - z[0]) * (i + 0.5)) / 50);
  const last = cutMesh.cellRegion.length - 1;
  const each = (f) => () => {
    for (let i = 0; i < many; ++i) f(i);
  };
  const calls = [
    ['cut()', 1, () => cut(mesh, { cells: Number(cells) }, withoutDense)],
    ['slices() by 50 planes', 1, () => slices(cutMesh, [0, 0, 1], heights)],
    ['cellAt()', many, each((i) => cellAt(cutMesh, cutMesh.positions.subarray(3 * i, 3 * i + 3)))],
    ['triangulate() of a cell', many, each((i) => triangulate(cutMesh, { cell: Math.round((i * last) / many) }))],
    ['validate()', 1, () => validate(mesh, cutMesh)],
  ];
  for (const [name, count, f] of calls) {
    const times = [];
    for (let run = 0; run < Number(runs); ++run) times.push((await timed(f)) / count);
    console.log(`  ${name}: median ${median(times).toPrecision(3)} ms, least ${Math.min(...times).toPrecision(3)} ms`);
  }
}

const start = performance.now();
const { cellAt, cut, readMesh, slices, triangulate, validate } = await init();
console.log(`init ${(performance.now() - start).toFixed(1)} ms`);
const bytes = readFileSync(fileURLToPath(new URL('./mandoline.wasm', import.meta.resolve('mandoline-wasm'))));
const packed = gzipSync(bytes, { level: 9 });
console.log(`mandoline.wasm ${(bytes.length / 1024).toFixed(0)} KB, gzipped ${(packed.length / 1024).toFixed(0)} KB`);

for (const file of files) {
  const mesh = await readMesh(readFileSync(file), { name: file });
  const before = performance.now();
  const cutMesh = cut(mesh, { cells: Number(cells) }, withoutDense);
  console.log(`${file.replace(/.*\//, '')} N = ${cells}, first cut() ${(performance.now() - before).toFixed(1)} ms`);
  await reportCalls(mesh, cutMesh);
}
