// Voxels and marching cubes beside cut-cells.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assertClosed, box, torus } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const { comparison } = await importBundled('worker/compare/index.ts');
const { cubeCases, cubeEdges } = await importBundled('worker/compare/marching_cubes.ts');

const cases = {
  torus: [torus(48, 24), { cells: 12 }],
  bunny: [await galleryMesh('bunny'), { cells: 16 }],
  'nested-spheres': [await galleryMesh('nested-spheres'), { cells: 14 }],
};

async function compared([mesh, grid], way) {
  const { cutMesh, measures } = await cutOf(mesh, grid);
  const origin = [0.1, 0.2, 0.3];
  return { cutMesh, measures, result: comparison(mandoline, { mesh, cutMesh, origin, measures: null }, way) };
}

test('each case of marching cubes parts the corners inside from the others, and cubes side by side agree', () => {
  assert.equal(cubeCases.length, 256);
  cubeCases.forEach((edges, inside) => {
    const crossed = cubeEdges.flatMap(([a, b], edge) => (((inside >> a) ^ (inside >> b)) & 1 ? [edge] : []));
    assert.deepEqual(
      [...new Set(edges)].sort((a, b) => a - b),
      crossed,
      `case ${inside}`,
    );
  });
  assert.equal(
    cubeCases.reduce((sum, edges) => sum + edges.length / 3, 0),
    820,
  );
});

for (const [name, given] of Object.entries(cases)) {
  test(`${name}: the exact numbers are those of measure()`, async () => {
    const { cutMesh, measures, result } = await compared(given, 'voxels');
    const inside = measures.regionVolume.filter((_, region) => cutMesh.regionWinding[region] !== 0);
    assert.equal(
      result.exact.volume,
      inside.reduce((sum, x) => sum + x, 0),
    );
    const { faceCells } = mandoline.adjacency(cutMesh);
    const isIn = (cell) => cell >= 0 && cutMesh.regionWinding[cutMesh.cellRegion[cell]] !== 0;
    let area = 0;
    measures.faceArea.forEach((x, face) => {
      if (cutMesh.faceTriangle[face] >= 0 && isIn(faceCells[2 * face]) !== isIn(faceCells[2 * face + 1])) area += x;
    });
    assert.ok(Math.abs(result.exact.area - area) < 1e-9 * area);
  });

  test(`${name}: voxels are the grid cells whose middle is inside`, async () => {
    const { cutMesh, result } = await compared(given, 'voxels');
    const { planes, cells } = cutMesh.grid;
    const points = [];
    for (let k = 0; k < cells[2]; ++k)
      for (let j = 0; j < cells[1]; ++j)
        for (let i = 0; i < cells[0]; ++i) points.push(...[i, j, k].map((c, d) => (planes[d][c] + planes[d][c + 1]) / 2));
    // By sums of solid angles, which know nothing of cells.
    const counted = mandoline.generalizedWindingNumbers(given[0], points).filter((winding) => Math.round(winding) !== 0).length;
    const size = planes.reduce((product, axis) => product * (axis[1] - axis[0]), 1);
    assert.ok(Math.abs(result.other.volume - counted * size) < 1e-9 * result.other.volume);
    assertClosed({ triangles: result.index });
  });

  test(`${name}: the surface of marching cubes is closed, on the mesh, and nearer to its area than voxels`, async () => {
    const { cutMesh, result } = await compared(given, 'cubes');
    assertClosed({ triangles: result.index });
    const points = Float64Array.from(result.position, (x, at) => x + [0.1, 0.2, 0.3][at % 3]);
    const { cell } = mandoline.cellsAt(cutMesh, points);
    assert.ok(
      cell.every((id) => id >= 0),
      'all of its vertices lie in cut-cells',
    );
    const voxels = (await compared(given, 'voxels')).result;
    const off = ({ other, exact }) => Math.abs(other.area / exact.area - 1);
    assert.ok(off(result) < off(voxels), `${off(result)}, of voxels ${off(voxels)}`);
  });
}

test('a box on grid planes is what voxels make of it', async () => {
  const { result } = await compared([box([1, 1, 1], [3, 2, 2]), { min: [0, 0, 0], max: [4, 4, 4], cells: [4, 4, 4] }], 'voxels');
  assert.deepEqual(result.other, { volume: 2, area: 10 });
  assert.deepEqual(result.exact, { volume: 2, area: 10 });
});
