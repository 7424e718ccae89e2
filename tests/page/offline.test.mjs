// What is loaded, and when: little before the first picture, then all the rest, so that the page works offline.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { octahedronFiles } from './mesh_files.mjs';
import { download, eventually, isReady, openPanel, shows, startSite } from './page_helpers.mjs';

const site = await startSite();
after(() => site.close());

/** The texts of all scripts that were asked for until then. */
async function scripts(until) {
  const asked = site.host.requests.filter(({ path, at }) => path.endsWith('.js') && at <= until);
  const paths = new Set(asked.map(({ path }) => path));
  const textAt = async (path) => (await fetch(new URL(path, site.url))).text();
  return Promise.all([...paths].map(textAt));
}

const has = (texts, word) => texts.some((text) => text.includes(word));

test('offline, meshes of the gallery and files of every format are opened and saved, and the wind blows', async (t) => {
  const page = await site.newPage(t);
  const loaded = [];
  page.on('requestfinished', (request) => loaded.push(request.url()));
  await page.addInitScript(() => {
    const noteFirstPicture = (_, observer) => {
      if (!document.getElementById('canvas')?.dataset.frames) return;
      window.firstPicture = Date.now();
      observer.disconnect();
    };
    new MutationObserver(noteFirstPicture).observe(document, { subtree: true, childList: true, attributeFilter: ['data-frames'] });
  });
  await page.goto(`${site.url}#mesh=wedge&n=4`);
  const first = await scripts(await (await page.waitForFunction(() => window.firstPicture)).jsonValue());
  assert.ok(has(first, 'WebGL'), 'three draws the picture');
  assert.ok(!has(first, 'THREE.GLTFLoader') && !has(first, 'THREE.GLTFExporter'), 'the picture does not wait for readers and writers');
  await eventually(async () => {
    for (const name of [/gltf.*\.js$/, /export.*\.js$/, /files.*\.wasm$/, /physics.*\.wasm$/, /TransformControls.*\.js$/, /code-.*\.js$/])
      assert.ok(
        loaded.some((url) => name.test(url)),
        String(name),
      );
  });
  await eventually(async () => {
    const missing = await page.locator('#gallery img').evaluateAll((all) => all.filter((image) => image.naturalWidth === 0).length);
    assert.equal(missing, 0, 'then all of them are loaded');
  });
  const paths = site.host.requests.map(({ path }) => path);
  const firstOf = (part) => paths.findIndex((path) => path.includes(part));
  assert.ok(firstOf('mandoline-') >= 0);
  assert.ok(firstOf('thumbnails/') > firstOf('mandoline-'), 'the pictures of the gallery wait for what makes the first picture');
  await page.context().setOffline(true);
  const asked = site.host.requests.length;
  for (const name of ['claw', 'bunny']) {
    await page.locator(`#gallery [data-name="${name}"]`).click();
    await shows(page, '#mesh-line', { name });
    assert.equal(await isReady(page), 'ready');
  }
  for (const [name, content] of Object.entries(octahedronFiles).reverse()) {
    await page.locator('#file').setInputFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });
    await shows(page, '#mesh-line', { name, triangles: 8 });
    assert.equal(await isReady(page), 'ready');
  }
  await openPanel(page, 'save');
  for (const format of ['json', 'vtu', 'obj', 'glb', 'png']) {
    assert.ok((await download(page, `#save-${format}`)).bytes.length > 100, format);
  }
  await openPanel(page, 'wind');
  await page.locator('#wind-on').check();
  await shows(page, '#canvas', { wind: '1,0,0' });
  await openPanel(page, 'save');
  for (const format of ['csv', 'vtu', 'obj']) {
    assert.ok((await download(page, `#save-wind-${format}`)).bytes.length > 100, format);
  }
  await openPanel(page, 'checks');
  await page.locator('#validate').click();
  await shows(page, '#validation', { pass: true });
  const late = site.host.requests.slice(asked).map(({ path }) => path);
  assert.deepEqual(late, []);
});
