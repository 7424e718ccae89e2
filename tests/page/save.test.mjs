import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { Triangle, Vector3 } from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { readObj, writeObj } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { download, openPanel, startSite } from './page_helpers.mjs';
import { covered, difference, pixelsOf, settledPixels, share, tiles } from './pictures.mjs';
import { cutOf, galleryMesh, keptCells, mandoline } from './reference.mjs';

const { takePicture } = await importBundled('page/view/picture.ts');
const knot = await galleryMesh('torus-knot');
const site = await startSite({ files: { 'knot.obj': writeObj(knot) } });
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
    // The notice goes away by itself.
    const said = page
      .locator('[data-test=notice]')
      .filter({ hasText: /as many as it can: 1000 × \d+/ })
      .waitFor();
    const [{ bytes: most }] = await Promise.all([download(page, '#save-png'), said]);
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

  test('PNG: what goes wrong is said, and can be tried again', async (t) => {
    const page = await site.open(t, link, { expectedProblem: /out of canvas/ });
    await openPanel(page, 'save');
    await page.evaluate(() => {
      const { toBlob } = HTMLCanvasElement.prototype;
      HTMLCanvasElement.prototype.toBlob = () => {
        HTMLCanvasElement.prototype.toBlob = toBlob;
        throw new Error('out of canvas');
      };
    });
    await page.locator('#save-png').click();
    await page.getByRole('alert').filter({ hasText: 'out of canvas' }).waitFor();
    assert.ok((await download(page, '#save-png')).bytes.length > 1000);
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
    const { viewBox, stroke, paths } = await page.evaluate((text) => {
      const svg = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
      const { x, y, width, height } = svg.viewBox.baseVal;
      const paths = Array.from(svg.querySelectorAll('path'), (path) => ({ ...path.dataset, d: path.getAttribute('d') }));
      return { viewBox: [x, y, width, height], stroke: Number(svg.querySelector('g').getAttribute('stroke-width')), paths };
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
      [left - stroke / 2, top - stroke / 2, right - left + stroke, bottom - top + stroke].map((x) => x.toFixed(5)),
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
