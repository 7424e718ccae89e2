import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { readObj, writeObj } from '../package/meshes.mjs';
import { octahedron, octahedronFiles } from './mesh_files.mjs';
import { dataOf, download, enter, eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { covered, difference, pixelsOf, tiles } from './pictures.mjs';
import { cutOf, galleryMesh, keptCells } from './reference.mjs';

const knot = await galleryMesh('torus-knot');
const site = await startSite({ files: { ...octahedronFiles, 'knot.obj': writeObj(knot) } });
after(() => site.close());
const link = `url=${site.meshUrl('knot.obj')}&n=6&free=off&explode=0,0`;

describe('links', () => {
  const clipboard = { permissions: ['clipboard-read', 'clipboard-write'] };

  test('a copied link restores mesh, grid, slices, colours and camera', async (t) => {
    const page = await site.open(t, '', { ...clipboard, reducedMotion: 'reduce' });
    await page.locator('#gallery [data-name="torus-knot"]').click();
    await shows(page, '#mesh-line', { name: 'torus-knot' });
    await isReady(page);
    await enter(page, '#cells-number', 7);
    await page.locator('#slice-free').uncheck();
    await slideTo(page, '#slice-y-position', 0.612);
    await page.locator('#slice-y-flip').click();
    await slideTo(page, '#explode-cells', 0.31);
    await page.locator('#color-by').selectOption('volume');
    await page.locator('#show-edges').uncheck();
    await page.locator('#slice-mode-flat').check();
    const box = await page.locator('#canvas').boundingBox();
    await page.mouse.move(box.x + 40, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + 160, box.y + box.height / 2 - 60, { steps: 5 });
    await page.mouse.up();
    await eventually(async () => assert.match(page.url(), /camera=/));
    await shows(page, '#counts', { grid: (await cutOf(await galleryMesh('torus-knot'), { cells: 7 })).cutMesh.grid.cells.join('x') });
    await openPanel(page, 'save');
    await page.locator('#copy-link').click();
    await eventually(async () => assert.match(await textOf(page, '#link-status'), /Copied/));
    const copied = await page.evaluate(() => navigator.clipboard.readText());

    const other = await site.newPage(t, clipboard);
    await other.goto(copied);
    assert.equal(await isReady(other), 'ready');
    await shows(other, '#mesh-line', { name: 'torus-knot' });
    assert.equal((await dataOf(other, '#counts')).grid, (await dataOf(page, '#counts')).grid);
    const { cells, untouched, caps } = await dataOf(page, '#canvas');
    assert.ok(Number(caps) > 0);
    await shows(other, '#canvas', { cells, untouched, caps });
    const values = { '#color-by': 'volume', '#slice-y-position': '0.388', '#explode-cells': '0.31', '#cells': '7' };
    for (const [selector, value] of Object.entries(values)) {
      assert.equal(await other.locator(selector).inputValue(), value);
    }
    assert.equal(await other.locator('#slice-y').isChecked(), true);
    assert.equal(await other.locator('#slice-free').isChecked(), false);
    assert.equal(await other.locator('#show-edges').isChecked(), false);
    await eventually(async () => {
      const by = difference(tiles(await pixelsOf(page)), tiles(await pixelsOf(other)));
      assert.ok(by < 1.5, `seen from the same place: ${by}`);
    });
  });

  test('where the clipboard is out of reach the link is shown to be copied, and code with all of its lines', async (t) => {
    const page = await site.open(t, `${link}&x=0.5,1`, { permissions: [] });
    await page.evaluate(() => {
      navigator.clipboard.writeText = () => Promise.reject(new Error('not allowed'));
    });
    await openPanel(page, 'save');
    await page.locator('#copy-link').click();
    await page.locator('#link').waitFor();
    assert.match(await page.locator('#link').inputValue(), /#url=http.*knot\.obj&n=6&x=0\.5,1&explode=0,0$/);
    await openPanel(page, 'code');
    for (const name of ['command-line', 'javascript']) {
      await page.locator(`#copy-${name}`).click();
      const shown = await page.locator(`#${name}`).inputValue();
      assert.equal(shown, await page.locator(`#${name}-text`).textContent());
      assert.ok(shown.split('\n').filter(Boolean).length > 1, shown);
    }
  });

  test('the picture in another page: drawn, turned and zoomed, with the way to all the rest', async (t) => {
    const page = await site.open(t, 'mesh=wedge&n=3&color=cell', clipboard);
    await openPanel(page, 'save');
    await page.locator('#copy-embed').click();
    await eventually(async () => assert.match(await textOf(page, '#embed-status'), /Copied/));
    const html = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(html, /^<iframe src="http.*\/some\/sub-path\/\?embed#mesh=wedge&amp;n=3&amp;.*<\/iframe>$/);
    const other = await site.newPage(t);
    await other.setContent(`<!doctype html><title>Another page</title>${html}`);
    const frame = other.frameLocator('iframe');
    const canvas = frame.locator('#canvas');
    await eventually(async () => assert.ok(Number(await canvas.getAttribute('data-cells')) > 0));
    for (const part of ['h1', '#panels', '#tools', '.skip']) assert.equal(await frame.locator(part).isVisible(), false, part);
    assert.equal(await frame.locator('#bar').count(), 0);
    const { width, height } = await canvas.boundingBox();
    assert.deepEqual([width, height], [800, 500], 'the picture fills the frame');
    await canvas.hover();
    await other.mouse.wheel(0, -300);
    const whole = frame.locator('#whole-page');
    await eventually(async () => assert.match(await whole.getAttribute('href'), /sub-path\/#mesh=wedge&n=3&color=cell&camera=/));
    const [opened] = await Promise.all([other.context().waitForEvent('page'), whole.click()]);
    await opened.locator('#bar').waitFor();
    assert.equal(await isReady(opened), 'ready');
    assert.equal(await opened.locator('#cells').inputValue(), '3');
  });

  test('the picture in another page keeps its divider, and the words about both of its sides', async (t) => {
    const page = await site.newPage(t);
    await page.goto(`${site.url}?embed#mesh=wedge&n=3&compare=voxels&divider=0.3`);
    await shows(page, '#canvas', { compare: 'voxels' });
    await page.locator('#divided').waitFor();
    assert.match(await textOf(page, '#divided'), /cut-cells exact.*voxels volume/);
    await slideTo(page, '#divider', 0.6);
    await eventually(async () => assert.match(await page.locator('.divider-line').getAttribute('style'), /left: 60%/));
  });

  test('code for what is shown, to be copied, and the mesh that it reads', async (t) => {
    const page = await site.open(t, link, clipboard);
    await openPanel(page, 'code');
    for (const [name, expected] of [
      ['javascript', /^import .*cut\(mesh, \{ cells: 6 \}\)/s],
      ['command-line', /^mandoline cut knot\.obj --cells 6 -o cells\.vtu\n$/],
    ]) {
      await page.locator(`#copy-${name}`).click();
      await eventually(async () => assert.match(await textOf(page, `#${name}-status`), /Copied/));
      const copied = await page.evaluate(() => navigator.clipboard.readText());
      assert.match(copied, expected);
      assert.equal(copied, await page.locator(`#${name}-text`).textContent());
    }
    const { name, bytes } = await download(page, '#save-mesh');
    assert.equal(name, 'knot.obj');
    assert.deepEqual(readObj(bytes.toString()), readObj(writeObj(knot)));
    await enter(page, '#cells-number', 512);
    assert.equal(await isReady(page), 'error');
    assert.equal(await page.locator('#javascript-text').count(), 0, 'there is no code for what could not be cut');
    await enter(page, '#cells-number', 6);
    await page.locator('#wind-on').check();
    await eventually(async () => assert.match(await textOf(page, '#command-line-text'), /mandoline flow knot.obj --wind 1,0,0 --cells 48/));
  });

  test('a link to a mesh at an address, with a grid of its own', async (t) => {
    const grid = { min: [-2, -2, -2], max: [3, 2, 2], cells: [5, 4, 3] };
    const url = encodeURIComponent(site.meshUrl('octahedron.ply'));
    const page = await site.open(t, `url=${url}&n=5,4,3&box=-2,-2,-2,3,2,2&snap=0.1&free=off&x=0.5,-1`);
    const other = await cutOf(octahedron, grid, { snapTolerance: 0.1 });
    await shows(page, '#counts', { grid: '5x4x3', cutCells: other.cutMesh.cellRegion.length });
    await shows(page, '#canvas', { cells: keptCells(other, [{ normal: [-1, 0, 0], position: 0.5 }]).length });
  });

  for (const [hash, names] of [
    ['n=banana', /\(n\)/],
    ['n=0&x=2,1&y=0.5,3&free=a,b,c,d', /n, x, y, free/],
    ['box=1,2,3', /box/],
    ['n=3,4,5&box=0,0,0,-1,1,1', /n/],
    [
      'wind=north&smoke=maybe&flow=up&tunnel=1&compare=prices&divider=2&pose=dance,1&volumes=0,0&up=w',
      /wind, smoke, flow, tunnel, compare, divider, pose, volumes, up/,
    ],
    [
      'snap=0.7&explode=9,9&color=plaid&show=ghosts&camera=1,1,1,1,1,1&region=-2&slice=thick',
      /snap, explode, color, show, camera, region, slice/,
    ],
    ['nonsense=1&__proto__=2&constructor=3', /nonsense, __proto__, constructor/],
    ['%%%', /%%%/],
  ]) {
    test(`a link that says "${hash}" falls back, with a notice`, async (t) => {
      const page = await site.newPage(t);
      await page.goto(`${site.url}#${hash}`);
      await eventually(async () => assert.match(await textOf(page, '[data-test=notice]'), names));
      await page.waitForFunction(() => document.getElementById('canvas').dataset.model);
      assert.equal(await isReady(page), 'ready');
      await shows(page, '#mesh-line', { name: 'bunny' });
      await shows(page, '#counts', { grid: '16x16x13' });
      assert.equal(await page.locator('#wind-on').isChecked(), false);
    });
  }

  const hashes = [
    'mesh=unicorn',
    'mesh=bunny&n=100000',
    `n=${2 ** 31},1,1&box=0,0,0,1,1,1`,
    'mesh=bunny&n=2,2,2&box=50,50,50,51,51,51',
    'region=7',
  ];
  for (const hash of hashes) {
    test(`a link that asks for what isn't there, "${hash}", still shows a picture`, async (t) => {
      const page = await site.open(t, hash);
      await shows(page, '#mesh-line', { name: 'bunny' });
      await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.05, 'something is seen'));
    });
  }

  test('a changed address is followed', async (t) => {
    const page = await site.open(t, link);
    await page.evaluate(() => (location.hash = '#mesh=oscillator&n=3&free=off'));
    await shows(page, '#mesh-line', { name: 'oscillator' });
    await shows(page, '#counts', { grid: (await cutOf(await galleryMesh('oscillator'), { cells: 3 })).cutMesh.grid.cells.join('x') });
  });
});
