import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { readObj, writeObj } from '../package/meshes.mjs';
import { octahedron, octahedronFiles } from './mesh_files.mjs';
import { dataOf, download, enter, eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { covered, difference, pixelsOf, settledPixels, tiles } from './pictures.mjs';
import { cutOf, galleryMesh, keptCells, mandoline } from './reference.mjs';

const knot = await galleryMesh('torus-knot');
const site = await startSite({ files: { ...octahedronFiles, 'knot.obj': writeObj(knot) } });
after(() => site.close());
const source = `url=${site.meshUrl('knot.obj')}&n=6&free=off`;
const link = `${source}&explode=0,0`;
const reference = await cutOf(knot, { cells: 6 });
const { mesh, cutMesh } = reference;

async function saved(t, format, hash = link) {
  const page = await site.open(t, hash);
  await openPanel(page, 'save');
  const file = await download(page, `#save-${format}`);
  return { page, ...file };
}

describe('files', () => {
  test('JSON: the dump of all arrays', async (t) => {
    const { name, bytes } = await saved(t, 'json');
    assert.equal(name, `knot.obj-${cutMesh.grid.cells.join('x')}.json`);
    const dump = JSON.parse(bytes);
    assert.equal(dump.format, 'mandoline-cut-mesh');
    assert.ok(bytes.equals(await mandoline.write(mesh, cutMesh, 'json')), 'as the package writes it');
    assert.equal(dump.positions.length, cutMesh.positions.length);
    assert.equal(dump.cellHalfFaceOffsets.length, cutMesh.cellRegion.length + 1);
    assert.equal(dump.loopVertices.length, dump.loopOffsets.at(-1));
    assert.equal(
      dump.gridCellRegion.length,
      cutMesh.grid.cells.reduce((product, n) => product * n),
    );
  });

  test('VTU: one polyhedron per cell', async (t) => {
    const { name, bytes, page } = await saved(t, 'vtu');
    assert.match(name, /^knot\.obj-.*\.vtu$/);
    assert.ok(bytes.equals(await mandoline.write(mesh, cutMesh, 'vtu')), 'as the package writes it');
    const xml = `${bytes.toString('latin1').split('<AppendedData')[0]}</VTKFile>`;
    const piece = await page.evaluate((text) => {
      const parsed = new DOMParser().parseFromString(text, 'application/xml');
      const found = parsed.querySelector('VTKFile[type=UnstructuredGrid] Piece');
      if (parsed.querySelector('parsererror')) return parsed.documentElement.textContent;
      return ['NumberOfPoints', 'NumberOfCells'].map((name) => Number(found.getAttribute(name)));
    }, xml);
    assert.ok(piece[0] >= cutMesh.positions.length / 3, String(piece));
    assert.equal(piece[1], cutMesh.cellRegion.length + cutMesh.gridCellRegion.filter((region) => region >= 0).length);
  });

  test('OBJ: the cut surface', async (t) => {
    const { name, bytes } = await saved(t, 'obj');
    assert.match(name, /\.obj$/);
    assert.ok(bytes.equals(await mandoline.write(mesh, cutMesh, 'obj')), 'as the package writes it');
    const { positions, triangles } = readObj(bytes.toString());
    assert.ok(positions.every(Number.isFinite));
    assert.ok(triangles.length > 0 && triangles.every((vertex) => vertex < positions.length / 3));
  });

  test('GLB: what is shown', async (t) => {
    const positionsOf = async (hash) => {
      const { bytes } = await saved(t, 'glb', hash);
      const { scene } = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), '');
      const points = [];
      scene.updateMatrixWorld(true);
      scene.traverse(({ isMesh, geometry, matrixWorld }) => {
        if (!isMesh) return;
        const position = geometry.getAttribute('position').clone().applyMatrix4(matrixWorld);
        for (let at = 0; at < position.count; ++at) points.push([position.getX(at), position.getY(at), position.getZ(at)]);
      });
      return points;
    };
    const end = (points, best, d) => points.reduce((x, p) => best(x, p[d]), points[0][d]);
    const extent = (points) => [0, 1, 2].map((d) => end(points, Math.max, d) - end(points, Math.min, d));
    const whole = extent(await positionsOf(link));
    const sizes = [0, 1, 2].map((d) => {
      const along = Array.from(mesh.positions).filter((_, at) => at % 3 === d);
      return Math.max(...along) - Math.min(...along);
    });
    const scale = whole[0] / sizes[0];
    whole.forEach((length, d) => assert.ok(Math.abs(length - scale * sizes[d]) < 1e-4 * length, `all of the mesh along ${'xyz'[d]}`));
    const half = extent(await positionsOf(`${link}&x=0.5,1`));
    assert.ok(half[0] < 0.8 * whole[0] && half[0] > 0.4 * whole[0], 'sliced');
    const exploded = extent(await positionsOf(`${source}&explode=0.5,0`));
    assert.ok(exploded[0] > 1.2 * whole[0], 'exploded');
  });

  test('PNG: what is seen', async (t) => {
    const { page, bytes } = await saved(t, 'png');
    const picture = await pixelsOf(page, bytes);
    const seen = await settledPixels(page);
    assert.deepEqual([picture.width, picture.height], [seen.width, seen.height]);
    assert.ok(covered(picture) > 0.1);
    assert.ok(difference(tiles(picture), tiles(seen)) < 3);
  });
});

describe('links', () => {
  const clipboard = { permissions: ['clipboard-read', 'clipboard-write'] };

  test('a copied link restores mesh, grid, slices, colours and camera', async (t) => {
    const page = await site.open(t, '', clipboard);
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

  test('where the clipboard is out of reach the link is shown to be copied', async (t) => {
    const page = await site.open(t, link, { permissions: [] });
    await page.evaluate(() => {
      navigator.clipboard.writeText = () => Promise.reject(new Error('not allowed'));
    });
    await openPanel(page, 'save');
    await page.locator('#copy-link').click();
    await page.locator('#link').waitFor();
    assert.match(await page.locator('#link').inputValue(), /#url=http.*knot\.obj&n=6&explode=0,0$/);
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
