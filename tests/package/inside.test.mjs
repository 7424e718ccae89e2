// What is inside: by winding numbers, by parity, by estimates; and the boundaries that follow.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init } from 'mandoline-wasm';
import { assertClosed, box, join, sheet, torus, volumeOf } from './meshes.mjs';

const mandoline = await init();
const cube = box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]);
const grid = { min: [0, 0, 0], max: [5, 2, 2], cells: [20, 8, 8] };

/** The mesh without its last triangles. */
const without = ({ positions, triangles }, count) => ({ positions, triangles: triangles.slice(0, -3 * count) });

/** The mesh with its first triangle turned. */
function turned({ positions, triangles }) {
  const [a, b, c, ...others] = triangles;
  return { positions, triangles: Uint32Array.of(a, c, b, ...others) };
}

/** A cube without the side at its top. */
const openCube = without(cube, 2);
const closedBeside = box([3, 0.5, 0.5], [4, 1.5, 1.5]);

/** Whether each of these points is inside. */
function insideAt(cutMesh, points, options) {
  const { isInside } = mandoline.insideRegions(cutMesh, options);
  return [...mandoline.cellsAt(cutMesh, points.flat()).region].map((region) => isInside[region]);
}

const middle = [1, 1, 1];
const outside = [2.5, 1, 1];
const beside = [3.5, 1, 1];

test('by winding numbers, by each rule', () => {
  const overlapping = join(cube, box([0.75, 0.75, 0.75], [1.25, 1.25, 1.25]));
  const cutMesh = mandoline.cut(overlapping, grid);
  const near = [0.6, 0.6, 0.6];
  assert.deepEqual(insideAt(cutMesh, [middle, near, outside]), [1, 1, 0]);
  assert.deepEqual(insideAt(cutMesh, [middle, near, outside], { rule: 'odd' }), [0, 1, 0]);
  const { isInside, ...how } = mandoline.insideRegions(cutMesh);
  assert.deepEqual(how, { by: 'winding', isComplete: true });
  assert.deepEqual(
    isInside,
    Uint8Array.from(cutMesh.regionWinding, (winding) => (winding > 0 ? 1 : 0)),
  );
  const inverted = mandoline.cut({ ...cube, triangles: cube.triangles.slice().reverse() }, grid);
  assert.deepEqual(insideAt(inverted, [middle, outside]), [0, 0]);
  assert.deepEqual(insideAt(inverted, [middle, outside], { rule: 'nonZero' }), [1, 0]);
});

test('by parity, where a triangle is turned', () => {
  const cutMesh = mandoline.cut(turned(cube), grid);
  assert.equal(cutMesh.regionWinding, null);
  assert.deepEqual(insideAt(cutMesh, [middle, outside]), [1, 0]);
  const { by, isComplete } = mandoline.insideRegions(cutMesh);
  assert.deepEqual([by, isComplete], ['parity', true]);
  assert.equal(volumeOf(mandoline.boundary(cutMesh)), 1);
});

test('an open part is left out, unless there is an estimate', () => {
  const mesh = join(openCube, closedBeside);
  const cutMesh = mandoline.cut(mesh, grid);
  assert.deepEqual(insideAt(cutMesh, [middle, outside, beside]), [0, 0, 1]);
  const { by, isComplete } = mandoline.insideRegions(cutMesh);
  assert.deepEqual([by, isComplete], ['winding', false]);
  const estimated = mandoline.estimateInside(mesh, cutMesh);
  assert.deepEqual(insideAt(estimated, [middle, outside, beside]), [1, 0, 1]);
  const { isInside, ...how } = mandoline.insideRegions(estimated);
  assert.deepEqual(how, { by: 'estimate', isComplete: true });
  assert.equal(estimated.regionInsideness.length, estimated.regionCount);
  assert.equal(isInside.length, estimated.regionCount);
});

test('the boundary of a cut-mesh with estimates closes the holes at grid-faces', async () => {
  const mesh = join(openCube, closedBeside);
  const cutMesh = mandoline.cut(mesh, grid);
  const estimated = mandoline.estimateInside(mesh, cutMesh);
  const [closed, all] = [mandoline.boundary(cutMesh), mandoline.boundary(estimated)];
  for (const surface of [closed, all]) assertClosed(surface);
  assert.equal(volumeOf(closed), 1);
  assert.ok(Math.abs(volumeOf(all) - 2) < 0.25); // a layer of grid cells
  assert.ok((await mandoline.validate(mesh, estimated)).pass);
  assert.throws(() => mandoline.estimateInside(mesh, estimated), { code: 'badArgument', stage: 'estimateInside' });
});

test('the boundary of chosen regions', () => {
  const mesh = join(cube, closedBeside);
  const cutMesh = mandoline.cut(mesh, grid);
  const { region } = mandoline.cellAt(cutMesh, beside);
  const flags = Array.from({ length: cutMesh.regionCount }, (_, r) => r === region);
  const expected = mandoline.boundary(mandoline.cut(closedBeside, grid));
  for (const inside of [flags, Uint8Array.from(flags)]) {
    const surface = mandoline.boundary(cutMesh, inside);
    assertClosed(surface);
    assert.deepEqual([volumeOf(surface), surface.triangles.length], [volumeOf(expected), expected.triangles.length]);
  }
  assert.deepEqual(mandoline.boundary(cutMesh, mandoline.insideRegions(cutMesh).isInside), mandoline.boundary(cutMesh));
  assert.throws(() => mandoline.boundary(cutMesh, [true]), {
    code: 'badArgument',
    stage: 'boundary',
    message: /each of the 3, not for 1\.$/,
  });
  assert.throws(() => mandoline.boundary(mandoline.resolve(mesh), flags), { code: 'badArgument', message: /only a cut-mesh has regions/ });
});

test('a threshold moves where an open surface ends', () => {
  const cutMesh = mandoline.cut(openCube, grid);
  const volumes = [0.1, 0.5, 0.8].map((threshold) =>
    volumeOf(mandoline.boundary(mandoline.estimateInside(openCube, cutMesh, { threshold }))),
  );
  assert.ok(volumes[0] > volumes[1] && volumes[1] > volumes[2], volumes.join(', '));
});

test('without a closed part and an estimate nothing is inside, which is said', () => {
  const cutMesh = mandoline.cut(sheet([0.3, 0.3], [1.2, 1.2], 1.1), grid);
  const said = { code: 'badArgument', stage: 'insideRegions', message: /^No part of the mesh is closed.*estimateInside\(\)/ };
  assert.throws(() => mandoline.insideRegions(cutMesh), said);
});

test('without open parts an estimate is a copy, with a twin of its own', () => {
  const { stats: _, gridCellRegion: __, ...cutMesh } = mandoline.cut(cube, grid);
  assert.deepEqual(mandoline.estimateInside(cube, cutMesh), cutMesh);
});

test('generalized winding numbers: 1 inside, 0 outside, a half on the surface, between about a hole', () => {
  const close = (numbers, expected) => expected.forEach((number, i) => assert.ok(Math.abs(numbers[i] - number) < 1e-12, `${numbers[i]}`));
  const points = [...middle, ...outside, 1, 1, 1.5];
  close(mandoline.generalizedWindingNumbers(cube, points), [1, 0, 0.5]);
  close(mandoline.generalizedWindingNumbers(openCube, Float32Array.from(middle)), [5 / 6]);
  assert.equal(mandoline.generalizedWindingNumbers(cube, []).length, 0);
});

test('estimating tells its progress and can be cancelled', () => {
  const mesh = without(torus(40, 20), 30);
  const cutMesh = mandoline.cut(mesh, { cells: 12 });
  const calls = {
    estimateInside: (options) => mandoline.estimateInside(mesh, cutMesh, options),
    generalizedWindingNumbers: (options) => mandoline.generalizedWindingNumbers(mesh, cutMesh.positions, options),
  };
  for (const [name, call] of Object.entries(calls)) {
    const seen = [];
    const whole = call({
      progress: (state) => {
        seen.push(state);
      },
    });
    assert.deepEqual(whole, call());
    assert.ok(seen.length > 0 && seen.every(({ done, total, stageIndex, stageCount }) => done <= total && stageIndex < stageCount), name);
    assert.throws(() => call({ progress: () => false }), { code: 'cancelled', stage: name });
  }
});

test('wrong arguments', () => {
  const cutMesh = mandoline.cut(openCube, grid);
  const refused = (call, code, message) => assert.throws(call, { code, message });
  for (const threshold of [0, 1.1, NaN, -1]) {
    refused(() => mandoline.estimateInside(openCube, cutMesh, { threshold }), 'badOption', /^threshold must be above 0/);
    refused(() => mandoline.insideRegions(cutMesh, { threshold }), 'badOption', /^threshold must be above 0/);
  }
  refused(() => mandoline.insideRegions(cutMesh, { threshold: '1' }), 'badArgument', /^options\.threshold must be a number, not string/);
  refused(() => mandoline.insideRegions(cutMesh, { rule: 'even' }), 'badArgument', /^options\.rule must be "positive", "nonZero" or "odd"/);
  refused(() => mandoline.estimateInside(cube, cutMesh), 'badArgument', /^The mesh is not the one/);
  refused(() => mandoline.generalizedWindingNumbers(cube, [0, 1]), 'badArgument', /^points must have three numbers per point/);
  refused(() => mandoline.generalizedWindingNumbers({ ...cube, triangles: [0, 1, 99] }, [0, 1, 2]), 'badIndex', /^Triangle 0 refers to/);
});
