// What the projects run: a cut, validated, and cut again, the same in a worker, and a call of one's own in a worker of one's own; and the cells of all,
// computed.
import assert from 'node:assert/strict';

const mesh = `{
  positions: [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1],
  triangles: [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5],
}`;

/** A module that exports check(). The parameters are code: further imports, the arguments of init() and createWorker(), what comes last. */
export function checkModule({ imports = '', options = '', workerOptions = options, more = '' } = {}) {
  return `
import { init } from 'mandoline-wasm';
import { createWorker } from 'mandoline-wasm/worker';
${imports}
const mesh = ${mesh};

export async function check() {
  const { createRecutter, cut, validate } = await init(${options});
  const here = cut(mesh, { cells: 8 });
  const worker = await createWorker(${workerOptions});
  const there = await worker.cut(mesh, { cells: 8 });
  const valid = [await validate(mesh, here), await worker.validate(mesh, there)].map(({ pass }) => pass).join();
  const recutters = [await createRecutter(here.grid), await worker.createRecutter(here.grid)];
  const again = [await recutters[0].cut(mesh), await recutters[1].cut(mesh)].map(({ cellRegion }) => cellRegion.length).join();
  worker.terminate();
  const result = { cells: here.cellRegion.length, same: String(here.positions) === String(there.positions), valid, again };
  ${more}
  return result;
}
`;
}

/** For toolchains that bundle workers: a worker of one's own. */
export const ownWorker = {
  more: `
  const own = await createWorker({ thread: () => new Worker(new URL('./thread.js', import.meta.url), { type: 'module' }) });
  result.own = await own.call('countCells', [mesh]);
  own.terminate();`,
  files: {
    'thread.js': `
import { serve } from 'mandoline-wasm/worker-thread';

serve({ countCells: (mandoline, [mesh]) => mandoline.cut(mesh, { cells: 8 }).cellRegion.length });
`,
  },
};

/** All cells, here and in a worker that computes. `options` and `workerOptions` are code: the arguments of initPhysics() and createWorker(). */
export function physics(options = '', workerOptions = options) {
  return {
    imports: `import { initPhysics } from 'mandoline-wasm/physics';
import { createWorker as createPhysicsWorker } from 'mandoline-wasm/physics/worker';`,
    more: `
  const { cellComplex } = await initPhysics(${options});
  const computing = await createPhysicsWorker(${workerOptions});
  const complex = await computing.cellComplex(mesh, await computing.cut(mesh, { cells: 8 }));
  computing.terminate();
  result.computed = [cellComplex(mesh, here), complex].map(({ cellRegion }) => cellRegion.length).join();`,
  };
}

/** A script that tells the page of the result. */
export const pageScript = `
import { check } from './check.js';

check().then((result) => { globalThis.outcome = result; }, (error) => { globalThis.outcome = { error: error.message }; });
`;

/** A script that prints the result. */
export const print = '\ncheck().then((result) => console.log(JSON.stringify(result)));\n';

export function html(script, { head = '', module = true } = {}) {
  return `<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>Test</title><link rel="icon" href="data:,">${head}</head>
<body><script ${module ? 'type="module"' : 'defer'} src="${script}"></script></body>
</html>
`;
}

/** What has `computed` has to have computed. */
export function assertChecked({ cells, same, valid, again, own = cells, computed = '664,664', error }) {
  assert.equal(error, undefined);
  assert.equal(cells, 304);
  assert.equal(same, true);
  assert.equal(valid, 'true,true');
  assert.equal(again, '304,304');
  assert.equal(own, cells);
  assert.equal(computed, '664,664');
}
