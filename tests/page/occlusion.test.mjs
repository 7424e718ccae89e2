// Ambient occlusion: for quick GPUs, and never without one.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { PerspectiveCamera } from 'three';
import { importBundled } from './bundled.mjs';
import { download, shows, startSite } from './page_helpers.mjs';
import { pixelsOf } from './pictures.mjs';

const { Occlusion } = await importBundled('page/view/occlusion.ts');
const site = await startSite({ smooth: true });
after(() => site.close());

/** Runs in the page before all else: pictures are done at once, by a clock that counts frames, however slow they are. */
function makeQuick() {
  let time = performance.now();
  performance.now = () => time;
  const tick = () => {
    time += 10;
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  WebGL2RenderingContext.prototype.clientWaitSync = () => WebGL2RenderingContext.ALREADY_SIGNALED;
}

/** Runs in the page before all else: the renderer has the name of a GPU. */
function nameGpu() {
  const { getParameter } = WebGL2RenderingContext.prototype;
  const unmaskedRenderer = 0x9246;
  WebGL2RenderingContext.prototype.getParameter = function (key) {
    return key === unmaskedRenderer ? 'ANGLE (NVIDIA GeForce RTX 3060)' : getParameter.call(this, key);
  };
}

const link = 'mesh=hilbert&n=4&z=0.62,1&slice=flat&explode=0,0';
const small = { viewport: { width: 800, height: 480 }, panels: ['save'], reducedMotion: 'reduce' };

const luma = ({ rgba }, at) => 0.299 * rgba[at] + 0.587 * rgba[at + 1] + 0.114 * rgba[at + 2];

/** Of the pixels of two pictures: the shares that are darker and brighter in the second. */
function compare(before, later) {
  assert.equal(before.rgba.length, later.rgba.length);
  const count = { darker: 0, brighter: 0 };
  for (let at = 0; at < before.rgba.length; at += 4) {
    const change = luma(later, at) - luma(before, at);
    if (change < -12) ++count.darker;
    if (change > 4) ++count.brighter;
  }
  const pixels = before.rgba.length / 4;
  return { darker: count.darker / pixels, brighter: count.brighter / pixels };
}

/** Opens a page of its own, on which `scripts` run first. Gives also what it has asked for. */
async function open(t, scripts) {
  const requests = [];
  const page = await site.open(t, link, {
    ...small,
    onNewPage: async (made) => {
      made.on('request', (request) => requests.push(request.url()));
      for (const script of scripts) await made.addInitScript(script);
    },
  });
  await shows(page, '#canvas', { shadow: 'drawn' });
  return { page, isLoaded: () => requests.some((url) => url.includes('occlusion')) };
}

test('it is for pictures of the model alone, which took a GPU a moment', async () => {
  const gl = { RENDERER: 0, getExtension: () => null, getParameter: () => 'A GPU' };
  let asked = 0;
  const getContext = () => {
    ++asked;
    return gl;
  };
  const occlusion = new Occlusion({ getContext }, {}, new PerspectiveCamera());
  const loaded = new Promise((resolve) => (occlusion.onChange = resolve));
  const model = { instead: null, comparison: null, wind: null };
  occlusion.stand(model, 60);
  for (const other of [null, { ...model, instead: {} }, { ...model, comparison: {} }, { ...model, wind: { surface: null } }])
    occlusion.stand(other, 5);
  assert.equal(asked, 0, 'not even what the GPU is called');
  occlusion.stand(model, 20);
  assert.equal(asked, 1);
  await loaded;
});

test('on a quick GPU corners darken once the picture stands, also in what is saved; without a GPU it is not even loaded', async (t) => {
  const software = await open(t, [makeQuick]);
  const { page } = await open(t, [makeQuick, nameGpu]);
  await shows(page, '#canvas', { occlusion: 1 });
  const { darker, brighter } = compare(await pixelsOf(software.page), await pixelsOf(page));
  t.diagnostic(`${(100 * darker).toFixed(1)} % of the pixels are darker`);
  assert.ok(darker > 0.05 && darker < 0.5 && brighter < 0.001, `${darker} are darker, ${brighter} brighter`);
  await shows(software.page, '#canvas', { occlusion: 0 });
  assert.ok(!software.isLoaded());

  await page.locator('#canvas').evaluate((canvas) => {
    window.strengths = [];
    new MutationObserver(() => window.strengths.push(canvas.dataset.occlusion)).observe(canvas, { attributeFilter: ['data-occlusion'] });
  });
  await page.locator('#canvas').press('ArrowLeft');
  await page.waitForFunction(() => {
    const gone = window.strengths.indexOf('0');
    return gone >= 0 && window.strengths.indexOf('1', gone) >= 0;
  });
  await shows(page, '#canvas', { occlusion: 1 });

  await page.locator('#canvas').blur();
  const seen = await pixelsOf(page);
  const saved = await pixelsOf(page, (await download(page, '#save-png')).bytes);
  const change = compare(seen, saved);
  assert.ok(change.darker + change.brighter < 0.001, `the saved picture differs: ${JSON.stringify(change)}`);
});
