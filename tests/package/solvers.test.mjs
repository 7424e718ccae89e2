// Solvers and heat steppers that keep a state in the module: what solvePoisson() gives, to the bit; heat that decays as its formula does.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { createWorker } from 'mandoline-wasm/physics/worker';
import { box, torus } from './meshes.mjs';
import { rejection } from './workers.mjs';

const [{ cut }, physics] = await Promise.all([init(), initPhysics()]);
const mesh = torus(24, 12);
const cells = physics.cellComplex(mesh, cut(mesh, { cells: 12 }));
const boundary = physics.boundaryOf(cells, { xMin: { dirichlet: 1 }, surface: { robin: 0.5, coefficient: 2 } });
const source = cells.cellCentroid.filter((_, i) => i % 3 === 1);

test('a solver gives what solvePoisson() does, and takes fewer iterations from near the solution', () => {
  const solver = physics.createPoissonSolver(cells, { boundary });
  const given = { source, boundaryValue: boundary.value };
  const expected = physics.solvePoisson(cells, { boundary, source });
  assert.deepEqual(solver.solve(given), expected);
  const again = solver.solve({ ...given, start: expected.phi });
  assert.ok(again.residuals.length < expected.residuals.length / 2, `${again.residuals.length} of ${expected.residuals.length}`);
  assert.deepEqual(solver.solve(given, { corrections: 0 }), physics.solvePoisson(cells, { boundary, source }, { corrections: 0 }));
  solver.free();
  assert.throws(() => solver.solve(), { code: 'badArgument', stage: 'solve', message: 'The Poisson solver was freed.' });
});

test('what is freed while it works finishes that, and leaves the memory as it should', () => {
  const [solver, another] = [1, 2].map(() => physics.createPoissonSolver(cells, { boundary }));
  assert.deepEqual(solver.solve({ source }, { progress: () => solver.free() }), another.solve({ source }));
  assert.throws(() => solver.solve(), { code: 'badArgument', message: 'The Poisson solver was freed.' });
  const heat = { problem: { boundary }, phi: source, timeStep: 0.1 };
  const [freed, other] = [physics.createHeatStepper(cells, heat), physics.createHeatStepper(cells, heat)];
  assert.deepEqual(freed.step({ progress: () => freed.free() }), other.step());
  assert.throws(() => freed.phi(), { code: 'badArgument', message: /was freed/ });
});

test('what it is given wrong is named, and what the callback throws is thrown', () => {
  const solver = physics.createPoissonSolver(cells, { boundary });
  for (const data of [{ source: [1] }, { start: [1] }, { boundaryValue: [NaN] }, { sources: [] }, 7])
    assert.throws(() => solver.solve(data), { code: 'badArgument', stage: 'solve' });
  assert.throws(() => solver.solve({}, { tolerance: 0 }), { code: 'badOption' });
  assert.throws(() => solver.solve({ source }, { progress: () => false }), { code: 'cancelled' });
  const thrown = new Error('mine');
  const progress = () => {
    throw thrown;
  };
  assert.throws(() => solver.solve({ source }, { progress }), thrown);
  assert.equal(solver.solve({ source }).status, 'converged');
});

test('heat between two cold sides decays as its formula does', () => {
  const inside = box([0.3, 0.3, 0.3], [0.301, 0.301, 0.301]); // too small to matter
  const slab = physics.cellComplex(inside, cut(inside, { min: [0, 0, 0], max: [1, 1, 1], cells: [32, 2, 2] }));
  const wave = slab.cellCentroid.filter((_, i) => i % 3 === 0).map((x) => Math.sin(Math.PI * x));
  const conditions = physics.boundaryOf(slab, { xMin: { dirichlet: 0 }, xMax: { dirichlet: 0 } });
  const problem = { boundary: conditions, dualPoints: 'centroids' };
  const heat = physics.createHeatStepper(slab, { problem, phi: wave, timeStep: 0.01 });
  for (let i = 0; i < 10; ++i) assert.equal(heat.step(), 'converged');
  assert.ok(Math.abs(heat.time() - 0.1) < 1e-15);
  const amplitude = (phi) => phi.reduce((sum, value, c) => sum + 2 * value * wave[c] * slab.cellVolume[c], 0);
  const expected = Math.exp(-0.1 * Math.PI ** 2);
  assert.ok(Math.abs(amplitude(heat.phi()) - expected) < 0.005, `${amplitude(heat.phi())}, not ${expected}`);
  heat.setBoundaryValue(physics.boundaryOf(slab, { xMin: { dirichlet: 1 }, xMax: { dirichlet: 1 } }).value);
  heat.setSource(new Float64Array(wave.length));
  for (let i = 0; i < 200; ++i) assert.equal(heat.step(), 'converged');
  for (const c of slab.cellVolume.keys()) if (slab.cellVolume[c] > 1e-3) assert.ok(Math.abs(heat.phi()[c] - 1) < 1e-6);
  assert.throws(() => physics.createHeatStepper(slab, { phi: wave, timeStep: 0 }), { code: 'badOption' });
  assert.throws(() => physics.createHeatStepper(slab, { phi: [1], timeStep: 1 }), { code: 'badArgument' });
});

test('in a worker they are the same, with promises', async () => {
  const worker = await createWorker();
  const solver = await worker.createPoissonSolver(cells, { boundary });
  assert.deepEqual(await solver.solve({ source, boundaryValue: boundary.value }), physics.solvePoisson(cells, { boundary, source }));
  const given = { problem: { boundary }, phi: source, timeStep: 0.1 };
  const [there, here] = [await worker.createHeatStepper(cells, given), physics.createHeatStepper(cells, given)];
  assert.equal(await there.step(), here.step());
  assert.deepEqual([await there.phi(), await there.time()], [here.phi(), here.time()]);
  assert.equal((await rejection(solver.solve({ source }, { progress: () => false }))).code, 'cancelled');
  assert.match((await rejection(there.step())).message, /^The heat stepper is gone/);
  worker.terminate();
});
