// Voxels and marching cubes beside cut-cells.
import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { assertClosed, box, torus } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { dataOf, eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { settledPixels } from './pictures.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const { comparison } = await importBundled('worker/compare/index.ts');
const { otherGrid } = await importBundled('model/comparison.ts');
const { cubeCases, cubeEdges } = await importBundled('worker/compare/marching_cubes.ts');
const { OtherWay } = await importBundled('page/view/layers/other_way.ts');

const extentOf = ({ volume, area }) => ({ volume, area });

const cases = {
  torus: [torus(48, 24), { cells: 12 }],
  bunny: [await galleryMesh('bunny'), { cells: 16 }],
  'nested-spheres': [await galleryMesh('nested-spheres'), { cells: 14 }],
};

const origin = [0.1, 0.2, 0.3];

async function compared([mesh, grid]) {
  const { cutMesh, measures } = await cutOf(mesh, grid);
  return { cutMesh, measures, ...comparison(mandoline, { mesh, cutMesh, origin, measures: null }, null) };
}

test('each case of marching cubes parts the corners inside from the others, and cubes side by side agree', () => {
  assert.equal(cubeCases.length, 256);
  cubeCases.forEach((polygons, inside) => {
    const crossed = cubeEdges.flatMap(([a, b], edge) => (((inside >> a) ^ (inside >> b)) & 1 ? [edge] : []));
    assert.deepEqual(
      [...new Set(polygons.flat())].sort((a, b) => a - b),
      crossed,
      `case ${inside}`,
    );
  });
  assert.equal(
    cubeCases.flat().reduce((sum, { length }) => sum + length - 2, 0),
    820,
  );
});

test('what is drawn of one way leaves that of another as it is, to be drawn again', () => {
  const way = (length, value) => ({
    position: new Float32Array(length).fill(value),
    index: new Uint32Array(length).fill(value),
    grid: null,
  });
  const ways = { voxels: way(90, 1), cubes: way(60, 2) };
  const layer = new OtherWay({});
  for (const shown of ['voxels', 'cubes', 'voxels']) {
    const settings = { compare: { way: shown }, show: { surface: true, edges: true } };
    layer.setLook({ comparison: { origin, ways }, model: { origin }, settings });
    const { attributes, index, drawRange } = layer.object.children[0].geometry;
    for (const array of [attributes.position.array, index.array]) {
      assert.deepEqual(new Set(array.subarray(0, drawRange.count)), new Set([shown === 'voxels' ? 1 : 2]));
    }
  }
  assert.deepEqual(ways, { voxels: way(90, 1), cubes: way(60, 2) });
});

/** How many grid cells have their middle inside, by sums of solid angles, which know nothing of cells. */
function countedVoxels(mesh, { planes, cells }) {
  const points = [];
  for (let k = 0; k < cells[2]; ++k)
    for (let j = 0; j < cells[1]; ++j)
      for (let i = 0; i < cells[0]; ++i) points.push(...[i, j, k].map((c, d) => (planes[d][c] + planes[d][c + 1]) / 2));
  return mandoline.generalizedWindingNumbers(mesh, points).filter((winding) => Math.round(winding) !== 0).length;
}

for (const [name, given] of Object.entries(cases)) {
  const result = compared(given);

  test(`${name}: the exact numbers are those of measure()`, async () => {
    const { cutMesh, measures, exact } = await result;
    const inside = measures.regionVolume.filter((_, region) => cutMesh.regionWinding[region] !== 0);
    assert.equal(
      exact.volume,
      inside.reduce((sum, x) => sum + x, 0),
    );
    const { faceCells } = mandoline.adjacency(cutMesh);
    const isIn = (cell) => cell >= 0 && cutMesh.regionWinding[cutMesh.cellRegion[cell]] !== 0;
    let area = 0;
    measures.faceArea.forEach((x, face) => {
      if (cutMesh.faceTriangle[face] >= 0 && isIn(faceCells[2 * face]) !== isIn(faceCells[2 * face + 1])) area += x;
    });
    assert.ok(Math.abs(exact.area - area) < 1e-9 * area);
  });

  test(`${name}: voxels are the grid cells whose middle is inside`, async () => {
    const { cutMesh, ways } = await result;
    const counted = countedVoxels(given[0], cutMesh.grid);
    const { planes } = cutMesh.grid;
    const size = planes.reduce((product, axis) => product * (axis[1] - axis[0]), 1);
    assert.ok(Math.abs(ways.voxels.volume - counted * size) < 1e-9 * ways.voxels.volume);
    assertClosed({ triangles: ways.voxels.index });
  });

  test(`${name}: the surface of marching cubes is closed, on the mesh, and nearer to its area than voxels`, async () => {
    const { cutMesh, ways, exact } = await result;
    assertClosed({ triangles: ways.cubes.index });
    const points = Float64Array.from(ways.cubes.position, (x, at) => x + origin[at % 3]);
    const { cell } = mandoline.cellsAt(cutMesh, points);
    assert.ok(
      cell.every((id) => id >= 0),
      'all of its vertices lie in cut-cells',
    );
    const off = ({ area }) => Math.abs(area / exact.area - 1);
    assert.ok(off(ways.cubes) < off(ways.voxels), `${off(ways.cubes)}, of voxels ${off(ways.voxels)}`);
  });
}

/** How many cells are inside: those with a winding number. */
function countInside({ cellRegion, regionWinding, runRegion, runBegin, runEnd }) {
  const isIn = (region) => regionWinding[region] !== 0;
  const untouched = runRegion.reduce((sum, region, run) => sum + (isIn(region) ? runEnd[run] - runBegin[run] : 0), 0);
  return { cut: cellRegion.filter(isIn).length, untouched };
}

test('cut-cells of a coarser and a finer grid have the same volume and area, and other cells', async () => {
  const [mesh, grid] = cases.bunny;
  const cut = { ...(await cutOf(mesh, grid)), origin };
  for (const [way, cells] of [
    ['coarser', 8],
    ['finer', 32],
  ]) {
    assert.deepEqual(otherGrid(grid, way), { cells });
    const other = { ...(await cutOf(mesh, { cells })), origin: [7, 8, 9] };
    const { exact, ways } = comparison(mandoline, cut, { way, cut: other });
    assert.deepEqual(Object.keys(ways), ['voxels', 'cubes', way]);
    const surface = ways[way];
    for (const what of ['volume', 'area']) assert.ok(Math.abs(surface[what] / exact[what] - 1) < 1e-12, `${way}, ${what}`);
    assert.deepEqual(surface.cells, countInside(other.cutMesh));
    assert.deepEqual(exact.cells, countInside(cut.cutMesh));
    assertClosed({ triangles: surface.index });
    assert.deepEqual(
      surface.grid.low.map((x, d) => Math.abs(x + origin[d] - other.cutMesh.grid.planes[d][0]) < 1e-12),
      [true, true, true],
    );
  }
  assert.deepEqual(otherGrid({ min: [0, 0, 0], max: [1, 2, 3], cells: [1, 5, 8] }, 'coarser').cells, [1, 3, 4]);
});

test('a box on grid planes is what voxels make of it', async () => {
  const { ways, exact } = await compared([box([1, 1, 1], [3, 2, 2]), { min: [0, 0, 0], max: [4, 4, 4], cells: [4, 4, 4] }]);
  assert.deepEqual(extentOf(ways.voxels), { volume: 2, area: 10 });
  assert.deepEqual(extentOf(exact), { volume: 2, area: 10 });
});

test('a grid inside a box is full, and closed by its sides, in all ways', async () => {
  const { ways, exact } = await compared([box([0, 0, 0], [5, 5, 5]), { min: [1, 1, 1], max: [3, 3, 3], cells: [2, 2, 2] }]);
  for (const { volume, area } of [exact, ways.voxels, ways.cubes]) {
    assert.ok(Math.abs(volume - 8) < 1e-14 && area === 24, `${volume}, ${area}`);
  }
  for (const { index } of Object.values(ways)) assertClosed({ triangles: index });
});

describe('on the page', async () => {
  const site = await startSite();
  after(() => site.close());
  const rowOf = async (page, way) => {
    const { volume, area } = await dataOf(page, `#compare [data-way="${way}"]`);
    return { volume: Number(volume), area: Number(area) };
  };

  test('the table has the volume of measure(), and of voxels that are counted; it follows the cut', async (t) => {
    const page = await site.open(t, 'mesh=torus-knot&n=12&compare=voxels');
    const mesh = await galleryMesh('torus-knot');
    for (const cells of [12, 13]) {
      if (cells > 12) await slideTo(page, '#cells', cells);
      const { cutMesh, measures } = await cutOf(mesh, { cells });
      const exact = measures.regionVolume.reduce((sum, x, region) => sum + (cutMesh.regionWinding[region] ? x : 0), 0);
      const voxel = cutMesh.grid.planes.reduce((product, axis) => product * (axis[1] - axis[0]), 1);
      const counted = countedVoxels(mesh, cutMesh.grid);
      await eventually(async () => {
        const count = (await rowOf(page, 'voxels')).volume / voxel;
        assert.ok(Math.abs(count - counted) < 1e-6, `${count} voxels of ${counted}`);
      });
      assert.equal((await rowOf(page, 'cutCells')).volume, exact);
    }
    await openPanel(page, 'compare');
    const [exact, other] = [await rowOf(page, 'cutCells'), await rowOf(page, 'cubes')];
    const percent = (what) => (100 * Math.abs(other[what] / exact[what] - 1)).toPrecision(3);
    assert.match(await textOf(page, '#compare [data-way="cutCells"]'), /exact .* exact/);
    assert.match(await textOf(page, '#compare [data-way="cubes"]'), new RegExp(`−${percent('volume')}% .*${percent('area')}%`));
  });

  test('the divider is dragged, moved with keys and kept in the link', async (t) => {
    const page = await site.open(t, 'mesh=torus&n=8&free=off&explode=0,0&compare=voxels');
    await shows(page, '#canvas', { compare: 'voxels' });
    const { x, y, width, height } = await page.locator('#canvas').boundingBox();
    for (const [from, to, atHeight] of [
      [0.5, 0.3, 0.5],
      [0.3, 0.7, 0.1],
    ]) {
      await page.mouse.move(x + from * width, y + atHeight * height);
      await page.mouse.down();
      await page.mouse.move(x + to * width, y + 0.4 * height, { steps: 3 });
      await page.mouse.up();
      assert.ok(Math.abs(Number(await page.locator('#divider').inputValue()) - to) < 0.011);
    }
    await page.locator('#divider').press('ArrowRight');
    await eventually(async () => assert.match(page.url(), /compare=voxels&divider=0\.71$/));
    assert.doesNotMatch(page.url(), /camera=/);
  });

  test('left of the divider there are the cut-cells as they are alone, right of it the other way alone', async (t) => {
    const page = await site.open(t, 'mesh=torus&n=8&free=off&explode=0,0', {
      viewport: { width: 800, height: 400 },
      reducedMotion: 'reduce',
    });
    await openPanel(page, 'compare');
    const alone = await settledPixels(page);
    const changedIn = async (from, to) => {
      const { rgba, width, height } = await settledPixels(page);
      let changed = 0;
      for (let row = 0; row < height; ++row) {
        for (let column = Math.ceil(from * width); column < Math.floor(to * width); ++column) {
          const at = 4 * (column + width * row);
          if (!rgba.subarray(at, at + 3).equals(alone.rgba.subarray(at, at + 3))) ++changed;
        }
      }
      return changed / (width * height);
    };
    await page.locator('#compare-voxels').check();
    await shows(page, '#canvas', { compare: 'voxels' });
    await eventually(async () => assert.ok((await changedIn(0.5, 1)) > 0.02));
    assert.equal(await changedIn(0, 0.5), 0);
    await page.locator('#divider').press('Home');
    await eventually(async () => assert.ok((await changedIn(0, 0.5)) > 0.02));
    const { x, y, width, height } = await page.locator('#canvas').boundingBox();
    await page.mouse.click(x + 0.35 * width, y + 0.5 * height);
    assert.equal(await page.locator('#cell-card').isVisible(), false, 'voxels are not cut-cells that can be picked');
    await page.mouse.move(0, 0); // A cell that comes under the pointer would be lit.
    await page.locator('#divider').press('End');
    await eventually(async () => assert.equal(await changedIn(0, 1), 0));
    await openPanel(page, 'steps');
    await page.locator('#step-next').click();
    await eventually(async () => assert.equal(await page.locator('#divider').count(), 0, 'a step is not divided'));
  });

  test('cut-cells of a finer grid stand beside; the table has their numbers, which are the same', async (t) => {
    const page = await site.open(t, 'mesh=torus-knot&n=12&compare=finer', { panels: ['compare'] });
    await shows(page, '#canvas', { compare: 'finer' });
    const mesh = await galleryMesh('torus-knot');
    const row = async (way) => {
      const { cut, untouched } = await dataOf(page, `#compare [data-way="${way}"]`);
      return { cut: Number(cut), untouched: Number(untouched) };
    };
    const isBeside = async (way, cells) => {
      const { cutMesh } = await cutOf(mesh, { cells });
      await eventually(async () => assert.deepEqual(await row(way), countInside(cutMesh)));
      assert.ok((await textOf(page, '#divided')).includes(`${cutMesh.grid.cells.join(' × ')} grid`));
      const [exact, other] = [await rowOf(page, 'cutCells'), await rowOf(page, way)];
      for (const what of ['volume', 'area']) assert.ok(Math.abs(other[what] / exact[what] - 1) < 1e-12, what);
      assert.match(await textOf(page, `#compare [data-way="${way}"]`), /(the same|same to).*(the same|same to)/);
    };
    await isBeside('finer', 24);
    await page.locator('#compare-coarser').check();
    await isBeside('coarser', 6);
    await slideTo(page, '#cells', 14);
    await isBeside('coarser', 7);
    assert.deepEqual(await row('cutCells'), countInside((await cutOf(mesh, { cells: 14 })).cutMesh));
  });

  test('where there is no inside, as of an open sheet, the page says so', async (t) => {
    const page = await site.open(t, 'mesh=wavy-plane&n=8&compare=cubes');
    await openPanel(page, 'compare');
    assert.match(await textOf(page, '#compare-note'), /nothing to compare.*no inside/);
    assert.equal(await page.locator('#divider').count(), 0);
    await page.locator('#gallery [data-name="wedge"]').click();
    assert.equal(await isReady(page), 'ready');
    await page.locator('#compare-cubes').check();
    await shows(page, '#canvas', { compare: 'cubes' });
    assert.equal(await textOf(page, '#compare-note'), '');
  });
});
