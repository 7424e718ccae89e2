import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Worker as NodeWorker } from 'node:worker_threads';
import { init } from 'mandoline-wasm';
import { createWorker } from 'mandoline-wasm/worker';
import { startModule } from '../../wasm/dist/api.js';
import { compile } from '../../wasm/dist/load.js';
import { cutModule } from '../../wasm/dist/module.js';
import { ownWasm } from '../../wasm/dist/own-wasm.js';
import { Lead, follow } from '../../wasm/dist/shares.js';
import { box, torus } from './meshes.mjs';
import { rejection, withWorker, withoutStats } from './workers.mjs';

const here = await init();
const ring = torus(150, 120);
/** Two rings that cross, so that there are made vertices. */
const crossing = (() => {
  const [first, second] = [torus(60, 40), torus(40, 60, 0.9, 0.5)];
  const shift = first.positions.length / 3;
  return {
    positions: Float64Array.of(...first.positions, ...second.positions.map((x, i) => x + [0.1, 0.2, 0.05][i % 3])),
    triangles: Uint32Array.of(...first.triangles, ...second.triangles.map((v) => v + shift)),
  };
})();

/** Starts threads of the package, or with another script, which are listed. */
function listed(threads, script = '../../wasm/dist/worker-thread.js') {
  return () => {
    threads.push(new NodeWorker(new URL(script, import.meta.url), { execArgv: [] }));
    return threads.at(-1);
  };
}

/** f(leading module, Lead with that many others in this thread); onAnswer(what one of these is about to send it) */
async function withOthers(count, f, onAnswer = () => {}) {
  const compiled = await compile(ownWasm.source, 'mandoline.wasm');
  const [first, ...others] = Array.from({ length: count + 1 }, () => startModule(cutModule, compiled));
  const lead = new Lead(() => {});
  const ports = others.map(({ host }, i) => {
    const { port1, port2 } = new MessageChannel();
    lead.add(i, port1);
    const post = port2.postMessage.bind(port2);
    port2.postMessage = (answer, transfer) => {
      onAnswer(answer);
      post(answer, transfer);
    };
    follow(port2, host);
    return port1;
  });
  try {
    await f(first, lead);
  } finally {
    for (const port of ports) port.close();
  }
}

const never = () => assert.fail('it was cut alone');

for (const threads of [2, 3]) {
  test(`${threads} threads cut to the bit as one does, a mesh or a prepared one, again and again`, () =>
    withWorker(
      async (worker) => {
        for (const [mesh, cells] of [
          [ring, 80],
          [crossing, 64],
          [box([0, 0, 0], [1, 2, 3]), 90],
        ]) {
          const expected = here.cut(mesh, { cells });
          const whole = await worker.cut(mesh, { cells });
          assert.deepEqual(withoutStats(whole), withoutStats(expected));
          assert.deepEqual(
            whole.stats.stages.map(({ stage }) => stage),
            expected.stats.stages.map(({ stage }) => stage),
          );
          assert.deepEqual(whole.stats.parts, expected.stats.parts);
          const prepared = await worker.prepare(mesh);
          for (const n of [cells, 70]) {
            const again = await worker.cut(prepared, { cells: n }, { gridCellRegion: false });
            const { gridCellRegion, ...same } = here.cut(mesh, { cells: n });
            assert.deepEqual(withoutStats(again), withoutStats(same));
          }
          assert.deepEqual(await worker.measure(mesh, whole), here.measure(mesh, expected));
        }
      },
      { threads },
    ));
}

test('a share is cut by each of the threads, none alone', () =>
  withOthers(2, async (module, lead) => {
    const prepared = module.calls.prepare(ring);
    for (const mesh of [ring, prepared, prepared]) {
      const { host, calls } = module;
      const cutMesh = await lead.cut({ host, calls: { ...calls, cut: never } }, [mesh, { cells: 70 }]);
      assert.deepEqual(withoutStats(cutMesh), withoutStats(here.cut(ring, { cells: 70 })));
    }
  }));

test('parts are written into the memory of those before, and are the same', () => {
  const sizes = []; // of each part's buffers
  const note = ({ cutMesh }) => cutMesh && sizes.push(Object.values(cutMesh).map((array) => array?.buffer?.byteLength));
  return withOthers(
    1,
    async (module, lead) => {
      for (const cells of [90, 80, 70]) {
        const cutMesh = await lead.cut({ host: module.host, calls: { ...module.calls, cut: never } }, [ring, { cells }]);
        assert.deepEqual(withoutStats(cutMesh), withoutStats(here.cut(ring, { cells })));
      }
      const bytes = (list) => list.reduce((sum, size) => sum + (size ?? 0), 0);
      for (const later of sizes.slice(1)) {
        const isNew = later.filter((size) => !sizes[0].includes(size));
        assert.ok(bytes(isNew) < 0.1 * bytes(later), `${bytes(isNew)} of ${bytes(later)}`);
      }
    },
    note,
  );
});

test('a prepared mesh does not give way to the large cuts that several threads make of it', () =>
  withOthers(1, async (module, lead) => {
    const prepared = module.calls.prepare(box([0.5, 0.5, 0.5], [0.500001, 0.500001, 0.500001]));
    const grid = { min: [0, 0, 0], max: [1, 1, 1], cells: [1, 2 ** 11, 2 ** 11] }; // whose rows take 64 MB
    const stages = new Set();
    const progress = ({ stage }) => Boolean(stages.add(stage));
    for (let i = 0; i < 3; ++i) await lead.cut(module, [prepared, grid, { gridCellRegion: false, progress }]);
    assert.ok(stages.has('grid'));
    assert.ok(!stages.has('input')); // it was not prepared once more
  }));

test('the first large cut starts the others', async () => {
  const threads = [];
  await withWorker(
    async (worker) => {
      await worker.cut(box([0, 0, 0], [1, 1, 1]), { cells: 20 });
      assert.equal(threads.length, 1);
      for (const cells of [70, 71]) {
        await worker.cut(ring, { cells });
        assert.equal(threads.length, 3);
      }
    },
    { threads: 3, thread: listed(threads) },
  );
});

test("calls of the user's own script share cuts, of several at a time one", async () => {
  const threads = [];
  await withWorker(
    async (worker) => {
      const grids = [{ cells: 70 }, { cells: 75 }];
      const [first, second] = await worker.call('cutTogether', [ring, grids, { gridCellRegion: false }]);
      assert.equal(threads.length, 2);
      for (const [i, cutMesh] of [first, second].entries()) {
        assert.deepEqual(withoutStats(cutMesh), withoutStats(here.cut(ring, grids[i], { gridCellRegion: false })));
      }
      const error = await rejection(worker.call('cutTogether', [ring, [{ cells: -70 }]]));
      assert.throws(() => here.cut(ring, { cells: -70 }), { code: error.code, message: error.message });
    },
    { threads: 2, thread: listed(threads, 'extra_thread.mjs') },
  );
});

test('what is small or has a snapTolerance is cut alone, and so is what no other thread can take', () =>
  withOthers(1, async ({ host, calls }, lead) => {
    const alone = [];
    const noting = (mesh, grid, options) => alone.push(grid.cells) && calls.cut(mesh, grid, options);
    const cut = (mesh, cells, options) => lead.cut({ host, calls: { ...calls, cut: noting } }, [mesh, { cells }, options]);
    await cut(box([0, 0, 0], [1, 1, 1]), 20);
    await cut(ring, 71, { snapTolerance: 0.1 });
    await cut(ring, 72);
    lead.remove(0);
    await cut(ring, 73);
    assert.deepEqual(alone, [20, 71, 73]);
  }));

test('a cut that fails has the same error as on one thread', () =>
  withWorker(
    async (worker) => {
      const broken = { positions: ring.positions.slice(), triangles: ring.triangles };
      broken.positions[1234] = Number.NaN;
      const failing = [
        [broken, { cells: 70 }, {}],
        [crossing, { cells: 70 }, { intersections: 'refuse' }],
        [crossing, { cells: 70 }, { intersections: 'assumeNone' }],
        [
          ring,
          {
            planes: [
              [0, 1],
              [0, 1],
              [1, 0],
            ],
          },
          {},
        ],
        [ring, { cells: 20_000 }, {}],
      ];
      for (const [mesh, grid, options] of failing) {
        const { code, message, element, element2, stage } = await rejection(worker.cut(mesh, grid, options));
        const expected = assert.throws(() => here.cut(mesh, grid, options), { code, message, element, element2, stage });
        assert.equal(expected, undefined);
      }
      assert.deepEqual(withoutStats(await worker.cut(ring, { cells: 70 })), withoutStats(here.cut(ring, { cells: 70 })));
    },
    { threads: 2 },
  ));

test('a thread that dies leaves its shares to the others', async () => {
  const threads = [];
  await withWorker(
    async (worker) => {
      const expected = withoutStats(here.cut(ring, { cells: 80 }));
      const cut = worker.cut(ring, { cells: 80 }, { progress: () => void threads[1].terminate() });
      assert.deepEqual(withoutStats(await cut), expected);
      await threads[2].terminate();
      assert.deepEqual(withoutStats(await worker.cut(ring, { cells: 80 })), expected);
      assert.equal(threads.length, 3);
    },
    { threads: 3, thread: listed(threads) },
  );
});

test('a cancelled cut ends all threads, and the next ones share again', async () => {
  const threads = [];
  await withWorker(
    async (worker) => {
      const controller = new AbortController();
      const cut = worker.cut(ring, { cells: 150 }, { signal: controller.signal, progress: () => controller.abort() });
      assert.equal((await rejection(cut)).code, 'cancelled');
      assert.deepEqual(withoutStats(await worker.cut(ring, { cells: 80 })), withoutStats(here.cut(ring, { cells: 80 })));
      assert.equal(threads.length, 4);
    },
    { threads: 2, thread: listed(threads) },
  );
});

test('threads must be a whole number of them', async () => {
  for (const threads of [0, -1, 1.5, 65, '2', null]) {
    const error = await rejection(createWorker(/** @type {any} */ ({ threads })));
    assert.equal(error.code, 'badArgument');
    assert.match(error.message, /^options\.threads must be an integer from 1 to 64, not /);
  }
});
