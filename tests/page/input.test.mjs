import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { writeObj } from '../package/meshes.mjs';
import { badFiles, crossing, octahedron, octahedronFiles } from './mesh_files.mjs';
import { dataOf, eventually, isReady, shows, startSite, textOf } from './page_helpers.mjs';
import { looksLike } from './pictures.mjs';
import { cutOf, galleryMesh } from './reference.mjs';

const site = await startSite({ files: { ...octahedronFiles, 'bad.obj': 'v 0 0 0\nf 1 2 3\n' } });
after(() => site.close());
const start = 'mesh=wedge&n=4';

/** The page shows this mesh, cut by as many cells as it was cut with before. */
async function showsMesh(page, name, mesh, cells) {
  await shows(page, '#mesh-line', { name, triangles: mesh.triangles.length / 3 });
  const { cutMesh } = await cutOf(mesh, { cells });
  const { cellRegion, positions, grid } = cutMesh;
  await shows(page, '#counts', { cutCells: cellRegion.length, vertices: positions.length / 3, grid: grid.cells.join('x') });
  assert.equal(await isReady(page), 'ready');
}

async function pick(page, name, content) {
  await page.locator('#file').setInputFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });
}

/** As if the files, contents by their names, were dropped on the picture. */
async function drop(page, files) {
  await page.evaluate(
    (encoded) => {
      const dataTransfer = new DataTransfer();
      for (const [name, base64] of encoded) {
        const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
        dataTransfer.items.add(new File([bytes], name));
      }
      const target = document.getElementById('canvas');
      for (const kind of ['dragover', 'drop']) target.dispatchEvent(new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true }));
    },
    Object.entries(files).map(([name, content]) => [name, Buffer.from(content).toString('base64')]),
  );
}

test('from the gallery', async (t) => {
  const page = await site.open(t, start);
  await page.locator('#gallery [data-name="oscillator"]').click();
  await showsMesh(page, 'oscillator', await galleryMesh('oscillator'), 2);
  assert.equal(await page.locator('#gallery [data-name="oscillator"]').getAttribute('aria-pressed'), 'true');
  assert.equal(await page.locator('#gallery [data-name="wedge"]').getAttribute('aria-pressed'), 'false');
});

test('a linked mesh of the gallery is scrolled to', async (t) => {
  const page = await site.open(t, 'mesh=crate&n=4');
  const isInView = () =>
    page.locator('#gallery [data-name="crate"]').evaluate((entry) => {
      const { top, bottom } = entry.getBoundingClientRect();
      const list = entry.closest('ul').getBoundingClientRect();
      return top >= list.top - 1 && bottom <= list.bottom + 1;
    });
  await eventually(async () => assert.equal(await isInView(), true));
  assert.ok((await page.locator('#gallery').evaluate((list) => list.scrollTop)) > 0);
});

test('a snap tolerance is for one mesh: the next one is cut as it is', async (t) => {
  const page = await site.open(t, 'mesh=claw&n=3&snap=0.2');
  await page.locator('#gallery [data-name="torus-knot"]').click();
  await shows(page, '#mesh-line', { name: 'torus-knot' });
  assert.equal(await isReady(page), 'ready');
  assert.equal(await page.locator('#snap').inputValue(), '0');
  const { cutMesh } = await cutOf(await galleryMesh('torus-knot'), { cells: 14 });
  await shows(page, '#counts', { cutCells: cutMesh.cellRegion.length, vertices: cutMesh.positions.length / 3 });
});

test('files of every format, chosen', async (t) => {
  const page = await site.open(t, start);
  for (const [name, content] of Object.entries(octahedronFiles)) {
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.locator('#open-file').click()]);
    await chooser.setFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });
    await shows(page, '#mesh-line', { name, triangles: 8 });
    await eventually(async () => assert.equal(await isReady(page), 'ready'));
    const { cutMesh } = await cutOf(octahedron, { cells: 4 });
    await shows(page, '#counts', { cutCells: cutMesh.cellRegion.length, grid: cutMesh.grid.cells.join('x') });
  }
  await looksLike(page, 'octahedron');
});

test('a file opened after a mesh of the gallery is not cut as coarsely as that', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=2');
  await drop(page, { 'octahedron.obj': octahedronFiles['octahedron.obj'] });
  await showsMesh(page, 'octahedron.obj', octahedron, 16);
});

test('dropped files', async (t) => {
  const page = await site.open(t, start);
  await drop(page, { 'octahedron.off': octahedronFiles['octahedron.off'] });
  await showsMesh(page, 'octahedron.off', octahedron, 4);
  assert.equal(await page.locator('.drop-veil').isVisible(), false);
  await drop(page, { 'octahedron.stl': octahedronFiles['octahedron.stl'] });
  await shows(page, '#mesh-line', { name: 'octahedron.stl' });
});

test('a file that can not be read is dropped while a cut runs: the picture is still what the settings ask for', async (t) => {
  const page = await site.open(t, 'mesh=bunny&n=8');
  await page.locator('#cells').evaluate((input) => {
    input.value = '60';
    input.dispatchEvent(new Event('input', { bubbles: true }));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([], 'empty.obj'));
    input.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
  });
  await eventually(async () => assert.match(await textOf(page, '#alerts'), /empty\.obj can't be read/));
  assert.equal(await isReady(page), 'error');
  await shows(page, '#counts', { grid: '60x59x47' });
  assert.match(await textOf(page, '#alerts'), /empty\.obj can't be read/);
});

test('of several dropped files the first mesh is opened, and the page says which are not', async (t) => {
  const page = await site.open(t, start);
  await drop(page, { 'octahedron.mtl': 'newmtl red', ...octahedronFiles, 'letter.txt': 'Dear reader' });
  const says = /The page shows one mesh at a time: octahedron\.obj\. Not opened: octahedron\.mtl, octahedron\.off, .* and 1 more\./;
  await eventually(async () => assert.match(await textOf(page, '[data-test=notice]'), says));
  await showsMesh(page, 'octahedron.obj', octahedron, 4);
});

test('a dropped folder is refused, by its name', async (t) => {
  const page = await site.open(t, start);
  const browser = await page.context().newCDPSession(page);
  const data = { items: [], files: [import.meta.dirname], dragOperationsMask: 1 };
  for (const type of ['dragEnter', 'dragOver', 'drop']) await browser.send('Input.dispatchDragEvent', { type, x: 100, y: 300, data });
  await eventually(async () => assert.match(await textOf(page, '[data-test=alert]'), /^page can't be read .*it is a folder/));
  assert.equal(await isReady(page), 'ready');
});

test('an address', async (t) => {
  const page = await site.open(t, start);
  await page.locator('#url').fill(site.meshUrl('octahedron.obj'));
  await page.locator('#url').press('Enter');
  await showsMesh(page, 'octahedron.obj', octahedron, 4);
});

test('bad addresses are told and the page goes on', async (t) => {
  const page = await site.open(t, start, { expectedProblem: /Failed to load resource/ });
  for (const [url, says] of [
    [site.meshUrl('missing.obj'), /missing\.obj responded with 404/],
    ['http://127.0.0.1:1/mesh.obj', /Nothing came from http:\/\/127\.0\.0\.1:1\/mesh\.obj/],
    [site.meshUrl('bad.obj'), /line 2/i],
  ]) {
    await page.locator('#url').fill(url);
    await page.locator('#open-url').click();
    await eventually(async () => assert.match(await textOf(page, '[data-test=alert] >> nth=0'), says));
    await shows(page, '#mesh-line', { name: 'wedge' });
  }
  await page.locator('#url').fill(site.meshUrl('octahedron.ply'));
  await page.locator('#open-url').click();
  await showsMesh(page, 'octahedron.ply', octahedron, 4);
});

test('bad files are told, with what is wrong and where, and the page goes on', async (t) => {
  const page = await site.open(t, start);
  const { model } = await dataOf(page, '#counts');
  for (const { name, content, says } of badFiles) {
    await pick(page, name, content);
    await eventually(async () => {
      const alert = await textOf(page, '[data-test=alert] >> nth=0');
      assert.ok(alert.startsWith(`${name} can't be read`), alert);
      assert.match(alert, says);
    });
    await shows(page, '#mesh-line', { name: 'wedge' });
    await shows(page, '#counts', { model });
  }
  await page.locator('[data-test=alert] >> nth=0').getByRole('button', { name: 'Dismiss' }).click();
  await pick(page, 'octahedron.obj', octahedronFiles['octahedron.obj']);
  await showsMesh(page, 'octahedron.obj', octahedron, 4);
});

test('a mesh that intersects itself is cut, and the pairs that meet are counted', async (t) => {
  const page = await site.open(t, start);
  await pick(page, 'crossing.obj', writeObj(crossing));
  await showsMesh(page, 'crossing.obj', crossing, 4);
  await page.getByText('Stages and details').click();
  assert.match(await textOf(page, '#left-out'), /\d+ pairs of triangles crossing/);
  assert.equal(await isReady(page), 'ready');
});

test('two meshes asked for at once: the last one is shown', async (t) => {
  const page = await site.open(t, start);
  await page.evaluate(() => {
    for (const name of ['bunny', 'claw', 'torus-knot', 'oscillator']) document.querySelector(`#gallery [data-name="${name}"]`).click();
  });
  await showsMesh(page, 'oscillator', await galleryMesh('oscillator'), 2);
});
