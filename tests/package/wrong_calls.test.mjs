// 1,000 random calls, most of them wrong: each works or throws a MandolineError that says what was wrong with it, and none harms the
// module.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MandolineError, init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { box, gut, join, sheet, torus } from './meshes.mjs';

const mandoline = await init();
const physics = await initPhysics();

let state = 20261121;

function random(n) {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return Math.floor((state / 2 ** 32) * n);
}

const pick = (items) => items[random(items.length)];

const mesh = torus(16, 8);
const cube = box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]);
const open = sheet([0, 0], [2, 2], 0.5);
const grid = { min: [-1.5, -1.5, -0.5], max: [1.5, 1.5, 0.5], cells: [5, 5, 3] };
const cutMesh = mandoline.cut(mesh, grid);
const arraysOf = (object) => Object.keys(object).filter((key) => ArrayBuffer.isView(object[key]));

const cells = physics.cellComplex(mesh, cutMesh);
const octree = physics.coarsen(cutMesh);
const boundary = physics.boundaryOf(cells, { xMin: { dirichlet: 1 } });
const flow = physics.solveFlow(cells, [1, 2, 3]);
const flowField = { mesh, cutMesh, cells, flow };
const seeds = physics.inflowSeeds(grid, [1, 2, 3], 20);

const info = mandoline.inspect(open);
const lines = { points: new Float64Array(12), offsets: new Uint32Array([0, 2, 4]) };

const prepared = mandoline.prepare(mesh);
const layers = mandoline.outlines(cutMesh, [0, 0, 1], [0]);
const dump = await mandoline.write(mesh, cutMesh, 'mcm');
const resolved = mandoline.resolve(join(box([1, 1, 1], [3, 3, 3]), box([2, 2, 2], [4, 4, 4])));
const boundaryArrays = ['positions', 'triangles', 'frontWinding', 'backWinding'];

/** A copy with some entries of one of these arrays changed, or the array replaced. */
function damaged(original, keys = arraysOf(original)) {
  const key = pick(keys);
  const array = original[key].slice();
  for (let i = 0; i < 3 && array.length > 0; ++i) array[random(array.length)] = pick([0, 1, -1, 7, 1000, 2 ** 31 - 1, 2 ** 32 - 1, NaN]);
  return { ...original, [key]: pick([array, array, array, array.subarray(1), new Float32Array(array), [...array], null, undefined]) };
}

const scalars = [undefined, null, 0, -1, 0.5, NaN, Infinity, 2 ** 31, 2 ** 40, true, '', 'json', 10n, Symbol.iterator, () => 1];
function outOfBounds() {
  const buffer = new ArrayBuffer(24, { maxByteLength: 24 });
  const array = new Float64Array(buffer, 0, 3);
  buffer.resize(8);
  return array;
}

const objects = [
  () => ({}),
  () => [],
  () => [1, 2],
  () => [0, 1, 2],
  () => new Float64Array(3),
  () => gut({ array: new Float64Array(6) }).array,
  () => new Map(),
  () => new Proxy({}, { get: () => 7 }),
  () => new Date(0),
  () => Object.create(null),
  () => new ArrayBuffer(8),
  () => ({ length: 2 ** 31 }),
  outOfBounds,
];
const anything = () => (random(2) ? pick(scalars) : pick(objects)());

/** Values that are right, or nearly so, for each kind of argument. */
const kinds = {
  mesh: () =>
    pick([
      mesh,
      mesh,
      mesh,
      cube,
      open,
      prepared,
      resolved,
      { ...prepared },
      { ...mesh, positions: mesh.positions.slice(3) },
      { ...mesh, triangles: mesh.triangles.slice(0, 9) },
      { ...mesh, positions: mesh.positions.map((x, i) => (i === random(90) ? NaN : x)) },
      { positions: anything(), triangles: mesh.triangles },
      { positions: mesh.positions, triangles: anything() },
    ]),
  cutMesh: () =>
    pick([
      () => cutMesh,
      () => cutMesh,
      () => ({ ...cutMesh }),
      () => mandoline.cut(mesh, grid, { keep: false }),
      () => damaged(cutMesh),
      () => damaged(cutMesh),
      () => gut(mandoline.cut(mesh, grid)),
      () => mandoline.cut(open, grid),
      () => prepared,
      () => ({ ...cutMesh, grid: anything() }),
      () => ({ ...cutMesh, regionCount: anything() }),
    ])(),
  solid: () =>
    pick([
      () => resolved,
      () => mandoline.resolve(open),
      () => damaged(resolved, boundaryArrays),
      () => damaged(resolved, boundaryArrays),
      kinds.cutMesh,
      kinds.cutMesh,
      kinds.mesh,
    ])(),
  inside: () => pick([undefined, 'positive', 'nonZero', 'odd', 'nonzero', [true, false], new Uint8Array(random(4)), anything()]),
  grid: () =>
    pick([
      grid,
      { cells: 4 },
      { cells: anything() },
      { ...grid, cells: anything() },
      { ...grid, min: anything() },
      { planes: anything() },
      {
        planes: [
          [0, 1],
          [1, 0],
          [0, 1],
        ],
      },
      { origin: [0, 0, 0], spacing: [1, anything(), 1], cells: [2, 2, 2] },
      cutMesh.grid,
    ]),
  options: () =>
    pick([
      undefined,
      {},
      { snapTolerance: anything() },
      { intersections: anything() },
      { maxPairs: anything() },
      { rule: pick(['odd', anything()]) },
      { threshold: pick([0.5, 1, anything()]) },
      { progress: anything() },
      { progress: () => pick([true, false, undefined]) },
      { keep: anything() },
      { gridCellRegion: anything() },
      { untouched: anything() },
      { regions: anything() },
      { groups: anything() },
      { groups: { names: ['a'], triangleGroup: new Uint32Array(random(300)) } },
      { name: anything() },
    ]),
  of: () =>
    pick([undefined, { cell: random(60) }, { region: random(3) }, { cell: anything() }, { region: anything() }, { cell: 1, region: 1 }]),
  drawing: () =>
    pick([
      undefined,
      {},
      { origin: [1, 2, 3] },
      { origin: anything() },
      { reuse: [] },
      { origin: [0, 0, 0], reuse: [new ArrayBuffer(100)] },
      { reuse: [new ArrayBuffer(random(9000)), new ArrayBuffer(0)] },
      { reuse: [anything()] },
      { reuse: anything() },
    ]),
  point: () =>
    pick([
      [0, 0, 0],
      [1, 0.1, 0],
      [1e300, 0, 0],
      [NaN, 0, 0],
      [0, anything(), 0],
    ]),
  points: () => pick([[0, 0, 0, 1, 0, 0], new Float32Array(9), [0, 0], [Infinity, -Infinity, NaN], [anything()]]),
  plane: () =>
    pick([
      { normal: [0, 0, 1], offset: 0 },
      { normal: [1, 2, 3], offset: 1e-300 },
      { normal: [0, 0, 0], offset: 0 },
      { normal: [1e300, 1e-300, 0], offset: 1e300 },
      { normal: anything(), offset: 0 },
      { normal: [0, 1, 0], offset: anything() },
    ]),
  vector: () => pick([[0, 0, 1], [1, 2, 3], [0, 0, 0], [NaN, 0, 1], anything()]),
  offsets: () => pick([[0, 0.1], [], new Float32Array(2), [NaN], [anything()], anything()]),
  format: () => pick(['json', 'mcm', 'vtu', 'obj', 'stl', 'ply', 'svg', 'off', anything()]),
  info: () => pick([info, damaged(info), damaged(info), anything()]),
  lines: () => pick([lines, damaged(lines), { points: [0, 0, 0], offsets: anything() }, anything()]),
  written: () =>
    pick([undefined, {}, { untouched: false }, { fields: { phi: flow.phi } }, { fields: { phi: anything() } }, { regions: anything() }]),
  stack: () =>
    pick([
      { normal: [0, 0, 1], offsets: [0], layers },
      { normal: [0, 0, 1], offsets: [0, 1], layers },
      { normal: anything(), offsets: [0], layers },
      { normal: [0, 0, 1], offsets: [0], layers: [damaged(layers[0])] },
      { normal: [0, 0, 1], offsets: [0], layers: anything() },
      anything(),
    ]),
  cells: () =>
    pick([
      () => cells,
      () => cells,
      () => ({ ...cells }),
      () => damaged(cells),
      () => damaged(cells),
      () => gut(physics.cellComplex(mesh, cutMesh)),
      () => physics.regionComplex(cells, 0).cells,
      () => physics.mergeSmallCells(cutMesh, cells).cells,
      () => damaged(physics.mergeSmallCells(cutMesh, cells).cells),
      () => physics.uniteWalls(cutMesh, cells),
      () => ({ ...cells, cutFaces: anything() }),
      () => cutMesh,
      () => octree,
    ])(),
  octree: () => pick([() => octree, () => undefined, () => damaged(octree), () => ({ ...octree, gridCells: anything() }), anything])(),
  coarsening: () =>
    pick([
      undefined,
      { maxLevel: 1 },
      { maxLevel: anything() },
      { fineLayers: anything() },
      { layersPerLevel: anything() },
      { balanceEdges: anything() },
    ]),
  refining: () =>
    pick([
      undefined,
      { levels: 1 },
      { levels: 1, angle: anything() },
      { layers: anything() },
      { boxes: [{ min: [0, 0, 0], max: [1, 1, 1], levels: 1 }] },
      { boxes: [{ min: anything(), max: [1, 1, 1], levels: 1 }] },
      { boxes: [anything()] },
      { boxes: anything() },
      { rule: { divides: () => pick([true, false]), levels: 1 } },
      { rule: { divides: anything, levels: 1 } },
      { rule: { divides: () => false, levels: anything() } },
      { rule: anything() },
      { coarsening: { maxLevel: anything() } },
      { coarsening: anything() },
      { intersections: anything() },
    ]),
  merging: () => pick([undefined, { fraction: 0.3 }, { fraction: 2 }, { fraction: anything() }]),
  uniting: () => pick([undefined, { angle: 10 }, { angle: 1000 }, { angle: anything() }, { groups: anything() }]),
  ids: () => pick([[], [1, 2], [2, 2], [1e5], new Uint32Array([3]), [anything()]]),
  region: () => pick([0, 1, 99, anything()]),
  operators: () => pick([undefined, { only: ['gradient'] }, { only: [anything()] }, { only: anything() }, { dualPoints: anything() }]),
  conditions: () =>
    pick([
      undefined,
      {},
      { xMin: { dirichlet: 1 } },
      { surface: { neumann: anything() } },
      { surface: { robin: 1, coefficient: pick([2, -1, anything()]) } },
      { [pick(['yMax', 'left'])]: anything() },
      anything(),
    ]),
  boundary: () =>
    pick([() => boundary, () => damaged(boundary), () => physics.boundaryOf(physics.regionComplex(cells, 0).cells), anything])(),
  problem: () =>
    pick([
      () => undefined,
      () => ({ boundary }),
      () => ({ boundary: damaged(boundary) }),
      () => ({ source: cells.cellVolume }),
      () => ({ source: anything() }),
      () => ({ mass: cells.cellVolume, faceCoefficient: cells.faceArea }),
      () => ({ [pick(['mass', 'faceCoefficient'])]: anything() }),
      () => ({ dualPoints: anything() }),
      () => ({ boundary: anything() }),
    ])(),
  solving: () =>
    pick([
      undefined,
      { balance: true },
      { balance: anything() },
      { tolerance: anything() },
      { maxIterations: anything() },
      { freeConstant: anything() },
      { progress: () => pick([true, false]) },
    ]),
  field: () =>
    pick([
      () => flowField,
      () => flowField,
      () => ({ ...flowField, mesh: kinds.mesh() }),
      () => ({ ...flowField, cutMesh: kinds.cutMesh() }),
      () => ({ ...flowField, cells: kinds.cells() }),
      () => ({ ...flowField, cells: damaged(cells, ['cellCorner', 'cellLevel', 'faceCells']) }),
      () => ({ ...flowField, flow: damaged(flow) }),
      () => ({ ...flowField, [pick(['mesh', 'cutMesh', 'cells', 'flow'])]: anything() }),
    ])(),
  stepping: () => pick([undefined, { viscosity: pick([0.1, anything()]) }, { timeStep: anything() }, { courant: anything() }, anything()]),
  heat: () =>
    pick([
      { phi: cells.cellVolume, timeStep: 0.1 },
      { problem: anything(), phi: cells.cellVolume, timeStep: 0.1 },
      { phi: anything(), timeStep: anything() },
      anything(),
    ]),
  groups: () => pick([{ names: ['a'], triangleGroup: new Uint32Array(random(300)) }, { names: [], triangleGroup: anything() }, anything()]),
  seeds: () => pick([seeds, seeds, [0, 0, 0, 9, 9, 9], [0, NaN, Infinity], [], [1, 2], anything()]),
  following: () =>
    pick([
      undefined,
      { upstream: true },
      { upstream: anything() },
      { tolerance: anything() },
      { maxLength: anything() },
      { maxPoints: anything() },
      { progress: () => pick([true, false]) },
    ]),
  brick: () => pick([0, 1, 2, 3, 99, anything()]),
  bricks: () =>
    pick([undefined, { cells: pick([4, 5, anything()]) }, { untouched: pick([true, anything()]) }, { intersections: anything() }]),
  count: () => pick([0, 1, 20, anything()]),
  file: () =>
    pick([
      new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'),
      new Blob(['OFF\n1 1 0\n']),
      dump,
      dump.map((byte, i) => (i === random(dump.length) ? 255 - byte : byte)),
      new Uint8Array([31, 139, 8, 0, 1]),
      anything(),
    ]),
};

const parameters = {
  cut: ['mesh', 'grid', 'options'],
  validate: ['mesh', 'cutMesh', 'options'],
  measure: ['mesh', 'cutMesh', 'options'],
  prepare: ['mesh', 'options'],
  findIntersections: ['mesh', 'options'],
  inspect: ['mesh'],
  orient: ['mesh', 'options'],
  resolve: ['mesh', 'options'],
  boundary: ['solid', 'inside'],
  insideRegions: ['cutMesh', 'options'],
  estimateInside: ['mesh', 'cutMesh', 'options'],
  generalizedWindingNumbers: ['mesh', 'points', 'options'],
  cutEdges: ['mesh', 'cutMesh'],
  adjacency: ['cutMesh'],
  triangulate: ['cutMesh', 'of'],
  cellDrawing: ['mesh', 'cutMesh', 'drawing'],
  cellAt: ['cutMesh', 'point'],
  cellsAt: ['cutMesh', 'points'],
  slice: ['cutMesh', 'plane', 'options'],
  slices: ['cutMesh', 'vector', 'offsets', 'options'],
  outlines: ['cutMesh', 'vector', 'offsets'],
  write: ['mesh', 'cutMesh', 'format', 'options'],
  writeMesh: ['mesh', 'format', 'options'],
  writeOutlines: ['stack', 'format', 'options'],
  writeDefects: ['mesh', 'info', 'options'],
  writeLines: ['lines', 'options'],
  readMesh: ['file', 'options'],
  readGroups: ['file', 'options'],
  readCutMesh: ['file', 'options'],
  createRecutter: ['grid', 'options'],
  recut: ['mesh', 'options'],
  counts: [],
  cutBrick: ['brick', 'options'],
  firstOfBrick: ['brick'],
  createBrickCutter: ['mesh', 'grid', 'bricks'],
  refineCells: ['mesh', 'cutMesh', 'refining'],
  coarsen: ['cutMesh', 'coarsening'],
  cellComplex: ['mesh', 'cutMesh', 'octree', 'options'],
  mergeSmallCells: ['cutMesh', 'cells', 'merging'],
  uniteWalls: ['cutMesh', 'cells', 'uniting'],
  subComplex: ['cells', 'ids'],
  regionComplex: ['cells', 'region'],
  createPoissonSolver: ['cells', 'problem'],
  createHeatStepper: ['cells', 'heat'],
  createFlowStepper: ['cells', 'vector', 'stepping'],
  faceGroups: ['cutMesh', 'cells', 'groups'],
  complexEdges: ['cells'],
  operators: ['cells', 'operators'],
  boundaryOf: ['cells', 'conditions'],
  outwardNormals: ['boundary', 'cells'],
  cellComponents: ['cells'],
  poissonSystem: ['cells', 'problem'],
  solvePoisson: ['cells', 'problem', 'solving'],
  solveFlow: ['cells', 'vector', 'solving'],
  velocityAt: ['field', 'seeds'],
  streamlines: ['field', 'seeds', 'following'],
  inflowSeeds: ['grid', 'vector', 'count'],
  writeCells: ['cutMesh', 'cells', 'format', 'written'],
  writeFaces: ['cutMesh', 'cells', 'written'],
  writePolyMesh: ['cutMesh', 'cells', 'written'],
};

/** Calls one of these at random, 1,200 times. Gives how many calls were fine, and how many had each code. */
async function callAtRandom(calls) {
  const names = Object.keys(calls).filter((name) => typeof calls[name] === 'function');
  for (const name of names) assert.ok(parameters[name], `${name} is not tried`);
  const counts = { fine: 0 };
  for (let i = 0; i < 1200; ++i) {
    const name = pick(names);
    const args = parameters[name].map((kind) => (random(6) ? kinds[kind]() : anything()));
    try {
      await calls[name](...args);
      ++counts.fine;
    } catch (error) {
      assert.ok(error instanceof MandolineError, `call ${i}, ${name}: ${error?.stack ?? error}`);
      assert.notEqual(error.code, 'internalError', `call ${i}, ${name}: ${error.message} ${error.cause?.stack}`);
      assert.match(error.message, /^\S.*[^.]\.$/s, `call ${i}, ${name}`);
      counts[error.code] = (counts[error.code] ?? 0) + 1;
    }
  }
  assert.ok(counts.fine > 100 && counts.badArgument > 100, JSON.stringify(counts));
  return counts;
}

test('1,200 random calls', async (t) => {
  t.diagnostic(JSON.stringify(await callAtRandom(mandoline)));
  assert.equal((await mandoline.validate(mesh, cutMesh)).pass, true);
});

test('1,200 random calls of objects that cut', async (t) => {
  const [recutter, cutter] = [await mandoline.createRecutter(grid), await mandoline.createBrickCutter(mesh, grid, { cells: 2 })];
  t.diagnostic(
    JSON.stringify(
      await callAtRandom({
        recut: recutter.cut,
        counts: recutter.counts,
        cutBrick: cutter.cut,
        firstOfBrick: cutter.first,
      }),
    ),
  );
  const { stats: _, ...expected } = cutMesh;
  const { stats: __, ...found } = recutter.cut(mesh);
  assert.deepEqual(found, expected);
});

test('1,200 random calls that compute', async (t) => {
  t.diagnostic(JSON.stringify(await callAtRandom(physics)));
  assert.equal(physics.solvePoisson(cells, { boundary, source: cells.cellVolume }, { balance: true }).status, 'converged');
});
