// The types against the module: real results, written as literals, must fit their declarations with no key missing or left
// over.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join as path } from 'node:path';
import { after, test } from 'node:test';
import * as index from 'mandoline-wasm';
import * as physicsEntry from 'mandoline-wasm/physics';
import { root } from './environments.mjs';
import { box, join, sheet } from './meshes.mjs';
import { compiler } from './types.mjs';

const { compile, assertCompiles, remove } = compiler();
after(remove);

/** A value as an expression that shows its shape and its kinds of numbers; arrays are left empty. */
function literal(value) {
  if (ArrayBuffer.isView(value)) return `new ${value[Symbol.toStringTag]}()`;
  if (Array.isArray(value)) return `[${value.map(literal).join(', ')}]`;
  if (typeof value !== 'object' || value === null) return JSON.stringify(value);
  return `{ ${Object.entries(value)
    .map(([key, item]) => `${key}: ${literal(item)}`)
    .join(', ')} }`;
}

/** The kind of each key. */
const kinds = (object) => JSON.stringify(Object.fromEntries(Object.entries(object).map(([key, value]) => [key, typeof value])));

const mandoline = await index.init();
const mesh = box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]);
const states = [];
const cutMesh = mandoline.cut(
  mesh,
  { cells: 3 },
  {
    progress: (state) => {
      states.push(state);
    },
  },
);
const open = mandoline.cut(
  sheet([0, 0], [1, 1], 0.5),
  {
    planes: [
      [0, 1],
      [0, 1],
      [0, 1],
    ],
  },
  { gridCellRegion: false },
);

const physics = await physicsEntry.initPhysics();
const cells = physics.cellComplex(mesh, cutMesh);

/** Declarations of values, with the types of an entry. */
function declared(results, entry) {
  const checks = results.map(([type, value], i) => `export const result${i}: ${type} = ${literal(value)};`);
  const names = new Set(results.flatMap(([type]) => type.match(/\w+/g)).filter((name) => !/^(null|number|\w*Array)$/.test(name)));
  const types = `import type { ${[...names].join(', ')} } from '${entry}';`;
  return { types, text: [types, ...checks].join('\n') };
}

test('interfaces of results are as the C++ headers have them', () => {
  execFileSync(process.execPath, [path(root, 'wasm', 'results.mjs'), '--check']);
});

test('results', async () => {
  const recutter = await mandoline.createRecutter(cutMesh.grid);
  const cutter = await mandoline.createBrickCutter(mesh, { cells: 3 });
  const results = [
    ['CutMesh', cutMesh],
    ['CutMesh', open],
    ['Progress', states[0]],
    ['Progress', states.at(-1)],
    ['CutMesh', recutter.cut(mesh)],
    ['RecutCounts', recutter.counts()],
    ['[number, number, number]', cutter.first(0)],
    ['CutPiece', cutter.cut(0)],
    ['MeshArrays', mandoline.prepare(mesh)],
    ['MeshIntersections', mandoline.findIntersections(mesh)],
    ['MeshInfo', mandoline.inspect(mesh)],
    ['OrientedMesh', mandoline.orient(mesh)],
    ['ResolvedMesh', mandoline.resolve(mesh)],
    ['ResolvedMesh', mandoline.resolve(sheet([0, 0], [1, 1], 0.5))],
    ['MeshArrays', mandoline.boundary(cutMesh)],
    ['MeshArrays', mandoline.boundary(cutMesh, new Uint8Array(cutMesh.regionCount))],
    ['InsideRegions', mandoline.insideRegions(cutMesh)],
    ['CutMeshArrays', mandoline.estimateInside(sheet([0, 0], [1, 1], 0.5), open)],
    ['Float64Array', mandoline.generalizedWindingNumbers(mesh, [1, 1, 1])],
    ['Measures', mandoline.measure(mesh, cutMesh)],
    ['CutEdges', mandoline.cutEdges(mesh, cutMesh)],
    ['Adjacency', mandoline.adjacency(cutMesh)],
    ['FaceTriangles', mandoline.triangulate(cutMesh)],
    ['Uint32Array', mandoline.triangulate(cutMesh, { cell: 0 })],
    ['Uint32Array', mandoline.triangulate(cutMesh, { region: 0 })],
    ['Validation', await mandoline.validate(mesh, cutMesh)],
    ['Locations', mandoline.cellsAt(cutMesh, [1, 1, 1])],
    ['Location | null', mandoline.cellAt(cutMesh, [1, 1, 1])],
    ['Slice', mandoline.slice(cutMesh, { normal: [0, 0, 1], offset: 1 })],
    ['Slice[]', mandoline.slices(cutMesh, [0, 0, 1], [1])],
    ['Outlines[]', mandoline.outlines(cutMesh, [0, 0, 1], [1])],
    ['Uint8Array', await mandoline.write(mesh, cutMesh, 'obj')],
    ['CutMeshArrays', await mandoline.readCutMesh(await mandoline.write(mesh, cutMesh, 'mcm'))],
    ['TriangleGroups', await mandoline.readGroups(new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1 2 3\n'))],
  ];
  const { types, text } = declared(results, 'mandoline-wasm');
  assertCompiles(text);
  assert.throws(() => compile(`${types}\nexport const wrong: CutEdges = ${literal({ edgeVertices: new Uint32Array() })};`));
  assertCompiles(`
    import type { CutMesh, Mandoline, Mesh } from 'mandoline-wasm';
    import type { MandolineWorker } from 'mandoline-wasm/worker';
    export async function use(mandoline: Mandoline, worker: MandolineWorker, mesh: Mesh): Promise<CutMesh[]> {
      const grid = { min: [0, 0, 0], max: [1, 1, 1], cells: [9, 9, 9] };
      using recutter = await mandoline.createRecutter(grid, { snapTolerance: 0.1, intersections: 'refuse' });
      const there = await worker.createRecutter(grid, { signal: AbortSignal.timeout(9) });
      // @ts-expect-error: around what?
      mandoline.createRecutter({ cells: 9 });
      const cutter = await worker.createBrickCutter(mesh, { cells: 9 }, { cells: 8, untouched: true });
      for (let brick = 0; brick < (await cutter.count()); ++brick) {
        const { cutMesh, mesh: near } = await cutter.cut(brick, { keep: false, progress: () => true });
        // @ts-expect-error: no such option
        await cutter.cut(brick, { kept: false, signal: AbortSignal.timeout(9) });
        console.log(await worker.measure(near, cutMesh));
      }
      cutter.free();
      return [recutter.cut(mesh, { reuse: [] }), await there.cut(mesh, { gridCellRegion: false, signal: AbortSignal.timeout(9), transfer: [] })];
    }`);
});

test('results of mandoline-wasm/physics', async () => {
  const boundary = physics.boundaryOf(cells, { xMin: { dirichlet: 0 } });
  const flow = physics.solveFlow(cells, [1, 0, 0]);
  const stepper = physics.createFlowStepper(cells, [1, 0, 0]);
  const heat = physics.createHeatStepper(cells, { problem: { boundary }, phi: cells.cellVolume, timeStep: 0.1 });
  const results = [
    ['OctreeCells', physics.coarsen(cutMesh)],
    ['CellComplex', cells],
    ['RefinedCells', await mandoline.refineCells(mesh, cutMesh, { levels: 1 })],
    ['MergedCells', physics.mergeSmallCells(cutMesh, cells)],
    ['SubComplex', physics.regionComplex(cells, 0)],
    ['SubComplex', physics.subComplex(cells, [0])],
    ['ComplexEdges', physics.complexEdges(cells)],
    ['Operators', physics.operators(cells)],
    ['Boundary', boundary],
    ['Float64Array', physics.outwardNormals(boundary, cells)],
    ['CellComponents', physics.cellComponents(cells)],
    ['PoissonSystem', physics.poissonSystem(cells, { boundary })],
    ['Flow', flow],
    ['Solution', physics.createPoissonSolver(cells, { boundary }).solve({ source: cells.cellVolume })],
    ['SolveStatus', heat.step()],
    ['Float64Array', heat.phi()],
    ['FlowStep', stepper.step()],
    ['UnsteadyFlow', stepper.flow()],
    ['SurfaceForce[]', stepper.forces()],
    ['Float64Array', physics.velocityAt({ mesh, cutMesh, cells, flow }, [1, 1, 1])],
    ['Streamlines', physics.streamlines({ mesh, cutMesh, cells, flow }, [1, 1, 1])],
    ['Float64Array', physics.inflowSeeds(cutMesh.grid, [1, 0, 0], 3)],
    ['Solution', physics.solvePoisson(cells, { boundary, source: cells.cellVolume })],
  ];
  assertCompiles(declared(results, 'mandoline-wasm/physics').text);
  assertCompiles(`
    import { type CellComplex, type FlowField, type Operators, type Physics, faceTags, streamlineEnds } from 'mandoline-wasm/physics';
    import type { PhysicsWorker } from 'mandoline-wasm/physics/worker';
    export async function use(physics: Physics, worker: PhysicsWorker, cells: CellComplex): Promise<number | undefined> {
      const { gradient } = physics.operators(cells, { only: ['gradient', 'laplacian'], dualPoints: 'centroids' });
      // @ts-expect-error: was not asked for
      physics.operators(cells, { only: ['gradient'] }).divergence;
      const every: Operators = physics.operators(cells, { dualPoints: 'centroids' });
      const names = Object.keys(every) as (keyof Operators)[];
      const some: Partial<Operators> = await worker.operators(cells, { only: names });
      // @ts-expect-error: may not have been asked for
      physics.operators(cells, { only: names }).gradient.rows;
      const boundary = physics.boundaryOf(cells, { xMin: { dirichlet: 0 }, surface: { neumann: 1 } });
      // @ts-expect-error: one of both
      physics.boundaryOf(cells, { xMin: { dirichlet: 0, neumann: 1 } });
      // @ts-expect-error: no such tag
      physics.boundaryOf(cells, { left: { dirichlet: 0 } });
      const wind = [1, 0, 0];
      physics.inflowSeeds({ min: wind, max: [2, 1, 1], cells: wind }, wind, 9);
      const { phi } = await worker.solvePoisson(cells, { boundary }, { signal: AbortSignal.timeout(9) });
      const tag: 'surface' = faceTags[7];
      using stepper = physics.createFlowStepper(cells, [1, 0, 0], { viscosity: 0.1 });
      const there = await worker.createFlowStepper(cells, [1, 0, 0], { signal: AbortSignal.timeout(9) });
      const status: 'converged' | 'iterationLimit' | 'incompatible' | 'unresolved' | 'breakdown' = (await there.step()).status ?? stepper.step().status;
      const [{ pressure }] = await there.forces({ centre: [1, 0, 0] });
      there.free();
      console.log(status, pressure);
      const follow = (field: FlowField) => physics.streamlines(field, physics.inflowSeeds(field.cutMesh.grid, [1, 0, 0], 9), { maxLength: 3 });
      const end: 'rest' = streamlineEnds[2];
      // @ts-expect-error: around what?
      physics.inflowSeeds({ cells: 9 }, [1, 0, 0], 9);
      console.log(follow, end);
      return phi[gradient.entryColumns[0] ?? tag.length];
    }`);
});

test('the calls and the exports of every entry', async () => {
  const entries = ['worker', 'three', 'inline', 'physics/worker', 'physics/inline'];
  const [worker, three, inline, physicsWorker, physicsInline] = await Promise.all(
    entries.map((entry) => import(`mandoline-wasm/${entry}`)),
  );
  assertCompiles(`
    import type { Mandoline } from 'mandoline-wasm';
    import type * as index from 'mandoline-wasm';
    import type * as worker from 'mandoline-wasm/worker';
    import type * as three from 'mandoline-wasm/three';
    import type * as inline from 'mandoline-wasm/inline';
    import type { Physics } from 'mandoline-wasm/physics';
    import type * as physics from 'mandoline-wasm/physics';
    import type * as physicsWorker from 'mandoline-wasm/physics/worker';
    import type * as physicsInline from 'mandoline-wasm/physics/inline';
    type Callable = ((...given: never[]) => unknown) | (new (...given: never[]) => unknown);
    type Kinds<T> = { [Key in keyof T]: T[Key] extends string ? 'string' : T[Key] extends Callable ? 'function' : 'object' };
    export const calls: Kinds<Mandoline> = ${kinds(mandoline)};
    export const indexKinds: Kinds<typeof index> = ${kinds({ ...index })};
    export const workerKinds: Kinds<typeof worker> = ${kinds({ ...worker })};
    export const threeKinds: Kinds<typeof three> = ${kinds({ ...three })};
    export const inlineKinds: Kinds<typeof inline> = ${kinds({ ...inline })};
    export const physicsCalls: Kinds<Physics> = ${kinds(physics)};
    export const physicsKinds: Kinds<typeof physics> = ${kinds({ ...physicsEntry })};
    export const physicsWorkerKinds: Kinds<typeof physicsWorker> = ${kinds({ ...physicsWorker })};
    export const physicsInlineKinds: Kinds<typeof physicsInline> = ${kinds({ ...physicsInline })};
  `);
});

test('errors', () => {
  let error;
  try {
    mandoline.cut(join(mesh, box([0.4, 0.6, 0.6], [1.6, 1.4, 1.4])), { cells: 9 }, { intersections: 'refuse' });
  } catch (caught) {
    error = caught;
  }
  const { message, name, stack, code, stage, element, element2, ...rest } = error;
  assert.deepEqual(rest, {});
  assertCompiles(`import type { MandolineError } from 'mandoline-wasm';
    export const error: MandolineError = ${literal({ name, message, code, stage, element, element2 })};`);
});

test('every code of the core and of the types has advice', () => {
  const types = readFileSync(path(root, 'wasm', 'src', 'index.d.ts'), 'utf8').replace(/\/\*\*.*?\*\//gs, '');
  const codes = [...types.match(/type ErrorCode =([^;]*);/)[1].matchAll(/'(\w+)'/g)].map(([, word]) => word);
  const headers = path(root, 'src', 'include', 'mandoline');
  const core = readFileSync(path(headers, 'status.h'), 'utf8').match(/enum class Status[^{]*\{([^}]*)\}/)[1];
  const statuses = [...core.matchAll(/^\s*(\w+),/gm)].map(([, word]) => word);
  assert.ok(statuses.length > 10);
  for (const status of statuses) assert.ok(status === 'ok' || codes.includes(status), status);
  for (const code of codes) {
    const error = new index.MandolineError(code, 'What.');
    assert.match(index.describe(error), /^What\. \w.{20}/, code);
  }
});

test('uses as in the documentation', async () => {
  assertCompiles(`
    import { init, MandolineError, describe, type CutMesh, type Mesh } from 'mandoline-wasm';
    const mandoline = await init();
    const mesh: Mesh = { positions: [0, 0, 0], triangles: new Uint16Array(3) };
    const cutMesh: CutMesh = mandoline.cut(mesh, { cells: 32 }, { progress: ({ done, total }) => done < total });
    mandoline.cut(mesh, cutMesh.grid);
    mandoline.cut(mesh, { min: [0, 0, 0], max: [1, 1, 1], cells: [4, 4, 4] });
    mandoline.cut(mesh, { origin: [0, 0, 0], spacing: [1, 1, 1], cells: [4, 4, 4] });
    mandoline.cut(mesh, { planes: [[0, 1], [0, 1], new Float64Array(2)] });
    const triangles: Uint32Array = mandoline.triangulate(cutMesh, { cell: 3 });
    const offsets: Uint32Array = mandoline.triangulate(cutMesh).faceTriangleOffsets;
    try {
      console.log(triangles, offsets);
    } catch (error) {
      if (error instanceof MandolineError) console.log(error.code === 'badGrid', describe(error));
    }
    // @ts-expect-error: no such format
    mandoline.write(mesh, cutMesh, 'off');
    // @ts-expect-error: a grid needs cells
    mandoline.cut(mesh, { min: [0, 0, 0], max: [1, 1, 1] });
  `);
});
