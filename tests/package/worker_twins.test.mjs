// Cut-meshes and prepared meshes that stay in the worker's thread: their arrays are the page's, and are sent back only where the twin is
// gone.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { Worker as NodeWorker } from 'node:worker_threads';
import { init } from 'mandoline-wasm';
import { box, gut, join, torus } from './meshes.mjs';
import { rejection, withWorker } from './workers.mjs';

const mesh = torus(24, 12);
const plane = { normal: [1, 2, 3], offset: 0.1 };
const sliced = await init().then(({ cut, slice }) => slice(cut(mesh, { cells: 9 }), plane));

/** Runs f with a worker and the list of the messages to its threads. */
function withWatched(f) {
  const sent = [];
  const thread = () => {
    const worker = new NodeWorker(new URL('watched_thread.mjs', import.meta.url));
    const post = worker.postMessage.bind(worker);
    worker.postMessage = (message, transfer) => {
      sent.push(structuredClone({ call: message.call, subjects: message.subjects ?? [], forget: message.forget }));
      post(message, transfer);
    };
    return worker;
  };
  return withWorker((worker) => f(worker, sent), { thread });
}

const wasSent = ({ subjects }) => subjects.some(({ data }) => data !== undefined);

test('every call works on the twin, without the arrays', () =>
  withWatched(async (worker, sent) => {
    const { cut, ...here } = await init();
    const expected = cut(mesh, { cells: 9 });
    const cutMesh = gut(await worker.cut(mesh, { cells: 9 }));
    const calls = {
      validate: [mesh, cutMesh],
      measure: [mesh, cutMesh],
      cutEdges: [mesh, cutMesh],
      adjacency: [cutMesh],
      triangulate: [cutMesh, { cell: 3 }],
      cellDrawing: [mesh, cutMesh, { origin: [0, 0, 1] }],
      boundary: [cutMesh, 'nonZero'],
      insideRegions: [cutMesh, { rule: 'odd' }],
      estimateInside: [mesh, cutMesh],
      cellAt: [cutMesh, [1, 0.01, 0.02]],
      cellsAt: [cutMesh, [1, 0.01, 0.02]],
      slice: [cutMesh, plane],
      slices: [cutMesh, [1, 2, 3], [0, 0.1]],
      outlines: [cutMesh, [0, 0, 1], [0.05]],
      write: [mesh, cutMesh, 'vtu'],
      refineCells: [mesh, cutMesh, { levels: 1 }],
    };
    for (const [name, args] of Object.entries(calls)) {
      assert.deepEqual(await worker[name](...args), await here[name](...args.map((arg) => (arg === cutMesh ? expected : arg))), name);
    }
    const withoutCutMesh = ['findIntersections', 'generalizedWindingNumbers', 'inspect', 'orient', 'prepare', 'readCutMesh', 'readGroups'];
    withoutCutMesh.unshift('createBrickCutter', 'createRecutter');
    withoutCutMesh.push('readMesh', 'resolve', 'version', 'writeDefects', 'writeLines', 'writeMesh', 'writeOutlines');
    assert.deepEqual(
      Object.keys(here)
        .filter((name) => !(name in calls))
        .sort(),
      withoutCutMesh,
    );
    assert.equal(sent.filter(wasSent).length, 0);
  }));

test('copies, and results that were not to be kept, are sent each time', () =>
  withWatched(async (worker, sent) => {
    const kept = await worker.cut(mesh, { cells: 9 });
    const other = await worker.cut(mesh, { cells: 9 }, { keep: false });
    const { stats: _, ...keptData } = kept;
    const { stats: __, ...otherData } = other;
    assert.deepEqual(otherData, keptData);
    for (const cutMesh of [{ ...kept }, structuredClone(kept), other, other]) assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
    assert.ok(sent.every(({ subjects }) => subjects.length === 0));
    assert.equal((await rejection(worker.slice(gut(other), plane))).code, 'badArgument');
  }));

test('after an abort the new thread is sent the arrays once', () =>
  withWatched(async (worker, sent) => {
    const cutMesh = await worker.cut(mesh, { cells: 9 });
    await rejection(worker.cut(mesh, { cells: 99 }, { progress: () => false }));
    for (let i = 0; i < 3; ++i) assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
    assert.equal(sent.filter(wasSent).length, 1);
    assert.deepEqual(await worker.slice(gut(cutMesh), plane), sliced);
    await rejection(worker.cut(mesh, { cells: 99 }, { progress: () => false }));
    assert.equal((await rejection(worker.slice(cutMesh, plane))).code, 'badArgument');
    assert.equal((await worker.cut(mesh, { cells: 9 })).regionCount, 2);
  }));

test('a call that waits is sent the arrays when the thread it was made for is gone', () =>
  withWatched(async (worker, sent) => {
    const cutMesh = await worker.cut(mesh, { cells: 9 });
    const cancelled = worker.cut(mesh, { cells: 99 }, { progress: () => false });
    const waiting = [worker.slice(cutMesh, plane), worker.measure(mesh, cutMesh), worker.slice(cutMesh, plane)];
    await rejection(cancelled);
    assert.deepEqual((await Promise.all(waiting))[2], sliced);
    assert.equal(sent.filter(wasSent).length, 1);
  }));

test('those that the thread let go are sent again, with the other arguments', () =>
  withWatched(async (worker, sent) => {
    const first = await worker.cut(mesh, { cells: 9 });
    const expected = await worker.measure(mesh, first);
    const many = [];
    for (let i = 0; i < 20; ++i) many.push(await worker.cut(mesh, { cells: 5 }));
    assert.deepEqual(await worker.measure(mesh, first), expected);
    assert.deepEqual(
      sent.filter(wasSent).map(({ call }) => call),
      ['measure'],
    );
    assert.deepEqual(await worker.measure(mesh, gut(first)), expected);
    assert.equal((await rejection(worker.adjacency(gut(many[0])))).code, 'badArgument');
    assert.ok(await worker.adjacency(gut(many.at(-1))));
  }));

test('arrays that are handed over with the call are sent', () =>
  withWatched(async (worker) => {
    const cutMesh = await worker.cut(mesh, { cells: 9 });
    assert.deepEqual(await worker.slice(cutMesh, plane, { transfer: [cutMesh.positions.buffer] }), sliced);
    assert.equal(cutMesh.positions.length, 0);
    assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
  }));

test('bad arguments beside a twin are told as such, and it stays', () =>
  withWatched(async (worker, sent) => {
    const cutMesh = gut(await worker.cut(mesh, { cells: 9 }));
    assert.match((await rejection(worker.triangulate(cutMesh, { cell: 1e6 }))).message, /cell/);
    assert.equal((await rejection(worker.measure(box([0, 0, 0], [1, 1, 1]), cutMesh))).code, 'badArgument');
    assert.equal((await rejection(worker.slice(cutMesh, { normal: [0, 0, 0], offset: 0 }))).code.slice(0, 3), 'bad');
    assert.equal(sent.filter(({ call }) => call === 'slice').length, 1);
    assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
  }));

test('a prepared mesh is cut with any number of grids, without its arrays', () =>
  withWatched(async (worker, sent) => {
    const { cut } = await init();
    const prepared = gut(await worker.prepare(mesh));
    for (const cells of [4, 9]) {
      const { stats, ...cutMesh } = await worker.cut(prepared, { cells });
      const { stats: _, ...expected } = cut(mesh, { cells });
      assert.deepEqual(cutMesh, expected);
      assert.equal(stats.stages[0].stage, 'grid'); // what comes before is prepared
    }
    assert.deepEqual(await worker.slice(gut(await worker.cut(prepared, { cells: 9 })), plane), sliced);
    assert.equal(sent.filter(wasSent).length, 0);
  }));

test('a prepared mesh whose twin is gone is sent and prepared once more, as it was', () =>
  withWatched(async (worker, sent) => {
    const tip = { positions: [1, 0.5, 0.4, 2, 0, 0, 2, 1, 0, 2, 0, 1], triangles: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
    const touching = join(box([0, 0, 0], [1, 1, 1]), tip);
    const prepared = await worker.prepare(touching, { intersections: 'assumeNone' });
    const { stats: _, ...expected } = await worker.cut(prepared, { cells: 4 });
    const again = async () => {
      const { stats, ...cutMesh } = await worker.cut(prepared, { cells: 4 });
      assert.deepEqual(cutMesh, expected);
      return stats;
    };
    await rejection(worker.cut(mesh, { cells: 99 }, { progress: () => false })); // in a new thread
    for (let i = 0; i < 2; ++i) assert.equal((await again()).intersections.touching, 0);
    assert.equal(sent.filter(wasSent).length, 1);
    const others = []; // which it gives way to: their twins are freed no sooner than they are
    for (let i = 0; i < 20; ++i) others.push(await worker.cut(mesh, { cells: 3 }));
    for (let i = 0; i < 2; ++i) assert.equal((await again()).stages[0].stage, 'grid');
    assert.equal(sent.filter(wasSent).length, 2);
    assert.equal(others.length, 20);
    assert.ok((await worker.cut({ ...prepared }, { cells: 4 })).stats.intersections.touching > 0); // a copy is data
  }));

test('a prepared mesh is no cut-mesh, and a cut-mesh no mesh', () =>
  withWatched(async (worker) => {
    const [prepared, cutMesh] = [await worker.prepare(mesh), await worker.cut(mesh, { cells: 9 })];
    assert.match((await rejection(worker.measure(mesh, prepared))).message, /what cut\(\) gives, not what prepare\(\) does/);
    assert.equal((await rejection(worker.boundary(prepared))).code, 'badArgument');
    assert.equal((await rejection(worker.cut(cutMesh, { cells: 9 }))).code, 'badArgument');
    assert.deepEqual(await worker.slice(gut(cutMesh), plane), sliced);
    assert.ok(await worker.cut(gut(prepared), { cells: 9 }));
  }));

test('preparing fails and is cancelled like any call', () =>
  withWatched(async (worker) => {
    const crossing = join(mesh, torus(24, 12, 1.1));
    assert.equal((await rejection(worker.prepare(crossing, { intersections: 'refuse' }))).code, 'selfIntersection');
    assert.equal((await rejection(worker.prepare(crossing, { intersections: 'never' }))).code, 'badArgument');
    assert.equal((await rejection(worker.prepare(crossing, { progress: () => false }))).code, 'cancelled');
    assert.equal((await rejection(worker.prepare(crossing, { signal: AbortSignal.abort() }))).code, 'cancelled');
  }));

test('twins of unreachable results are freed', () =>
  withWatched(async (worker, sent) => {
    setFlagsFromString('--expose-gc');
    const collectGarbage = runInNewContext('gc');
    const kept = await worker.prepare(mesh);
    await worker.prepare(mesh);
    await worker.cut(kept, { cells: 9 });
    const isFreed = () => sent.filter(({ forget }) => forget !== undefined).length === 2;
    for (let i = 0; i < 50 && !isFreed(); ++i) {
      collectGarbage();
      await new Promise((resolve) => {
        setTimeout(resolve, 20);
      });
    }
    assert.ok(isFreed());
    assert.ok(await worker.cut(gut(kept), { cells: 9 }));
  }));

test("a worker's result is data to another worker, and to the page", () =>
  withWatched((one) =>
    withWatched(async (two, sent) => {
      const cutMesh = await one.cut(mesh, { cells: 9 });
      assert.deepEqual(await two.slice(cutMesh, plane), sliced);
      assert.ok(sent.every(({ subjects }) => subjects.length === 0));
      assert.deepEqual((await init()).slice(cutMesh, plane), sliced);
    }),
  ));

test("calls of the thread's own work on twins as long as they hold the results", () =>
  withWatched(async (worker) => {
    const { cutMesh, slice } = await worker.call('sliceOfOwn', [mesh, 9, plane]);
    assert.deepEqual(slice, sliced);
    assert.deepEqual(await worker.slice(cutMesh, plane), sliced); // as data
  }));

test('1,000 cuts leave the memory of the thread flat', () =>
  withWatched(async (worker) => {
    let early;
    for (let i = 0; i < 1000; ++i) {
      const cutMesh = await worker.cut(mesh, { cells: 4 + (i % 10) });
      if (i % 10 === 0) await worker.slice(cutMesh, plane);
      if (i % 10 === 1) await worker.cut(await worker.prepare(mesh), { cells: 4 });
      if (i === 100) early = await worker.call('memory');
    }
    assert.deepEqual(await worker.call('memory'), early);
  }));
