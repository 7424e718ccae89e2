// Surfaces that move, cut again where they moved, and grids cut brick by brick: what cut() gives, to the bit; here and in a worker.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join as path } from 'node:path';
import { test } from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { Worker as NodeWorker } from 'node:worker_threads';
import { init } from 'mandoline-wasm';
import { meshFolder, skipWithoutMeshes } from '../mesh_folder.mjs';
import { box, gut, join, torus } from './meshes.mjs';
import { rejection, withWorker, withoutStats } from './workers.mjs';

const { createBrickCutter, createRecutter, cut, measure, readMesh, slice, validate } = await init();
const mesh = torus(48, 20);
const grid = { min: [-2, -2, -1], max: [2, 2, 1], cells: [32, 32, 16] };
const plane = { normal: [1, 2, 3], offset: 0.1 };

/** The mesh with the positions (x, y, z) of which isMoved() is true shifted along z. */
function moved({ positions, triangles }, shift, isMoved = ([x]) => x > 0.8) {
  const shifted = Float64Array.from(positions);
  for (let v = 0; v < positions.length; v += 3) if (isMoved(positions.subarray(v, v + 3))) shifted[v + 2] += shift;
  return { positions: shifted, triangles };
}

/** Frames of a part that moves, as new cuts have them. Gives the counts of the last one. */
async function assertFrames(frames, where, options) {
  const recutter = await createRecutter(where, options);
  for (const [i, frame] of frames.entries()) {
    const { stats: _, ...expected } = cut(frame, where, options);
    const { stats, ...found } = recutter.cut(frame, { keep: i % 3 === 0 });
    assert.deepEqual(found, expected, `frame ${i}`);
    assert.ok(stats.totalMs > 0);
  }
  const counts = recutter.counts();
  recutter.free();
  return counts;
}

const frame = (i) => 0.02 * Math.sin(i);
const thirty = [...Array(30).keys()];

test('30 frames of a torus that moves in part are as new cuts, and most bricks are kept', async () => {
  const { bricks, kept } = await assertFrames(
    thirty.map((i) => moved(mesh, frame(i))),
    grid,
  );
  assert.ok(kept > bricks / 2 && kept < bricks, `${kept} of ${bricks}`);
});

test('30 frames of a torus that moves as a whole are as new cuts', async () => {
  const frames = thirty.map((i) => moved(mesh, frame(i), () => true));
  assert.equal((await assertFrames(frames, grid, { snapTolerance: 0.01, intersections: 'assumeNone' })).kept, 0);
});

test('30 frames of parts that pass through each other are as new cuts', async () => {
  const cube = box([-0.2, -0.2, -0.7], [0.33, 1, 0.71]);
  const { kept } = await assertFrames(
    thirty.map((i) =>
      join(
        mesh,
        moved(cube, 10 * frame(i), () => true),
      ),
    ),
    grid,
  );
  assert.ok(kept > 0);
});

test('30 frames of a bunny with a moving ear are as new cuts', { skip: skipWithoutMeshes }, async () => {
  const bunny = await readMesh(readFileSync(path(meshFolder, 'common_stanford-bunny.obj.gz')));
  const along = (d) => bunny.positions.filter((_, i) => i % 3 === d);
  const [min, max] = [Math.min, Math.max].map((end) => [0, 1, 2].map((d) => along(d).reduce((a, b) => end(a, b))));
  const size = Math.max(...max.map((x, d) => x - min[d]));
  const top = max[1] - 0.1 * size;
  const around = { min: min.map((x) => x - 0.05 * size), max: max.map((x) => x + 0.05 * size), cells: [24, 24, 24] };
  const { bricks, kept } = await assertFrames(
    thirty.map((i) => moved(bunny, size * frame(i), ([, y]) => y > top)),
    around,
  );
  assert.ok(kept > bricks / 2, `${kept} of ${bricks}`);
});

test('other triangles, and errors, begin anew', async () => {
  const recutter = await createRecutter(grid);
  assert.deepEqual(recutter.counts(), { bricks: 0, kept: 0 });
  const is = (given) => assert.deepEqual(withoutStats(recutter.cut(given)), withoutStats(cut(given, grid)));
  is(mesh);
  is(torus(24, 12));
  assert.equal(recutter.counts().kept, 0);
  is(torus(24, 12));
  assert.equal(recutter.counts().kept, recutter.counts().bricks);
  const wrong = { ...mesh, positions: mesh.positions.with(7, NaN) };
  assert.throws(() => recutter.cut(wrong), { code: 'nonFiniteCoordinate', element: 2, stage: 'input' });
  is(mesh);
  assert.equal(recutter.counts().kept, 0);
  const cancelled = { code: 'cancelled', stage: 'input' };
  assert.throws(() => recutter.cut(mesh, { progress: () => false }), cancelled);
  is(mesh);
  recutter.free();
});

test('a recutter tells its progress, and what the callback throws is thrown', async () => {
  const recutter = await createRecutter(grid);
  const stages = new Set();
  recutter.cut(mesh, { progress: ({ stage }) => void stages.add(stage) });
  assert.deepEqual([...stages].slice(-2), ['regions', 'output']);
  const thrown = new Error('mine');
  const progress = () => {
    throw thrown;
  };
  assert.throws(() => recutter.cut(mesh, { progress }), thrown);
  assert.ok(recutter.cut(mesh).regionCount > 1); // without that callback
});

test('what a recutter gives has a twin, and can be written over former results', async () => {
  const recutter = await createRecutter(grid);
  const expected = cut(mesh, grid);
  const results = [recutter.cut(mesh), recutter.cut(mesh)];
  assert.ok((await validate(mesh, results[0])).pass);
  for (const result of results) assert.deepEqual(slice(gut(result), plane), slice(expected, plane));
  assert.deepEqual(measure(mesh, results[1]), measure(mesh, expected));
  assert.throws(() => slice(gut(recutter.cut(mesh, { keep: false })), plane), { code: 'badArgument', message: /detached/ });
  assert.equal('gridCellRegion' in recutter.cut(mesh, { gridCellRegion: false }), false);
  const spare = new ArrayBuffer(2 * expected.positions.byteLength);
  const reused = recutter.cut(mesh, { reuse: [spare] });
  assert.ok(Object.values(reused).some((array) => array?.buffer === spare));
  assert.deepEqual(withoutStats(reused), withoutStats(expected));
});

/** The volumes of cells by grid cell. */
function volumesIn(whole, { cutMesh, mesh: near, first }, volumes = new Map()) {
  const { cellVolume } = measure(near, cutMesh);
  for (const [cell, volume] of cellVolume.entries()) {
    const place = [0, 1, 2].map((d) => first[d] + cutMesh.cellGridCell[3 * cell + d]);
    const [x, y] = whole.grid.cells;
    const key = place[0] + x * (place[1] + y * place[2]);
    volumes.set(key, [...(volumes.get(key) ?? []), volume]);
  }
  return volumes;
}

for (const [cells, options] of [
  [4, {}],
  [8, { untouched: true }],
  [128, {}],
]) {
  test(`pieces of ${cells} cells along each side make up the whole cut`, async () => {
    const whole = cut(mesh, grid);
    const cutter = await createBrickCutter(mesh, grid, { cells, ...options });
    const volumes = new Map();
    let runs = 0;
    for (let brick = 0; brick < cutter.count(); ++brick) {
      const piece = cutter.cut(brick);
      assert.deepEqual(piece.first, cutter.first(brick));
      assert.ok(piece.first.every((place) => place % cells === 0));
      piece.triangles.forEach((triangle, t) => {
        const corners = [...piece.mesh.triangles.subarray(3 * t, 3 * t + 3)].map((v) => piece.triVertices[v]);
        assert.deepEqual(corners, [...mesh.triangles.subarray(3 * triangle, 3 * triangle + 3)]);
      });
      volumesIn(whole, piece, volumes);
      const { runBegin, runEnd } = piece.cutMesh;
      runs += runEnd.reduce((sum, end, run) => sum + end - runBegin[run], 0);
    }
    const expected = volumesIn(whole, { cutMesh: whole, mesh, first: [0, 0, 0] });
    assert.deepEqual([...volumes.keys()].sort(), [...expected.keys()].sort());
    for (const [key, found] of volumes) {
      const there = expected.get(key);
      assert.equal(found.length, there.length);
      found.forEach((volume, i) => assert.ok(Math.abs(volume - there[i]) < 1e-15, `grid cell ${key}: ${volume}, not ${there[i]}`));
    }
    const allRuns = whole.runEnd.reduce((sum, end, run) => sum + end - whole.runBegin[run], 0);
    assert.ok(options.untouched ? runs === allRuns : runs <= allRuns);
    cutter.free();
  });
}

test('pieces have twins, by their cut-meshes', async () => {
  const cutter = await createBrickCutter(mesh, { cells: 20 }, { cells: 8 });
  const [first, second] = [cutter.cut(3), cutter.cut(3, { keep: false })];
  assert.deepEqual(first, second);
  const expected = slice(second.cutMesh, plane);
  gut(first.cutMesh);
  gut(second.cutMesh);
  assert.deepEqual(slice(first.cutMesh, plane), expected);
  assert.throws(() => slice(second.cutMesh, plane), { code: 'badArgument', message: /detached/ });
});

test('a brick cutter tells its progress, and ends when it is told to', async () => {
  const seen = [];
  const cutter = await createBrickCutter(mesh, grid, { progress: (state) => void seen.push(state) });
  assert.deepEqual([seen[0].stage, seen.at(-1).stage], ['input', 'grid']);
  assert.ok(seen.every(({ stageIndex, stageCount }) => stageIndex < stageCount && stageCount === seen[0].stageCount));
  assert.equal(seen.at(-1).stageIndex, seen[0].stageCount - 1);
  assert.equal((await rejection(createBrickCutter(mesh, grid, { progress: () => false }))).code, 'cancelled');
  assert.throws(() => cutter.cut(0, { progress: () => false }), { code: 'cancelled' });
  assert.ok(cutter.cut(0).cutMesh.regionCount > 0);
});

test('what is given wrong is named', async () => {
  const named = async (promise, expected) => {
    const error = await rejection(promise);
    for (const [key, value] of Object.entries(expected)) assert.match(String(error[key]), new RegExp(value), error.message);
  };
  await named(createRecutter({ cells: 8 }), { code: 'badArgument', stage: 'createRecutter', message: '^grid must be that of a cut-mesh' });
  await named(createRecutter(grid, { snapTolerance: 1 }), { code: 'badOption', message: 'options.snapTolerance' });
  await named(createRecutter(grid, { keep: true }), { code: 'badArgument', message: 'options has no keep' });
  await named(createBrickCutter(mesh, grid, { cells: 7 }), { code: 'badOption', message: 'power of two' });
  await named(createBrickCutter(mesh, grid, { cells: 0.5 }), { code: 'badArgument', message: 'options.cells must be a whole number' });
  await named(createBrickCutter(mesh, { ...grid, cells: [0, 1, 1] }), { code: 'badGrid' });
  await named(createBrickCutter({ ...mesh, triangles: [0, 1, 2 ** 31] }, grid), { code: 'badIndex', element: '0', stage: 'input' });
  const crossing = join(mesh, torus(24, 12, 1.1));
  await named(createBrickCutter(crossing, grid, { intersections: 'refuse' }), { code: 'selfIntersection' });

  const empty = await createRecutter({ ...grid, cells: [0, 1, 1] });
  assert.throws(() => empty.cut(mesh), { code: 'badGrid' });
  const recutter = await createRecutter(grid);
  assert.throws(() => recutter.cut(7), { code: 'badArgument', stage: 'input' });
  assert.throws(() => recutter.cut(mesh, { snapTolerance: 0 }), { code: 'badArgument', stage: 'input', message: /no snapTolerance/ });
  const cutter = await createBrickCutter(mesh, grid);
  const count = cutter.count();
  assert.equal(count, 1);
  for (const call of [() => cutter.first(count), () => cutter.cut(count)]) assert.throws(call, { code: 'badArgument', element: count });
  for (const brick of [-1, 0.5, '0', 2 ** 32]) assert.throws(() => cutter.cut(brick), { code: 'badArgument', message: /^brick / });
});

test('what was freed refuses calls, by name', async () => {
  const [recutter, cutter] = [await createRecutter(grid), await createBrickCutter(mesh, grid)];
  for (const object of [recutter, cutter]) {
    object.free();
    object.free();
  }
  const refused = (call, stage, message) => assert.throws(call, { code: 'badArgument', stage, message });
  refused(() => recutter.cut(mesh), 'cut', 'The recutter was freed.');
  refused(() => recutter.counts(), 'counts', 'The recutter was freed.');
  for (const stage of ['count', 'first', 'cut']) refused(() => cutter[stage](0), stage, 'The brick cutter was freed.');
});

test('what is freed while it cuts finishes that cut, and leaves the memory as it should', async () => {
  const [recutter, cutter] = [await createRecutter(grid), await createBrickCutter(mesh, grid)];
  const frame = moved(mesh, 0.02);
  recutter.cut(mesh);
  assert.deepEqual(withoutStats(recutter.cut(frame, { progress: () => recutter.free() })), withoutStats(cut(frame, grid)));
  assert.deepEqual(cutter.cut(0, { progress: () => cutter.free() }), (await createBrickCutter(mesh, grid)).cut(0));
  for (const object of [recutter, cutter]) assert.throws(() => object.cut(mesh), { code: 'badArgument', message: /was freed/ });
});

test('in a worker they are the same, with promises', () =>
  withWorker(async (worker) => {
    const recutter = await worker.createRecutter(grid);
    const here = await createRecutter(grid);
    for (const frame of [mesh, moved(mesh, 0.02)]) {
      const found = await recutter.cut(frame);
      assert.deepEqual(withoutStats(found), withoutStats(here.cut(frame)));
      assert.deepEqual(await worker.slice(gut(found), plane), slice(cut(frame, grid), plane)); // by the twin
    }
    assert.deepEqual(await recutter.counts(), here.counts());
    const wrong = await rejection(recutter.cut({ ...mesh, positions: [1] }));
    assert.deepEqual([wrong.code, wrong.stage], ['badArrays', 'input']);

    const [there, cutter] = await Promise.all([
      worker.createBrickCutter(mesh, grid, { cells: 8 }),
      createBrickCutter(mesh, grid, { cells: 8 }),
    ]);
    assert.equal(await there.count(), cutter.count());
    assert.deepEqual(await there.first(5), cutter.first(5));
    const [piece, expected] = [await there.cut(5), cutter.cut(5)];
    assert.deepEqual(piece, expected);
    gut(piece.cutMesh);
    assert.deepEqual(await worker.measure(piece.mesh, piece.cutMesh), measure(expected.mesh, expected.cutMesh));
    assert.equal((await rejection(there.first(1e6))).element, 1e6);
    const stages = new Set();
    await there.cut(5, { progress: ({ stage }) => void stages.add(stage) });
    assert.ok(stages.size > 0);
    there.free();
    assert.equal((await rejection(there.cut(0))).message, 'The brick cutter was freed.');

    assert.equal((await rejection(recutter.cut(mesh, { progress: () => false }))).code, 'cancelled');
    const gone = await rejection(recutter.cut(mesh));
    assert.match(gone.message, /^The recutter is gone with its thread/);
  }));

test('1,000 recuts leave memory flat, and what is not freed is collected', async () => {
  setFlagsFromString('--expose-gc');
  const collectGarbage = runInNewContext('gc');
  let collected = 0;
  const registry = new FinalizationRegistry(() => ++collected);
  await withWorker(
    async (worker) => {
      let recutter = await worker.createRecutter(grid);
      let early;
      for (let i = 0; i < 1000; ++i) {
        await recutter.cut(moved(torus(24, 12), frame(i)), { gridCellRegion: false, keep: i % 2 === 0 });
        if (i % 100 === 99) {
          registry.register(recutter);
          recutter = await worker.createRecutter(grid);
          while (collected < (i + 1) / 100) {
            collectGarbage();
            await new Promise((resolve) => {
              setTimeout(resolve, 20);
            });
          }
        }
        if (i === 400) early = await worker.call('memory');
      }
      assert.deepEqual(await worker.call('memory'), early);
    },
    { thread: () => new NodeWorker(new URL('watched_thread.mjs', import.meta.url)) },
  );
});
