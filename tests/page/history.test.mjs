// Back and Forward of the browser.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { octahedronFiles } from './mesh_files.mjs';
import { dataOf, enter, eventually, isReady, shows, slideTo, startSite, textOf } from './page_helpers.mjs';

const site = await startSite({ files: octahedronFiles });
after(() => site.close());

const entries = (page) => page.evaluate(() => history.length);

async function hasUrl(page, expected) {
  await eventually(async () => assert.match(decodeURIComponent(page.url()), expected));
}

async function openGallery(page, name) {
  await page.locator(`#gallery [data-name="${name}"]`).click();
  await hasUrl(page, new RegExp(`mesh=${name}`));
}

test('go through meshes, cuts and looks', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4');
  const first = await entries(page);
  await openGallery(page, 'claw');
  await enter(page, '#cells-number', 7);
  await hasUrl(page, /n=7/);
  await page.locator('#color-by').selectOption('volume');
  await hasUrl(page, /color=volume/);
  assert.equal(await entries(page), first + 3);
  await isReady(page);
  const { model } = await dataOf(page, '#canvas');
  await page.goBack();
  await eventually(async () => assert.equal(await page.locator('#color-by').inputValue(), 'region'));
  await isReady(page);
  await shows(page, '#counts', { model }); // A look is no reason to cut again.
  await page.goBack();
  await shows(page, '#mesh-line', { name: 'claw' });
  await eventually(async () => assert.notEqual(await page.locator('#cells').inputValue(), '7'));
  await page.goBack();
  await shows(page, '#mesh-line', { name: 'wedge' });
  assert.equal(await isReady(page), 'ready');
  assert.equal(await page.locator('#cells').inputValue(), '4');
  for (let step = 0; step < 3; ++step) await page.goForward();
  await shows(page, '#mesh-line', { name: 'claw' });
  await eventually(async () => assert.equal(await page.locator('#color-by').inputValue(), 'volume'));
  assert.equal(await page.locator('#cells').inputValue(), '7');
  assert.equal(await entries(page), first + 3);
});

test('take the steps of a slider as one, and the camera with what it looks at', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4&free=off');
  const first = await entries(page);
  const slider = page.locator('#slice-x-position');
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await slider.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  for (const position of [0.9, 0.8, 0.7]) {
    await slideTo(page, '#slice-x-position', position);
    await hasUrl(page, new RegExp(`x=${position}`));
  }
  await page.mouse.up();
  const settled = page.url().split('#')[1];
  assert.equal(await entries(page), first + 1);
  const box = await page.locator('#canvas').boundingBox();
  await page.mouse.move(box.x + 40, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 160, box.y + box.height / 2 - 60, { steps: 5 });
  await page.mouse.up();
  await hasUrl(page, /camera=/);
  assert.equal(await entries(page), first + 1);
  await page.goBack();
  await eventually(async () => assert.equal(await page.locator('#slice-x').isChecked(), false));
  await page.goForward();
  await eventually(async () => assert.equal(await page.locator('#slice-x').isChecked(), true));
  assert.ok(page.url().includes(settled), `${page.url()} instead of ${settled}`);
  assert.match(page.url(), /camera=/);
});

test('bring back a file that was opened, also after another one of its name that could not be read', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4');
  const open = (content) =>
    page.locator('#file').setInputFiles({ name: 'octahedron.obj', mimeType: 'text/plain', buffer: Buffer.from(content) });
  await open(octahedronFiles['octahedron.obj']);
  await hasUrl(page, /file=octahedron\.obj/);
  await open('v 0 0 0');
  await eventually(async () => assert.match(await textOf(page, '#alerts'), /can't be read/));
  await openGallery(page, 'claw');
  await page.goBack();
  await shows(page, '#mesh-line', { name: 'octahedron.obj' });
  assert.equal(await isReady(page), 'ready');
});

test('bring back a file that was opened, and what was loaded from an address', async (t) => {
  const page = await site.open(t, `url=${encodeURIComponent(site.meshUrl('octahedron.ply'))}&n=4`);
  const buffer = Buffer.from(octahedronFiles['octahedron.obj']);
  await page.locator('#file').setInputFiles({ name: 'octahedron.obj', mimeType: 'text/plain', buffer });
  await hasUrl(page, /file=octahedron\.obj/);
  await openGallery(page, 'claw');
  await page.goBack();
  await shows(page, '#mesh-line', { name: 'octahedron.obj' });
  await page.goBack();
  await shows(page, '#mesh-line', { name: 'octahedron.ply' });
  await page.goForward();
  await shows(page, '#mesh-line', { name: 'octahedron.obj' });
  assert.equal(await isReady(page), 'ready');
  assert.equal(await page.locator('[data-test=notice]').count(), 0);
});
