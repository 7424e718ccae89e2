// Cut-meshes and prepared meshes that stay in WebAssembly: they are found by the identity of the result, and what is not found is taken as
// data.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { failNext } from './instances.mjs';
import { box, gut, torus } from './meshes.mjs';

const { init } = await import('mandoline-wasm'); // after the instances are watched
const mandoline = await init();
const mesh = torus(24, 12);
const cube = box([0.1, 0.1, 0.1], [0.9, 0.9, 0.9]);

const plane = { normal: [1, 2, 3], offset: 0.1 };
const calls = {
  validate: (cutMesh) => mandoline.validate(mesh, cutMesh),
  measure: (cutMesh) => mandoline.measure(mesh, cutMesh),
  cutEdges: (cutMesh) => mandoline.cutEdges(mesh, cutMesh),
  adjacency: (cutMesh) => mandoline.adjacency(cutMesh),
  triangulate: (cutMesh) => mandoline.triangulate(cutMesh),
  'triangulate a cell': (cutMesh) => mandoline.triangulate(cutMesh, { cell: 3 }),
  'triangulate a region': (cutMesh) => mandoline.triangulate(cutMesh, { region: 1 }),
  boundary: (cutMesh) => mandoline.boundary(cutMesh, 'odd'),
  cellAt: (cutMesh) => mandoline.cellAt(cutMesh, [1, 0.01, 0.02]),
  cellsAt: (cutMesh) => mandoline.cellsAt(cutMesh, [1, 0.01, 0.02, 0, 0, 0]),
  slice: (cutMesh) => mandoline.slice(cutMesh, plane),
  slices: (cutMesh) => mandoline.slices(cutMesh, [1, 2, 3], [0, 0.1]),
  outlines: (cutMesh) => mandoline.outlines(cutMesh, [0, 0, 1], [0.05]),
  'write json': (cutMesh) => mandoline.write(mesh, cutMesh, 'json'),
  'write vtu': (cutMesh) => mandoline.write(mesh, cutMesh, 'vtu'),
  'write obj': (cutMesh) => mandoline.write(mesh, cutMesh, 'obj'),
};

const fresh = (options) => mandoline.cut(mesh, { cells: 9 }, options);

function assertNeedsData(cutMesh) {
  assert.throws(() => mandoline.slice(cutMesh, plane), { name: 'MandolineError', code: 'badArgument', message: /detached/ });
}

for (const [name, call] of Object.entries(calls)) {
  test(`${name} gives the same from the twin and from data`, async () => {
    const kept = fresh();
    const { stats, ...data } = structuredClone(kept);
    const fromData = await call(data);
    assert.deepEqual(await call(kept), fromData);
    assert.deepEqual(await call(gut(kept)), fromData);
    assert.deepEqual(await call(gut(fresh())), fromData);
    assert.deepEqual(await call(fresh({ keep: false })), fromData);
  });
}

test('results that are kept and those that are not look alike', () => {
  const { stats: _, ...kept } = fresh();
  const { stats: __, ...other } = fresh({ keep: false });
  assert.deepEqual(kept, other);
  assert.deepEqual(Object.keys(kept), Object.keys(other));
});

test('keep: false keeps none', () => {
  assertNeedsData(gut(fresh({ keep: false })));
});

test('copies are data of their own', () => {
  const kept = fresh();
  for (const copy of [{ ...kept }, structuredClone(kept), Object.assign(Object.create(null), kept)]) {
    assert.deepEqual(mandoline.slice(copy, plane), mandoline.slice(kept, plane));
    copy.cellRegion = copy.cellRegion.map((region) => 1 - region);
    assert.notDeepEqual(mandoline.slice(copy, plane).polygonRegion, mandoline.slice(kept, plane).polygonRegion);
  }
  const copy = { ...kept };
  gut(kept);
  assertNeedsData(copy);
});

test('what is written into the arrays of a result is not read, in those of a copy it is', async () => {
  const kept = fresh();
  const before = mandoline.measure(mesh, kept);
  const file = await mandoline.write(mesh, { ...kept }, 'vtu');
  kept.positions.fill(NaN);
  assert.deepEqual(mandoline.measure(mesh, kept), before);
  assert.deepEqual(await mandoline.write(mesh, kept, 'vtu'), file);
  assert.equal((await mandoline.validate(mesh, kept)).pass, true);
  assert.throws(() => mandoline.measure(mesh, { ...kept }), { code: 'badArgument' });
  assert.equal((await mandoline.validate(mesh, { ...kept })).pass, false);
});

test('those used least recently give way, and come back with their arrays', () => {
  const first = fresh();
  const second = fresh();
  for (let i = 0; i < 40; ++i) {
    fresh();
    mandoline.slice(first, plane); // stays
  }
  assert.ok(mandoline.slice(gut(first), plane));
  const expected = mandoline.slice(fresh(), plane);
  assert.deepEqual(mandoline.slice(second, plane), expected); // from its arrays, once
  assert.deepEqual(mandoline.slice(gut(second), plane), expected);
});

test('large ones give way to newer ones, but for the newest', () => {
  const n = 3000;
  const tiny = box([0.5, 0.5, 0.5], [0.500001, 0.500001, 0.500001]);
  const large = () => mandoline.cut(tiny, { min: [0, 0, 0], max: [1, 1, 1], cells: [1, n, n] }, { gridCellRegion: false }); // 140 MB
  const point = [0.1, 0.1, 0.1];
  const [one, two, three] = [large(), large(), large()].map(gut);
  assert.throws(() => mandoline.cellAt(one, point), { code: 'badArgument' });
  assert.throws(() => mandoline.cellAt(two, point), { code: 'badArgument' });
  assert.equal(mandoline.cellAt(three, point).cell, -1);
});

test('after the instance was replaced the arrays are read, once', () => {
  for (const error of [new WebAssembly.RuntimeError('unreachable'), new RangeError('Array buffer allocation failed')]) {
    const [kept, gutted] = [fresh(), gut(fresh())];
    const expected = mandoline.slice(kept, plane);
    failNext(error);
    assert.throws(() => fresh(), { name: 'MandolineError' });
    assertNeedsData(gutted);
    assert.deepEqual(mandoline.slice(kept, plane), expected);
    assert.deepEqual(mandoline.slice(gut(kept), plane), expected);
  }
});

test('prepared meshes give way to newer results, and are prepared once more', () => {
  const prepared = mandoline.prepare(mesh);
  const firstStage = () => mandoline.cut(prepared, { cells: 5 }).stats.stages[0].stage;
  for (let i = 0; i < 40; ++i) {
    fresh();
    assert.equal(firstStage(), 'grid'); // stays
  }
  for (let i = 0; i < 40; ++i) fresh();
  assert.equal(firstStage(), 'grid');
  assert.equal(mandoline.cut({ ...prepared }, { cells: 5 }).stats.stages[0].stage, 'input');
  failNext(new WebAssembly.RuntimeError('unreachable'));
  assert.throws(() => fresh(), { code: 'internalError' });
  assert.equal(firstStage(), 'grid');
  assert.ok(mandoline.cut(gut(prepared), { cells: 5 }));
});

test('a prepared mesh is no cut-mesh', async () => {
  const prepared = mandoline.prepare(mesh);
  for (const [name, call] of Object.entries(calls)) {
    const message = /^cutMesh must be what cut\(\) gives, not what prepare\(\) does/;
    await assert.rejects(async () => call(prepared), { name: 'MandolineError', code: 'badArgument', message }, name);
  }
  assert.ok(mandoline.cut(gut(prepared), { cells: 5 }));
});

test('a cut within a cut, and a failed cut, keep what is kept', () => {
  const kept = gut(fresh());
  let inner;
  const outer = mandoline.cut(
    mesh,
    { cells: 9 },
    {
      progress: () => {
        inner ??= fresh();
      },
    },
  );
  assert.throws(() => mandoline.cut(mesh, { cells: 9 }, { progress: () => false }), { code: 'cancelled' });
  for (const cutMesh of [kept, gut(inner), gut(outer)]) assert.ok(mandoline.slice(cutMesh, plane));
});

test('a mesh that is not the input is a badArgument, with and without a twin', async () => {
  const kept = fresh();
  const others = [torus(8, 8), cube, { ...mesh, positions: mesh.positions.slice(3) }, { positions: [], triangles: [] }];
  for (const cutMesh of [kept, structuredClone(kept)]) {
    for (const other of others) {
      for (const call of [mandoline.measure, mandoline.cutEdges, (input, cut) => mandoline.write(input, cut, 'vtu')]) {
        await assert.rejects(async () => call(other, cutMesh), { code: 'badArgument' });
      }
    }
  }
  assert.ok(mandoline.measure(mesh, kept));
});
