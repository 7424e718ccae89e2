// Volumes and centroids for the picture beside the package's measures.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { box } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const { cellShapes } = await importBundled('worker/cell_shapes.ts');
const origin = [0.1, -0.2, 0.3];

const cases = {
  bunny: [await galleryMesh('bunny'), { cells: 16 }],
  'noisy-sphere': [await galleryMesh('noisy-sphere'), { cells: 8 }],
  'double-bubble': [await galleryMesh('double-bubble'), { cells: 12 }],
  'nested-spheres': [await galleryMesh('nested-spheres'), { cells: 10 }],
};
for (const [name, [mesh, grid]] of Object.entries(cases)) {
  test(`${name}: as measured, to the digits of a picture`, async () => {
    const { cutMesh, measures } = await cutOf(mesh, grid);
    const { volume, centroid } = cellShapes(cutMesh, mandoline.triangulate(cutMesh), origin);
    const size = cutMesh.grid.spacing[0];
    volume.forEach((x, cell) => assert.ok(Math.abs(x - measures.cellVolume[cell]) < 1e-11 * size ** 3, `volume of cell ${cell}`));
    const off = centroid.findIndex((x, at) => !(Math.abs(x + origin[at % 3] - measures.cellCentroid[at]) < 1e-5 * size));
    assert.equal(off, -1, `centroid of cell ${Math.floor(off / 3)}`);
  });
}

test('a cell 1e-13 thin has a centroid within it', async () => {
  const mesh = box([0.25, 0.25, 0.25], [1 + 1e-13, 1.75, 1.75]);
  const { cutMesh, measures } = await cutOf(mesh, { min: [0, 0, 0], max: [2, 2, 2], cells: [2, 2, 2] });
  const { volume, centroid } = cellShapes(cutMesh, mandoline.triangulate(cutMesh), [1, 1, 1]);
  const thin = measures.cellVolume.findIndex((x) => x < 1e-12);
  assert.ok(thin >= 0);
  assert.ok(volume.every((x) => x >= 0));
  for (let d = 0; d < 3; ++d) assert.ok(Math.abs(centroid[3 * thin + d] + 1 - measures.cellCentroid[3 * thin + d]) < 0.25, `axis ${d}`);
});
