// Results know what they were made of: here, in a worker, in files and in copies; what was not made from each other is refused.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { createWorker } from 'mandoline-wasm/physics/worker';
import { box, torus } from './meshes.mjs';

const [mandoline, physics] = await Promise.all([init(), initPhysics()]);

const { positions, triangles } = torus(16, 8);
const mesh = { positions: positions.map((x) => Math.round(x * 2 ** 20) / 2 ** 20), triangles }; // moved exactly
const grid = { min: [-1.5, -1.5, -0.5], max: [1.5, 1.5, 0.5], cells: [6, 6, 4] };
const cutMesh = mandoline.cut(mesh, grid);

// As many of everything, elsewhere.
const moved = { positions: mesh.positions.map((x) => x + 4), triangles: mesh.triangles };
const movedGrid = { min: grid.min.map((x) => x + 4), max: grid.max.map((x) => x + 4), cells: grid.cells };
const other = mandoline.cut(moved, movedGrid);

const known = /^[0-9a-f]{16}$/;

test('equal input gives equal fingerprints, here and in a worker', async () => {
  assert.match(cutMesh.fingerprint, known);
  assert.match(cutMesh.madeFrom, known);
  const again = mandoline.cut({ positions: new Float64Array(mesh.positions), triangles: [...mesh.triangles] }, grid);
  assert.deepEqual([again.madeFrom, again.fingerprint], [cutMesh.madeFrom, cutMesh.fingerprint]);
  assert.equal(mandoline.cut(mandoline.prepare(mesh), grid).fingerprint, cutMesh.fingerprint);
  assert.notEqual(mandoline.cut(mesh, grid, { snapTolerance: 0.01 }).fingerprint, cutMesh.fingerprint);
  const worker = await createWorker();
  try {
    const there = await worker.cut(mesh, grid);
    assert.equal(there.fingerprint, cutMesh.fingerprint);
    const cells = await worker.cellComplex(mesh, cutMesh);
    assert.equal(cells.fingerprint, physics.cellComplex(mesh, there).fingerprint);
    await assert.rejects(worker.measure(moved, there), { code: 'badArgument', message: /^The mesh is not the one/ });
    await assert.rejects(worker.cellComplex(mesh, cutMesh, physics.coarsen(other)), { message: /^The octree cells are not those/ });
  } finally {
    worker.terminate();
  }
});

test('files and copies keep them', async () => {
  const read = await mandoline.readCutMesh(await mandoline.write(mesh, cutMesh, 'mcm'));
  const dump = JSON.parse(new TextDecoder().decode(await mandoline.write(mesh, cutMesh, 'json')));
  for (const { madeFrom, fingerprint } of [read, dump, structuredClone(cutMesh)]) {
    assert.deepEqual([madeFrom, fingerprint], [cutMesh.madeFrom, cutMesh.fingerprint]);
  }
});

test('what was not made from each other is refused', async () => {
  const cells = physics.cellComplex(mesh, cutMesh);
  const fine = physics.cellComplex(mesh, mandoline.cut(mesh, { ...grid, cells: [7, 6, 4] }));
  const otherCells = physics.cellComplex(moved, other);
  const flow = physics.solveFlow(cells, [1, 0, 0]);
  const otherBoundary = physics.boundaryOf(otherCells);
  assert.deepEqual(otherBoundary.halfFaces, physics.boundaryOf(cells).halfFaces);
  const field = { mesh, cutMesh, cells, flow };
  const cases = [
    [() => mandoline.measure(moved, cutMesh), /^The mesh is not the one that the cut-mesh was made from: its positions or triangles/],
    [() => physics.cellComplex(mesh, cutMesh, physics.coarsen(other)), /^The octree cells are not those of this cut-mesh\.$/],
    [() => physics.outwardNormals(otherBoundary, cells), /^The boundary is not that of these cells\.$/],
    [() => physics.solvePoisson(cells, { boundary: otherBoundary }), /^The boundary is not that of these cells\.$/],
    [() => physics.solvePoisson(cells, { boundary: { ...otherBoundary } }), /^The boundary is not that of these cells\.$/],
    [() => physics.velocityAt({ ...field, cells: otherCells }, []), /^The cells are not all of this cut-mesh's\.$/],
    [() => physics.velocityAt({ ...field, cells: fine }, []), /^The cells are not all of this cut-mesh's\.$/],
    [() => physics.streamlines({ ...field, flow: physics.solveFlow(otherCells, [1, 0, 0]) }, []), /^The flow is one of other cells\.$/],
  ];
  for (const [call, message] of cases) assert.throws(call, { code: 'badArgument', message });
  assert.equal(physics.velocityAt(structuredClone(field), [0, 0, 0.4]).length, 3);
});

test('arrays from elsewhere have none and are trusted', () => {
  const { fingerprint: _, madeFrom: __, snapTolerance: ___, ...foreign } = cutMesh;
  assert.deepEqual(mandoline.measure(mesh, foreign).cellVolume, mandoline.measure(mesh, cutMesh).cellVolume);
  assert.throws(() => mandoline.measure(box([0, 0, 0], [1, 1, 1]), foreign), { message: /^The mesh is not the one/ });
  const cells = physics.cellComplex(mesh, foreign, physics.coarsen(other, { maxLevel: 0 }));
  assert.equal(cells.fingerprint, '0'.repeat(16));
  for (const wrong of [7, null, 'x', '0123456789ABCDEF']) {
    assert.throws(() => mandoline.adjacency({ ...cutMesh, fingerprint: wrong }), {
      message: /^cutMesh\.fingerprint must be 16 hexadecimal/,
    });
  }
});
