// Cut-meshes that stay in the worker's thread: their arrays are the page's, and are sent back only where the twin is gone.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Worker as NodeWorker } from 'node:worker_threads';
import { init } from 'mandoline-wasm';
import { MandolineError, createWorker } from 'mandoline-wasm/worker';
import { box, torus } from './meshes.mjs';

const mesh = torus(24, 12);
const plane = { normal: [1, 2, 3], offset: 0.1 };
const sliced = await init().then(({ cut, slice }) => slice(cut(mesh, { cells: 9 }), plane));

/** Runs f with a worker and the list of the messages to its threads. */
async function withWorker(f) {
  const sent = [];
  const thread = () => {
    const worker = new NodeWorker(new URL('watched_thread.mjs', import.meta.url));
    const post = worker.postMessage.bind(worker);
    worker.postMessage = (message, transfer) => {
      sent.push(structuredClone({ call: message.call, cutMesh: message.cutMesh, forget: message.forget }));
      post(message, transfer);
    };
    return worker;
  };
  const worker = await createWorker({ thread });
  try {
    return await f(worker, sent);
  } finally {
    worker.terminate();
  }
}

async function rejection(promise) {
  const error = await promise.then(() => assert.fail('should have been rejected'), (reason) => reason);
  assert.ok(error instanceof MandolineError, `${error?.stack}`);
  return error;
}

/** Leaves a result without its arrays, so that only its twin can answer for it. */
function gut(cutMesh) {
  structuredClone(null, { transfer: Object.values(cutMesh).filter((value) => ArrayBuffer.isView(value)).map((array) => array.buffer) });
  return cutMesh;
}

const wasSent = ({ cutMesh }) => cutMesh?.data !== undefined;

test('every call works on the twin, without the arrays', () => withWorker(async (worker, sent) => {
  const { cut, ...here } = await init();
  const expected = cut(mesh, { cells: 9 });
  const cutMesh = gut(await worker.cut(mesh, { cells: 9 }));
  const calls = {
    validate: [mesh, cutMesh], measure: [mesh, cutMesh], cutEdges: [mesh, cutMesh], adjacency: [cutMesh], triangulate: [cutMesh, { cell: 3 }],
    cellAt: [cutMesh, [1, 0.01, 0.02]], cellsAt: [cutMesh, [1, 0.01, 0.02]], slice: [cutMesh, plane],
    slices: [cutMesh, [1, 2, 3], [0, 0.1]], outlines: [cutMesh, [0, 0, 1], [0.05]], write: [mesh, cutMesh, 'vtu'],
  };
  for (const [name, args] of Object.entries(calls)) {
    assert.deepEqual(await worker[name](...args), here[name](...args.map((arg) => (arg === cutMesh ? expected : arg))), name);
  }
  assert.deepEqual(Object.keys(here).filter((name) => !(name in calls)).sort(), ['readMesh', 'version']);
  assert.equal(sent.filter(wasSent).length, 0);
}));

test('copies, and results that were not to be kept, are sent each time', () => withWorker(async (worker, sent) => {
  const kept = await worker.cut(mesh, { cells: 9 });
  const other = await worker.cut(mesh, { cells: 9 }, { keep: false });
  const { stats: _, ...keptData } = kept;
  const { stats: __, ...otherData } = other;
  assert.deepEqual(otherData, keptData);
  for (const cutMesh of [{ ...kept }, structuredClone(kept), other, other]) assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
  assert.ok(sent.every(({ call, cutMesh }) => call === 'cut' || cutMesh === undefined));
  assert.equal((await rejection(worker.slice(gut(other), plane))).code, 'badArgument');
}));

test('after an abort the new thread is sent the arrays once', () => withWorker(async (worker, sent) => {
  const cutMesh = await worker.cut(mesh, { cells: 9 });
  await rejection(worker.cut(mesh, { cells: 99 }, { progress: () => false }));
  for (let i = 0; i < 3; ++i) assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
  assert.equal(sent.filter(wasSent).length, 1);
  assert.deepEqual(await worker.slice(gut(cutMesh), plane), sliced);
  await rejection(worker.cut(mesh, { cells: 99 }, { progress: () => false }));
  assert.equal((await rejection(worker.slice(cutMesh, plane))).code, 'badArgument');
  assert.equal((await worker.cut(mesh, { cells: 9 })).regionCount, 2);
}));

test('a call that waits is sent the arrays when the thread it was made for is gone', () => withWorker(async (worker, sent) => {
  const cutMesh = await worker.cut(mesh, { cells: 9 });
  const cancelled = worker.cut(mesh, { cells: 99 }, { progress: () => false });
  const waiting = [worker.slice(cutMesh, plane), worker.measure(mesh, cutMesh), worker.slice(cutMesh, plane)];
  await rejection(cancelled);
  assert.deepEqual((await Promise.all(waiting))[2], sliced);
  assert.equal(sent.filter(wasSent).length, 1);
}));

test('those that the thread let go are sent again, with the other arguments', () => withWorker(async (worker, sent) => {
  const first = await worker.cut(mesh, { cells: 9 });
  const expected = await worker.measure(mesh, first);
  const many = [];
  for (let i = 0; i < 20; ++i) many.push(await worker.cut(mesh, { cells: 5 }));
  assert.deepEqual(await worker.measure(mesh, first), expected);
  assert.deepEqual(sent.filter(wasSent).map(({ call }) => call), ['measure']);
  assert.deepEqual(await worker.measure(mesh, gut(first)), expected);
  assert.equal((await rejection(worker.adjacency(gut(many[0])))).code, 'badArgument');
  assert.ok(await worker.adjacency(gut(many.at(-1))));
}));

test('arrays that are handed over with the call are sent', () => withWorker(async (worker) => {
  const cutMesh = await worker.cut(mesh, { cells: 9 });
  assert.deepEqual(await worker.slice(cutMesh, plane, { transfer: [cutMesh.positions.buffer] }), sliced);
  assert.equal(cutMesh.positions.length, 0);
  assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
}));

test('bad arguments beside a twin are told as such, and it stays', () => withWorker(async (worker, sent) => {
  const cutMesh = gut(await worker.cut(mesh, { cells: 9 }));
  assert.match((await rejection(worker.triangulate(cutMesh, { cell: 1e6 }))).message, /cell/);
  assert.equal((await rejection(worker.measure(box([0, 0, 0], [1, 1, 1]), cutMesh))).code, 'badArgument');
  assert.equal((await rejection(worker.slice(cutMesh, { normal: [0, 0, 0], offset: 0 }))).code.slice(0, 3), 'bad');
  assert.equal(sent.filter(({ call }) => call === 'slice').length, 1);
  assert.deepEqual(await worker.slice(cutMesh, plane), sliced);
}));

test('a worker\'s result is data to another worker, and to the page', () => withWorker((one) => withWorker(async (two, sent) => {
  const cutMesh = await one.cut(mesh, { cells: 9 });
  assert.deepEqual(await two.slice(cutMesh, plane), sliced);
  assert.ok(sent.every(({ cutMesh: named }) => named === undefined));
  assert.deepEqual((await init()).slice(cutMesh, plane), sliced);
})));

test('calls of the thread\'s own work on twins as long as they hold the results', () => withWorker(async (worker) => {
  const { cutMesh, slice } = await worker.call('sliceOfOwn', [mesh, 9, plane]);
  assert.deepEqual(slice, sliced);
  assert.deepEqual(await worker.slice(cutMesh, plane), sliced); // as data
}));

test('1,000 cuts leave the memory of the thread flat', () => withWorker(async (worker) => {
  let early;
  for (let i = 0; i < 1000; ++i) {
    const cutMesh = await worker.cut(mesh, { cells: 4 + (i % 10) });
    if (i % 10 === 0) await worker.slice(cutMesh, plane);
    if (i === 100) early = await worker.call('memory');
  }
  assert.deepEqual(await worker.call('memory'), early);
}));
