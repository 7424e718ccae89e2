// Memory of the instance that computes: flat over many calls; and after what kills it the next call works.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { failNext, memories, memorySize } from './instances.mjs';
import { gut, torus } from './meshes.mjs';

const { init } = await import('mandoline-wasm'); // after the instances are watched
const { initPhysics } = await import('mandoline-wasm/physics');
const { cut } = await init();
const { cellComplex, coarsen, operators, regionComplex, solvePoisson } = await initPhysics(); // the latest instance

const mesh = torus(20, 10);

test('1,000 complexes in a row leave the memory flat', () => {
  const sizes = [];
  for (let i = 0; i < 1000; ++i) {
    const cutMesh = cut(mesh, { cells: 3 + (i % 5) });
    const cells = cellComplex(mesh, cutMesh, i % 2 ? coarsen(cutMesh) : undefined);
    if (i % 10 === 0) {
      operators({ ...cells });
      const part = regionComplex(cells, 0).cells;
      assert.equal(solvePoisson(part, { source: part.cellCentre.filter((_, at) => at % 3 === 0) }, { balance: true }).status, 'converged');
      assert.throws(() => solvePoisson(part, { source: [0, 1] }), { code: 'badArgument' });
    }
    sizes.push(memorySize());
  }
  assert.equal(memories.length, 2);
  assert.deepEqual(new Set(sizes.slice(100)), new Set([sizes[100]]));
});

test('a trap', () => {
  const cutMesh = cut(mesh, { cells: 6 });
  const cells = cellComplex(mesh, cutMesh);
  const expected = operators(cells);
  const { length } = memories;
  failNext(new WebAssembly.RuntimeError('unreachable'));
  assert.throws(() => operators(cells), { name: 'MandolineError', code: 'internalError', stage: 'operators' });
  assert.deepEqual(operators(cells), expected); // from the arrays, in a new instance
  assert.equal(memories.length, length + 1);
  assert.deepEqual(operators(gut(cells)), expected);
});
