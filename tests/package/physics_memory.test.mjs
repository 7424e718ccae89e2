// Memory of the instance that computes: flat over many calls; and after what kills it the next call works.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { failNext, memories, memorySize } from './instances.mjs';
import { box, gut, torus } from './meshes.mjs';

const { init } = await import('mandoline-wasm'); // after the instances are watched
const { initPhysics } = await import('mandoline-wasm/physics');
const { cut } = await init();
const physics = await initPhysics(); // the latest instance

const { cellComplex, coarsen, inflowSeeds, operators, regionComplex, solveFlow, solvePoisson, streamlines } = physics;

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
      const field = { mesh, cutMesh, cells, flow: solveFlow(cells, [1, 0, 0]) };
      streamlines(i % 20 ? field : { ...field, cells: { ...cells } }, inflowSeeds(cutMesh.grid, [1, 0, 0], 10));
      assert.throws(() => streamlines({ ...field, cells: part }, []), { code: 'badArgument' });
      const half = { ...field, cutMesh: { ...cutMesh }, cells: { ...cells, faceTag: new Uint8Array() } };
      assert.throws(() => streamlines(half, []), { code: 'badArgument' });
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

test('a cut-mesh larger than all twins may be stays for the call that uses it, and after memory has run out all is made anew', () => {
  const tiny = box([0.5, 0.5, 0.5], [0.500001, 0.500001, 0.500001]);
  const grid = { min: [0, 0, 0], max: [1, 1, 1], cells: [1, 4100, 4100] }; // 270 MB
  const cutMesh = cut(tiny, grid, { gridCellRegion: false });
  const cells = cellComplex(tiny, cutMesh, coarsen(cutMesh));
  const field = { mesh: tiny, cutMesh, cells, flow: solveFlow(cells, [0, 0, 1], { maxIterations: 3 }) };
  const seeds = inflowSeeds(grid, [0, 0, 1], 5);
  const expected = streamlines(field, seeds);
  assert.ok(expected.offsets[5] > 10);
  assert.deepEqual(streamlines({ ...field, cells: { ...cells } }, seeds), expected);
  failNext(new WebAssembly.RuntimeError('unreachable'));
  assert.throws(() => streamlines(field, seeds), { code: 'internalError', stage: 'streamlines' });
  assert.deepEqual(streamlines(field, seeds), expected); // which makes both twins
  const { length } = memories;
  failNext(new RangeError('Array buffer allocation failed'));
  assert.deepEqual(streamlines(field, seeds), expected); // since much was kept, once more in a new instance
  assert.equal(memories.length, length + 1);
  gut(cutMesh);
  gut(cells);
  assert.deepEqual(streamlines(field, seeds), expected);
});
