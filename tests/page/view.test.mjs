import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { torus, writeObj } from '../package/meshes.mjs';
import { octahedron } from './mesh_files.mjs';
import { dataOf, enter, eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { covered, difference, isBlue, isDrawn, isOrange, looksLike, pixelsOf, settledPixels, share, tiles } from './pictures.mjs';
import { cutOf, galleryMesh, keptCells, mandoline } from './reference.mjs';

const mesh = torus(24, 12);
const reference = await cutOf(mesh, { cells: 8 });
const spheres = await galleryMesh('nested-spheres');
const sheet = await galleryMesh('wavy-plane');
const pocket = withPocket(sheet);
const files = { 'torus.obj': mesh, 'spheres.obj': spheres, 'sheet.obj': sheet, 'pocket.obj': pocket };
const site = await startSite({
  smooth: true,
  files: Object.fromEntries(Object.entries(files).map(([name, file]) => [name, writeObj(file)])),
});
after(() => site.close());

/** The torus as one solid, whole, unless the rest says otherwise. */
const link = (rest = '') => {
  const parts = { url: site.meshUrl('torus.obj'), n: 8, up: 'y', explode: '0,0', ...Object.fromEntries(new URLSearchParams(rest)) };
  return Object.entries(parts)
    .map(([key, value]) => `${key}=${key === 'url' ? encodeURIComponent(value) : value}`)
    .join('&');
};
/** The sheet and, high above it, a closed octahedron. */
function withPocket({ positions, triangles }) {
  const top = octahedron.positions.map((x, at) => 0.1 * x + (at % 3 === 1 ? 1 : 0));
  return {
    positions: new Float64Array([...positions, ...top]),
    triangles: new Uint32Array([...triangles, ...Array.from(octahedron.triangles, (v) => v + positions.length / 3)]),
  };
}

const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const negated = (vector) => vector.map((x) => -x);
const allInside = keptCells(reference, []).length;

/** Waits until the canvas looks unlike the picture. */
async function looksUnlike(page, former, least = 4) {
  await eventually(async () => assert.ok(difference(tiles(await pixelsOf(page)), tiles(former)) > least));
}

/** Polygons of a slice that belong to shown cells: all but those outside. */
function capsOf({ cutMesh }, normal, position) {
  const { planes } = cutMesh.grid;
  const [low, high] = [0, 1].map((end) => normal.reduce((sum, n, d) => sum + n * planes[d].at(n > 0 === (end === 1) ? -1 : 0), 0));
  const slice = mandoline.slice(cutMesh, { normal, offset: low + (high - low) * position });
  return slice.polygonRegion.filter((region) => cutMesh.regionWinding[region] !== 0).length;
}

describe('slices', () => {
  for (const [axis, normal] of Object.entries(axes)) {
    test(`along ${axis}, moved, flipped and off`, async (t) => {
      const page = await site.open(t, link());
      await shows(page, '#canvas', { cells: allInside });
      await page.locator(`#slice-${axis}`).check();
      await shows(page, '#canvas', { cells: keptCells(reference, [{ normal, position: 0.5 }]).length });
      await slideTo(page, `#slice-${axis}-position`, 0.402);
      await shows(page, '#canvas', { cells: keptCells(reference, [{ normal, position: 0.402 }]).length });
      await looksLike(page, `torus sliced along ${axis}`);
      await page.locator(`#slice-${axis}-flip`).click();
      await shows(page, '#canvas', { cells: keptCells(reference, [{ normal: negated(normal), position: 0.598 }]).length });
      await slideTo(page, `#slice-${axis}-position`, 0);
      await shows(page, '#canvas', { cells: 0, untouched: 0 });
      await page.locator(`#slice-${axis}`).uncheck();
      await shows(page, '#canvas', { cells: allInside });
    });
  }

  test('several planes together, by key', async (t) => {
    const page = await site.open(t, link());
    await page.locator('#canvas').focus();
    await page.keyboard.press('x');
    await page.keyboard.press('z');
    const planes = [axes.x, axes.z].map((normal) => ({ normal, position: 0.5 }));
    await shows(page, '#canvas', { cells: keptCells(reference, planes).length });
    await page.keyboard.press('x');
    await shows(page, '#canvas', { cells: keptCells(reference, [{ normal: axes.z, position: 0.5 }]).length });
  });

  test('the free plane is turned with arrow keys, around and upward', async (t) => {
    const page = await site.open(t, link('free=0.44,1,0,0&up=y'));
    const keptBy = (heading, rise) => {
      const [h, r] = [(heading * Math.PI) / 180, (rise * Math.PI) / 180];
      const normal = [Math.cos(r) * Math.cos(h), Math.sin(r), Math.cos(r) * Math.sin(h)];
      return keptCells(reference, [{ normal, position: 0.44 }]).length;
    };
    await openPanel(page, 'view');
    await shows(page, '#canvas', { cells: keptBy(0, 0) });
    await slideTo(page, '#free-heading', 69);
    await page.locator('#free-heading').press('ArrowRight');
    await shows(page, '#canvas', { cells: keptBy(70, 0) });
    await slideTo(page, '#free-rise', 39);
    await page.locator('#free-rise').press('ArrowUp');
    await shows(page, '#canvas', { cells: keptBy(70, 40) });
    assert.equal(new Set([keptBy(0, 0), keptBy(70, 0), keptBy(70, 40)]).size, 3);
  });

  test('cells cut flat have filled caps', async (t) => {
    const page = await site.open(t, link('x=0.44,1&camera=6,1.5,2,0,0,0'));
    await shows(page, '#canvas', { caps: 0 });
    const whole = await settledPixels(page);
    await page.locator('#slice-mode-flat').check();
    await shows(page, '#canvas', { caps: capsOf(reference, axes.x, 0.44) });
    await looksUnlike(page, whole);
    await looksLike(page, 'torus cut flat');
    await page.locator('#slice-mode-whole').check();
    await shows(page, '#canvas', { caps: 0 });
    await eventually(async () => assert.equal(difference(tiles(await pixelsOf(page)), tiles(whole)), 0));
  });

  test('a flat cut comes with its caps, and new ones with every cut', async (t) => {
    const onNewPage = (made) =>
      made.addInitScript(() => {
        // What is asked of the worker reaches it late, so that whatever is asked for after a cut comes after its picture.
        window.Worker = class extends Worker {
          postMessage(...given) {
            setTimeout(() => super.postMessage(...given), 600);
          }
        };
        window.hollows = [];
        new MutationObserver(() => {
          const { frames, model, caps } = document.getElementById('canvas').dataset;
          if (model && caps === '0') window.hollows.push(`frame ${frames} of model ${model}`);
        }).observe(document, { subtree: true, attributeFilter: ['data-frames'] });
      });
    const page = await site.open(t, link('x=0.44,1&slice=flat'), { onNewPage });
    await shows(page, '#canvas', { caps: capsOf(reference, axes.x, 0.44) });
    await slideTo(page, '#cells', 9);
    await shows(page, '#counts', { grid: mandoline.cut(mesh, { cells: 9 }).grid.cells.join('x') });
    assert.equal(await isReady(page), 'ready');
    await shows(page, '#canvas', { caps: capsOf(await cutOf(mesh, { cells: 9 }), axes.x, 0.44) });
    assert.deepEqual(await page.evaluate(() => window.hollows), [], 'no frame lacks its caps');
  });

  test('a flat cut has no gaps: two discs of one colour', async (t) => {
    const page = await site.open(t, link('x=0.48,1&slice=flat&camera=8,0,0,0,0,0&color=region&show=surface,gridFaces,untouched,cutCells'));
    await shows(page, '#canvas', { caps: capsOf(reference, axes.x, 0.48) });
    // Between two axial planes. Seen from x = 8 with 35 degrees, the caps are nearly discs of radius 0.4 about (y, z) = (±1, 0).
    const picture = await pixelsOf(page);
    const scale = picture.height / 2 / Math.tan((35 * Math.PI) / 360) / 8;
    const colorAt = (y, z) => {
      const pixel = 4 * (Math.round(picture.width / 2 - scale * z) + picture.width * Math.round(picture.height / 2 - scale * y));
      return picture.rgba.subarray(pixel, pixel + 3);
    };
    assert.equal(isDrawn(picture)(...colorAt(1, 0.8)), false, 'nothing beside the discs');
    const middle = colorAt(1, 0);
    assert.ok(isDrawn(picture)(...middle), 'a cap in the middle of a disc');
    for (const y of [-1, 1]) {
      for (let angle = 0; angle < 24; ++angle) {
        for (const radius of [0.05, 0.2, 0.33]) {
          const color = colorAt(y + radius * Math.cos(angle), radius * Math.sin(angle));
          const isLikeMiddle = color.every((value, c) => Math.abs(value - middle[c]) < 12);
          assert.ok(isLikeMiddle, `filled at ${y}, ${radius}, ${angle}: ${color.join()} like ${middle.join()}`);
        }
      }
    }
  });

  test('cells that end in the plane of a flat cut are gone with their outlines', async (t) => {
    const at = (position) => `x=${position},1&slice=flat&explode=0.4,0&n=8&camera=8,3,4,0,0,0`;
    const exact = await settledPixels(await site.open(t, link(at(0.5)), { panels: [] }));
    const before = await settledPixels(await site.open(t, link(at(0.4999)), { panels: [] }));
    let unlike = 0;
    for (let i = 0; i < exact.rgba.length; i += 4) if (Math.abs(exact.rgba[i] - before.rgba[i]) > 40) ++unlike;
    t.diagnostic(`${unlike} of ${exact.rgba.length / 4} pixels differ`);
    assert.ok(unlike < 0.0005 * (exact.rgba.length / 4), `${unlike} pixels differ`);
  });

  test('the free plane, moved and flipped', async (t) => {
    const normal = [0.6, 0.48, 0.64];
    const page = await site.open(t, link(`free=0.45,${normal}`));
    await shows(page, '#canvas', { cells: keptCells(reference, [{ normal, position: 0.45 }]).length });
    await slideTo(page, '#slice-free-position', 0.7);
    await shows(page, '#canvas', { cells: keptCells(reference, [{ normal, position: 0.7 }]).length });
    await page.locator('#slice-free-flip').click();
    await shows(page, '#canvas', { cells: keptCells(reference, [{ normal: negated(normal), position: 0.3 }]).length });
  });

  test('the gizmo moves the free plane', async (t) => {
    // Seen from +z, a plane across x has its handle's arrow along the picture's horizontal.
    const page = await site.open(t, link('free=0.5,1,0,0&camera=0,0,7,0,0,0'));
    const box = await page.locator('#canvas').boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    const position = async () => Number(await page.locator('#slice-free-position').inputValue());
    const moved = async () => {
      for (let reach = 20; reach <= 90; reach += 10) {
        await page.mouse.move(x + reach, y);
        await page.mouse.down();
        await page.mouse.move(x + reach + 20, y, { steps: 4 });
        await page.mouse.move(x + reach + 50, y, { steps: 4 });
        await page.mouse.up();
        if ((await position()) > 0.52) return;
      }
      assert.fail('no handle moved the plane');
    };
    await moved();
    await eventually(async () => {
      const kept = keptCells(reference, [{ normal: axes.x, position: await position() }]).length;
      assert.ok(Math.abs(Number((await dataOf(page, '#canvas')).cells) - kept) <= 8);
    });
  });
});

describe('explosions', () => {
  test('by cell', async (t) => {
    const page = await site.open(t, link());
    const whole = await settledPixels(page);
    await slideTo(page, '#explode-cells', 0.6);
    await looksUnlike(page, whole, 8);
    await looksLike(page, 'torus exploded');
    assert.equal(await page.locator('#explode-cells').getAttribute('aria-valuetext'), '60%');
    await slideTo(page, '#explode-cells', 0);
    await eventually(async () => assert.equal(difference(tiles(await pixelsOf(page)), tiles(whole)), 0));
  });

  test('by region', async (t) => {
    const page = await site.open(t, 'mesh=nested-spheres&n=6&free=off&explode=0,0&color=region&camera=0,2,16,0,0,0');
    const whole = await settledPixels(page);
    await slideTo(page, '#explode-regions', 0.8);
    await looksUnlike(page, whole, 8);
    await looksLike(page, 'nested spheres side by side');
  });
});

describe('a whole view stays whole', () => {
  /** How many pixels along the picture's rim have a region's colour; its shadow, which has none, may be there. */
  const atRim = async (page) => {
    const picture = await pixelsOf(page);
    const { width, height, rgba } = picture;
    const isColored = (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) > 40;
    let count = 0;
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        if (x > 1 && y > 1 && x < width - 2 && y < height - 2) continue;
        const at = 4 * (x + width * y);
        if (isColored(...rgba.subarray(at, at + 3))) ++count;
      }
    }
    return count;
  };
  for (const [name, cells] of [
    ['nested-spheres', 6],
    ['chain', 8],
  ]) {
    for (const key of ['regions', 'cells']) {
      test(`when ${name} explode by ${key}`, async (t) => {
        const page = await site.open(t, `mesh=${name}&n=${cells}&free=off&explode=0,0&color=region`);
        const whole = await settledPixels(page);
        for (const amount of [0.5, 1]) {
          await slideTo(page, `#explode-${key}`, amount);
          await looksUnlike(page, whole, 3);
          await eventually(async () => {
            assert.equal(await atRim(page), 0, 'nothing leaves the picture');
            assert.ok(covered(await pixelsOf(page)) > 0.03, 'yet it is seen from near');
          });
        }
        await slideTo(page, `#explode-${key}`, 0);
        await eventually(async () => assert.ok(difference(tiles(await pixelsOf(page)), tiles(whole)) < 1, 'and comes back'));
      });
    }
  }
});

describe('colours', () => {
  test('the legend leaves out untouched cells where there are none', async (t) => {
    const page = await site.open(t, 'mesh=wedge&n=4&free=off');
    await shows(page, '#counts', { untouchedCells: 0 });
    assert.equal(await textOf(page, '#legend'), 'pieces of triangles pieces of grid-faces');
    await enter(page, '#cells-number', 12);
    await eventually(async () => assert.match(await textOf(page, '#legend'), /untouched cells$/));
  });

  test('an empty picture has no legend', async (t) => {
    const page = await site.open(t, link('x=0.4,1'));
    const hasLegend = (expected) => eventually(async () => assert.equal(await page.locator('#legend').isVisible(), expected));
    await hasLegend(true);
    await slideTo(page, '#slice-x-position', 0);
    await hasLegend(false);
    await slideTo(page, '#slice-x-position', 0.5);
    await hasLegend(true);
    for (const layer of ['cutCells', 'untouched']) await page.locator(`#show-${layer}`).uncheck();
    await hasLegend(false);
    await page.locator('#show-cutCells').check();
    await hasLegend(true);
    for (const layer of ['surface', 'gridFaces', 'edges']) await page.locator(`#show-${layer}`).uncheck();
    await hasLegend(false);
  });

  const legends = {
    region: ['region 0, outside', 'region 1', 'region 2, outside', 'region 3', 'region 4, outside', 'region 5'],
    winding: ['winding number 0', 'winding number 1'],
    volume: ['0% of a grid cell', '25% of a grid cell', '50% of a grid cell', '100% of a grid cell'],
    kind: ['pieces of triangles', 'pieces of grid-faces', 'untouched cells'],
    cell: [],
  };
  test('by region, winding number, volume, kind and cell, each with its legend', async (t) => {
    const look = 'free=off&explode=0,0&z=0.55,1&show=surface,gridFaces,untouched,cutCells,outside&camera=1,1,5,0,0,0';
    const page = await site.open(t, `mesh=nested-spheres&n=6&${look}`);
    const pictures = [];
    for (const [colorBy, expected] of Object.entries(legends)) {
      await page.locator('#color-by').selectOption(colorBy);
      await eventually(async () => assert.deepEqual(await page.locator('#legend .entry').allInnerTexts(), expected));
      await looksLike(page, `nested spheres by ${colorBy}`);
      const picture = tiles(await pixelsOf(page));
      for (const former of pictures) assert.ok(difference(former, picture) > 3, `colours by ${colorBy} are unlike the others`);
      pictures.push(picture);
      const swatches = await page.locator('#legend .swatch').evaluateAll((all) => {
        return all.map((swatch) => getComputedStyle(swatch).backgroundColor);
      });
      if (colorBy !== 'region' && colorBy !== 'winding') assert.equal(new Set(swatches).size, expected.length);
    }
  });
});

describe('show', () => {
  test('surface and grid-faces', async (t) => {
    const page = await site.open(t, link('explode=0.4,0'));
    await eventually(async () => {
      const picture = await pixelsOf(page);
      assert.ok(share(picture, isOrange) > 0.02 && share(picture, isBlue) > 0.02);
    });
    await page.locator('#show-surface').uncheck();
    await eventually(async () => assert.ok(share(await pixelsOf(page), isOrange) < 0.001));
    await page.locator('#show-surface').check();
    await page.locator('#show-gridFaces').uncheck();
    await eventually(async () => {
      const picture = await pixelsOf(page);
      assert.ok(share(picture, isBlue) < 0.001);
      assert.ok(share(picture, isOrange) > 0.02);
    });
  });

  test('edges', async (t) => {
    const page = await site.open(t, link('show=surface,gridFaces,cutCells'));
    const bare = await settledPixels(page);
    assert.ok(covered(bare) > 0.1);
    const isDark = (r, g, b) => r + g + b < 240;
    await page.locator('#show-edges').check();
    await eventually(async () => assert.ok(share(await pixelsOf(page), isDark) > share(bare, isDark) + 0.005));
    await page.locator('#show-edges').uncheck();
    await eventually(async () => assert.equal(difference(tiles(await pixelsOf(page)), tiles(bare)), 0));
  });

  test('untouched cells, cut-cells and the outside', async (t) => {
    const page = await site.open(t, link('n=14'));
    const finer = await cutOf(mesh, { cells: 14 });
    const { cutMesh } = finer;
    const inside = keptCells(finer, []).length;
    assert.ok(
      cutMesh.gridCellRegion.some((region) => cutMesh.regionWinding[region] === 1),
      'there are untouched cells inside',
    );
    const untouched = async () => Number((await dataOf(page, '#canvas')).untouched);
    await shows(page, '#canvas', { cells: inside });
    await eventually(async () => assert.ok((await untouched()) > 0));
    await page.locator('#show-untouched').uncheck();
    await shows(page, '#canvas', { cells: inside, untouched: 0 });
    await page.locator('#show-cutCells').uncheck();
    await shows(page, '#canvas', { cells: 0, untouched: 0 });
    await eventually(async () => assert.ok(covered(await pixelsOf(page)) < 0.01));
    await page.locator('#show-untouched').check();
    await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.02));
    await page.locator('#show-cutCells').check();
    await page.locator('#show-outside').check();
    await shows(page, '#canvas', { cells: cutMesh.cellRegion.length });
    await looksLike(page, 'torus with the outside');
  });

  test('one region', async (t) => {
    const page = await site.open(t, link(`url=${encodeURIComponent(site.meshUrl('spheres.obj'))}&n=6`));
    const { cutMesh } = await cutOf(spheres, { cells: 6 });
    const options = await page.locator('#region option').allTextContents();
    assert.equal(options.length, cutMesh.regionCount + 1);
    for (let region = 0; region < cutMesh.regionCount; ++region) {
      const cells = cutMesh.cellRegion.filter((id) => id === region).length;
      assert.match(options[region + 1], new RegExp(`^${region}\\b.*winding ${cutMesh.regionWinding[region]}.*· ${cells} cut-cells?$`));
      await page.locator('#region').selectOption(String(region));
      await shows(page, '#canvas', { cells });
    }
    await page.locator('#region').selectOption('');
    await shows(page, '#canvas', { cells: cutMesh.cellRegion.filter((region) => cutMesh.regionWinding[region] !== 0).length });
  });

  test('an open sheet has next to no inside: all cells around it are shown', async (t) => {
    const page = await site.open(t, '', { reducedMotion: 'reduce' });
    await page.locator('#url').fill(site.meshUrl('sheet.obj'));
    await page.locator('#open-url').click();
    const { cutMesh } = await cutOf(sheet, { cells: 16 });
    assert.equal(cutMesh.regionWinding, null);
    await shows(page, '#counts', { cutCells: cutMesh.cellRegion.length });
    await shows(page, '#canvas', { cells: cutMesh.cellRegion.length });
    const hasSheetLook = async () => {
      assert.equal(await page.locator('#show-outside').isChecked(), true);
      assert.equal(await page.locator('#show-gridFaces').isChecked(), false, 'what would hide the sheet is left out');
      assert.equal(await textOf(page, '#legend'), 'pieces of triangles inside by an estimate', 'the sheet has one colour');
    };
    await hasSheetLook();
    await page.locator('#show-outside').uncheck();
    const estimated = mandoline.estimateInside(sheet, cutMesh);
    const { isInside } = mandoline.insideRegions(estimated, { rule: 'nonZero' });
    await shows(page, '#canvas', { cells: estimated.cellRegion.filter((region) => isInside[region] === 1).length });
    await page.locator('#reset-look').click();
    await shows(page, '#canvas', { cells: cutMesh.cellRegion.length });
    await hasSheetLook();

    await page.locator('#gallery [data-name="bunny"]').click();
    await shows(page, '#mesh-line', { name: 'bunny' });
    await isReady(page);
    assert.equal(await page.locator('#show-gridFaces').isChecked(), true);
    assert.equal(await page.locator('#color-by').inputValue(), 'kind');
  });

  test('a sheet with a closed pocket is shown, and a link to a sheet too', async (t) => {
    for (const name of ['pocket.obj', 'sheet.obj']) {
      const page = await site.open(t, `n=12&url=${encodeURIComponent(site.meshUrl(name))}`);
      const { cutMesh } = await cutOf(name === 'sheet.obj' ? sheet : pocket, { cells: 12 });
      assert.equal(cutMesh.regionCount, name === 'sheet.obj' ? 1 : 2);
      await shows(page, '#canvas', { cells: cutMesh.cellRegion.length });
      assert.equal(await page.locator('#show-gridFaces').isChecked(), false);
    }
  });

  test('beside a sheet there is but an outside, also where the corner is cut', async (t) => {
    const page = await site.open(t, `n=3&url=${encodeURIComponent(site.meshUrl('sheet.obj'))}`);
    const { cutMesh } = await cutOf(sheet, { cells: 2 });
    assert.ok(
      cutMesh.gridCellRegion.every((region) => region < 0),
      'all grid cells are cut',
    );
    await page.locator('#cells-number').fill('2');
    await page.locator('#cells-number').press('Enter');
    await eventually(async () =>
      assert.match((await page.locator('#region option').allTextContents())[1], /^0 · outside by an estimate: −?0/),
    );
  });

  test('a grid within the mesh has an inside alone, which is shown', async (t) => {
    const url = encodeURIComponent(site.meshUrl('spheres.obj'));
    const page = await site.open(t, `n=2,2,2&box=-0.1,-0.1,-0.1,0.1,0.1,0.1&free=off&url=${url}`);
    const options = await page.locator('#region option').allTextContents();
    assert.match(options[1], /^0 · winding 1/);
    assert.ok(Number((await dataOf(page, '#canvas')).untouched) > 0);
  });
});

test('a link to an exploded view shows all of it', async (t) => {
  const page = await site.open(t, link('explode=1,0'));
  const linked = await settledPixels(page);
  assert.ok(covered(linked) > 0.05);
  await page.locator('#fit').click();
  await eventually(async () => assert.ok(difference(tiles(await pixelsOf(page)), tiles(linked)) < 1));
});

test('reset and fit', async (t) => {
  const page = await site.open(t, link('x=0.4,1&explode=0.5,0.5&color=cell&show=surface&camera=9,9,9,0,0,0'));
  await page.locator('#reset-look').click();
  await eventually(async () => {
    assert.equal(await page.locator('#slice-x').isChecked(), false);
    assert.equal(await page.locator('#slice-free').isChecked(), false);
    assert.equal(await page.locator('#color-by').inputValue(), 'kind');
  });
  await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.1));
  assert.match(await textOf(page, '#hover-line'), /torus\.obj/);
});
