// What is inside of meshes that are not closed and consistently oriented, and what the page says tells it.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { torus, writeObj } from '../package/meshes.mjs';
import { eventually, openPanel, shows, startSite, textOf } from './page_helpers.mjs';
import { cutOf, mandoline } from './reference.mjs';

const closed = torus(32, 16);
/** With a hole of 20 triangles. */
const open = { ...closed, triangles: closed.triangles.slice(60) };
const [a, b, c, ...others] = closed.triangles;
const turned = { ...closed, triangles: Uint32Array.of(a, c, b, ...others) };
const files = { 'open.obj': writeObj(open), 'turned.obj': writeObj(turned), 'closed.obj': writeObj(closed) };

let site;
before(async () => {
  site = await startSite({ files });
});
after(() => site.close());

const link = (name) => `url=${encodeURIComponent(site.meshUrl(name))}&n=12&free=off`;
const entries = (page) => page.locator('#legend .entry').allInnerTexts();

/** Numbers of the cells in regions inside, and of the others. */
function sides(cutMesh) {
  const { isInside } = mandoline.insideRegions(cutMesh, { rule: 'nonZero' });
  const cells = [...cutMesh.cellRegion.keys()];
  return [1, 0].map((side) => cells.filter((cell) => isInside[cutMesh.cellRegion[cell]] === side));
}

test('an open mesh has an inside by an estimate, and its outside is hidden', async (t) => {
  const page = await site.open(t, link('open.obj'));
  const { cutMesh } = await cutOf(open, { cells: 12 });
  assert.equal(cutMesh.regionCount, 1);
  const [inner, outer] = sides(mandoline.estimateInside(open, cutMesh));
  assert.ok(inner.length > 100 && outer.length > 100);
  await shows(page, '#counts', { regions: 2 });
  await shows(page, '#canvas', { cells: inner.length });
  assert.equal(await page.locator('#show-outside').isChecked(), false);
  await page.locator('#show-outside').check();
  await shows(page, '#canvas', { cells: cutMesh.cellRegion.length });

  assert.match(await textOf(page, '#legend'), / inside by an estimate$/);
  assert.match(await textOf(page, '#counts'), / inside by an estimate time /);
  await page.getByText('Stages and details').click();
  assert.match(await textOf(page, '#left-out'), /1 of 1 part open, with \d+ open edges around 1 hole: inside by an estimate/);
  assert.match(await textOf(page, '#stage-times'), / Estimate of inside /);
  await page.locator('#color-by').selectOption('winding');
  await eventually(async () => assert.deepEqual(await entries(page), ['winding number 0, estimated', 'winding number 1, estimated']));
  const options = await page.locator('#region option').allTextContents();
  assert.deepEqual(options.map((option) => option.match(/(in|out)side by an estimate: −?[01]/)?.[1]).sort(), ['in', 'out', undefined]);
  await openPanel(page, 'view');
  await page.locator('#pin-number').fill(String(inner[0]));
  await page.locator('#pin-number').press('Enter');
  await eventually(async () => assert.match(await textOf(page, '#cell-card'), /side inside by an estimate: (1|0\.9)/));
});

test('a mesh with a turned triangle has an inside by parity', async (t) => {
  const page = await site.open(t, link('turned.obj'));
  const { cutMesh } = await cutOf(turned, { cells: 12 });
  assert.equal(cutMesh.regionWinding, null);
  const [inner, outer] = sides(cutMesh);
  await shows(page, '#canvas', { cells: inner.length });
  assert.match(await textOf(page, '#legend'), / inside by parity$/);
  assert.match(await textOf(page, '#counts'), / inside by parity time /);
  await page.getByText('Stages and details').click();
  assert.match(await textOf(page, '#left-out'), /1 of 1 part not consistently oriented: inside by parity/);
  await page.locator('#color-by').selectOption('winding');
  await eventually(async () => assert.deepEqual(await entries(page), ['outside by parity', 'inside by parity']));
  await page.locator('#pin-number').fill(String(outer[0]));
  await page.locator('#pin-number').press('Enter');
  await eventually(async () => assert.match(await textOf(page, '#cell-card'), /side outside by parity/));
});

test('of a closed mesh that is consistently oriented winding numbers tell it, which needs no note', async (t) => {
  const page = await site.open(t, link('closed.obj'));
  assert.match(await textOf(page, '#counts'), / inside by winding numbers time /);
  assert.equal(await textOf(page, '#legend'), 'pieces of triangles pieces of grid-faces untouched cells');
});
