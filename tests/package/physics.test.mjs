// Computing on the cells: identities of the operators, exact solutions, twins, and what wrong arguments get.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init } from 'mandoline-wasm';
import { MandolineError, faceTags, initPhysics, streamlineEnds } from 'mandoline-wasm/physics';
import { box, gut, join, sheet, torus } from './meshes.mjs';

const [mandoline, physics] = await Promise.all([init(), initPhysics()]);
const { cut } = mandoline;

const mesh = torus(40, 20);
const grid = { min: [-1.7, -1.6, -0.9], max: [1.7, 1.6, 0.9], cells: [13, 12, 7] };
const box3 = 3.4 * 3.2 * 1.8;
const cutMesh = cut(mesh, grid);
const cells = physics.cellComplex(mesh, cutMesh);
const octree = physics.coarsen(cutMesh, { fineLayers: 0 });
const coarse = physics.cellComplex(mesh, cutMesh, octree);
const complexes = Object.entries({ 'grid cells': cells, 'octree cells': coarse });
const field = [0.75, -1.25, 0.5];

const sum = (values) => values.reduce((total, value) => total + value, 0);
const dot = (u, vectors, i) => u[0] * vectors[3 * i] + u[1] * vectors[3 * i + 1] + u[2] * vectors[3 * i + 2];
const products = (u, vectors) => Float64Array.from({ length: vectors.length / 3 }, (_, i) => dot(u, vectors, i));
const faceCount = ({ faceTag }) => faceTag.length;
const cellCount = ({ cellRegion }) => cellRegion.length;

function assertNear(values, expected, tolerance) {
  assert.equal(values.length, expected.length);
  for (let i = 0; i < values.length; ++i) assert.ok(Math.abs(values[i] - expected[i]) <= tolerance, `[${i}]: ${values[i]}, ${expected[i]}`);
}

/** matrix * vector. */
function times({ rows, rowOffsets, entryColumns, entryValues }, vector) {
  return Float64Array.from({ length: rows }, (_, row) => {
    let total = 0;
    for (let i = rowOffsets[row]; i < rowOffsets[row + 1]; ++i) total += entryValues[i] * vector[entryColumns[i]];
    return total;
  });
}

/** Rows of a * b, as maps from column to value. */
function product(a, b) {
  return Array.from({ length: a.rows }, (_, row) => {
    const entries = new Map();
    for (let i = a.rowOffsets[row]; i < a.rowOffsets[row + 1]; ++i) {
      const middle = a.entryColumns[i];
      for (let j = b.rowOffsets[middle]; j < b.rowOffsets[middle + 1]; ++j) {
        const column = b.entryColumns[j];
        entries.set(column, (entries.get(column) ?? 0) + a.entryValues[i] * b.entryValues[j]);
      }
    }
    return entries;
  });
}

const isZero = (rows) => rows.every((entries) => [...entries.values()].every((value) => value === 0));

test('the cells fill the box, with the regions of the cut-mesh', () => {
  const { regionVolume } = mandoline.measure(mesh, cutMesh);
  for (const [name, all] of complexes) {
    assert.equal(all.cutCells, cutMesh.cellRegion.length, name);
    assert.ok(Math.abs(sum(all.cellVolume) - box3) < 1e-12 * box3, name);
    const volumes = new Float64Array(cutMesh.regionCount);
    all.cellVolume.forEach((volume, cell) => {
      volumes[all.cellRegion[cell]] += volume;
    });
    assertNear(volumes, regionVolume, 1e-12 * box3);
  }
  const untouched = cutMesh.gridCellRegion.filter((region) => region >= 0).length;
  assert.equal(cellCount(cells), cells.cutCells + untouched);
  assert.equal(cellCount(coarse), coarse.cutCells + octree.cellLevel.length);
  assert.ok(octree.cellLevel.length < untouched && octree.cellLevel.some((level) => level > 0));
  assert.deepEqual(octree.gridCells, [13, 12, 7]);
});

test('options of coarsen()', () => {
  assert.equal(Math.max(...physics.coarsen(cutMesh, { maxLevel: 0 }).cellLevel), 0);
  const { cellLevel } = physics.coarsen(cutMesh, { fineLayers: 3 });
  assert.ok(cellLevel.length > octree.cellLevel.length);
  assert.ok(physics.coarsen(cutMesh, { balanceEdges: true }).cellLevel.length >= octree.cellLevel.length);
  assert.equal(Math.max(...physics.coarsen(cutMesh, { layersPerLevel: 100 }).cellLevel), 1);
  for (const options of [{ maxLevel: -1 }, { fineLayers: -1 }, { layersPerLevel: -2 }]) {
    assert.throws(() => physics.coarsen(cutMesh, options), { code: 'badOption', stage: 'coarsen' });
  }
});

test('small cells merged: volumes, members, and what other calls make of them', () => {
  for (const [name, all] of complexes) {
    const { cells: merged, mergedCell, pockets } = physics.mergeSmallCells(cutMesh, all);
    assert.deepEqual(pockets.length, 0, name);
    assert.ok(cellCount(merged) < cellCount(all), name);
    const volumes = new Float64Array(cellCount(merged));
    all.cellVolume.forEach((volume, cell) => {
      volumes[mergedCell[cell]] += volume;
    });
    assert.deepEqual(merged.cellVolume, volumes, name);
    const gridCell = box3 / (13 * 12 * 7);
    assert.ok(Math.min(...volumes) >= 0.2 * gridCell, name);
    assert.deepEqual(Uint32Array.from(merged.cellMembers).sort(), Uint32Array.from(mergedCell.keys()), name);
    const { divergence } = physics.operators(merged, { only: ['divergence'] });
    assertNear(times(divergence, products(field, merged.faceNormal)), new Float64Array(cellCount(merged)), 1e-13);
    const flow = physics.solveFlow(merged, [1, 0, 0]);
    assert.equal(flow.status, 'converged', name);
    const { points, ends } = physics.streamlines({ mesh, cutMesh, cells: merged, flow }, physics.inflowSeeds(cutMesh.grid, [1, 0, 0], 30));
    assert.ok(points.length > 30 && ends.filter((end) => streamlineEnds[end] === 'side').length > 20, name);
  }
  assert.throws(() => physics.mergeSmallCells(cutMesh, cells, { fraction: 0.6 }), { code: 'badOption', stage: 'mergeSmallCells' });
  assert.throws(() => physics.mergeSmallCells(cutMesh, physics.mergeSmallCells(cutMesh, cells).cells), /merged already/);
});

test('walls united: fewer faces, as closed as before', () => {
  const { cells: merged } = physics.mergeSmallCells(cutMesh, coarse);
  const walls = ({ faceTag }) => faceTag.filter((tag) => faceTags[tag] === 'surface').length;
  const united = physics.uniteWalls(cutMesh, merged);
  assert.ok(walls(united) < walls(merged) / 2);
  assert.deepEqual(united.cellVolume, merged.cellVolume);
  const { divergence } = physics.operators(united, { only: ['divergence'] });
  assertNear(times(divergence, products(field, united.faceNormal)), new Float64Array(cellCount(united)), 1e-13);
  const triangleGroup = Uint32Array.from({ length: mesh.triangles.length / 3 }, (_, t) => t % 2);
  const groups = { names: ['even', 'odd'], triangleGroup };
  assert.ok(walls(physics.uniteWalls(cutMesh, merged, { groups })) > walls(united));
  assert.ok(walls(physics.uniteWalls(cutMesh, merged, { angle: 5 })) > walls(united));
  assert.throws(() => physics.uniteWalls(cutMesh, merged, { angle: 100 }), { code: 'badOption', stage: 'uniteWalls' });
});

test('the boundary of a boundary is nothing, to the bit', () => {
  for (const [name, all] of complexes) {
    const { cellFaceIncidence, faceEdgeIncidence, edgeVertexIncidence, ...rest } = physics.operators(all, {
      only: ['cellFaceIncidence', 'faceEdgeIncidence', 'edgeVertexIncidence'],
    });
    assert.deepEqual(rest, {});
    const edges = physics.complexEdges(all).vertices.length / 2;
    assert.deepEqual([cellFaceIncidence.rows, cellFaceIncidence.columns], [cellCount(all), faceCount(all)], name);
    assert.deepEqual([faceEdgeIncidence.rows, faceEdgeIncidence.columns], [faceCount(all), edges], name);
    assert.deepEqual([edgeVertexIncidence.rows, edgeVertexIncidence.columns], [edges, all.positions.length / 3], name);
    assert.ok(isZero(product(cellFaceIncidence, faceEdgeIncidence)), name);
    assert.ok(isZero(product(faceEdgeIncidence, edgeVertexIncidence)), name);
    assert.ok(!isZero(product(edgeVertexIncidence, { ...edgeVertexIncidence, rowOffsets: faceEdgeIncidence.rowOffsets })), name);
  }
});

test('gradient, divergence and Laplacian', () => {
  for (const [name, all] of complexes) {
    const { gradient, divergence, laplacian, cellMass, faceStar, faceMass } = physics.operators(all);
    const u = products(field, all.faceNormal);
    assertNear(times(divergence, u), new Float64Array(cellCount(all)), 1e-13);
    const derivative = times(gradient, products(field, all.cellCentre));
    const inner = [...derivative.keys()].filter((f) => gradient.rowOffsets[f] < gradient.rowOffsets[f + 1]);
    assert.ok(inner.length > cellCount(all), name);
    assertNear(
      inner.map((f) => derivative[f]),
      inner.map((f) => u[f]),
      1e-9,
    );
    assertNear(times(laplacian, new Float64Array(cellCount(all)).fill(1)), new Float64Array(cellCount(all)), 1e-10);
    assertNear(times(laplacian, all.cellCentroid), times(divergence, times(gradient, all.cellCentroid)), 1e-9);
    assert.deepEqual(cellMass.entryValues, all.cellVolume, name);
    for (const { rows, columns } of [faceStar, faceMass]) assert.deepEqual([rows, columns], [faceCount(all), faceCount(all)], name);
  }
  const slanted = physics.operators(cells, { only: ['gradient'], dualPoints: 'centroids' });
  assert.notDeepEqual(slanted, physics.operators(cells, { only: ['gradient'] }));
});

test('a linear solution, its values given on two sides and its derivative elsewhere', () => {
  for (const [name, all] of complexes) {
    const boundary = physics.boundaryOf(all);
    const normals = physics.outwardNormals(boundary, all);
    for (let b = 0; b < boundary.halfFaces.length; ++b) {
      const face = boundary.halfFaces[b] >> 1;
      const isHeld = faceTags[all.faceTag[face]] === 'xMin';
      boundary.condition[b] = isHeld ? 1 : 0;
      boundary.value[b] = isHeld ? dot(field, all.faceCentroid, face) : dot(field, normals, b);
    }
    const { status, phi, residuals } = physics.solvePoisson(all, { boundary });
    assert.equal(status, 'converged', name);
    assert.ok(residuals.at(-1) <= 1e-10 && residuals.length < 60, name);
    const outside = [...phi.keys()].filter((cell) => all.cellRegion[cell] === all.cellRegion.at(-1));
    assertNear(
      outside.map((cell) => phi[cell]),
      outside.map((cell) => dot(field, all.cellCentre, cell)),
      1e-8,
    );
  }
});

test('conditions by tag', () => {
  const boundary = physics.boundaryOf(cells, { xMin: { dirichlet: 3 }, surface: { neumann: 0.5 } });
  const tags = Array.from(boundary.halfFaces, (h) => faceTags[cells.faceTag[h >> 1]]);
  assert.deepEqual(
    [...boundary.value],
    tags.map((tag) => ({ xMin: 3, surface: 0.5 })[tag] ?? 0),
  );
  assert.deepEqual(
    [...boundary.condition],
    tags.map((tag) => (tag === 'xMin' ? 1 : 0)),
  );
  assert.ok(!tags.includes('inner') && tags.includes('zMax'));
  const robin = physics.boundaryOf(cells, { zMax: { robin: 3, coefficient: 2 } });
  assert.deepEqual(
    Array.from(robin.coefficient),
    tags.map((tag) => (tag === 'zMax' ? 2 : 0)),
  );
  const constant = Object.fromEntries(faceTags.map((tag) => [tag, { robin: 3, coefficient: 2 }]));
  assertNear(
    physics.solvePoisson(cells, { boundary: physics.boundaryOf(cells, constant) }).phi,
    new Float64Array(cellCount(cells)).fill(1.5),
    1e-8,
  );
  const absent = { xMin: { dirichlet: 3, neumann: undefined }, yMin: undefined, surface: { neumann: 0.5 } };
  assert.deepEqual(physics.boundaryOf(cells, absent), boundary);
  const all = physics.boundaryOf(cells, Object.fromEntries(faceTags.map((tag) => [tag, { dirichlet: 2 }])));
  assertNear(physics.solvePoisson(cells, { boundary: all }).phi, new Float64Array(cellCount(cells)).fill(2), 1e-8);
});

test('the system of a problem, and its solution', () => {
  const problem = { boundary: physics.boundaryOf(cells, { zMin: { dirichlet: 1 } }), source: cells.cellVolume };
  const { matrix, rhs, nullSpace } = physics.poissonSystem(cells, problem);
  const balanced = physics.solvePoisson(cells, problem, { balance: true, tolerance: 1e-12, corrections: 0 });
  assert.equal(balanced.status, 'converged');
  const { cellComponent, count } = physics.cellComponents(cells);
  assert.deepEqual([count, nullSpace.rows, nullSpace.columns], [2, cellCount(cells), 1]); // the torus is not held
  const residual = times(matrix, balanced.phi).map((value, i) => value - rhs[i]);
  const held = cellComponent.at(-1);
  for (const [cell, value] of residual.entries()) assert.ok(cellComponent[cell] !== held || Math.abs(value) < 1e-10);
  const { status, incompatible, excess, phi } = physics.solvePoisson(cells, problem, { corrections: 0 });
  assert.deepEqual([status, ...incompatible, Math.sign(excess[0])], ['incompatible', 1 - held, -1]);
  const expected = balanced.phi.map((value, cell) => (cellComponent[cell] === held ? value : 0));
  assertNear(phi, expected, 1e-6);
  assert.equal(physics.solvePoisson(cells, problem, { balance: true, maxIterations: 1 }).status, 'iterationLimit');
  const pinned = physics.solvePoisson(cells, problem, { balance: true, freeConstant: 'pinned' });
  assert.equal(pinned.phi[cellComponent.indexOf(1 - held)], 0);
});

test('a mass holds phi; a coefficient is part of the flux', () => {
  const [source, mass] = [-6, 2].map((value) => new Float64Array(cellCount(cells)).fill(value));
  assertNear(physics.solvePoisson(cells, { source, mass }).phi, new Float64Array(cellCount(cells)).fill(3), 1e-8);
  const { matrix } = physics.poissonSystem(cells);
  const faceCoefficient = new Float64Array(cells.faceArea.length).fill(4);
  assert.deepEqual(
    physics.poissonSystem(cells, { faceCoefficient }).matrix.entryValues,
    matrix.entryValues.map((value) => 4 * value),
  );
});

test('corrections, and derivatives that balance the source', () => {
  const problem = { boundary: physics.boundaryOf(cells, { zMin: { dirichlet: 1 }, surface: { dirichlet: 0 } }) };
  const { phi, faceDerivative, boundaryDerivative } = physics.solvePoisson(cells, problem);
  const plain = physics.solvePoisson(cells, problem, { corrections: 0 });
  const gradient = times(physics.operators(cells, { only: ['gradient'] }).gradient, plain.phi);
  assertNear(plain.faceDerivative, gradient, 1e-12);
  assert.notDeepEqual(phi, plain.phi);
  const flow = new Float64Array(cellCount(cells));
  faceDerivative.forEach((derivative, face) => {
    if (derivative === 0) return;
    flow[cells.faceCells[2 * face]] += derivative * cells.faceArea[face];
    flow[cells.faceCells[2 * face + 1]] -= derivative * cells.faceArea[face];
  });
  problem.boundary.halfFaces.forEach((halfFace, at) => {
    flow[cells.faceCells[halfFace]] += boundaryDerivative[at] * cells.faceArea[halfFace >> 1];
  });
  assertNear(flow, new Float64Array(flow.length), 1e-7);
  assert.throws(() => physics.solvePoisson(cells, problem, { corrections: -1 }), { code: 'badOption', stage: 'solvePoisson' });
});

test('parts', () => {
  let total = 0;
  for (let region = 0; region < cutMesh.regionCount; ++region) {
    const part = physics.regionComplex(coarse, region);
    total += sum(part.cells.cellVolume);
    assert.ok(part.cells.cellRegion.every((r) => r === region));
    assert.deepEqual(
      part.cells.cellVolume,
      Float64Array.from(part.wholeCell, (cell) => coarse.cellVolume[cell]),
    );
    assert.equal(physics.cellComponents(part.cells).count, 1);
    assert.equal(physics.operators(part.cells, { only: ['divergence'] }).divergence.columns, part.wholeFace.length);
  }
  assert.ok(Math.abs(total - box3) < 1e-12 * box3);
  const { cells: two, wholeCell, wholeVertex } = physics.subComplex(cells, [7, 3]);
  assert.deepEqual([...wholeCell], [3, 7]);
  assert.equal(two.positions.length, 3 * wholeVertex.length);
  assert.deepEqual(physics.subComplex(cells, new Uint32Array([7, 3])).wholeCell, wholeCell);
  assert.throws(() => physics.subComplex(cells, [1, 1]), { code: 'badArgument', element: 1, message: 'Cell 1 is named twice.' });
  assert.throws(() => physics.subComplex(cells, [1e6]), { code: 'badArgument', element: 1e6 });
  assert.throws(() => physics.regionComplex(cells, 9), { code: 'badArgument', element: 9, stage: 'regionComplex' });
});

test('the two sides of a sheet do not meet', () => {
  const open = sheet([-2, -2], [2, 2], 0.05);
  const all = physics.cellComplex(open, cut(open, { min: [-1, -1, -1], max: [1, 1, 1], cells: [4, 4, 5] }));
  assert.equal(physics.cellComponents(all).count, 2);
  const boundary = physics.boundaryOf(all, { zMin: { dirichlet: -1 }, zMax: { dirichlet: 1 } });
  assertNear(physics.solvePoisson(all, { boundary }).phi, all.cellCentroid.filter((_, i) => i % 3 === 2).map(Math.sign), 1e-9);
});

test('a wind', () => {
  const wind = [1, 0.2, 0];
  for (const [name, all] of complexes) {
    const flow = physics.solveFlow(all, wind);
    assert.equal(flow.status, 'converged', name);
    assert.deepEqual(flow.wind, wind);
    assert.equal(flow.throttled.length, 0);
    const { divergence } = physics.operators(all, { only: ['divergence'] });
    assertNear(times(divergence, flow.faceVelocity), new Float64Array(cellCount(all)), 1e-8);
    for (let face = 0; face < faceCount(all); ++face) {
      const tag = faceTags[all.faceTag[face]];
      if (tag === 'surface') assert.equal(flow.faceVelocity[face], 0, name);
      else if (tag !== 'inner') assert.ok(Math.abs(flow.faceVelocity[face] - dot(wind, all.faceNormal, face)) < 1e-9, name);
    }
    const speeds = Array.from({ length: cellCount(all) }, (_, c) => Math.hypot(...flow.cellVelocity.subarray(3 * c, 3 * c + 3)));
    const inside = all.cellRegion.map((region) => (cutMesh.regionWinding[region] === 1 ? 1 : 0));
    assert.ok(Math.max(...speeds.filter((_, c) => inside[c])) < 1e-12 && Math.max(...speeds) > Math.hypot(...wind), name);
    assertNear(
      flow.cellPressure,
      speeds.map((speed) => 1 - speed ** 2 / 1.04),
      1e-12,
    );
  }
  const empty = physics.cellComplex(mesh, cut(mesh, { min: [3, 3, 3], max: [4, 4, 4], cells: [3, 3, 3] }));
  const { cellVelocity } = physics.solveFlow(empty, wind);
  assertNear(
    cellVelocity,
    Float64Array.from(cellVelocity, (_, i) => wind[i % 3]),
    1e-9,
  );
  assert.throws(() => physics.solveFlow(cells, [1, NaN, 0]), { code: 'badArgument', stage: 'solveFlow' });
});

test('a wind in unbounded space', () => {
  for (const [name, all] of complexes) {
    const [flow, tunnel] = [true, false].map((farField) => physics.solveFlow(all, [1, 0.2, 0], { farField }));
    assert.equal(flow.status, 'converged', name);
    const { divergence } = physics.operators(all, { only: ['divergence'] });
    assertNear(times(divergence, flow.faceVelocity), new Float64Array(cellCount(all)), 1e-8);
    const fastest = ({ cellVelocity }) => Math.max(...cellVelocity);
    assert.ok(fastest(flow) < fastest(tunnel), name);
  }
  const box = { min: [-3, -3, 0.05], max: [3, 3, 2.05], cells: [6, 6, 4] };
  const torn = physics.cellComplex(mesh, cut(mesh, box));
  assert.throws(
    () => physics.solveFlow(torn, [1, 0, 0], { farField: true }),
    ({ code, element, message }) =>
      code === 'badArgument' && element >= 0 && /may reach a side of the box, but face \d+ does/.test(message),
  );
  assert.throws(() => physics.solveFlow(cells, [1, 0, 0], { farField: 1 }), /options\.farField must be true or false/);
});

test('velocities at points', () => {
  const wind = [0.75, -1.25, 0.5];
  const outside = cut(mesh, { min: [3, 3, 3], max: [4, 4, 4], cells: [3, 3, 3] });
  const calm = physics.cellComplex(mesh, outside);
  const steady = { mesh, cutMesh: outside, cells: calm, flow: physics.solveFlow(calm, wind) };
  assertNear(physics.velocityAt(steady, [3, 3, 3, 3.3, 3.5, 3.9]), [...wind, ...wind], 1e-9);
  for (const [name, all] of complexes) {
    const flow = physics.solveFlow(all, wind);
    const at = physics.velocityAt({ mesh, cutMesh, cells: all, flow }, [1.65, 0, 0, 0.05, 0.05, 0, 1, 0, 0, 9, 0, 0]);
    assert.ok(Math.hypot(...at.subarray(0, 6)) > 1, name);
    assert.ok(Math.hypot(...at.subarray(6, 9)) < 1e-9, name); // within the tube
    assert.deepEqual([...at.subarray(9)], [NaN, NaN, NaN], name);
  }
});

test('streamlines round a torus, none into it', () => {
  const wind = [0.3, 0.1, 1];
  const seeds = physics.inflowSeeds(cutMesh.grid, wind, 60);
  assert.equal(seeds.length, 180);
  for (let i = 0; i < 180; i += 3) assert.ok(seeds[i] === -1.7 || seeds[i + 1] === -1.6 || seeds[i + 2] === -0.9);
  assert.deepEqual(physics.inflowSeeds(grid, wind, 60), seeds);
  assert.equal(physics.inflowSeeds(grid, [0, 0, 0], 60).length, 0); // nothing enters
  for (const [name, all] of complexes) {
    const flowField = { mesh, cutMesh, cells: all, flow: physics.solveFlow(all, wind) };
    const { points, speeds, offsets, ends } = physics.streamlines(flowField, seeds);
    assert.deepEqual([ends.length, offsets.length, offsets.at(-1), points.length], [60, 61, speeds.length, 3 * speeds.length], name);
    const words = Array.from(ends, (end) => streamlineEnds[end]);
    assert.ok(words.every((word) => word === 'side' || word === 'surface') && words.filter((word) => word === 'side').length > 40, name);
    assert.ok(
      mandoline.cellsAt(cutMesh, points).region.every((region) => cutMesh.regionWinding[region] === 0),
      name,
    );
    const velocities = physics.velocityAt(flowField, points);
    const onPlane = (i) => [0, 1, 2].some((d) => cutMesh.grid.planes[d].includes(points[3 * i + d])); // may be either cell's
    const within = [...speeds.keys()].filter((i) => !onPlane(i));
    assert.ok(within.length > 500, name);
    assertNear(
      within.map((i) => speeds[i]),
      within.map((i) => Math.hypot(...velocities.subarray(3 * i, 3 * i + 3))),
      1e-12,
    );
  }
});

test('options of streamlines()', () => {
  const flowField = { mesh, cutMesh, cells, flow: physics.solveFlow(cells, [0, 0, 1]) };
  const seeds = [1.4, 1.3, 0, 1, 0, 0, 1, 0, 0.4000001, 5, 5, 5];
  const wordsOf = ({ ends }) => Array.from(ends, (end) => streamlineEnds[end]);
  const lines = physics.streamlines(flowField, seeds);
  assert.deepEqual(
    wordsOf(lines).filter((_, i) => i !== 2),
    ['side', 'rest', 'outside'],
  );
  assert.deepEqual([lines.points[3 * lines.offsets[1] - 1], lines.offsets[4]], [0.9, lines.offsets[3]]);
  const upstream = physics.streamlines(flowField, new Float32Array(seeds), { upstream: true });
  assert.equal(upstream.points[3 * upstream.offsets[1] - 1], -0.9);
  assert.equal(wordsOf(physics.streamlines(flowField, seeds, { maxLength: 0.25 }))[0], 'maxLength');
  const few = physics.streamlines(flowField, seeds, { maxPoints: 2 });
  assert.deepEqual([wordsOf(few)[0], few.offsets[1]], ['maxPoints', 2]);
  assert.ok(physics.streamlines(flowField, seeds, { tolerance: 1e-7 }).offsets[1] > lines.offsets[1]);
  assert.deepEqual(physics.streamlines(flowField, []).offsets, new Uint32Array(1));
});

const source = cells.cellCentre.filter((_, i) => i % 3 === 0);
const flow = physics.solveFlow(cells, [1, 2, 3]);
const inputs = {
  cutMesh: () => cut(mesh, grid),
  cells: () => physics.cellComplex(mesh, cut(mesh, grid)),
  both: () => {
    const made = cut(mesh, grid);
    return { cutMesh: made, cells: physics.cellComplex(mesh, made) };
  },
  field: () => ({ mesh, ...inputs.both(), flow }),
};
const groups = { names: ['a', 'b'], triangleGroup: Uint32Array.from({ length: cutMesh.triangleCount }, (_, t) => t % 2) };
/** Of several results, those that have twins. */
const gutInput = (given) => (given.cells ? { ...given, cutMesh: gut(given.cutMesh), cells: gut(given.cells) } : gut(given));
const copyInput = (given) => (given.cells ? { ...given, cells: { ...given.cells } } : { ...given });
const calls = {
  coarsen: ['cutMesh', (given) => physics.coarsen(given)],
  cellComplex: ['cutMesh', (given) => physics.cellComplex(mesh, given, octree)],
  mergeSmallCells: ['both', (given) => physics.mergeSmallCells(given.cutMesh, given.cells)],
  uniteWalls: ['both', (given) => physics.uniteWalls(given.cutMesh, given.cells)],
  subComplex: ['cells', (given) => physics.subComplex(given, [1, 2, 3])],
  regionComplex: ['cells', (given) => physics.regionComplex(given, 0)],
  complexEdges: ['cells', (given) => physics.complexEdges(given)],
  operators: ['cells', (given) => physics.operators(given, { only: ['laplacian'] })],
  boundaryOf: ['cells', (given) => physics.boundaryOf(given)],
  outwardNormals: ['cells', (given) => physics.outwardNormals(physics.boundaryOf(cells), given)],
  cellComponents: ['cells', (given) => physics.cellComponents(given)],
  poissonSystem: ['cells', (given) => physics.poissonSystem(given)],
  solveFlow: ['cells', (given) => physics.solveFlow(given, [1, 2, 3])],
  solvePoisson: ['cells', (given) => physics.solvePoisson(given, { source }, { balance: true })],
  createPoissonSolver: ['cells', (given) => physics.createPoissonSolver(given).solve({ source }, { balance: true })],
  createHeatStepper: [
    'cells',
    (given) => {
      const stepper = physics.createHeatStepper(given, { phi: source, timeStep: 0.1 });
      return [stepper.step(), stepper.phi()];
    },
  ],
  createFlowStepper: ['cells', (given) => physics.createFlowStepper(given, [1, 2, 3]).flow()],
  faceGroups: ['both', (given) => physics.faceGroups(given.cutMesh, given.cells, groups)],
  velocityAt: ['field', (given) => physics.velocityAt(given, cells.cellCentre)],
  streamlines: ['field', (given) => physics.streamlines(given, physics.inflowSeeds(cutMesh.grid, [1, 2, 3], 50))],
  writeCells: ['both', (given) => physics.writeCells(given.cutMesh, given.cells, 'vtu')],
  writeFaces: ['both', (given) => physics.writeFaces(given.cutMesh, given.cells)],
  writePolyMesh: ['both', (given) => physics.writePolyMesh(given.cutMesh, given.cells)],
};

test('every call gives the same from the twin and from data', () => {
  const tried = Object.keys(calls).sort();
  assert.deepEqual(
    tried,
    Object.keys(physics)
      .filter((name) => !['version', 'inflowSeeds'].includes(name))
      .sort(),
  );
  for (const [name, [kind, call]] of Object.entries(calls)) {
    const given = inputs[kind]();
    const fromData = call(structuredClone(given));
    assert.deepEqual(call(given), fromData, name); // a cut-mesh gets its twin here
    assert.deepEqual(call(gutInput(given)), fromData, name);
    assert.throws(() => call(copyInput(given)), { code: 'badArgument', message: /detached/, stage: name });
  }
  const { cells: part } = physics.regionComplex(cells, 0);
  assert.equal(physics.cellComponents(gut(part)).count, 1);
});

test('wrong arguments are named', () => {
  const boundary = physics.boundaryOf(cells);
  const flowField = { mesh, cutMesh, cells, flow };
  const lost = flow.cellVelocity.map((component, i) => (i === 7 ? NaN : component));
  const shifted = cells.cellCorner.map((corner, i) => (i === 4 ? 12 : corner));
  const { cells: part } = physics.regionComplex(cells, 0);
  const assertBad = (call, message, code = 'badArgument') =>
    assert.throws(call, (error) => {
      assert.ok(error instanceof MandolineError, error.stack);
      assert.match(error.message, message);
      assert.match(error.code, new RegExp(code));
      return error.stage !== '';
    });
  const cases = [
    [() => physics.coarsen(), /^cutMesh must be an object, not undefined/],
    [() => physics.coarsen(cells), /^cutMesh must be what cut\(\) gives, not what cellComplex\(\)/],
    [() => physics.coarsen(cutMesh, { maxLevel: 1.5 }), /^options\.maxLevel must be a whole number, not 1\.5/],
    [() => physics.coarsen(cutMesh, { balanceEdges: 1 }), /^options\.balanceEdges must be true or false/],
    [() => physics.cellComplex(mesh, {}), /^cutMesh\.grid must be an object/],
    [() => physics.cellComplex(mesh, cutMesh, {}), /^octree\.gridCells must have three numbers/],
    [() => physics.cellComplex(mesh, cutMesh, { ...octree, cellLevel: [] }), /^octree\.cellLevel must be a Uint8Array, not an array/],
    [() => physics.cellComplex(mesh, cutMesh, { ...octree, cellLevel: new Uint8Array() }), /octree cells are not those of this cut-mesh/],
    [() => physics.cellComplex(mesh, cutMesh, { ...octree, gridCells: [1, 2, 3] }), /octree cells are of another grid/],
    [() => physics.cellComplex(box([0, 0, 0], [1, 1, 1]), cutMesh), /cut-mesh/],
    [() => physics.operators(cutMesh), /^cells must be what cellComplex\(\), .* not what cut\(\) does/],
    [() => physics.operators({ ...cells, faceArea: cells.faceArea.slice(1) }), /^The arrays of cells don't fit together: .* length\.$/],
    [() => physics.operators({ ...cells, cutCells: -1 }), /^cells\.cutCells is -1/],
    [() => physics.operators(cells, { only: 'gradient' }), /^options\.only must be an array of names/],
    [() => physics.operators(cells, { only: ['curl'] }), /^options\.only\[0\] must be "cellFaceIncidence", .*, not "curl"/],
    [() => physics.operators(cells, { dualPoints: 'corners' }), /^options\.dualPoints must be "centres" or "centroids", not "corners"/],
    [() => physics.solvePoisson(cells, { mass: cells.cellVolume.map((v, c) => (c === 4 ? -1 : v)) }), /^The mass of cell 4 is negative/],
    [() => physics.solvePoisson(cells, { faceCoefficient: [1, 2] }), /faces, but another number of coefficients/],
    [() => physics.subComplex(cells, 7), /^cellIds must be a Uint32Array or an array, not 7/],
    [() => physics.subComplex(cells, [0.5]), /^cellIds\[0\] must be a whole number/],
    [() => physics.subComplex(cells, new Array(2 ** 32 - 1)), /^cellIds\[0\] must be a whole number|memory for cellIds/, /badArg|outOfMem/],
    [() => physics.boundaryOf(cells, { left: { dirichlet: 0 } }), /^conditions has no left, only xMin, .* and surface\.$/],
    [() => physics.boundaryOf(cells, 7), /^conditions must be an object, not 7/],
    [() => physics.boundaryOf(cells, []), /^conditions must be a plain object, not an array\.$/],
    [() => physics.boundaryOf(cells, new Map([['xMin', { dirichlet: 0 }]])), /^conditions must be a plain object, not a Map\.$/],
    [() => physics.boundaryOf(cells, { xMin: 0 }), /^conditions\.xMin must be an object/],
    [
      () => physics.boundaryOf(cells, { xMin: { dirichlet: 0, neumann: 1 } }),
      /^conditions\.xMin must be \{ dirichlet \}, \{ neumann \} or \{ robin, coefficient \}/,
    ],
    [() => physics.boundaryOf(cells, { xMin: {} }), /^conditions\.xMin must be \{ dirichlet \}, \{ neumann \} or \{ robin, coefficient \}/],
    [() => physics.boundaryOf(cells, { xMin: { robin: 1 } }), /^conditions\.xMin must be .* or \{ robin, coefficient \}/],
    [() => physics.boundaryOf(cells, { xMin: { neumann: 1, coefficient: 2 } }), /^conditions\.xMin must be /],
    [
      () => physics.boundaryOf(cells, { xMin: { flux: 1 } }),
      /^conditions\.xMin has no flux, only neumann, dirichlet, robin and coefficient/,
    ],
    [() => physics.solvePoisson(cells, { boundary: { ...boundary, coefficient: [1] } }), /coefficients/],
    [() => physics.boundaryOf(cells, { xMin: { neumann: '1' } }), /^conditions\.xMin\.neumann must be a number/],
    [() => physics.outwardNormals({ ...boundary, halfFaces: new Uint32Array([2 ** 30]) }, cells), /^There is no half-face 1073741824/],
    [() => physics.solvePoisson(cells, { boundary: {} }), /^problem\.boundary\.halfFaces must be a Uint32Array/],
    [() => physics.solvePoisson(cells, { boundary: physics.boundaryOf(coarse) }), /boundary/],
    [() => physics.solvePoisson(cells, { boundary: { ...boundary, condition: new Uint8Array([3]) } }), /condition\[0\] must be 0/],
    [() => physics.solvePoisson(cells, { source: [1] }), /source/],
    [() => physics.solvePoisson(cells, {}, { freeConstant: 'none' }), /^options\.freeConstant must be "zeroMean" or "pinned"/],
    [() => physics.solvePoisson(cells, {}, { tolerance: 0 }), /tolerance/, 'badOption'],
    [() => physics.solvePoisson(cells, {}, { maxIterations: -1 }), /maxIterations|iterations/, 'badOption'],
    [() => physics.solveFlow(cells, [1, 0]), /^wind must have three numbers, not 2/],
    [() => physics.solveFlow(cells, [1, 0, 0], { maxIterations: 0.5 }), /^options\.maxIterations must be a whole number/],
    [() => physics.solvePoisson(cells, {}, { progress: 1 }), /^options\.progress must be a function/],
    [() => physics.velocityAt(), /^field must be an object, not undefined/],
    [() => physics.velocityAt({}, []), /^mesh must be an object, not undefined/],
    [() => physics.velocityAt({ mesh }, []), /^flow must be an object, not undefined/],
    [() => physics.velocityAt({ flow }, []), /^mesh must be an object, not undefined/],
    [() => physics.velocityAt({ mesh, flow }, []), /^cutMesh must be an object, not undefined/],
    [() => physics.velocityAt({ mesh, cutMesh, flow }, []), /^cells must be an object, not undefined/],
    [() => physics.velocityAt({ ...flowField, flow: { ...flow, wind: 1 } }, []), /^flow\.wind must have three numbers/],
    [() => physics.velocityAt({ ...flowField, flow: { ...flow, cellGradient: null } }, []), /^flow\.cellGradient must be a Float64Array/],
    [() => physics.velocityAt({ ...flowField, flow: physics.solveFlow(coarse, [1, 0, 0]) }, []), /^The flow is one of other cells/],
    [() => physics.velocityAt({ ...flowField, flow: { ...flow, cellVelocity: lost } }, []), /^The flow has a number that is not finite/],
    [() => physics.velocityAt({ ...flowField, cutMesh: cells }, []), /^cutMesh must be what cut\(\) gives, not what cellComplex\(\)/],
    [() => physics.velocityAt({ ...flowField, cells: cutMesh }, []), /^cells must be what cellComplex\(\), .* not what cut\(\) does/],
    [() => physics.velocityAt({ ...flowField, cells: part }, []), /^The cells are not all of this cut-mesh's/],
    [() => physics.velocityAt({ ...flowField, cells: { ...cells, cellCorner: shifted } }, []), /^The cells are not all of this cut-mesh's/],
    [() => physics.velocityAt({ ...flowField, mesh: box([0, 0, 0], [1, 1, 1]) }, []), /^The mesh is not the one/],
    [() => physics.velocityAt(flowField, [1, 2]), /^points must have three numbers per point/],
    [() => physics.velocityAt(flowField, new Array(2 ** 32 - 1)), /^points\[0\] must be a number|memory for points/, /badArg|outOfMem/],
    [() => physics.streamlines(flowField, 7), /^seeds must be an array of numbers, not 7/],
    [() => physics.streamlines(flowField, [], { upstream: 1 }), /^options\.upstream must be true or false/],
    [() => physics.streamlines(flowField, [], { tolerance: 0 }), /tolerance has to be positive/, 'badOption'],
    [() => physics.streamlines(flowField, [], { maxLength: -1 }), /^The largest length has to be 0 or more\.$/, 'badOption'],
    [() => physics.streamlines(flowField, [], { maxLength: NaN }), /^The largest length has to be 0 or more\.$/, 'badOption'],
    [() => physics.streamlines(flowField, [], { maxPoints: 1.5 }), /^options\.maxPoints must be a whole number/],
    [() => physics.streamlines(flowField, [], { maxPoints: -1 }), /^options\.maxPoints must be at least 0/, 'badOption'],
    [() => physics.inflowSeeds({ cells: 8 }, [1, 0, 0], 1), /^grid must be that of a cut-mesh, or have min and max/],
    [() => physics.inflowSeeds({ planes: [[], [0, 1], [0, 1]] }, [1, 0, 0], 1), /^The grid has no cells along x/, 'badGrid'],
    [() => physics.inflowSeeds(grid, [1, 0, NaN], 1), /^The wind is not finite/],
    [() => physics.inflowSeeds(grid, [1, 0, 0], -1), /^count is -1, which is out of range/],
  ];
  for (const [call, message, code] of cases) assertBad(call, message, code);
});

test('progress, and its end', () => {
  const states = [];
  physics.solvePoisson(
    cells,
    { source },
    {
      balance: true,
      progress: (state) => {
        states.push(state);
      },
    },
  );
  assert.ok(states.length > 0 && states.every(({ done, total }) => done <= total));
  assert.throws(() => physics.solvePoisson(cells, { source }, { balance: true, progress: () => false }), { code: 'cancelled' });
  assert.throws(
    () =>
      physics.cellComplex(mesh, cutMesh, octree, {
        progress: () => {
          throw new TypeError('mine');
        },
      }),
    TypeError,
  );
  assert.equal(physics.solvePoisson(cells, { source }, { balance: true }).status, 'converged');
  const seeds = physics.inflowSeeds(cutMesh.grid, [1, 2, 3], 100);
  const stages = new Set();
  physics.streamlines({ mesh, cutMesh, cells, flow }, seeds, {
    progress: ({ stage }) => {
      stages.add(stage);
    },
  });
  assert.deepEqual([...stages], ['seeds', 'streamlines']);
  const call = () => physics.streamlines({ mesh, cutMesh, cells, flow }, seeds, { progress: ({ stage }) => stage === 'seeds' });
  assert.throws(call, { code: 'cancelled', stage: 'streamlines' });
});

test('crossing surfaces', () => {
  const both = join(box([0.2, 0.2, 0.2], [0.7, 0.7, 0.7]), box([0.4, 0.4, 0.4], [0.9, 0.9, 0.9]));
  const made = cut(both, { min: [0, 0, 0], max: [1, 1, 1], cells: [9, 9, 9] });
  const all = physics.cellComplex(both, made, physics.coarsen(made));
  assert.equal(physics.cellComponents(all).count, made.regionCount);
  assertNear([sum(all.cellVolume)], [1], 1e-12);
});
