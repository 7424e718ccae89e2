// Memory of the instance: constant over many calls, a named error at its limit, and when an instance has died the next call works.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { failNext, memories, memorySize } from './instances.mjs';
import { box, torus } from './meshes.mjs';

const { init } = await import('mandoline-wasm'); // after the instances are watched
const mandoline = await init();

const mesh = torus(60, 30);
const small = box([0.5, 0.5, 0.5], [0.500001, 0.500001, 0.500001]);
const measured = () => mandoline.measure(mesh, mandoline.cut(mesh, { cells: 8 }));
const expected = measured();
const works = () => assert.deepEqual(measured(), expected);

/** What the calls of a script without breaks do, in which no garbage is collected as far as the module can see. */
test('1,000 cuts in a row leave the memory flat', () => {
  const sizes = [];
  const before = 3 * 180; // what is called is the same again after 180 cuts, but finds what those before have left
  for (let i = 0; i < before + 1000; ++i) {
    const cutMesh = mandoline.cut(mesh, { cells: 4 + (i % 20) });
    mandoline.slice(cutMesh, { normal: [1, 2, 3], offset: 0.1 });
    if (i % 10 === 0) {
      mandoline.measure(mesh, cutMesh);
      mandoline.triangulate({ ...cutMesh });
      mandoline.adjacency(cutMesh);
      try {
        mandoline.cut(mesh, { cells: 9 }, { progress: ({ stageIndex }) => stageIndex < i % 9 });
      } catch (error) {
        assert.equal(error.code, 'cancelled');
      }
    }
    sizes.push(memorySize());
  }
  assert.equal(memories.length, 1);
  assert.deepEqual(new Set(sizes.slice(before)), new Set([sizes[before]]));
});

test('1,000 cuts with breaks, half of them kept, leave the memory flat', async () => {
  const kept = [];
  let early;
  for (let i = 0; i < 1000; ++i) {
    const cutMesh = mandoline.cut(mesh, { cells: 4 + (i % 20) });
    if (i % 2) kept.push(cutMesh);
    await new Promise((resolve) => {
      setImmediate(resolve);
    });
    if (i === 100) early = memorySize();
  }
  assert.equal(memorySize(), early);
});

/** Rows of untouched grid cells take 16 bytes each. */
const rows = (n) => ({ min: [0, 0, 0], max: [1, 1, 1], cells: [1, n, n] });

test('large cuts in a row soon take the memory of those before', () => {
  const sizes = [];
  for (let i = 0; i < 8; ++i) {
    mandoline.cut(small, rows(2 ** 10), { gridCellRegion: false }); // 16 MB
    sizes.push(memorySize());
  }
  assert.deepEqual(new Set(sizes.slice(3)), new Set([sizes[3]]));
});

test('a prepared mesh does not give way to the large cuts made of it', () => {
  const prepared = mandoline.prepare(small);
  const stages = new Set();
  const progress = ({ stage }) => Boolean(stages.add(stage));
  for (let i = 0; i < 3; ++i) mandoline.cut(prepared, rows(2 ** 11), { gridCellRegion: false, progress }); // 64 MB
  assert.ok(stages.has('grid'));
  assert.ok(!stages.has('input')); // the mesh was not prepared once more
});

test('twins of results that are gone are freed', async () => {
  setFlagsFromString('--expose-gc');
  const collectGarbage = runInNewContext('gc');
  const sizes = [];
  for (let i = 0; i < 6; ++i) {
    mandoline.cut(small, rows(2 ** 11), { gridCellRegion: false }); // 64 MB
    await new Promise((resolve) => {
      setTimeout(resolve);
    });
    collectGarbage();
    await new Promise((resolve) => {
      setTimeout(resolve, 50);
    });
    sizes.push(memorySize());
  }
  assert.ok(sizes[5] < sizes[0] + 2 ** 26, sizes.map((size) => Math.round(size / 2 ** 20)).join(' '));
});

test('a cut that overruns 4 GB', () => {
  const call = () => mandoline.cut(small, rows(2 ** 14), { gridCellRegion: false }); // the untouched grid cells alone take 4 GB
  const { length } = memories;
  assert.throws(call, { name: 'MandolineError', code: 'outOfMemory' });
  works();
  assert.equal(memories.length, length + 1); // with a small memory again
});

test('gridCellRegion that no memory holds', () => {
  const grid = { min: [0, 0, 0], max: [1, 1, 1], cells: [2 ** 20, 64, 64] }; // a multiple of 2^32 grid cells
  assert.throws(() => mandoline.cut(small, grid), { code: 'outOfMemory' });
  works();
});

test('a trap', () => {
  for (const [error, code] of [
    [new WebAssembly.RuntimeError('unreachable'), 'internalError'],
    [new RangeError('Maximum call stack size exceeded'), 'internalError'],
    [new RangeError('Array buffer allocation failed'), 'outOfMemory'],
  ]) {
    const { length } = memories;
    failNext(error);
    assert.throws(() => mandoline.cut(mesh, { cells: 8 }), { name: 'MandolineError', code, stage: 'input', cause: error });
    works();
    assert.equal(memories.length, length + 1);
  }
});

test('the stack of JavaScript at its end', () => {
  let caught = 0;
  const dive = (depth) => {
    try {
      return dive(depth + 1);
    } catch (error) {
      if (error instanceof RangeError) {
        try {
          mandoline.cut(mesh, { cells: 8 });
        } catch (inner) {
          ++caught;
          if (inner.code !== undefined) assert.equal(inner.code, 'internalError');
          if (caught < 400) throw new RangeError('up');
        }
      }
      return depth;
    }
  };
  dive(0);
  assert.ok(caught > 0);
  works();
});
