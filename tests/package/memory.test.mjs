// Memory of the instance: flat over many calls, at its limit a named error, and after whatever kills an instance the next call works.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { box, torus } from './meshes.mjs';

// Instances are private to the package, so they are caught where they are made; and what they import can be made to fail.
const memories = [];
let failure;
const { Instance } = WebAssembly;
const sabotaged = (imported) => (...values) => {
  if (failure) {
    const error = failure;
    failure = undefined;
    throw error;
  }
  return imported(...values);
};
WebAssembly.Instance = function (module, imports) {
  const wrapped = Object.entries(imports).map(([name, all]) => [name, Object.fromEntries(Object.entries(all).map(([key, f]) => [key, sabotaged(f)]))]);
  const instance = new Instance(module, Object.fromEntries(wrapped));
  memories.push(Object.values(instance.exports).find((value) => value instanceof WebAssembly.Memory));
  return instance;
};
const { init } = await import('mandoline-wasm');
const mandoline = await init();

const mesh = torus(60, 30);
const small = box([0.5, 0.5, 0.5], [0.500001, 0.500001, 0.500001]);
const works = () => assert.equal(mandoline.validate(mesh, mandoline.cut(mesh, { cells: 8 })).pass, true);

test('500 cuts in a row leave the memory flat', () => {
  const sizes = [];
  for (let i = 0; i < 500; ++i) {
    const cutMesh = mandoline.cut(mesh, { cells: 4 + (i % 20) });
    mandoline.measure(mesh, cutMesh);
    mandoline.triangulate(cutMesh);
    mandoline.adjacency(cutMesh);
    mandoline.slice(cutMesh, { normal: [1, 2, 3], offset: 0.1 });
    try {
      mandoline.cut(mesh, { cells: 9 }, { progress: ({ stageIndex }) => stageIndex < i % 9 });
    } catch (error) {
      assert.equal(error.code, 'cancelled');
    }
    sizes.push(memories.at(-1).buffer.byteLength);
  }
  assert.equal(memories.length, 1);
  assert.deepEqual(new Set(sizes.slice(20)), new Set([sizes[20]]));
});

test('a cut that overruns 4 GB', () => {
  const rows = 2 ** 14; // the untouched grid cells alone take 4 GB: 16 bytes for each row
  const call = () => mandoline.cut(small, { min: [0, 0, 0], max: [1, 1, 1], cells: [1, rows, rows] }, { gridCellRegion: false });
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
    failure = error;
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
