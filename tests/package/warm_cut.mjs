// One cut in WebAssembly, timed once the engine has compiled its best code, for `mandoline-bench --wasm 'node tests/package/warm_cut.mjs'`:
//   node tests/package/warm_cut.mjs MESH N
// Prints the process's time on all processors in ms during the call, with arrays copied in and out, and the number of cut-cells.
import { readFileSync } from 'node:fs';
import { init } from 'mandoline-wasm';

// Cuts. Code is compiled after two or three, but up to about the tenth results take memory that is new to the process, since garbage is
// collected late; native cuts free theirs at once.
const earlier = 11;

const [file, n] = process.argv.slice(2);
const { cut, readMesh } = await init();
const mesh = await readMesh(readFileSync(file), { name: file });
const once = () => cut(mesh, { cells: Number(n) }, { gridCellRegion: false }); // which the native cut does not make either
for (let i = 0; i < earlier; ++i) once();
const start = process.cpuUsage();
const cutMesh = once();
const { user, system } = process.cpuUsage(start);
console.log((user + system) / 1000, cutMesh.cellRegion.length);
