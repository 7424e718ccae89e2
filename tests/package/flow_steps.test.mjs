// Flows in time: what the native program writes, to the bit; objects that keep a state in the module, here and in a worker, and how they
// end.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join as path } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { failNext, memorySize } from './instances.mjs';
import { box, gut, readVtu, sheet, torus, writeObj } from './meshes.mjs';
import { rejection } from './workers.mjs';

const { init } = await import('mandoline-wasm'); // after the instances are watched
const { initPhysics } = await import('mandoline-wasm/physics');
const { createWorker } = await import('mandoline-wasm/physics/worker');
const { cut } = await init();
const physics = await initPhysics(); // the latest instance

const root = path(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.MANDOLINE_CLI ?? path(root, 'build', 'mandoline');
const folder = mkdtempSync(path(tmpdir(), 'mandoline-'));
after(() => rmSync(folder, { recursive: true }));

const wind = [1, 0.2, -0.1];
const grid = { min: [-1.9, -1.7, -0.95], max: [1.8, 1.75, 0.9], cells: [19, 17, 11] };
const meshes = { torus: torus(30, 15), box: box([-0.7, -0.6, -0.5], [0.7, 0.6, 0.5]), sheet: sheet([-1, -1], [0.9, 0.8], 0.125) };

function cellsAbout(mesh) {
  const cutMesh = cut(mesh, grid);
  const { cells } = physics.mergeSmallCells(cutMesh, physics.cellComplex(mesh, cutMesh));
  return { cutMesh, cells };
}

const { cutMesh, cells } = cellsAbout(meshes.torus);
const options = { viscosity: 0.01 };

for (const [name, mesh] of Object.entries(meshes)) {
  for (const viscosity of [0, 0.01]) {
    const what = `${name}, viscosity ${viscosity}: the steps of the native program, to the bit`;
    test(what, { skip: existsSync(program) ? false : `there is no native program ${program}` }, () => {
      const files = ['mesh.obj', 'report.json', 'flow.vtu'].map((file) => path(folder, file));
      writeFileSync(files[0], writeObj(mesh));
      const box = ['--box', [...grid.min, ...grid.max].join(), '--cells', grid.cells.join(), '--coarsen', '0'];
      const args = ['flow', files[0], '--wind', wind.join(), ...box, '--steps', '4', '--viscosity', String(viscosity)];
      execFileSync(program, [...args, '--report', files[1], '-o', files[2]], { stdio: 'pipe' });
      const report = JSON.parse(readFileSync(files[1]));
      const arrays = readVtu(readFileSync(files[2]));
      const stepper = physics.createFlowStepper(cellsAbout(mesh).cells, wind, { viscosity });
      const steps = Array.from({ length: 4 }, () => stepper.step());
      const { time, cellVelocity, cellPressure } = stepper.flow();
      assert.deepEqual(
        steps.map(({ status }) => status),
        ['converged', 'converged', 'converged', 'converged'],
      );
      assert.deepEqual([report.time, report.timeStep], [time, steps[3].timeStep]);
      assert.deepEqual([arrays.velocity, arrays.pressure], [cellVelocity, cellPressure]);
      assert.deepEqual(
        report.forces.map(({ group: _, ...force }) => force),
        stepper.forces(),
      );
      stepper.free();
    });
  }
}

test('it starts again, and steps are as long as they are to be', () => {
  const stepper = physics.createFlowStepper(cells, wind, { ...options, timeStep: 0.02 });
  const { cellVelocity } = stepper.flow();
  const twoSteps = () => {
    stepper.start([...cellVelocity]);
    assert.equal(stepper.flow().time, 0);
    assert.deepEqual([stepper.step().timeStep, stepper.step().timeStep], [0.02, 0.02]);
    return stepper.flow();
  };
  const first = twoSteps();
  assert.equal(first.time, 0.04);
  assert.deepEqual(twoSteps(), first);
});

test('forces by groups, about a point', () => {
  const groups = { names: ['a', 'b'], triangleGroup: Uint32Array.from({ length: cutMesh.triangleCount }, (_, t) => t % 2) };
  const faceGroup = physics.faceGroups(cutMesh, cells, groups);
  const stepper = physics.createFlowStepper(cells, wind, options);
  stepper.step();
  const [all] = stepper.forces();
  const parts = stepper.forces({ faceGroup });
  assert.equal(parts.length, 2);
  for (const key of ['pressure', 'viscous', 'moment'])
    all[key].forEach((x, d) => assert.ok(Math.abs(parts[0][key][d] + parts[1][key][d] - x) < 1e-12, key));
  assert.notDeepEqual(stepper.forces({ centre: [0, 0, 1] })[0].moment, all.moment);
  assert.deepEqual(stepper.forces({ centre: [0, 0, 1] })[0].pressure, all.pressure);
});

test('after it was freed, each method is a named error', () => {
  const stepper = physics.createFlowStepper(cells, wind);
  stepper.free();
  stepper.free();
  for (const method of ['start', 'step', 'flow', 'forces'])
    assert.throws(() => stepper[method]([]), {
      name: 'MandolineError',
      code: 'badArgument',
      stage: method,
      message: 'The flow stepper was freed.',
    });
  const disposed = physics.createFlowStepper(cells, wind);
  disposed[Symbol.dispose]();
  assert.throws(() => disposed.step(), { message: 'The flow stepper was freed.' });
});

test('wrong calls of methods leave it as it is', () => {
  const stepper = physics.createFlowStepper(cells, wind);
  const wrong = [
    ['start', [[1, 2]], 'badArgument'],
    ['start', ['text'], 'badArgument'],
    ['start', [new Float64Array(3 * cells.cellVolume.length).fill(NaN)], 'badArgument'],
    ['forces', [{ faceGroup: [1] }], 'badArgument'],
    ['forces', [{ faceGroup: new Uint32Array(3) }], 'badArgument'],
    ['forces', [{ centre: [1] }], 'badArgument'],
    ['forces', [{ center: [0, 0, 0] }], 'badArgument'],
    ['step', [{ steps: 2 }], 'badArgument'],
  ];
  for (const [method, args, code] of wrong) assert.throws(() => stepper[method](...args), { name: 'MandolineError', code, stage: method });
  assert.throws(() => stepper.forces({ center: 0 }), /did you mean centre\?/);
  assert.throws(() => physics.createFlowStepper(cells, [NaN, 0, 0]), { code: 'badArgument', stage: 'createFlowStepper' });
  for (const option of [{ viscosity: -1 }, { timeStep: -1 }, { courant: 0 }, { tolerance: 0 }, { maxIterations: -1 }])
    assert.throws(() => physics.createFlowStepper(cells, wind, option), { code: 'badOption' });
  assert.equal(stepper.flow().time, 0);
  assert.equal(stepper.step().status, 'converged');
});

test('what breaks a step off is its status', () => {
  const still = physics.createFlowStepper(cells, [0, 0, 0]);
  assert.equal(still.step().status, 'breakdown');
  assert.equal(still.flow().time, 0);
  assert.equal(physics.createFlowStepper(cells, wind, { maxIterations: 0 }).step().status, 'iterationLimit');
});

test('the memory is flat whether they are freed or collected', async () => {
  setFlagsFromString('--expose-gc');
  const collectGarbage = runInNewContext('gc');
  const sizes = [];
  for (let i = 0; i < 60; ++i) {
    const stepper = physics.createFlowStepper(cells, wind, options);
    stepper.step();
    if (i % 2) stepper.free();
    collectGarbage();
    await new Promise((resolve) => {
      setTimeout(resolve);
    });
    sizes.push(memorySize());
  }
  assert.deepEqual(new Set(sizes.slice(20)), new Set([sizes[20]]));
});

test('it outlives the twin of its cells', () => {
  const stepper = physics.createFlowStepper(cells, wind);
  for (let i = 0; i < 20; ++i) physics.cellComplex(meshes.box, cut(meshes.box, { cells: 4 }));
  assert.equal(stepper.step().status, 'converged');
});

test('with the memory of a module that failed it is gone', () => {
  const stepper = physics.createFlowStepper(cells, wind);
  failNext(new WebAssembly.RuntimeError('unreachable'));
  assert.throws(() => stepper.flow(), { code: 'internalError', stage: 'flow' });
  assert.throws(() => stepper.step(), { code: 'badArgument', stage: 'step', message: /^The flow stepper is gone/ });
  stepper.free();
  assert.equal(physics.createFlowStepper(cells, wind).step().status, 'converged');
});

async function withWorker(f) {
  const worker = await createWorker();
  try {
    await f(worker);
  } finally {
    worker.terminate();
  }
}

test('in a worker it is the same, with promises', () =>
  withWorker(async (worker) => {
    const there = await worker.createFlowStepper(cells, wind, options);
    const here = physics.createFlowStepper(cells, wind, options);
    for (let i = 0; i < 2; ++i) assert.deepEqual(await there.step(), here.step());
    assert.deepEqual(await there.flow(), here.flow());
    assert.deepEqual(await there.forces({ centre: [1, 0, 0] }), here.forces({ centre: [1, 0, 0] }));
    const start = here.flow().cellVelocity;
    await there.start(start);
    here.start(start);
    assert.deepEqual(await there.flow(), here.flow());
    assert.deepEqual(
      [(await rejection(there.start([1]))).code, (await rejection(there.forces({ center: 1 }))).code],
      ['badArgument', 'badArgument'],
    );
    assert.deepEqual((await rejection(worker.createFlowStepper(cells, wind, { courant: -1 }))).code, 'badOption');
    const last = there.step();
    there.free();
    assert.equal((await last).status, 'converged'); // it was made before
    const { code, stage, message } = await rejection(there.step());
    assert.deepEqual([code, stage, message], ['badArgument', 'step', 'The flow stepper was freed.']);
  }));

test("it works on the twins of the worker's cells", () =>
  withWorker(async (worker) => {
    const made = await worker.cellComplex(meshes.torus, await worker.cut(meshes.torus, grid));
    const stepper = await worker.createFlowStepper(gut(made), wind);
    assert.equal((await stepper.step()).status, 'converged');
  }));

test('with the thread of a call that was cancelled it is gone', () =>
  withWorker(async (worker) => {
    const stepper = await worker.createFlowStepper(cells, wind);
    await stepper.step();
    await rejection(worker.cut(meshes.torus, { cells: 99 }, { progress: () => false }));
    const { code, message } = await rejection(stepper.step());
    assert.equal(code, 'badArgument');
    assert.match(message, /^The flow stepper is gone/);
    stepper.free();
    assert.equal((await (await worker.createFlowStepper(cells, wind)).step()).status, 'converged');
  }));
