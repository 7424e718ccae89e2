import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { writeObj } from '../package/meshes.mjs';
import { dataOf, enter, eventually, shows, startSite, textOf } from './page_helpers.mjs';
import { covered, isBlue, isOrange, pixelsOf, settledPixels, share } from './pictures.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const knot = await galleryMesh('torus-knot');
const spheres = await galleryMesh('nested-spheres');
const site = await startSite({ files: { 'knot.obj': writeObj(knot), 'spheres.obj': writeObj(spheres) } });
after(() => site.close());
const camera = { position: [0, 0, 14], fieldOfView: 35 };
const link = `url=${site.meshUrl('knot.obj')}&n=8&free=off&explode=0,0&camera=0,0,14,0,0,0`;
const reference = await cutOf(knot, { cells: 8 });
const { cutMesh, measures } = reference;
const adjacency = mandoline.adjacency(cutMesh);
const real = (x) => String(Number(x.toPrecision(4)));

/** Where a point of the model, as seen from +z, is on the screen. */
function project([x, y, z], box) {
  const scale = box.height / 2 / Math.tan((camera.fieldOfView * Math.PI) / 360) / (camera.position[2] - z);
  return [box.x + box.width / 2 + scale * x, box.y + box.height / 2 - scale * y, scale];
}

/** Inner cells by how far they are in front. */
function frontCells() {
  const inner = Array.from(cutMesh.cellRegion.keys()).filter((cell) => cutMesh.regionWinding[cutMesh.cellRegion[cell]] === 1);
  return inner.sort((a, b) => measures.cellCentroid[3 * b + 2] - measures.cellCentroid[3 * a + 2]);
}

/** Hovers over cells in front until one is under the pointer. */
async function hoverCell(page) {
  const box = await page.locator('#canvas').boundingBox();
  for (const cell of frontCells().slice(0, 40)) {
    const [x, y, scale] = project(measures.cellCentroid.subarray(3 * cell, 3 * cell + 3), box);
    await page.mouse.move(x, y);
    const found = await eventually(async () => {
      const { cell: hovered } = await dataOf(page, '#hover-line');
      assert.notEqual(hovered ?? '', '');
      return Number(hovered);
    }, 3000).catch(() => null);
    if (found !== null) return { cell: found, x, y, scale, box };
  }
  return assert.fail('no cell lies under the pointer');
}

/** What the card has to say, from the arrays of the cut. */
function factsOf(cell) {
  const [begin, end] = cutMesh.cellHalfFaceOffsets.subarray(cell, cell + 2);
  const halfFaces = Array.from(cutMesh.cellHalfFaces.subarray(begin, end), (h) => h >> 1);
  const vertices = new Set();
  for (const face of halfFaces) {
    const [first, last] = [cutMesh.faceLoopOffsets[face], cutMesh.faceLoopOffsets[face + 1]];
    for (const vertex of cutMesh.loopVertices.subarray(cutMesh.loopOffsets[first], cutMesh.loopOffsets[last])) vertices.add(vertex);
  }
  const neighbours = Array.from(adjacency.cellCells.subarray(adjacency.cellCellOffsets[cell], adjacency.cellCellOffsets[cell + 1]));
  const region = cutMesh.cellRegion[cell];
  return {
    facts: [
      `grid cell ${Array.from(cutMesh.cellGridCell.subarray(3 * cell, 3 * cell + 3)).join(', ')} `,
      `region ${region} `,
      `winding number ${cutMesh.regionWinding[region]} `,
      `volume ${real(measures.cellVolume[cell])} `,
      `faces ${halfFaces.length}, ${halfFaces.filter((face) => cutMesh.faceTriangle[face] >= 0).length} of them on the surface`,
      `vertices ${vertices.size} `,
    ],
    neighbours,
  };
}

async function cardIs(page, cell) {
  await shows(page, '#cell-card', { cell });
  const { facts, neighbours } = factsOf(cell);
  const text = await textOf(page, '#cell-card');
  assert.match(text, new RegExp(`Cell ${cell}\\b`));
  for (const fact of facts) assert.ok(text.includes(fact), `"${text}" says "${fact}"`);
  assert.ok(text.includes(`Neighbours: ${neighbours.length} cut-cell`), text);
  assert.deepEqual((await page.locator('#cell-card .neighbours button').allInnerTexts()).map(Number), neighbours);
}

test('hovering tells the cell under the pointer and lights it up', async (t) => {
  const page = await site.open(t, link);
  const before = await settledPixels(page);
  const { cell, x, y, scale, box } = await hoverCell(page);
  const [cellX, cellY] = project(measures.cellCentroid.subarray(3 * cell, 3 * cell + 3), box);
  const reach = scale * Math.hypot(...[0, 1].map((d) => cutMesh.grid.spacing[d]));
  assert.ok(Math.hypot(cellX - x, cellY - y) < reach, 'its centroid is near the pointer');
  const region = cutMesh.cellRegion[cell];
  const words = `Cell ${cell} · region ${region} · winding ${cutMesh.regionWinding[region]} · volume ${real(measures.cellVolume[cell])}`;
  assert.ok((await textOf(page, '#hover-line')).includes(words));
  await eventually(async () => assert.notDeepEqual((await pixelsOf(page)).rgba, before.rgba));
  await page.mouse.move(box.x + 5, box.y + box.height / 2);
  await shows(page, '#hover-line', { cell: '' });
  const summary = `knot.obj · ${cutMesh.grid.cells.join(' × ')} grid · ${cutMesh.cellRegion.length} cut-cells`;
  assert.ok((await textOf(page, '#hover-line')).startsWith(summary));
});

test('a click pins a cell; its card, its neighbours, Escape', async (t) => {
  const page = await site.open(t, link);
  const { cell, x, y } = await hoverCell(page);
  await page.mouse.click(x, y);
  await cardIs(page, cell);
  const [neighbour] = factsOf(cell).neighbours;
  await page.locator('#cell-card .neighbours button').first().click();
  await cardIs(page, neighbour);
  await page.keyboard.press('Escape');
  await eventually(async () => assert.equal(await page.locator('#cell-card').isVisible(), false));
  await page.mouse.click(x, y);
  await cardIs(page, cell);
  await page.locator('#unpin').click();
  await eventually(async () => assert.equal(await page.locator('#cell-card').isVisible(), false));
});

test('a cell by its number, drawn alone and turned by keys', async (t) => {
  const page = await site.open(t, link);
  const [cell] = frontCells();
  await enter(page, '#pin-number', cell);
  await cardIs(page, cell);
  const alone = await eventually(async () => {
    const picture = await pixelsOf(page, '.cell-canvas');
    assert.ok(covered(picture) > 0.08, `${covered(picture)} of the viewer is drawn on`);
    assert.ok(share(picture, isOrange) > 0.01 && share(picture, isBlue) > 0.01, 'both kinds of faces are seen');
    return picture;
  });
  await page.locator('.cell-canvas').focus();
  for (let press = 0; press < 4; ++press) await page.keyboard.press('ArrowRight');
  await eventually(async () => assert.notDeepEqual((await pixelsOf(page, '.cell-canvas')).rgba, alone.rgba));
});

test('a cavity is counted', async (t) => {
  const page = await site.open(t, `url=${site.meshUrl('spheres.obj')}&n=6&free=off`);
  const { cutMesh: nested } = await cutOf(spheres, { cells: 6 });
  // The smallest sphere floats inside one grid cell, so the cell around it has the sphere's region as its only neighbour beyond its
  // grid-faces.
  const smallest = Array.from(nested.cellRegion.keys()).filter((cell) => nested.cellRegion[cell] === nested.regionCount - 1);
  const cells = smallest.length === 1 ? smallest : [];
  assert.equal(cells.length, 1, 'the smallest sphere is one cell');
  const around = mandoline.adjacency(nested);
  const [outer] = around.cellCells.subarray(around.cellCellOffsets[cells[0]], around.cellCellOffsets[cells[0] + 1]);
  await enter(page, '#pin-number', outer);
  await shows(page, '#cell-card', { cell: outer });
  assert.match(await textOf(page, '#cell-card'), /cavities 1\b/);
});

test('a cut anew lets go of the pinned cell', async (t) => {
  const page = await site.open(t, link);
  await enter(page, '#pin-number', 3);
  await shows(page, '#cell-card', { cell: 3 });
  await enter(page, '#cells-number', 9);
  await eventually(async () => assert.equal(await page.locator('#cell-card').isVisible(), false));
});

test('a tap pins, a swipe turns', async (t) => {
  const page = await site.open(t, link, { hasTouch: true });
  const { cell, x, y, box } = await hoverCell(page);
  await page.mouse.move(box.x + 5, box.y + 5);
  await page.touchscreen.tap(x, y);
  await cardIs(page, cell);
  await page.keyboard.press('Escape');
  const before = await settledPixels(page);
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  await touch('touchStart', [{ x, y }]);
  for (let step = 1; step <= 6; ++step) await touch('touchMove', [{ x: x + 15 * step, y }]);
  await touch('touchEnd', []);
  await eventually(async () => assert.notDeepEqual((await pixelsOf(page)).rgba, before.rgba));
  assert.equal(await page.locator('#cell-card').isVisible(), false);
});
