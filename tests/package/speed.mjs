// Times of cuts in WebAssembly beside those of the native program on one thread, medians of alternating runs:
//   node tests/package/speed.mjs [N] [runs] [MESH ...]
// By default of the scans that `npm run bench` fetches.
// Also the time of init() and the size of the module. Native runs are fresh processes that tell the time of the cut alone; WebAssembly runs are
// calls of cut(), arrays copied in and out, in one process after a first one that the engine still compiles during.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { init } from 'mandoline-wasm';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.MANDOLINE_CLI ?? join(root, 'build', 'mandoline');
const [cells = '50', runs = '9', ...given] = process.argv.slice(2);
const scans = join(root, 'build', 'scans');
const files = given.length > 0 ? given : readdirSync(scans).map((name) => join(scans, name));

const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

function timed(f) {
  const start = performance.now();
  f();
  return performance.now() - start;
}

function nativeTime(file) {
  const report = execFileSync(program, ['cut', file, '--cells', cells, '--threads', '1', '--report', '-'], { encoding: 'utf8', maxBuffer: 2 ** 28 });
  return JSON.parse(report).timings.total;
}

const start = performance.now();
const { cut, readMesh } = await init();
console.log(`init ${(performance.now() - start).toFixed(1)} ms`);
const bytes = readFileSync(fileURLToPath(new URL('./mandoline.wasm', import.meta.resolve('mandoline-wasm'))));
console.log(`mandoline.wasm ${(bytes.length / 1024).toFixed(0)} KB, gzipped ${(gzipSync(bytes, { level: 9 }).length / 1024).toFixed(0)} KB`);

for (const file of files) {
  const mesh = await readMesh(readFileSync(file), { name: file });
  const once = () => cut(mesh, { cells: Number(cells) }, { gridCellRegion: false });
  const first = timed(once);
  const native = [];
  const wasm = [];
  for (let run = 0; run < Number(runs); ++run) {
    native.push(nativeTime(file));
    wasm.push(timed(once));
  }
  console.log(`${file.replace(/.*\//, '')} N = ${cells}, first call ${first.toFixed(1)} ms`);
  for (const [name, of] of [['median', median], ['least', (times) => Math.min(...times)]]) { // the latter for machines with other work
    console.log(`  ${name}: native ${of(native).toFixed(1)} ms, WebAssembly ${of(wasm).toFixed(1)} ms, ratio ${(of(wasm) / of(native)).toFixed(2)}`);
  }
}
