import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { test } from 'node:test';
import { promisify } from 'node:util';
import { Worker as NodeWorker } from 'node:worker_threads';
import { MandolineError as CoreError, compiledModule, init } from 'mandoline-wasm';
import { MandolineError, createWorker, describe } from 'mandoline-wasm/worker';
import { buffersOf } from '../../wasm/dist/buffers.js';
import { box, torus } from './meshes.mjs';
import { rejection, withWorker, withoutStats } from './workers.mjs';

const cube = box([0, 0, 0], [1, 1, 1]);
const ring = torus(200, 200);
const root = new URL('../..', import.meta.url);

/** Resolves once the cut has begun; `promise` is that of the cut. */
function begun(worker, mesh, cells, options = {}) {
  let promise;
  const running = new Promise((resolve) => {
    promise = worker.cut(mesh, { cells }, { ...options, progress: resolve });
  });
  return { promise, running };
}

test('every call gives what it gives without a worker', () =>
  withWorker(async (worker) => {
    const here = await init();
    const cutMesh = await worker.cut(cube, { cells: 7 });
    const expected = here.cut(cube, { cells: 7 });
    assert.deepEqual(withoutStats(cutMesh), withoutStats(expected));
    const plane = { normal: [1, 2, 3], offset: 2.9 };
    const points = [0.5, 0.5, 0.5, 9, 9, 9];
    assert.deepEqual(await worker.validate(cube, cutMesh), await here.validate(cube, expected));
    assert.deepEqual(await worker.measure(cube, cutMesh), here.measure(cube, expected));
    assert.deepEqual(await worker.cutEdges(cube, cutMesh), here.cutEdges(cube, expected));
    assert.deepEqual(await worker.adjacency(cutMesh), here.adjacency(expected));
    assert.deepEqual(await worker.triangulate(cutMesh), here.triangulate(expected));
    assert.deepEqual(await worker.triangulate(cutMesh, { cell: 3 }), here.triangulate(expected, { cell: 3 }));
    assert.deepEqual(await worker.triangulate(cutMesh, { region: 1 }), here.triangulate(expected, { region: 1 }));
    assert.deepEqual(await worker.cellAt(cutMesh, [0.01, 0.5, 0.5]), here.cellAt(expected, [0.01, 0.5, 0.5]));
    assert.deepEqual(await worker.cellsAt(cutMesh, points), here.cellsAt(expected, points));
    assert.deepEqual(await worker.slice(cutMesh, plane, { untouched: false }), here.slice(expected, plane, { untouched: false }));
    assert.deepEqual(await worker.slices(cutMesh, [0, 0, 1], [0.2, 0.7]), here.slices(expected, [0, 0, 1], [0.2, 0.7]));
    assert.deepEqual(await worker.outlines(cutMesh, [0, 0, 1], [0.2, 0.7]), here.outlines(expected, [0, 0, 1], [0.2, 0.7]));
    assert.deepEqual(await worker.write(cube, cutMesh, 'json'), await here.write(cube, expected, 'json'));
    assert.deepEqual(withoutStats(await worker.resolve(cube)), withoutStats(here.resolve(cube)));
    assert.deepEqual(await worker.boundary(cutMesh, 'odd'), here.boundary(expected, 'odd'));
    assert.deepEqual(await worker.boundary(here.resolve(cube)), here.boundary(here.resolve(cube)));
    assert.deepEqual(await worker.prepare(cube), here.prepare(cube));
    const calls = Object.keys(here).filter((key) => typeof here[key] === 'function');
    assert.deepEqual(Object.keys(worker).sort(), [...calls, 'call', 'terminate'].sort());
  }));

test('options reach the call', () =>
  withWorker(async (worker) => {
    const cutMesh = await worker.cut(cube, { cells: 4 }, { gridCellRegion: false });
    assert.equal('gridCellRegion' in cutMesh, false);
    assert.equal((await rejection(worker.cut(cube, { cells: 4 }, { snapTolerance: 2 }))).code, 'badOption');
  }));

test('calls run in the order they were made', () =>
  withWorker(async (worker) => {
    const order = [];
    await Promise.all([24, 4, 16, 2].map((cells) => worker.cut(cube, { cells }).then(() => order.push(cells))));
    assert.deepEqual(order, [24, 4, 16, 2]);
  }));

test('arguments are taken as they are at the call', () =>
  withWorker(async (worker) => {
    const mesh = { positions: cube.positions.slice(), triangles: cube.triangles.slice() };
    const blocking = worker.cut(ring, { cells: 8 });
    const cutMesh = worker.cut(mesh, { min: [-1, -1, -1], max: [2, 2, 2], cells: [5, 5, 5] });
    mesh.positions.fill(NaN);
    await blocking;
    assert.equal((await cutMesh).regionCount, 2);
  }));

test('buffers of arguments are handed over on request, and only then', () =>
  withWorker(async (worker) => {
    const mesh = { positions: cube.positions.slice(), triangles: cube.triangles.slice() };
    await worker.cut(mesh, { cells: 4 });
    assert.equal(mesh.positions.length, 24);
    const cutMesh = await worker.cut(mesh, { cells: 4 }, { transfer: [mesh.positions.buffer] });
    assert.equal(cutMesh.regionCount, 2);
    assert.equal(mesh.positions.buffer.byteLength, 0);
    assert.equal(mesh.triangles.length, 36);
    const error = await rejection(worker.cut(mesh, { cells: 4 }));
    assert.equal(error.code, 'badArgument');
  }));

test('all buffers that go to the thread go there uncopied: those of arguments, of former results and of `reuse`', async () => {
  let copied = 0;
  const thread = () => {
    const worker = new NodeWorker(new URL('extra_thread.mjs', import.meta.url));
    const post = worker.postMessage.bind(worker);
    worker.postMessage = (message, transfer = []) => {
      copied += buffersOf(message).filter((buffer) => !transfer.includes(buffer)).length;
      post(message, transfer);
    };
    return worker;
  };
  await withWorker(
    async (worker) => {
      const cutMesh = await worker.cut(cube, { cells: 4 }, { keep: false });
      await worker.measure(cube, cutMesh);
      const used = buffersOf(cutMesh);
      const again = await worker.cut(cube, { cells: 4 }, { reuse: used, transfer: used });
      assert.equal(again.regionCount, 2);
    },
    { thread },
  );
  assert.equal(copied, 0);
});

test('what no call reads is not sent', () =>
  withWorker(async (worker) => {
    const cutMesh = await worker.cut(cube, { cells: 4 });
    structuredClone(cutMesh.gridCellRegion, { transfer: [cutMesh.gridCellRegion.buffer] });
    assert.equal((await worker.validate(cube, cutMesh)).pass, true);
  }));

test('progress is told, in order', () =>
  withWorker(async (worker) => {
    const stages = [];
    await worker.cut(
      ring,
      { cells: 16 },
      {
        progress: ({ stageIndex, stageCount, done, total }) => {
          assert.ok(stageIndex >= 0 && stageIndex < stageCount && done <= total);
          stages.push(stageIndex);
        },
      },
    );
    assert.ok(stages.length > 3);
    assert.deepEqual(
      stages,
      [...stages].sort((a, b) => a - b),
    );
  }));

test('progress that returns false cancels the cut; what it throws is what the cut rejects with', () =>
  withWorker(async (worker) => {
    assert.equal((await rejection(worker.cut(ring, { cells: 32 }, { progress: () => false }))).code, 'cancelled');
    const thrown = new Error('from the callback');
    await assert.rejects(
      worker.cut(
        ring,
        { cells: 32 },
        {
          progress: () => {
            throw thrown;
          },
        },
      ),
      thrown,
    );
    assert.equal((await worker.cut(cube, { cells: 4 })).regionCount, 2);
  }));

test('errors keep their class, code, place and message', () =>
  withWorker(async (worker) => {
    assert.equal(MandolineError, CoreError);
    const bad = { positions: cube.positions, triangles: [0, 1, 2, 0, 1, 99] };
    const { cut } = await init();
    let expected;
    assert.throws(
      () => cut(bad, { cells: 4 }),
      (error) => {
        expected = error;
        return error instanceof MandolineError;
      },
    );
    const error = await rejection(worker.cut(bad, { cells: 4 }));
    for (const key of ['name', 'code', 'message', 'stage', 'element', 'element2']) assert.equal(error[key], expected[key], key);
    assert.equal(error.code, 'badIndex');
    assert.equal(error.element, 1);
    assert.equal(describe(error), describe(expected));
  }));

test('two crossing triangles are both named', () =>
  withWorker(async (worker) => {
    const positions = [0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, -1, 0.5, 0.5, 1, 3, 3, 0];
    const mesh = { positions, triangles: [0, 1, 2, 3, 4, 5] };
    const error = await rejection(worker.cut(mesh, { cells: 3 }, { intersections: 'refuse' }));
    assert.equal(error.code, 'selfIntersection');
    assert.deepEqual(await worker.findIntersections(mesh), (await init()).findIntersections(mesh));
    assert.deepEqual([error.element, error.element2].sort(), [0, 1]);
  }));

test('what a worker cannot be given is a badArgument', () =>
  withWorker(async (worker) => {
    assert.equal((await rejection(worker.cut(cube, { cells: () => 4 }))).code, 'badArgument');
    assert.equal((await rejection(worker.cut(cube, { cells: 4 }, { signal: 'no' }))).code, 'badArgument');
    assert.equal((await rejection(worker.cut(cube, { cells: 4 }, { transfer: [cube] }))).code, 'badArgument');
    assert.equal((await rejection(worker.cut(cube, { cells: 4 }, null))).code, 'badArgument');
    assert.equal((await rejection(worker.cut())).code, 'badArgument');
    const buffer = new ArrayBuffer(24, { maxByteLength: 24 });
    const positions = new Float64Array(buffer, 0, 3);
    buffer.resize(8);
    const error = await rejection(worker.cut({ ...cube, positions }, { cells: 4 }));
    assert.equal(error.code, 'badArgument');
    assert.match(error.message, /^args\[0\]\.positions is detached or out of bounds/);
    assert.equal((await worker.cut(cube, { cells: 4 })).regionCount, 2);
  }));

test('a call that waits leaves the queue when aborted', () =>
  withWorker(async (worker) => {
    const controller = new AbortController();
    const { promise, running } = begun(worker, ring, 32);
    const waiting = worker.cut(ring, { cells: 128 }, { signal: controller.signal });
    const last = worker.cut(cube, { cells: 4 });
    await running;
    controller.abort();
    assert.equal((await rejection(waiting)).code, 'cancelled');
    assert.equal((await promise).regionCount, 2);
    assert.equal((await last).regionCount, 2);
  }));

test('a call that runs is stopped when aborted, and the queue goes on', () =>
  withWorker(async (worker) => {
    const controller = new AbortController();
    const whole = performance.now();
    await worker.cut(ring, { cells: 128 });
    const wholeTime = performance.now() - whole;
    const { promise, running } = begun(worker, ring, 128, { signal: controller.signal });
    const next = worker.cut(cube, { cells: 4 });
    await running;
    const aborted = performance.now();
    controller.abort(new Error('why'));
    const error = await rejection(promise);
    assert.equal(error.code, 'cancelled');
    assert.equal(error.cause.message, 'why');
    assert.equal((await next).regionCount, 2);
    assert.ok(performance.now() - aborted < wholeTime, 'the aborted cut was waited for');
  }));

test('an aborted signal keeps a call from being made; aborting later does nothing', () =>
  withWorker(async (worker) => {
    assert.equal((await rejection(worker.cut(cube, { cells: 4 }, { signal: AbortSignal.abort() }))).code, 'cancelled');
    const controller = new AbortController();
    await worker.cut(cube, { cells: 4 }, { signal: controller.signal });
    const other = worker.cut(ring, { cells: 16 });
    controller.abort();
    assert.equal((await other).regionCount, 2);
  }));

test('two workers work at the same time, each on its own', () =>
  withWorker((one) =>
    withWorker(async (two) => {
      const { promise, running } = begun(one, ring, 128);
      await running;
      assert.equal(await Promise.race([promise.then(() => 'one'), two.cut(cube, { cells: 4 }).then(() => 'two')]), 'two');
      one.terminate();
      assert.equal((await rejection(promise)).code, 'cancelled');
      assert.equal((await two.cut(cube, { cells: 4 })).regionCount, 2);
    }),
  ));

test('terminating rejects what runs, what waits and what comes', async () => {
  const worker = await createWorker();
  const { promise, running } = begun(worker, ring, 64);
  const waiting = worker.cut(cube, { cells: 4 });
  await running;
  worker.terminate();
  worker.terminate();
  for (const call of [promise, waiting, worker.cut(cube, { cells: 4 })]) assert.equal((await rejection(call)).code, 'cancelled');
});

test('a worker starts from a compiled module', async () => {
  const wasm = await compiledModule();
  assert.equal(await withWorker(async (worker) => (await worker.cut(cube, { cells: 4 })).regionCount, { wasm }), 2);
});

test('options that are not an object are a badArgument', async () => {
  for (const options of [null, 'mandoline.wasm']) {
    const error = await rejection(createWorker(options));
    assert.equal(error.code, 'badArgument');
    assert.equal(error.stage, 'init');
  }
});

test('a worker that cannot load the module rejects', async () => {
  for (const wasm of [new URL('missing.wasm', import.meta.url), 'not an address', new Uint8Array([1, 2, 3]), () => {}]) {
    const error = await rejection(createWorker({ wasm }));
    assert.equal(error.code, 'loadFailed');
    assert.match(describe(error), /could not be|can't be/);
  }
});

const extra = { thread: () => new NodeWorker(new URL('extra_thread.mjs', import.meta.url)) };

test("a thread of a script of its own answers the package's calls and its own", () =>
  withWorker(async (worker) => {
    const { cut, measure } = await init();
    assert.deepEqual(withoutStats(await worker.cut(cube, { cells: 7 })), withoutStats(cut(cube, { cells: 7 })));
    assert.deepEqual(await worker.call('volume', [cube, 7]), measure(cube, cut(cube, { cells: 7 })).regionVolume);
    assert.equal(await worker.call('count'), 1);
    assert.equal(await worker.call('count'), 2);
  }, extra));

test('calls of its own wait for others, tell progress and give what they promise', () =>
  withWorker(async (worker) => {
    const seen = [];
    const order = [];
    const value = { a: new Uint8Array([1, 2]) };
    const later = worker
      .call('later', [value], {
        progress: (i) => {
          seen.push(i);
        },
      })
      .then((result) => order.push('later') && result);
    const cut = worker.cut(cube, { cells: 4 }).then(() => order.push('cut'));
    value.a.fill(9);
    assert.deepEqual(await later, { value: { a: new Uint8Array([1, 2]) }, nested: [new Float32Array([1, 2])] });
    await cut;
    assert.deepEqual(seen, [0, 1, 2]);
    assert.deepEqual(order, ['later', 'cut']);
    assert.equal(value.a.length, 2);
    await worker.call('later', [value], { transfer: [value.a.buffer] });
    assert.equal(value.a.length, 0);
    const cyclic = await worker.call('cyclic');
    assert.equal(cyclic.itself, cyclic);
  }, extra));

test('what a call of its own tells after its end is no progress, whether another call runs or none', () =>
  withWorker(async (worker) => {
    const told = [];
    const progress = (value) => {
      told.push(value);
    };
    const pause = () => new Promise((resolve) => setTimeout(resolve, 60));
    await worker.call('tellAfterwards', [], { progress });
    await pause();
    await worker.call('tellAfterwards', [], { progress });
    await worker.call('later', [0]); // takes no progress
    await worker.call('tellAfterwards', [], { progress });
    await worker.call('later', [0], { progress });
    assert.deepEqual(told, [0, 1, 2]);
    assert.equal(await worker.call('count'), 1);
    await worker.call('later', [0]);
    assert.equal(await worker.call('count'), 2); // by the same thread
  }, extra));

test('calls of its own are cancelled by their signal or their progress, in a new thread', () =>
  withWorker(async (worker) => {
    assert.equal(await worker.call('count'), 1);
    const controller = new AbortController();
    const aborted = worker.call('later', [0], { signal: controller.signal, progress: () => controller.abort() });
    assert.equal((await rejection(aborted)).code, 'cancelled');
    const cancelled = await rejection(worker.call('later', [0], { progress: (i) => i < 1 }));
    assert.deepEqual([cancelled.code, cancelled.stage], ['cancelled', 'later']);
    assert.equal(await worker.call('count'), 1);
  }, extra));

test('what a call of its own throws arrives', () =>
  withWorker(async (worker) => {
    const core = await rejection(worker.call('fail', ['core']));
    assert.deepEqual([core.code, core.message, core.stage, core.element], ['badGrid', 'No.', 'fail', 1]);
    await assert.rejects(worker.call('fail', ['plain']), (thrown) => thrown.title === 'Mine' && thrown.detail === 7);
    await assert.rejects(worker.call('fail', ['type']), (thrown) => thrown instanceof TypeError && thrown.message === 'mine');
    assert.equal((await rejection(worker.call('fail', ['function']))).code, 'internalError');
    assert.match((await rejection(worker.call('unsendable'))).message, /can't be sent/);
    assert.equal((await rejection(worker.call('cut', [cube, { cells: 4 }]))).code, 'badArgument'); // that is a method
    assert.equal((await rejection(worker.call('toString'))).code, 'badArgument');
    assert.equal((await rejection(worker.call('volume', [() => {}]))).code, 'badArgument');
    assert.equal(await worker.call('count'), 1);
  }, extra));

test('all threads of a page that is built with the inline script share one address of it', async (t) => {
  const { thread } = await import('mandoline-wasm/inline');
  const started = [];
  globalThis.Worker = class {
    constructor(address) {
      started.push(address);
    }
  };
  t.after(() => delete globalThis.Worker);
  for (let i = 0; i < 3; ++i) thread();
  assert.equal(started.length, 3);
  assert.equal(new Set(started).size, 1);
});

test('a thread that cannot start is named', async () => {
  for (const [thread, pattern] of [
    [() => new NodeWorker(new URL('no_such_thread.mjs', import.meta.url)), /no_such_thread\.mjs/],
    [
      () => {
        throw new Error('mine');
      },
      /mine/,
    ],
  ]) {
    const error = await rejection(createWorker({ thread }));
    assert.deepEqual([error.code, error.stage], ['loadFailed', 'init']);
    assert.match(error.message, pattern);
  }
  for (const thread of [() => 7, () => undefined, 'thread.js']) {
    const error = await rejection(createWorker({ thread }));
    assert.deepEqual([error.code, error.stage], ['badArgument', 'init']);
    assert.match(error.message, /options\.thread/);
  }
});

/** Runs a script of its own; resolves to what it printed when its process ended. */
async function runScript(script) {
  const { stdout } = await promisify(execFile)(process.execPath, ['--input-type=module', '-e', script], { cwd: root, timeout: 20_000 });
  return stdout.trim();
}

const preamble = `
  import { createWorker } from 'mandoline-wasm/worker';
  const cube = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], triangles: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
  const worker = await createWorker();`;

test('a compiled module that cannot be had is a rejection to whoever asks, and to nobody else', async () => {
  const script = `
    WebAssembly.compile = async () => { throw new Error('no'); };
    const { compiledModule } = await import('mandoline-wasm');
    console.log((await compiledModule().catch((error) => error)).code);`;
  assert.equal(await runScript(script), 'loadFailed');
});

test('an idle worker does not keep the process alive', async () => {
  assert.equal(await runScript(`${preamble} console.log('idle');`), 'idle');
});

test('the process waits for calls under way', async () => {
  assert.equal(await runScript(`${preamble} worker.cut(cube, { cells: 20 }).then((r) => console.log(r.regionCount));`), '2');
});

test('after an abort the process still ends', async () => {
  const script = `${preamble}
    const controller = new AbortController();
    worker.cut(cube, { cells: 200 }, { signal: controller.signal, progress: () => controller.abort() })
      .catch((error) => console.log(error.code));`;
  assert.equal(await runScript(script), 'cancelled');
});

test('a worker that dies rejects its call, and the next call works', async () => {
  const script = `
    import threads from 'node:worker_threads';
    import { syncBuiltinESMExports } from 'node:module';
    const made = [];
    threads.Worker = class extends threads.Worker { constructor(...given) { super(...given); made.push(this); } };
    syncBuiltinESMExports();
    ${preamble}
    const call = worker.cut(cube, { cells: 200 }, { progress: () => made.at(-1).terminate() });
    const next = worker.cut(cube, { cells: 4 });
    console.log((await call.catch((error) => error)).code, (await next).regionCount, made.length);`;
  assert.equal(await runScript(script), 'internalError 2 2');
});
