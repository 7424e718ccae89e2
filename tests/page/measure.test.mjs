// Distances between places of the model.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { box as boxMesh, writeObj } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { enter, eventually, isReady, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { notFinite } from './mesh_files.mjs';
import { covered, pixelsOf, settledPixels } from './pictures.mjs';
import { cutOf, originOf } from './reference.mjs';

const { Measuring } = await importBundled('page/measuring.ts');
const mesh = boxMesh([0, 0, 0], [4, 2, 1]);
const site = await startSite({ files: { 'box.obj': writeObj(mesh) } });
after(() => site.close());
const eye = [2, 1, 12];
const grid = { min: [-1, -1, -1], max: [5, 3, 2], cells: [5, 5, 5] };
const link = `url=${site.meshUrl('box.obj')}&n=5,5,5&box=${grid.min},${grid.max}&free=off&explode=0,0&up=y&camera=${eye},2,1,0`;
const { cutMesh, measures } = await cutOf(mesh, grid);

/** Where a point of the model is on the screen: seen from +z. */
async function onScreen(page, [x, y, z]) {
  const { x: left, y: top, width, height } = await page.locator('#canvas').boundingBox();
  const scale = height / 2 / Math.tan((35 * Math.PI) / 360) / (eye[2] - z);
  return { x: left + width / 2 + scale * (x - eye[0]), y: top + height / 2 - scale * (y - eye[1]), scale };
}

async function click(page, point, [right, down] = [0, 0]) {
  const { x, y } = await onScreen(page, point);
  await page.mouse.click(x + right, y + down);
}

/** What the fields say, which are rounded to 5 digits. */
async function placeIs(page, end, expected, error = 1e-4) {
  await eventually(async () => {
    const place = await Promise.all(['x', 'y', 'z'].map((axis) => page.locator(`#measure-${end}-${axis}`).inputValue()));
    const off = place.map((x, d) => Math.abs(Number(x) - expected[d]));
    assert.ok(place.every((x) => x !== '') && Math.max(...off) <= error, `${place} instead of ${expected}`);
  });
}

/** Without what the pointer lights. */
async function restingPixels(page) {
  const { x, y } = await page.locator('#canvas').boundingBox();
  await page.mouse.move(x + 5, y + 5);
  await shows(page, '#hover-line', { cell: '' });
  return settledPixels(page);
}

const lengthOf = (page) => page.locator('#measure-line strong').getAttribute('data-length').then(Number);
const asks = (page, words) => eventually(async () => assert.match(await textOf(page, '#measure-line'), words));

test('two places are touched: corners that are near, and where a face is met; Escape and a new cut end that', async (t) => {
  const page = await site.open(t, link.replace('explode=0,0', 'explode=0.1,0'), { panels: ['measure'] });
  await page.locator('#canvas').focus();
  await page.keyboard.press('m');
  await asks(page, /two places/);
  assert.equal(await page.locator('#explode-cells').inputValue(), '0', 'nothing is pulled apart');
  const before = await restingPixels(page);
  await click(page, [0, 2, 1], [4, 3]);
  await placeIs(page, 'from', [0, 2, 1], 0);
  await asks(page, /where the distance ends/);
  await click(page, [4, 0, 1], [-4, -3]);
  await placeIs(page, 'to', [4, 0, 1], 0);
  assert.ok(Math.abs((await lengthOf(page)) - Math.sqrt(20)) < 1e-6);
  assert.match(await textOf(page, '#measure-line'), /4\.472 x 4 y −2 z 0/);
  const drawn = await restingPixels(page);
  assert.notDeepEqual(drawn.rgba, before.rgba, 'it is drawn');
  assert.equal(await page.locator('#cell-card').isVisible(), false, 'no cell is pinned');

  const { planes } = cutMesh.grid;
  const inFace = [0.5, 0.45, 0].map((share, d) => (d === 2 ? 1 : planes[d][2] + share * (planes[d][3] - planes[d][2])));
  await click(page, inFace);
  await asks(page, /where the distance ends/);
  const { scale } = await onScreen(page, inFace);
  await placeIs(page, 'from', inFace, 1.5 / scale);
  assert.equal(await page.locator('#measure-from-z').inputValue(), '1');
  await page.keyboard.press('Escape');
  await eventually(async () => assert.equal(await page.locator('#measure-line').isVisible(), false));
  assert.deepEqual((await restingPixels(page)).rgba, before.rgba, 'nothing else was');
  await click(page, inFace);
  await eventually(async () => assert.ok(await page.locator('#cell-card').isVisible()));
  await page.keyboard.press('Escape');

  await page.locator('#measure-on').click();
  await click(page, inFace);
  await placeIs(page, 'from', inFace, 1.5 / scale);
  await enter(page, '#measure-to-x', 1);
  await slideTo(page, '#cells', 9);
  await isReady(page);
  await asks(page, /two places/);
  assert.equal(await page.locator('#measure-from-x').inputValue(), '');
});

test('cells that are pulled apart, flat cuts and untouched cells are met where they are drawn and measured where they were', async (t) => {
  const page = await site.open(t, link, { panels: ['measure', 'view'] });
  await page.locator('#measure-on').click();
  await slideTo(page, '#explode-cells', 0.2);
  const corner = [0, 2, 1];
  const origin = originOf(cutMesh);
  const cell = Array.from(cutMesh.cellRegion.keys()).find((id) => {
    const isThere = [0, 1, 2].every((d) => {
      const [low, high] = cutMesh.grid.planes[d].subarray(cutMesh.cellGridCell[3 * id + d], cutMesh.cellGridCell[3 * id + d] + 2);
      return low < corner[d] && corner[d] < high;
    });
    return isThere && cutMesh.regionWinding[cutMesh.cellRegion[id]] === 1;
  });
  const moved = corner.map((x, d) => x + 0.2 * (measures.cellCentroid[3 * cell + d] - origin[d]));
  await settledPixels(page);
  await click(page, moved, [2, 2]);
  await placeIs(page, 'from', corner, 0);

  await slideTo(page, '#explode-cells', 0);
  await page.locator('#slice-mode-flat').check();
  await page.locator('#slice-z').check();
  const middle = [2.1, 1.1, 0.5];
  await settledPixels(page);
  await click(page, middle);
  await placeIs(page, 'to', middle, 0.03);
  assert.equal(Number(await page.locator('#measure-to-z').inputValue()), 0.5, 'in the plane');
  await page.locator('#slice-mode-whole').check();
  await slideTo(page, '#slice-z-position', 0.55);
  await settledPixels(page);
  await click(page, middle);
  await asks(page, /where the distance ends/);
  await placeIs(page, 'from', [2.1, 1.1, 0.8], 0.1);
  assert.equal(await page.locator('#measure-from-z').inputValue(), '0.8', 'on the side of an untouched grid cell');
});

test('where only the end is known, the beginning is asked for and taken next', async (t) => {
  const page = await site.open(t, link, { panels: ['measure', 'view'] });
  await enter(page, '#pin-number', 3);
  await shows(page, '#cell-card', { cell: 3 });
  await page.locator('#measure-to-pinned').click();
  await asks(page, /where the distance begins/);
  await settledPixels(page);
  await click(page, [0, 2, 1], [4, 3]);
  await placeIs(page, 'from', [0, 2, 1], 0);
  const [x, y, z] = measures.cellCentroid.subarray(9, 12);
  await placeIs(page, 'to', [x, y, z]);
  assert.ok(Math.abs((await lengthOf(page)) / Math.hypot(x, y - 2, z - 1) - 1) < 1e-6);
});

test('the middle of a cell moves as its region does', () => {
  const measurement = { value: null, peek: () => measurement.value };
  const measuring = new Measuring({ model: { value: { origin: [1, 2, 3] } }, measurement }, { setMeasurement() {} });
  measuring.set('from', [4, 4, 4], 5);
  assert.deepEqual(measurement.value, { from: { point: [4, 4, 4], middle: [3, 2, 1], region: 5 }, to: null });
});

test('by keys: typed coordinates, and the middle of the pinned cell', async (t) => {
  const page = await site.open(t, link, { panels: ['measure', 'view'] });
  for (const [axis, value] of Object.entries({ x: 0.5, y: 1, z: -1 })) await enter(page, `#measure-from-${axis}`, value);
  await asks(page, /where the distance ends/);
  await enter(page, '#pin-number', 3);
  await shows(page, '#cell-card', { cell: 3 });
  await page.locator('#measure-to-pinned').focus();
  await page.keyboard.press('Enter');
  const centroid = measures.cellCentroid.subarray(9, 12);
  await placeIs(page, 'to', centroid);
  const expected = Math.hypot(centroid[0] - 0.5, centroid[1] - 1, centroid[2] + 1);
  assert.ok(Math.abs((await lengthOf(page)) / expected - 1) < 1e-12);
  await enter(page, '#measure-to-y', 7);
  const changed = Math.hypot(centroid[0] - 0.5, 7 - 1, centroid[2] + 1);
  await eventually(async () => assert.ok(Math.abs((await lengthOf(page)) / changed - 1) < 1e-12));
  const drawn = await settledPixels(page);
  await page.locator('#measure-end').click();
  await eventually(async () => assert.notDeepEqual((await pixelsOf(page)).rgba, drawn.rgba));
});

test('where nothing is shown there is nothing to measure: the distance goes with the picture, and the key does nothing', async (t) => {
  const page = await site.open(t, link, { panels: ['measure'] });
  for (const end of ['from', 'to']) {
    for (const [axis, value] of Object.entries({ x: end === 'to' ? 4 : 0, y: 1, z: 0.5 }))
      await enter(page, `#measure-${end}-${axis}`, value);
  }
  await page.locator('#file').setInputFiles({ name: 'not-finite.obj', mimeType: 'text/plain', buffer: Buffer.from(writeObj(notFinite)) });
  await page.locator('#stage-note').waitFor();
  await eventually(async () => assert.ok(covered(await pixelsOf(page)) < 0.001, 'the line is gone'));
  const explode = await page.locator('#explode-cells').inputValue();
  await page.locator('#canvas').focus();
  await page.keyboard.press('m');
  assert.equal(await page.locator('#measure-line').isVisible(), false);
  assert.equal(await page.locator('#explode-cells').inputValue(), explode);
});

test('a touch that a slow GPU answers after the end of measuring does not begin it again', async (t) => {
  const page = await site.open(t, link, { panels: ['measure'] });
  await settledPixels(page);
  await page.locator('#measure-on').click();
  const middle = [2.1, 1.1, 1];
  await page.evaluate(() => {
    const { clientWaitSync, fenceSync, TIMEOUT_EXPIRED } = WebGL2RenderingContext.prototype;
    window.isBehind = true;
    WebGL2RenderingContext.prototype.clientWaitSync = function (...given) {
      return window.isBehind ? TIMEOUT_EXPIRED : clientWaitSync.apply(this, given);
    };
    window.fences = 0;
    WebGL2RenderingContext.prototype.fenceSync = function (...given) {
      window.fences++;
      return fenceSync.apply(this, given);
    };
  });
  await click(page, middle);
  await page.waitForFunction(() => window.fences > 0);
  await page.keyboard.press('Escape');
  await page.evaluate(() => (window.isBehind = false));
  await click(page, middle);
  await page.locator('#cell-card').waitFor();
  assert.equal(await page.locator('#measure-line').isVisible(), false);
});
