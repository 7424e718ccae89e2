import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { Triangle, Vector3 } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { readObj, writeObj } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { octahedron, octahedronFiles } from './mesh_files.mjs';
import { dataOf, download, enter, eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { covered, difference, pixelsOf, settledPixels, share, tiles } from './pictures.mjs';
import { cutOf, galleryMesh, keptCells, mandoline } from './reference.mjs';

const { takePicture } = await importBundled('page/view/picture.ts');
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
  const gltfOf = ({ buffer, byteOffset, length }) => new GLTFLoader().parseAsync(buffer.slice(byteOffset, byteOffset + length), '');
  const meshesOf = ({ scene }) => {
    const meshes = [];
    scene.updateMatrixWorld(true);
    scene.traverse((object) => object.isMesh && meshes.push(object));
    return meshes;
  };
  const areaOfMeshes = (meshes) => {
    const triangle = new Triangle();
    let area = 0;
    for (const { geometry } of meshes) {
      const position = geometry.getAttribute('position');
      for (let at = 0; at < position.count; at += 3) area += triangle.setFromAttributeAndIndices(position, at, at + 1, at + 2).getArea();
    }
    return area;
  };
  const gridCellOf = (at) => {
    const [nx, ny] = cutMesh.grid.cells;
    return [at % nx, Math.floor(at / nx) % ny, Math.floor(at / (nx * ny))];
  };
  /** Twice the area: that of the corners of a loop, counter-clockwise where y points up. */
  const shoelace = (loop) =>
    loop.reduce((sum, [x, y], at) => sum + x * loop.at(at - loop.length + 1)[1] - y * loop.at(at - loop.length + 1)[0], 0);
  const polygonArea = ({ polygonTriangleOffsets, triangles, positions }, at) => {
    let sum = 0;
    for (let corner = 3 * polygonTriangleOffsets[at]; corner < 3 * polygonTriangleOffsets[at + 1]; corner += 3) {
      const places = [0, 1, 2].map((k) => [-positions[3 * triangles[corner + k]], positions[3 * triangles[corner + k] + 1]]);
      sum += shoelace(places);
    }
    return sum;
  };

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
      const points = [];
      for (const { geometry, matrixWorld } of meshesOf(await gltfOf(bytes))) {
        const position = geometry.getAttribute('position').clone().applyMatrix4(matrixWorld);
        for (let at = 0; at < position.count; ++at) points.push([position.getX(at), position.getY(at), position.getZ(at)]);
      }
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
    await page.locator('#picture-size').selectOption('4');
    await page.locator('#picture-transparent').check();
    const large = await pixelsOf(page, (await download(page, '#save-png')).bytes);
    assert.deepEqual([large.width, large.height], [4 * seen.width, 4 * seen.height]);
    const alphas = [0, 255].map((alpha) => share(large, (_r, _g, _b, a) => a === alpha));
    assert.ok(alphas[0] > 0.3 && alphas[1] > 0.1 && alphas[0] + alphas[1] < 1, `shares without and with all colour: ${alphas}`);
    assert.equal(large.rgba[3], 0, 'nothing is drawn in the corner');
    assert.deepEqual((await settledPixels(page)).rgba, seen.rgba, 'the picture on the screen is the same');
    await page.evaluate(() => {
      const { getParameter, MAX_RENDERBUFFER_SIZE } = WebGL2RenderingContext.prototype;
      WebGL2RenderingContext.prototype.getParameter = function (name) {
        return name === MAX_RENDERBUFFER_SIZE ? 1000 : getParameter.call(this, name);
      };
    });
    await page.locator('#picture-size').selectOption('2');
    const { bytes: most } = await download(page, '#save-png');
    assert.match(await textOf(page, '[data-test=notice]'), /as many as it can: 1000 × \d+/);
    assert.equal((await pixelsOf(page, most)).width, 1000, 'the largest for which there is room');
  });

  test('PNG: drawn once where it has the pixels of the screen, and the background is back also where drawing fails', async () => {
    const gl = { canvas: { width: 100, height: 50 }, drawingBufferWidth: 100, drawingBufferHeight: 50 };
    Object.assign(gl, { getParameter: (name) => (name === 'MAX_VIEWPORT_DIMS' ? [8192, 8192] : 8192) });
    Object.assign(gl, { MAX_RENDERBUFFER_SIZE: 'MAX_RENDERBUFFER_SIZE', MAX_VIEWPORT_DIMS: 'MAX_VIEWPORT_DIMS' });
    const domElement = { width: 100, height: 50, toBlob: (take) => take('blob') };
    const renderer = { domElement, getContext: () => gl, setClearColor() {} };
    const scene = { background: 'grey' };
    for (const [times, expected] of Object.entries({ 1: [1], 2: [1, 2] })) {
      const drawn = [];
      const options = { times: Number(times), isTransparent: true };
      const picture = await takePicture(renderer, scene, options, (share) => drawn.push([share, scene.background]));
      assert.deepEqual(
        drawn,
        expected.map((share) => [share, null]),
      );
      assert.deepEqual(picture, { blob: 'blob', width: 100, height: 50, isSmaller: false });
    }
    const draw = () => {
      throw new Error('no memory');
    };
    assert.throws(() => takePicture(renderer, scene, { times: 1, isTransparent: true }, draw), /no memory/);
    assert.equal(scene.background, 'grey');
  });

  test('GLB with an object for each cell', async (t) => {
    const { page, bytes, name } = await saved(t, 'cells-glb');
    assert.equal(name, 'knot.obj-cells.glb');
    const one = await gltfOf((await download(page, '#save-glb')).bytes);
    const many = await gltfOf(bytes);
    const nodes = meshesOf(many);
    const cells = keptCells(reference, []);
    const untouched = Array.from(cutMesh.gridCellRegion.keys()).filter((at) => cutMesh.regionWinding[cutMesh.gridCellRegion[at]] === 1);
    assert.deepEqual(
      nodes.map((node) => node.name).sort(),
      // three's loader makes names of nodes such that it can address them.
      [...cells.map((cell) => `cell_${cell}`), ...untouched.map((at) => `grid_cell_${gridCellOf(at).join('_')}`)].sort(),
    );
    const areas = [nodes, meshesOf(one)].map(areaOfMeshes);
    assert.ok(Math.abs(areas[0] - areas[1]) < 1e-5 * areas[0], `the same triangles: ${areas}`);
    const { cellCentroid } = reference.measures;
    for (const cell of cells) {
      const at = nodes.find((node) => node.name === `cell_${cell}`).getWorldPosition(new Vector3());
      at.toArray().forEach((x, d) => assert.ok(Math.abs(x - cellCentroid[3 * cell + d]) < 1e-4, `cell ${cell} turns about its middle`));
    }
  });

  test('GLB with an object for each of too many cells is refused by name', async (t) => {
    const page = await site.open(t, 'mesh=wedge&n=28,28,28&box=-3,-3,-3,3,3,3&show=surface,gridFaces,edges,untouched,cutCells,outside');
    await openPanel(page, 'save');
    await page.locator('#save-cells-glb').click();
    const alert = page.getByRole('alert').filter({ hasText: 'Too many cells for an object each' });
    await alert.waitFor();
    assert.match(await alert.innerText(), /20,000.*one object/s);
  });

  test('SVG: what a plane cuts, cell by cell', async (t) => {
    const { name, bytes, page } = await saved(t, 'slice-z-svg', `${link}&z=0.55,-1&x=0.4,1`);
    assert.equal(name, 'knot.obj-slice-z.svg');
    const along = cutMesh.grid.planes[2];
    const [middle, half] = [(along.at(-1) + along[0]) / 2, (along.at(-1) - along[0]) / 2];
    const slice = mandoline.slice(cutMesh, { normal: [0, 0, -1], offset: 0.1 * half - middle }, { untouched: true });
    const inside = Array.from(slice.polygonCell.keys()).filter((at) => cutMesh.regionWinding[slice.polygonRegion[at]] === 1);
    assert.ok(inside.length > 10);
    const { viewBox, paths } = await page.evaluate((text) => {
      const svg = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
      const { x, y, width, height } = svg.viewBox.baseVal;
      const paths = Array.from(svg.querySelectorAll('path'), (path) => ({ ...path.dataset, d: path.getAttribute('d') }));
      return { viewBox: [x, y, width, height], paths };
    }, bytes.toString());
    assert.deepEqual(
      paths.map(({ cell, region }) => [cell === undefined ? -1 : Number(cell), Number(region)]),
      inside.map((at) => [slice.polygonCell[at], slice.polygonRegion[at]]),
    );
    // Seen against z with y upwards, x points to the left.
    const ends = (axis, sign) => {
      const points = inside.flatMap((at) =>
        Array.from(slice.triangles.subarray(3 * slice.polygonTriangleOffsets[at], 3 * slice.polygonTriangleOffsets[at + 1])),
      );
      const along = points.map((point) => sign * slice.positions[3 * point + axis]);
      return [Math.min(...along), Math.max(...along)];
    };
    const [[left, right], [top, bottom]] = [ends(0, -1), ends(1, -1)];
    assert.deepEqual(
      viewBox.map((x) => x.toFixed(5)),
      [left, top, right - left, bottom - top].map((x) => x.toFixed(5)),
    );
    const areaOf = (d) =>
      d
        .split('Z')
        .slice(0, -1)
        .reduce(
          (sum, loop) =>
            sum +
            shoelace(
              loop
                .slice(1)
                .split('L')
                .map((point) => point.split(' ').map(Number)),
            ),
          0,
        );
    const drawn = paths.reduce((sum, { d }) => sum - areaOf(d), 0);
    const expected = inside.reduce((sum, at) => sum + polygonArea(slice, at), 0);
    assert.ok(Math.abs(drawn - expected) < 1e-9 * expected, `${drawn} of ${expected}`);
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
