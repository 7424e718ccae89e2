// A worker that also computes: the same results, the module loaded when it is first needed, and the twins in its thread.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Worker as NodeWorker } from 'node:worker_threads';
import { init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { createWorker } from 'mandoline-wasm/physics/worker';
import { box, gut, torus } from './meshes.mjs';
import { rejection } from './workers.mjs';

const [{ cut }, physics] = await Promise.all([init(), initPhysics()]);
const mesh = torus(24, 12);
const grid = { cells: 9 };
const expected = physics.cellComplex(mesh, cut(mesh, grid));
const source = expected.cellCentre.filter((_, i) => i % 3 === 0);
const solved = physics.solvePoisson(expected, { source }, { balance: true });
const flow = physics.solveFlow(expected, [1, 0, 0]);
const seeds = physics.inflowSeeds(cut(mesh, grid).grid, [1, 0, 0], 30);
const followed = physics.streamlines({ mesh, cutMesh: cut(mesh, grid), cells: expected, flow }, seeds);

/** Runs f with a worker and the list of the messages to its threads. */
async function withWatched(f, options) {
  const sent = [];
  const thread = () => {
    const worker = new NodeWorker(new URL(import.meta.resolve('mandoline-wasm/physics/worker-thread')));
    const post = worker.postMessage.bind(worker);
    worker.postMessage = (message, transfer) => {
      const data = (message.subjects ?? []).filter((subject) => subject.data !== undefined).map(({ origin }) => origin.kind);
      sent.push({ call: message.call, module: message.module && (message.part ?? 'cut'), data });
      post(message, transfer);
    };
    return worker;
  };
  const worker = await createWorker({ thread, ...options });
  try {
    return await f(worker, sent);
  } finally {
    worker.terminate();
  }
}

test("the package's own worker", async () => {
  const worker = await createWorker();
  const cells = await worker.cellComplex(mesh, await worker.cut(mesh, grid));
  assert.deepEqual(await worker.solvePoisson(cells, { source }, { balance: true }), solved);
  worker.terminate();
});

test('every call gives the same, and no arrays are sent', () =>
  withWatched(async (worker, sent) => {
    const cutMesh = await worker.cut(mesh, grid);
    const octree = await worker.coarsen(cutMesh);
    assert.deepEqual(octree, physics.coarsen(cut(mesh, grid)));
    const cells = await worker.cellComplex(mesh, gut(cutMesh));
    assert.deepEqual(cells, expected);
    gut(cells);
    const boundary = physics.boundaryOf(expected);
    const field = { mesh, cutMesh, cells, flow };
    const groups = { names: ['all'], triangleGroup: new Uint32Array(cutMesh.triangleCount).fill(1) };
    const calls = {
      mergeSmallCells: [cutMesh, cells],
      uniteWalls: [cutMesh, cells],
      subComplex: [cells, [1, 2, 3]],
      regionComplex: [cells, 0],
      complexEdges: [cells],
      operators: [cells],
      boundaryOf: [cells],
      outwardNormals: [boundary, cells],
      cellComponents: [cells],
      poissonSystem: [cells, { source }],
      solvePoisson: [cells, { source }, { balance: true }],
      solveFlow: [cells, [1, 0, 0]],
      faceGroups: [cutMesh, cells, groups],
      velocityAt: [field, source.subarray(0, 60)],
      streamlines: [field, seeds],
      inflowSeeds: [cutMesh.grid, [1, 0, 0], 20],
      writeCells: [cutMesh, cells, 'vtu', { fields: { phi: flow.phi } }],
      writeFaces: [cutMesh, cells],
      writePolyMesh: [cutMesh, cells],
    };
    const replaced = new Map([
      [cells, expected],
      [cutMesh, cut(mesh, grid)],
      [field, { mesh, cutMesh: cut(mesh, grid), cells: expected, flow }],
    ]);
    for (const [name, args] of Object.entries(calls)) {
      assert.deepEqual(await worker[name](...args), await physics[name](...args.map((arg) => replaced.get(arg) ?? arg)), name);
    }
    assert.deepEqual(
      Object.keys(physics)
        .filter((name) => !(name in calls))
        .sort(),
      ['cellComplex', 'coarsen', 'createFlowStepper', 'createHeatStepper', 'createPoissonSolver', 'version'],
    );
    assert.deepEqual(
      sent.filter(({ data }) => data.length > 0),
      [],
    );
    assert.deepEqual(
      sent.map(({ module }) => module).filter((name) => name !== undefined),
      ['cut', 'physics'],
    );
  }));

test('twins of parts', () =>
  withWatched(async (worker, sent) => {
    const cells = await worker.cellComplex(mesh, await worker.cut(mesh, grid));
    const { cells: part } = await worker.regionComplex(cells, 0);
    assert.equal((await worker.cellComponents(gut(part))).count, 1);
    assert.equal(sent.filter(({ data }) => data.length > 0).length, 0);
  }));

test('copies are data', () =>
  withWatched(async (worker) => {
    const cells = await worker.cellComplex(mesh, structuredClone(await worker.cut(mesh, grid)));
    assert.deepEqual(await worker.cellComponents({ ...cells }), physics.cellComponents(expected));
    assert.equal((await rejection(worker.cellComponents({ ...gut(cells) }))).code, 'badArgument');
  }));

test('after an abort the new thread is sent module and arrays', () =>
  withWatched(async (worker, sent) => {
    const cells = await worker.cellComplex(mesh, await worker.cut(mesh, grid));
    const { code } = await rejection(worker.solvePoisson(cells, { source }, { balance: true, progress: () => false }));
    assert.equal(code, 'cancelled');
    for (let i = 0; i < 2; ++i) assert.deepEqual(await worker.solvePoisson(cells, { source }, { balance: true }), solved);
    assert.deepEqual(sent.slice(-3), [
      { call: 'solvePoisson', module: undefined, data: ['cells'] },
      { call: undefined, module: 'physics', data: [] },
      { call: 'solvePoisson', module: undefined, data: [] },
    ]);
  }));

test("of a flow's two twins, those that the thread let go are sent again, and no others", () =>
  withWatched(async (worker, sent) => {
    const cutMesh = await worker.cut(mesh, grid);
    const field = { mesh, cutMesh, cells: await worker.cellComplex(mesh, cutMesh), flow };
    const follow = async (...data) => {
      assert.deepEqual(await worker.streamlines(field, seeds), followed);
      assert.deepEqual(sent.filter(({ call }) => call === 'streamlines').at(-1).data, data);
      sent.length = 0;
    };
    /** Leaves so many others in the thread that they take the place of all but those that `use` is called with. */
    const crowd = async (use) => {
      for (let i = 0; i < 20; ++i) {
        await worker.subComplex(field.cells, [i]);
        await use();
      }
    };
    await follow();
    const crowdCuts = async () => {
      for (let i = 0; i < 20; ++i) await worker.cut(mesh, { cells: 3 });
    };
    await crowd(() => {}); // each takes the cells
    await follow(); // the module that cuts has the cut-mesh
    await crowd(() => {});
    await crowdCuts();
    await follow('cutMesh');
    await crowd(() => worker.coarsen(cutMesh));
    await follow();
    const { cells } = await worker.subComplex(field.cells, [0]);
    for (let i = 0; i < 20; ++i) await worker.subComplex(cells, [0]);
    await follow('cutMesh', 'cells');
    for (let i = 0; i < 20; ++i) await worker.subComplex(cells, [0]);
    gut(field.cells);
    const error = await rejection(worker.streamlines(field, seeds));
    assert.deepEqual([error.code, error.stage], ['badArgument', 'streamlines']);
    assert.match(error.message, /detached/);
  }));

test('a waiting call has the flow as it was', () =>
  withWatched(async (worker) => {
    const cutMesh = await worker.cut(mesh, grid);
    const field = { mesh, cutMesh, cells: await worker.cellComplex(mesh, cutMesh), flow };
    const cancelled = rejection(worker.cut(mesh, { cells: 99 }, { progress: () => false }));
    const waiting = worker.streamlines(field, seeds);
    field.cells = null;
    field.flow = null;
    await cancelled; // and the thread with the twins is gone
    assert.deepEqual(await waiting, followed);
  }));

test('following streamlines is told of and cancelled like any call', () =>
  withWatched(async (worker) => {
    const cutMesh = await worker.cut(mesh, grid);
    const field = { mesh, cutMesh, cells: await worker.cellComplex(mesh, cutMesh), flow };
    const stages = new Set();
    assert.deepEqual(
      await worker.streamlines(field, seeds, {
        progress: ({ stage }) => {
          stages.add(stage);
        },
      }),
      followed,
    );
    assert.ok(stages.has('streamlines'));
    assert.equal((await rejection(worker.streamlines(field, seeds, { progress: () => false }))).code, 'cancelled');
    assert.equal((await rejection(worker.streamlines(field, seeds, { signal: AbortSignal.abort() }))).code, 'cancelled');
    assert.equal((await rejection(worker.velocityAt(null, seeds))).message, 'field must be an object, not null.');
    assert.equal((await rejection(worker.velocityAt({ ...field, cells: cutMesh }, seeds))).code, 'badArgument');
  }));

test('what progress cancels names the stage of the cut or else the call, as without a worker', () =>
  withWatched(async (worker) => {
    const direct = { ...(await init()), ...physics };
    const made = cut(mesh, grid);
    const args = {
      prepare: [mesh],
      cut: [mesh, grid],
      resolve: [mesh],
      orient: [mesh],
      findIntersections: [mesh],
      validate: [mesh, made],
      measure: [mesh, made],
      write: [mesh, made, 'json'],
      coarsen: [made],
      cellComplex: [mesh, made, null],
      mergeSmallCells: [made, expected],
      solvePoisson: [expected, {}],
      solveFlow: [expected, [1, 0, 0]],
      streamlines: [{ mesh, cutMesh: made, cells: expected, flow }, seeds],
    };
    const stages = {};
    for (const [name, given] of Object.entries(args)) {
      const cancelled = (calls) => rejection((async () => calls[name](...given, { progress: () => false }))());
      const [here, there] = [await cancelled(direct), await cancelled(worker)];
      assert.deepEqual([there.code, there.stage], [here.code, here.stage], name);
      stages[name] = there.stage;
    }
    const { prepare, cut: ofCut, resolve, ...others } = stages;
    assert.deepEqual([prepare, ofCut, resolve], ['input', 'input', 'input']);
    for (const [name, stage] of Object.entries(others)) assert.equal(stage, name);
  }));

test('calls keep their order, though the first loads the module', () =>
  withWatched(async (worker) => {
    const cutMesh = await worker.cut(mesh, grid);
    const done = [];
    await Promise.all([
      worker.coarsen(cutMesh).then(() => done.push('coarsen')),
      worker.measure(mesh, cutMesh).then(() => done.push('measure')),
      worker.coarsen(cutMesh).then(() => done.push('again')),
    ]);
    assert.deepEqual(done, ['coarsen', 'measure', 'again']);
  }));

test("a module that can't be loaded fails the calls that compute, and is tried again", async () => {
  let attempts = 0;
  const physicsWasm = () => {
    if (++attempts < 3) throw new TypeError('not yet');
    return new URL(import.meta.resolve('mandoline-wasm/physics.wasm'));
  };
  await withWatched(
    async (worker) => {
      const cutMesh = await worker.cut(mesh, grid);
      for (let i = 0; i < 2; ++i) assert.equal((await rejection(worker.coarsen(cutMesh))).code, 'loadFailed');
      assert.deepEqual(await worker.coarsen(cutMesh), physics.coarsen(cut(mesh, grid)));
    },
    { physicsWasm },
  );
});

test('errors name the call', () =>
  withWatched(async (worker) => {
    const cells = await worker.cellComplex(mesh, await worker.cut(mesh, grid));
    const { code, stage, element } = await rejection(worker.regionComplex(cells, 7));
    assert.deepEqual([code, stage, element], ['badArgument', 'regionComplex', 7]);
    const other = await rejection(worker.cellComplex(box([0, 0, 0], [1, 1, 1]), await worker.cut(mesh, grid)));
    assert.deepEqual([other.code, other.stage], ['badArgument', 'cellComplex']);
    const prepared = await worker.prepare(mesh);
    assert.equal((await rejection(worker.coarsen(prepared))).code, 'badArgument');
  }));

test("a script of one's own that does not import the part", async () => {
  const thread = () => new NodeWorker(new URL(import.meta.resolve('mandoline-wasm/worker-thread')));
  const worker = await createWorker({ thread });
  const error = await rejection(worker.coarsen(await worker.cut(mesh, grid)));
  assert.deepEqual([error.code, error.stage], ['badArgument', 'coarsen']);
  assert.match(error.message, /import mandoline-wasm\/physics\/worker-thread/);
  worker.terminate();
});

test("calls of one's own compute in the thread", async () => {
  const worker = await createWorker({ thread: () => new NodeWorker(new URL('physics_thread.mjs', import.meta.url)) });
  assert.deepEqual(await worker.call('potential', [mesh, grid]), solved.phi);
  worker.terminate();
});
