// How meshes of the gallery open: as their presets have it, whatever was seen before.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { importBundled } from './bundled.mjs';
import { octahedronFiles } from './mesh_files.mjs';
import { dataOf, eventually, isReady, shows, slideTo, startSite, textOf } from './page_helpers.mjs';

const { presetOf } = await importBundled('model/gallery/preset.ts');
const { fromHash } = await importBundled('model/hash.ts');
const site = await startSite();
after(() => site.close());

const hash = (page) => page.evaluate(() => location.hash);
const entries = (page) => page.evaluate(() => history.length);
const click = (page, name) => page.locator(`#gallery [data-name="${name}"]`).click();

/** The page comes to rest with these settings. */
async function hasSettings(page, expected) {
  await eventually(async () => assert.deepEqual(fromHash(await hash(page)).settings, expected));
  assert.equal(await isReady(page), 'ready');
}

const preset = (name) => presetOf({ kind: 'gallery', name });

test('an entry opens with its preset alone, as one step, and Back returns', async (t) => {
  const former =
    'mesh=bunny&n=6&snap=0.1&x=0.6,-1&slice=flat&explode=0.3,0.2&color=volume&show=surface,edges&region=1&up=z&wind=0,0,1&compare=voxels';
  const page = await site.open(t, former, { panels: ['mesh'], reducedMotion: 'reduce' });
  await eventually(async () => assert.match(await hash(page), /compare=voxels/));
  const before = await hash(page);
  const steps = await entries(page);
  for (const [at, name] of ['claw', 'nested-spheres', 'passing-tori'].entries()) {
    await click(page, name);
    await hasSettings(page, preset(name));
    assert.equal(await entries(page), steps + at + 1);
  }
  assert.match(await textOf(page, '#play'), /Play/, 'where motion is unwanted nothing moves by itself');
  await page.goBack();
  await hasSettings(page, preset('nested-spheres'));
  await page.goBack();
  await page.goBack();
  await hasSettings(page, fromHash(before).settings);
});

/** Runs in the page before all else: an entry is clicked as soon as the page has come to rest. */
function clickAtOnce() {
  const watch = new MutationObserver(() => {
    if (document.body?.dataset.state !== 'ready') return;
    watch.disconnect();
    setTimeout(() => document.querySelector('#gallery [data-name="claw"]').click());
  });
  watch.observe(document, { attributes: true, subtree: true, attributeFilter: ['data-state'] });
}

test('an entry is a step however soon it is clicked', async (t) => {
  const page = await site.newPage(t, { onNewPage: (made) => made.addInitScript(clickAtOnce) });
  await page.goto(`${site.url}#mesh=wedge&n=4`);
  await shows(page, '#mesh-line', { name: 'claw' });
  await hasSettings(page, preset('claw'));
  await page.goBack();
  await hasSettings(page, fromHash('mesh=wedge&n=4').settings);
});

test('a file is seen whole after an entry that is cut flat and coloured, with what was chosen since', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4', { panels: ['mesh'] });
  await click(page, 'nested-spheres');
  await hasSettings(page, preset('nested-spheres'));
  const open = async (name) => {
    await page.locator('#file').setInputFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(octahedronFiles['octahedron.obj']) });
    await shows(page, '#mesh-line', { name });
  };
  const whole = (name) => fromHash(`file=${name}`).settings;
  await open('first.obj');
  await hasSettings(page, whole('first.obj'));
  await click(page, 'noisy-sphere');
  await hasSettings(page, preset('noisy-sphere'));
  await page.locator('#color-by').selectOption('volume');
  await open('second.obj');
  await hasSettings(page, { ...whole('second.obj'), colorBy: 'volume' });
});

test('a file after an entry in wind is seen without it, its cells apart; a wind that was turned stays', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4', { panels: ['mesh', 'wind'], reducedMotion: 'reduce' });
  const open = async (name) => {
    await page.locator('#file').setInputFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(octahedronFiles['octahedron.obj']) });
    await shows(page, '#mesh-line', { name });
  };
  for (const entry of ['bunny-in-wind', 'adaptive-grid']) {
    await click(page, entry);
    await hasSettings(page, preset(entry));
    await open(`after-${entry}.obj`);
    await hasSettings(page, fromHash(`file=after-${entry}.obj`).settings);
  }
  await click(page, 'bunny-in-wind');
  await hasSettings(page, preset('bunny-in-wind'));
  await slideTo(page, '#wind-heading', 90);
  await eventually(async () => assert.notDeepEqual(fromHash(await hash(page)).settings.wind, preset('bunny-in-wind').wind));
  const { wind } = fromHash(await hash(page)).settings;
  await open('turned.obj');
  const whole = fromHash('file=turned.obj&explode=0,0').settings;
  await hasSettings(page, { ...whole, wind });
});

/** Runs in the page before all else: pictures are as far apart as on a slow machine. */
function makeSlow() {
  const request = requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) => setTimeout(() => request(callback), 700);
}

test('what has a pose moves at once, without steps of its own however slowly; Back ends that', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4', { panels: ['mesh'], onNewPage: (made) => made.addInitScript(makeSlow) });
  const steps = await entries(page);
  await click(page, 'turning-gears');
  await eventually(async () => assert.match(await textOf(page, '#play'), /Pause/));
  const { model } = await dataOf(page, '#counts');
  await eventually(async () => assert.ok(Number((await dataOf(page, '#counts')).model) > Number(model) + 2));
  assert.equal(await entries(page), steps + 1);
  await page.goBack();
  await shows(page, '#mesh-line', { name: 'wedge' });
  await eventually(async () => assert.match(await textOf(page, '#play'), /Play/));
  await hasSettings(page, fromHash('mesh=wedge&n=4').settings);
});
