// Names that a call does not have are errors, which suggest the names that it has.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, test } from 'node:test';
import { MandolineError, init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { createWorker } from 'mandoline-wasm/physics/worker';
import { createWorker as createCutter } from 'mandoline-wasm/worker';
import { brickCalls } from '../../wasm/src/bricks/calls.js';
import { cutCalls } from '../../wasm/src/calls.js';
import { fileCalls } from '../../wasm/src/files/calls.js';
import { physicsCalls } from '../../wasm/src/physics/calls.js';
import { box } from './meshes.mjs';
import { compiler } from './types.mjs';

const three = await import('mandoline-wasm/three');
const [mandoline, physics, worker] = await Promise.all([init(), initPhysics(), createWorker()]);
after(() => worker.terminate());
const { assertCompiles, remove } = compiler();
after(remove);

const mesh = box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]);
const grid = { min: [0, 0, 0], max: [2, 2, 2], cells: [2, 2, 2] };
const cutMesh = mandoline.cut(mesh, grid);
const cells = physics.cellComplex(mesh, cutMesh);
const flow = physics.solveFlow(cells, [1, 0, 0]);
const field = { mesh, cutMesh, cells, flow };
const boundary = physics.boundaryOf(cells);
const source = new TextEncoder().encode('OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n');
const plane = { normal: [0, 0, 1], offset: 1 };
const [recutter, brickCutter] = await Promise.all([mandoline.createRecutter(grid), mandoline.createBrickCutter(mesh, grid)]);

/** Right arguments of each name. */
const given = {
  mesh,
  grid,
  cutMesh,
  cells,
  field,
  boundary,
  source,
  plane,
  normal: [0, 0, 1],
  wind: [1, 0, 0],
  offsets: [1],
  point: [1, 1, 1],
  points: [1, 1, 1],
  seeds: [1, 1, 1],
  format: 'obj',
  stack: { normal: [0, 0, 1], offsets: [], layers: [] },
  inside: 'odd',
  cellIds: [0],
  region: 0,
  count: 1,
  heat: { phi: new Float64Array(cells.cellVolume.length), timeStep: 1 },
  groups: { names: ['a'], triangleGroup: new Uint32Array(12) },
};

/** What takes an object of names: the names, and a call with that object. */
const takers = [
  ['cut, grid', ['cells', 'margin', 'min', 'max', 'origin', 'spacing', 'planes'], (object) => mandoline.cut(mesh, object)],
  [
    'inflowSeeds, grid',
    ['cells', 'margin', 'min', 'max', 'origin', 'spacing', 'planes'],
    (object) => physics.inflowSeeds(object, [1, 0, 0], 1),
  ],
  ['createRecutter, grid', ['cells', 'margin', 'min', 'max', 'origin', 'spacing', 'planes'], (object) => mandoline.createRecutter(object)],
  ['cut of a recutter', ['gridCellRegion', 'keep', 'reuse', 'progress'], (object) => recutter.cut(mesh, object)],
  ['cut of a brick cutter', ['keep', 'progress'], (object) => brickCutter.cut(0, object)],
  ['refineCells, box', ['min', 'max', 'levels'], (object) => mandoline.refineCells(mesh, cutMesh, { boxes: [object] })],
  ['refineCells, rule', ['divides', 'levels'], (object) => mandoline.refineCells(mesh, cutMesh, { rule: object })],
  [
    'refineCells, coarsening',
    ['maxLevel', 'fineLayers', 'layersPerLevel', 'balanceEdges'],
    (object) => mandoline.refineCells(mesh, cutMesh, { coarsening: object }),
  ],
  ['slice, plane', ['normal', 'offset'], (object) => mandoline.slice(cutMesh, object)],
  ['triangulate, of', ['cell', 'region'], (object) => mandoline.triangulate(cutMesh, object)],
  [
    'poissonSystem, problem',
    ['boundary', 'source', 'dualPoints', 'faceCoefficient', 'mass'],
    (object) => physics.poissonSystem(cells, object),
  ],
  [
    'solvePoisson, problem',
    ['boundary', 'source', 'dualPoints', 'faceCoefficient', 'mass'],
    (object) => physics.solvePoisson(cells, object),
  ],
  ['velocityAt, field', ['mesh', 'cutMesh', 'cells', 'flow'], (object) => physics.velocityAt({ ...field, ...object }, [])],
  [
    'boundaryOf, conditions',
    ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'],
    (object) => physics.boundaryOf(cells, object),
  ],
  ['boundaryOf, condition', ['dirichlet', 'neumann', 'robin', 'coefficient'], (object) => physics.boundaryOf(cells, { xMin: object })],
  ['init', ['wasm', 'filesWasm', 'bricksWasm', 'physicsWasm', 'thread', 'default'], init],
  ['initPhysics', ['wasm', 'filesWasm', 'bricksWasm', 'physicsWasm', 'thread', 'default'], initPhysics],
  ['createWorker', ['wasm', 'filesWasm', 'bricksWasm', 'physicsWasm', 'thread', 'threads', 'default'], createWorker],
  ['createWorker that only cuts', ['wasm', 'filesWasm', 'bricksWasm', 'physicsWasm', 'thread', 'threads', 'default'], createCutter],
  ['call', ['signal', 'transfer', 'progress'], (object) => worker.call('any', [], object)],
];
for (const [api, table] of [
  [mandoline, { ...cutCalls, ...fileCalls, ...brickCalls }],
  [physics, physicsCalls],
]) {
  for (const [name, { takes, options = {} }] of Object.entries(table)) {
    const args = Object.keys(takes).map((argument) => given[argument]);
    const own = Object.keys(options);
    takers.push([`${name}, options`, own, (object) => api[name](...args, object)]);
    takers.push([`${name} of a worker, options`, [...own, 'signal', 'transfer'], (object) => worker[name](...args, object)]);
  }
}
const drawOptions = ['cells', 'regions', 'faces', 'origin', 'explode', 'colorBy', 'measures'];
const drawn = {
  cellArrays: [mandoline.triangulate(cutMesh)],
  cellEdgeArrays: [],
  untouchedCells: [],
  cellGeometry: [mandoline.triangulate(cutMesh)],
  cellEdgeGeometry: [],
  untouchedGeometry: [],
  untouchedEdgeGeometry: [],
  sliceGeometry: [mandoline.slice(cutMesh, plane)],
};
for (const [name, args] of Object.entries(drawn)) takers.push([name, drawOptions, (object) => three[name](cutMesh, ...args, object)]);

let state = 20261123;

function random(n) {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return Math.floor((state / 2 ** 32) * n);
}

const pick = (items) => items[random(items.length)];

/** The name with a letter left out, put in or changed, or two swapped. */
function misspelt(name) {
  const i = random(name.length);
  const letter = String.fromCharCode(97 + random(26));
  const [before, after] = [name.slice(0, i), name.slice(i + 1)];
  return pick([
    before + after,
    before + letter + name[i] + after,
    before + letter + after,
    before + after.slice(0, 1) + name[i] + after.slice(1),
  ]);
}

async function failureOf(call) {
  try {
    await call();
  } catch (error) {
    return error;
  }
  return undefined;
}

test('500 misspellings, each an error that suggests the name', async () => {
  const withNames = takers.filter(([, names]) => names.length > 0);
  for (let i = 0; i < 500; ) {
    const [what, names, call] = pick(withNames);
    const name = pick(names);
    const wrong = misspelt(name);
    if (names.includes(wrong)) continue;
    const error = await failureOf(() => call({ [wrong]: undefined }));
    assert.ok(error instanceof MandolineError, `${what}, ${wrong}: ${error?.stack ?? 'no error'}`);
    assert.equal(error.code, 'badArgument', what);
    assert.match(error.message, new RegExp(` has no ${wrong}: did you mean .*\\b${name}\\b`), what);
    assert.notEqual(error.stage, '', what);
    ++i;
  }
});

test('names that are like none are told which there are', async () => {
  for (const [what, names, call] of takers) {
    const { code, message } = await failureOf(() => call({ somethingElseAltogether: 1 }));
    assert.equal(code, 'badArgument', what);
    const [, said] =
      message.match(/ has no somethingElseAltogether(?:, only (.*)|: the call takes none)\.$/) ?? assert.fail(`${what}: ${message}`);
    assert.deepEqual((said?.split(/, | and /) ?? []).sort(), [...names].sort(), what);
  }
});

test('types have these names, no more and no fewer', () => {
  const types = {
    'slice, plane': 'Plane',
    'poissonSystem, problem': 'PoissonProblem',
    'velocityAt, field': 'FlowField',
    'boundaryOf, conditions': 'Conditions',
    'refineCells, box': 'RefinementBox',
    'refineCells, rule': 'RefinementRule',
    'cut of a recutter': 'RecutOptions',
    'cut of a brick cutter': 'PieceOptions',
    call: 'ExtraCallOptions',
    cellArrays: 'DrawOptions',
  };
  const namesOf = (taker) => takers.find(([what]) => what === taker)[1].map((name) => `${name}: 0`);
  assertCompiles(`
    import type { PieceOptions, Plane, RecutOptions } from 'mandoline-wasm';
    import type { Conditions, FlowField, PoissonProblem, RefinementBox, RefinementRule } from 'mandoline-wasm/physics';
    import type { DrawOptions } from 'mandoline-wasm/three';
    import type { ExtraCallOptions } from 'mandoline-wasm/worker';
    ${Object.entries(types)
      .map(([taker, type]) => `export const of${type}: Record<keyof ${type}, 0> = { ${namesOf(taker)} };`)
      .join('\n')}`);
});

test('known names that are undefined are absent', async () => {
  const none = { progress: undefined, snapTolerance: undefined, signal: undefined, transfer: undefined };
  assert.equal((await worker.cut(mesh, { cells: 4, margin: undefined, planes: undefined }, none)).regionCount, 2);
  assert.deepEqual(physics.poissonSystem(cells, { boundary: undefined, source: undefined }), physics.poissonSystem(cells));
});

test('results that carry more are arguments', () => {
  const more = (object) => ({ ...object, mine: 1 });
  assert.ok(mandoline.measure(more(mesh), more(cutMesh)));
  assert.ok(physics.solvePoisson(more(cells), { boundary: more(boundary) }));
  assert.ok(physics.velocityAt({ mesh: more(mesh), cutMesh: more(cutMesh), cells: more(cells), flow: more(flow) }, []));
});

test('a grid is of one kind', () => {
  const refused = (wrong, message) => assert.throws(() => mandoline.cut(mesh, wrong), { code: 'badArgument', stage: 'input', message });
  refused({ ...grid, margin: 0.1 }, /^grid\.margin is not used by a grid that has min\.$/);
  refused(
    {
      cells: 8,
      planes: [
        [0, 1],
        [0, 1],
        [0, 1],
      ],
      min: [0, 0, 0],
    },
    /^grid\.min is not used by a grid that has planes\.$/,
  );
});

test('a module of the other kind is noticed by its name', async () => {
  const { message } = await failureOf(() => initPhysics({ wasm: new Uint8Array() }));
  assert.equal(message, 'options.wasm is not for this: did you mean physicsWasm?');
  assert.match((await failureOf(() => createCutter({ physicsWasm: new Uint8Array() }))).message, /did you mean wasm\?$/);
});

test('a module of another kind, or of another package, is told from the one that is needed', async () => {
  const bytesOf = (name) => readFile(new URL(import.meta.resolve(`mandoline-wasm/${name}`)));
  const another = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]);
  const cases = [
    [{ wasm: await bytesOf('physics.wasm') }, /^The WebAssembly module could not be loaded: it is physics\.wasm, not mandoline\.wasm\.$/],
    [{ wasm: await WebAssembly.compile(another) }, /: it is no module of mandoline-wasm, not mandoline\.wasm\.$/],
  ];
  for (const [options, message] of cases) {
    const error = await failureOf(() => createCutter(options));
    assert.deepEqual([error.code, error.stage], ['loadFailed', 'init']);
    assert.match(error.message, message);
  }
  const computing = await createWorker({ physicsWasm: await bytesOf('mandoline.wasm') });
  assert.match((await failureOf(() => computing.coarsen(cutMesh))).message, /: it is mandoline\.wasm, not physics\.wasm\.$/);
  computing.terminate();
  const writing = await createCutter({ filesWasm: await bytesOf('mandoline.wasm') });
  assert.match((await failureOf(() => writing.write(mesh, cutMesh, 'obj'))).message, /: it is mandoline\.wasm, not files\.wasm\.$/);
  assert.equal((await writing.cut(mesh, grid)).regionCount, 2); // the rest works
  assert.equal(await (await writing.createBrickCutter(mesh, grid)).count(), 1);
  writing.terminate();
});

/** The module without its custom sections, as some tools leave it. */
function stripped(bytes) {
  const sizeAt = (at) =>
    bytes[at] < 128 ? [bytes[at], at + 1] : sizeAt(at + 1).map((n, i) => (i === 0 ? 128 * n + (bytes[at] & 127) : n));
  const parts = [bytes.subarray(0, 8)];
  for (let at = 8; at < bytes.length; ) {
    const [size, start] = sizeAt(at + 1);
    if (bytes[at] !== 0) parts.push(bytes.subarray(at, start + size));
    at = start + size;
  }
  return Buffer.concat(parts);
}

test('modules that tools have stripped of custom sections work, and are told apart', async () => {
  const bytesOf = async (name) => stripped(await readFile(new URL(import.meta.resolve(`mandoline-wasm/${name}`))));
  const names = ['mandoline.wasm', 'files.wasm', 'bricks.wasm', 'physics.wasm'];
  const [wasm, filesWasm, bricksWasm, physicsWasm] = await Promise.all(names.map(bytesOf));
  assert.match((await failureOf(() => createCutter({ wasm: filesWasm }))).message, /: it is files\.wasm, not mandoline\.wasm\.$/);
  const computing = await createWorker({ wasm, filesWasm, bricksWasm, physicsWasm });
  const made = await computing.cut(mesh, grid);
  assert.equal((await computing.validate(mesh, made)).pass, true);
  assert.ok((await computing.cellComplex(mesh, made)).cutCells > 0);
  assert.equal(await (await computing.createBrickCutter(mesh, grid)).count(), 1);
  computing.terminate();
});

test('a worker that only cuts names the one that computes', async () => {
  const cutter = await createCutter();
  const error = await failureOf(() => cutter.coarsen(cutMesh));
  cutter.terminate();
  assert.deepEqual([error.code, error.stage], ['badArgument', 'coarsen']);
  assert.match(error.message, /mandoline-wasm\/physics\/worker/);
});

test('a call that the script does not serve', async () => {
  const error = await failureOf(() => worker.call('volumes'));
  assert.deepEqual([error.code, error.message], ['badArgument', "The worker's script serves no call volumes: it serves none."]);
});
