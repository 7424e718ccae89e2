// Cells of several sizes: what refineCells() gives, here and in a worker, and what calls of mandoline-wasm/physics make of it.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Worker as NodeWorker } from 'node:worker_threads';
import { init } from 'mandoline-wasm';
import { initPhysics, streamlineEnds } from 'mandoline-wasm/physics';
import { createWorker } from 'mandoline-wasm/physics/worker';
import { gut, torus } from './meshes.mjs';
import { rejection } from './workers.mjs';

const [mandoline, physics] = await Promise.all([init(), initPhysics()]);
const { cut, refineCells } = mandoline;

const mesh = torus(40, 20);
const grid = { min: [-1.7, -1.6, -0.9], max: [1.7, 1.6, 0.9], cells: [13, 12, 7] };
const box3 = 3.4 * 3.2 * 1.8;
const cutMesh = cut(mesh, grid);
const cells = physics.cellComplex(mesh, cutMesh);
const cellCount = ({ cellRegion }) => cellRegion.length;

/** Divides grid cells in the half x < 0, but none of what they are divided into. */
const rule = { divides: (_, [x], depth) => depth === 0 && x < 0, levels: 1 };

test('cells fill the box, with the regions of the cut-mesh', async () => {
  const { cells: refined, cutMesh: ofRefined, levels } = await refineCells(mesh, cutMesh, { levels: 1, angle: 20 });
  assert.equal(levels, 1);
  assert.ok(refined.cutCells > cells.cutCells && refined.cutCells === cellCount(ofRefined));
  assert.deepEqual(new Set(refined.cellLevel), new Set([0, 1]));
  const volumes = new Float64Array(cutMesh.regionCount);
  refined.cellVolume.forEach((volume, cell) => {
    volumes[refined.cellRegion[cell]] += volume;
  });
  mandoline.measure(mesh, cutMesh).regionVolume.forEach((volume, region) => {
    assert.ok(Math.abs(volumes[region] - volume) < 1e-12 * box3);
  });
});

test('options', async () => {
  const refined = async (options) => (await refineCells(mesh, cutMesh, options)).cells;
  const volumesOf = ({ cellVolume }) => Float64Array.from(cellVolume).sort();
  assert.deepEqual(volumesOf(await refined()), volumesOf(cells));
  assert.ok(cellCount(await refined({ coarsening: { maxLevel: 24 } })) < cellCount(cells));
  assert.ok(cellCount(await refined({ levels: 1, angle: 20, layers: 4 })) > cellCount(await refined({ levels: 1, angle: 20 })));
  const { min, max } = grid;
  const everywhere = await refined({ boxes: [{ min, max, levels: 1 }] });
  const uniform = physics.cellComplex(mesh, cut(mesh, { min, max, cells: [26, 24, 14] }));
  assert.deepEqual(volumesOf(everywhere), volumesOf(uniform));
  const halves = await refined({ rule: { divides: () => true, levels: 1 } });
  for (const name of ['positions', 'loopVertices', 'cellVolume']) assert.deepEqual(halves[name], everywhere[name], name);
});

test('a rule is asked of all grid cells and of what it divides', async () => {
  const asked = [];
  const divides = (...given) => {
    asked.push(given);
    return rule.divides(...given);
  };
  const { cells: refined } = await refineCells(mesh, cutMesh, { rule: { divides, levels: 2 } });
  const [x, y, z] = cutMesh.grid.planes;
  const [first] = asked;
  assert.deepEqual(first, [[x[0], y[0], z[0]], [x[1], y[1], z[1]], 0]);
  assert.equal(asked.filter(([, , depth]) => depth === 0).length, 13 * 12 * 7);
  const divided = asked.filter((given) => rule.divides(...given)).length;
  assert.equal(asked.length, 13 * 12 * 7 + 8 * divided);
  refined.cellCentre.forEach((centre, i) => {
    if (i % 3 === 0) assert.equal(refined.cellLevel[i / 3], centre < x[6] ? 1 : 2);
  });
});

test('what a rule throws is thrown by the call, and it has to answer', async () => {
  const asks = (divides) => refineCells(mesh, cutMesh, { rule: { divides, levels: 1 } });
  const fault = new Error('No way.');
  await assert.rejects(
    asks(() => {
      throw fault;
    }),
    (error) => error === fault,
  );
  for (const answer of [undefined, 1, Promise.resolve(true)]) {
    const { code, stage, message } = await rejection(asks(() => answer));
    assert.deepEqual([code, stage], ['badArgument', 'refineCells']);
    assert.match(message, /^options\.rule\.divides must give true or false, not /);
  }
  assert.ok((await refineCells(mesh, cutMesh, { rule })).levels === 1);
});

test('what calls of mandoline-wasm/physics make of it', async () => {
  const { cells: refined, cutMesh: ofRefined } = await refineCells(mesh, cutMesh, { levels: 1, angle: 20 });
  const { cells: merged } = physics.mergeSmallCells(ofRefined, refined);
  const united = physics.uniteWalls(ofRefined, merged);
  assert.equal(physics.solveFlow(united, [1, 0, 0]).status, 'converged');
  assert.ok(physics.writeCells(ofRefined, united, 'vtu').length > 1000);
  const flow = physics.solveFlow(merged, [1, 0, 0]);
  const lines = physics.streamlines({ mesh, cutMesh: ofRefined, cells: merged, flow }, physics.inflowSeeds(ofRefined.grid, [1, 0, 0], 30));
  assert.ok(lines.ends.filter((end) => streamlineEnds[end] === 'side').length > 20);
  const { count } = physics.cellComponents(refined);
  assert.equal(physics.cellComponents(gut(refined)).count, count); // by the twin that the first call kept
});

test('calls that need a cut of the grid refuse that of refined cells', async () => {
  const { cells: refined, cutMesh: ofRefined } = await refineCells(mesh, cutMesh, { levels: 1 });
  const refused = { code: 'badArgument' };
  assert.throws(() => physics.coarsen(ofRefined), { ...refused, message: /that of refined cells/ });
  assert.throws(() => physics.cellComplex(mesh, ofRefined), { ...refused, message: /that of refined cells/ });
  assert.throws(() => mandoline.measure(mesh, ofRefined), refused);
  assert.throws(() => mandoline.measure(mesh, refined), { ...refused, message: /not what cellComplex\(\), refineCells\(\)/ });
  const damaged = { ...ofRefined, faceTriangle: ofRefined.faceTriangle.map((triangle) => triangle + 1e6) };
  assert.throws(() => physics.uniteWalls(damaged, refined), { ...refused, message: /don't fit together/ });
  await assert.rejects(refineCells(mesh, ofRefined), refused);
});

test('what is refused', async () => {
  const refuses = async (options, code) => {
    const error = await rejection(refineCells(mesh, cutMesh, options));
    assert.deepEqual([error.code, error.stage], [code, 'refineCells'], `${JSON.stringify(options)}: ${error.message}`);
    return error;
  };
  const ruled = (levels) => ({ rule: { divides: () => false, levels } });
  for (const options of [{ levels: -1 }, { levels: 25 }, { angle: 181 }, { layers: 0 }, ruled(0), ruled(25)]) {
    await refuses(options, 'badOption');
  }
  await refuses({ boxes: [{ min: [0, 0, 0], max: [1, 0, 1], levels: 1 }] }, 'badOption');
  await refuses({ boxes: {} }, 'badArgument');
  await refuses({ boxes: [{ min: [0, 0, 0], max: [1, 1, 1], level: 1 }] }, 'badArgument');
  assert.match(
    (await refuses({ rule: { levels: 1 } }, 'badArgument')).message,
    /^options\.rule\.divides must be a function, not undefined\.$/,
  );
  await refuses({ coarsening: { maxLevel: -1 } }, 'badOption');
  await refuses({ coarsening: { progress: () => true } }, 'badArgument');
  await refuses({ levels: 22 }, 'gridTooLarge');
  await refuses({ progress: () => false }, 'cancelled');
  const other = { ...mesh, positions: mesh.positions.map((x) => 2 * x) };
  const { code, message } = await rejection(refineCells(other, cutMesh));
  assert.deepEqual([code, message.includes('not made from this mesh')], ['badArgument', true], message);
});

test('the same in a worker, where calls keep the cells once they were sent', async () => {
  const sent = [];
  const thread = () => {
    const started = new NodeWorker(new URL(import.meta.resolve('mandoline-wasm/physics/worker-thread')));
    const post = started.postMessage.bind(started);
    started.postMessage = (message, transfer) => {
      const kinds = (message.subjects ?? []).filter(({ data }) => data !== undefined).map(({ origin }) => origin.kind);
      if (message.call) sent.push([message.call, ...kinds]);
      post(message, transfer);
    };
    return started;
  };
  const worker = await createWorker({ thread });
  try {
    const there = await worker.cut(mesh, grid);
    const options = { levels: 1, angle: 20, boxes: [{ min: [0, 0, 0], max: [1, 1, 1], levels: 1 }] };
    const refined = await worker.refineCells(mesh, gut(there), options);
    assert.deepEqual(refined, await refineCells(mesh, cutMesh, options));
    const count = cellCount(refined.cells);
    assert.deepEqual(await worker.solveFlow(refined.cells, [1, 0, 0]), physics.solveFlow(refined.cells, [1, 0, 0]));
    const { cells: merged } = await worker.mergeSmallCells(refined.cutMesh, gut(refined.cells));
    assert.ok(cellCount(merged) < count);
    assert.deepEqual(sent, [['cut'], ['refineCells'], ['solveFlow', 'cells'], ['mergeSmallCells']]);
    const { code, message } = await rejection(worker.refineCells(mesh, there, { rule }));
    assert.equal(code, 'badArgument');
    assert.match(message, /^The arguments can't be given to the worker: .*could not be cloned\.$/s);
  } finally {
    worker.terminate();
  }
});
