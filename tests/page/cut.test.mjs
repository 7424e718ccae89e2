import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { torus, writeObj } from '../package/meshes.mjs';
import { dataOf, enter, eventually, isReady, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { looksLike } from './pictures.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const mesh = torus(24, 12);
const site = await startSite({ files: { 'torus.obj': writeObj(mesh) } });
after(() => site.close());
const link = (rest) => `url=${encodeURIComponent(site.meshUrl('torus.obj'))}&up=y&explode=0,0&${rest}`;

function countsOf({ cutMesh }) {
  return {
    grid: cutMesh.grid.cells.join('x'),
    cutCells: cutMesh.cellRegion.length,
    faces: cutMesh.faceTriangle.length,
    vertices: cutMesh.positions.length / 3,
    regions: cutMesh.regionCount,
  };
}

test('the resolution by keyboard', async (t) => {
  const page = await site.open(t, link('n=8'));
  await page.locator('#cells').focus();
  for (let press = 0; press < 5; ++press) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#cells').inputValue(), '12');
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 12 })));
  assert.equal(await page.locator('#cells-number').inputValue(), '12');
  await page.keyboard.press('Home');
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 1 })));
});

test('the resolution by number, also beyond the slider; what is out of range is refused', async (t) => {
  const page = await site.open(t, link('n=8'));
  await enter(page, '#cells-number', 21);
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 21 })));
  const { model } = await dataOf(page, '#counts');
  await enter(page, '#cells-number', 0);
  assert.equal(await page.locator('#cells-number').evaluate((input) => input.validity.valid), false);
  assert.deepEqual(await dataOf(page, '#counts').then((data) => data.model), model);
});

test('dragging the slider cuts all along, and the last place wins', async (t) => {
  const page = await site.open(t, 'mesh=bunny&n=10&free=off&explode=0,0');
  const slider = page.locator('#cells');
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await slider.boundingBox();
  const models = async () => Number((await dataOf(page, '#counts')).model);
  const first = await models();
  const at = (cells) => x + 8 + ((width - 16) * (cells - 1)) / 127;
  await page.mouse.move(at(10), y + height / 2);
  await page.mouse.down();
  for (let cells = 12; cells <= 30; cells += 2) await page.mouse.move(at(cells), y + height / 2);
  await eventually(async () => assert.ok((await models()) > first, 'cut while the button is down'));
  for (let cells = 30; cells >= 20; cells -= 2) await page.mouse.move(at(cells), y + height / 2);
  await page.mouse.up();
  const cells = Number(await slider.inputValue());
  assert.ok(Math.abs(cells - 20) <= 2, `the slider stands at ${cells}`);
  await shows(page, '#counts', countsOf(await cutOf(await galleryMesh('bunny'), { cells })));
  assert.equal(await isReady(page), 'ready');
});

test('of many resolutions at once the newest wins', async (t) => {
  const page = await site.open(t, link('n=8'));
  for (const cells of [60, 9, 70, 40, 14]) await slideTo(page, '#cells', cells);
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 14 })));
  assert.equal(await isReady(page), 'ready');
  assert.equal(await page.locator('#cells-number').inputValue(), '14');
});

test('after a large cut and a small one another thread goes on: memory that grew does not stay', async (t) => {
  const page = await site.open(t, link('n=8'));
  const threads = page.workers();
  await enter(page, '#cells-number', 190);
  await eventually(async () => assert.equal((await dataOf(page, '#canvas')).model, '2'), 120_000);
  assert.ok(threads.every((thread) => page.workers().includes(thread)));
  await enter(page, '#cells-number', 9);
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 9 })));
  await eventually(() => assert.ok(threads.some((thread) => !page.workers().includes(thread))));
  await enter(page, '#cells-number', 10);
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 10 })));
});

test('a custom grid', async (t) => {
  const page = await site.open(t, link('n=8'));
  await page.locator('#custom-grid summary').click();
  const grid = { min: [-2, -1.75, -0.5], max: [1.5, 2, 0.625], cells: [7, 5, 3] };
  for (const key of ['min', 'max', 'cells']) {
    for (const [d, axis] of ['x', 'y', 'z'].entries()) await enter(page, `#grid-${key}-${axis}`, grid[key][d]);
  }
  await shows(page, '#counts', countsOf(await cutOf(mesh, grid)));
  await looksLike(page, 'torus in a grid of its own');
  await page.locator('#grid-cubic').click();
  await shows(page, '#counts', countsOf(await cutOf(mesh, { cells: 7 })));
  assert.equal(await page.locator('#grid-cubic').isDisabled(), true);
});

test('a number entered while an earlier grid is being cut stays', async (t) => {
  const page = await site.open(t, link('n=8'));
  await page.locator('#custom-grid summary').click();
  await page.evaluate(() => {
    const set = (field, value) => {
      const input = document.querySelector(`#grid-${field}`);
      input.value = String(value);
      input.dispatchEvent(new Event('change'));
    };
    const nextModel = () =>
      new Promise((resolve) => {
        new MutationObserver(resolve).observe(document.querySelector('#counts'), { attributeFilter: ['data-model'] });
      });
    const cut = nextModel();
    set('min-x', -2);
    set('max-x', 2.5);
    return cut.then(() => set('cells-x', 9));
  });
  await shows(page, '#counts', { grid: '9x8x3' });
  assert.equal(await isReady(page), 'ready');
  assert.equal(await page.locator('#grid-min-x').inputValue(), '-2');
  assert.equal(await page.locator('#grid-max-x').inputValue(), '2.5');
});

test('a box turned inside out, and a grid too fine, are refused', async (t) => {
  const page = await site.open(t, link('n=8'));
  const former = await dataOf(page, '#counts');
  await page.locator('#custom-grid summary').click();
  await enter(page, '#grid-min-x', 5);
  await eventually(async () => assert.match(await textOf(page, '#cut-error'), /grid|box/i));
  await enter(page, '#grid-min-x', -2);
  await eventually(async () => assert.equal(await page.locator('#cut-error').isVisible(), false));
  for (const axis of ['x', 'y', 'z']) await enter(page, `#grid-cells-${axis}`, 4096);
  await eventually(async () => assert.match(await textOf(page, '#cut-error'), /too fine/));
  await enter(page, '#cells-number', 8);
  await shows(page, '#counts', { cutCells: former.cutCells });
  assert.notEqual(former.model, undefined);
});

test('cubic cells have the same limit', async (t) => {
  const page = await site.open(t, 'mesh=crate&n=9&free=off');
  const former = await dataOf(page, '#counts');
  await enter(page, '#cells-number', 512);
  await eventually(async () => assert.match(await textOf(page, '#cut-error'), /too fine.*cells; this page draws up to 16,777,216/));
  assert.equal(await isReady(page), 'error');
  await enter(page, '#cells-number', 9);
  await shows(page, '#counts', { cutCells: former.cutCells });
});

test('the snap tolerance', async (t) => {
  const page = await site.open(t, link('n=8'));
  await page.locator('#custom-grid summary').click();
  await enter(page, '#snap', 0.2);
  const snapped = await cutOf(mesh, { cells: 8 }, { snapTolerance: 0.2 });
  assert.notDeepEqual(countsOf(snapped), countsOf(await cutOf(mesh, { cells: 8 })));
  await shows(page, '#counts', countsOf(snapped));
  await page.getByText('Stages and details').click();
  assert.match(await textOf(page, '#left-out'), new RegExp(`${snapped.cutMesh.stats.snappedVertices} vertices snapped`));
});

test('a long cut says how far it is, and can be cancelled', async (t) => {
  const page = await site.open(t, 'mesh=bunny&n=8&free=off&explode=0,0');
  const former = await dataOf(page, '#counts');
  const stages = await page.evaluateHandle(() => {
    const seen = [];
    const bar = document.querySelector('#progress progress');
    new MutationObserver(() => seen.push(bar.value)).observe(bar, { attributes: true });
    return seen;
  });
  await enter(page, '#cells-number', 250);
  await page.locator('#cancel').waitFor();
  await eventually(async () => assert.ok((await stages.evaluate((seen) => Math.max(0, ...seen))) > 0, 'there is progress'));
  await page.locator('#cancel').click();
  assert.equal(await isReady(page), 'ready');
  assert.equal(await page.locator('#progress').isVisible(), false);
  assert.deepEqual(await dataOf(page, '#counts'), former);
  assert.equal(await page.locator('#cells').inputValue(), '8');
  await slideTo(page, '#cells', 9);
  await shows(page, '#counts', countsOf(await cutOf(await galleryMesh('bunny'), { cells: 9 })));
});

test('the stages and their times', async (t) => {
  const page = await site.open(t, link('n=8'));
  await page.getByText('Stages and details').click();
  const { cutMesh } = await cutOf(mesh, { cells: 8 });
  const { stages } = mandoline.cut(mandoline.prepare(mesh), { cells: 8 }).stats; // the page prepares a mesh once
  assert.equal(await page.locator('#stage-times tr').count(), stages.length);
  assert.match(await textOf(page, '#cut-details'), new RegExp(`vertices ${(cutMesh.positions.length / 3).toLocaleString('en')} `));
  const edges = mandoline.cutEdges(mesh, cutMesh).edgeLength.length;
  const counted = new RegExp(` edges ${edges.toLocaleString('en')} `);
  await eventually(async () => assert.match(await textOf(page, '#cut-details'), counted));
});
