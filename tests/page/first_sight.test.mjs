import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { eventually, isReady, shows, startSite, textOf } from './page_helpers.mjs';
import { covered, isBlue, isOrange, looksLike, pixelsOf, share } from './pictures.mjs';
import { cutOf, galleryMesh } from './reference.mjs';

const site = await startSite();
after(() => site.close());

test('the first sight is the whole bunny, its cells slightly apart', async (t) => {
  // Without the opening, which would go over the picture.
  const page = await site.newPage(t, { reducedMotion: 'reduce' });
  const began = performance.now();
  await page.goto(site.url);
  await page.waitForFunction(() => document.getElementById('canvas').dataset.model === '1');
  t.diagnostic(`first picture after ${Math.round(performance.now() - began)} ms`);
  assert.equal(await isReady(page), 'ready');

  const { cutMesh } = await cutOf(await galleryMesh('bunny'), { cells: 16 });
  await shows(page, '#counts', { cutCells: cutMesh.cellRegion.length, regions: cutMesh.regionCount, grid: cutMesh.grid.cells.join('x') });
  const inside = cutMesh.cellRegion.filter((region) => cutMesh.regionWinding[region] === 1).length;
  await shows(page, '#canvas', { cells: inside });
  assert.match(await textOf(page, 'body > header'), /Any triangle mesh, cut into exact cells/);

  await eventually(async () => {
    const picture = await pixelsOf(page);
    const seen = covered(picture);
    assert.ok(seen > 0.15 && seen < 0.6, `${seen} of the picture is drawn on`);
    assert.ok(share(picture, isOrange) > 0.05, 'the surface is seen');
    assert.ok(share(picture, isBlue) > 0.002, 'grid-faces are seen between the cells');
  });
  await looksLike(page, 'first sight');
});

test('what the first picture needs is less than 600 KB, compressed', async (t) => {
  // What is loaded ahead waits for an idle moment, which never comes; the gallery's pictures come after the first one, too.
  const onNewPage = (made) => made.addInitScript(() => (window.requestIdleCallback = () => 0));
  const page = await site.newPage(t, { onNewPage });
  const loading = [];
  page.on('response', (response) => response.request().resourceType() !== 'image' && loading.push(response.body()));
  await page.goto(site.url);
  await page.waitForFunction(() => document.getElementById('canvas').dataset.model);
  const sizes = (await Promise.all(loading)).map((body) => gzipSync(body, { level: 9 }).length);
  assert.ok(sizes.length >= 5, 'the page, its style, its script, the worker and the module');
  const sum = sizes.reduce((total, size) => total + size, 0);
  t.diagnostic(`${sum} bytes`);
  assert.ok(sum < 600_000, `${sum} bytes`);
});

test('all that is asked for is there and comes from the same folder', async (t) => {
  const requests = [];
  const failed = [];
  const before = site.host.requests.length;
  await site.open(t, 'mesh=claw&n=2', {
    onNewPage: async (made) => {
      made.on('request', (request) => requests.push(request.url()));
      made.on('requestfailed', (request) => failed.push(request.url()));
    },
  });
  await eventually(async () =>
    assert.ok(
      requests.some((url) => url.includes('/code-')),
      'the last that is loaded',
    ),
  );
  assert.deepEqual(failed, []);
  assert.deepEqual(
    site.host.requests.slice(before).filter(({ status }) => status !== 200),
    [],
  );
  assert.deepEqual(
    requests.filter((url) => !url.startsWith(site.url) && !/^(data|blob):/.test(url)),
    [],
  );
});

for (const colorScheme of ['light', 'dark']) {
  test(`the ${colorScheme} scheme is the system's, and can be switched`, async (t) => {
    const page = await site.open(t, 'mesh=wedge&n=2', { colorScheme });
    const isDark = async () => {
      const { rgba } = await pixelsOf(page);
      const text = await page.evaluate(() => getComputedStyle(document.body).color);
      const [r, g, b] = text.match(/[\d.]+/g).map(Number);
      assert.equal(rgba[0] < 128, r + g + b > 384, 'the picture and the text go together');
      return rgba[0] < 128;
    };
    assert.equal(await isDark(), colorScheme === 'dark');
    await page.locator('#scheme').click();
    await eventually(async () => assert.equal(await isDark(), colorScheme !== 'dark'));
  });
}
