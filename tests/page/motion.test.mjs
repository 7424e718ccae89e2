// Surfaces that move: where they go, and that the page cuts them at every moment.
import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { box, join } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { download, eventually, isReady, openPanel, shows, startSite, textOf } from './page_helpers.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const { makeMover, motions } = await importBundled('model/motion.ts');
const { boundsOf, gridAround } = await importBundled('model/grid_around.ts');

const moverOf = (mesh, motion) => makeMover(mesh, mandoline.inspect(mesh).triangleComponent, motion);
const meshes = { bunny: await galleryMesh('bunny'), gears: await galleryMesh('gears') };

describe('movers', () => {
  for (const [name, mesh] of Object.entries(meshes)) {
    for (const motion of motions) {
      test(`${name}, ${motion}: never leaves its bounds, and comes back`, () => {
        const { bounds, at } = moverOf(mesh, motion);
        for (let step = 0; step <= 24; ++step) {
          const { min, max } = boundsOf(at(step / 24));
          for (let d = 0; d < 3; ++d) assert.ok(min[d] >= bounds.min[d] - 1e-12 && max[d] <= bounds.max[d] + 1e-12, `phase ${step} / 24`);
        }
        const [first, last] = [at(0), at(motion === 'turn' ? 24 : 1)];
        const moved = at(0.3).positions.filter((x, i) => Math.abs(x - first.positions[i]) > 1e-3).length;
        assert.ok(moved > first.positions.length / 10, `${moved} coordinates have moved`);
        if (motion !== 'turn') for (const [i, x] of last.positions.entries()) assert.ok(Math.abs(x - first.positions[i]) < 1e-12);
        assert.deepEqual(last.triangles, first.triangles);
      });
    }
  }

  test('parts turn as gears do: in opposite directions, the smaller one faster', () => {
    const mesh = join(box([-2, -2, 0], [2, 2, 1]), box([3, -1, 0], [5, 1, 1]));
    const { positions } = moverOf(mesh, 'turn').at(1 / 8);
    // The large box by an eighth, the small one the other way by a quarter.
    const [x, y] = positions;
    assert.ok(Math.abs(Math.hypot(x, y) - Math.hypot(2, 2)) < 1e-12 && Math.abs(x) < 1e-12 !== Math.abs(y) < 1e-12);
    const small = positions.subarray(24).filter((_, i) => i % 3 === 0);
    assert.ok(small.every((value) => Math.abs(Math.abs(value - 4) - 1) < 1e-12));
  });

  test('a mesh of one part meets its own copy, turned; of several parts the first one stays', () => {
    const { positions, triangles } = moverOf(box([0, 0, 0], [3, 2, 1]), 'pass').at(0);
    assert.equal(triangles.length, 72);
    assert.deepEqual(boundsOf({ positions: positions.subarray(24), triangles: triangles.slice(36).map((v) => v - 8) }), {
      min: [0, 0.5, -0.5],
      max: [3, 1.5, 1.5],
    });
    const two = join(box([0, 0, 0], [1, 1, 1]), box([2, 0, 0], [3, 1, 1]));
    const moved = moverOf(two, 'pass').at(0.25);
    assert.deepEqual([...moved.positions.subarray(0, 24)], [...two.positions.slice(0, 24)]);
    assert.ok(Math.abs(moved.positions[24] - (2 + 0.6 * 3)) < 1e-12);
  });
});

describe('on the page', async () => {
  const site = await startSite();
  after(() => site.close());

  for (const [motion, phase] of [
    ['wave', 0.25],
    ['pass', 0.1],
  ]) {
    test(`a link to a moment of a ${motion} shows the cut of that moment`, async (t) => {
      const page = await site.open(t, `n=12&pose=${motion},${phase}`);
      const { bounds, at } = moverOf(meshes.bunny, motion);
      const { cutMesh } = await cutOf(at(phase), gridAround(bounds, 12));
      await shows(page, '#counts', {
        cutCells: cutMesh.cellRegion.length,
        regions: cutMesh.regionCount,
        grid: cutMesh.grid.cells.join('x'),
      });
    });
  }

  test('a moving surface is cut again and again, validly, until it is paused; at rest it is as it was', async (t) => {
    const page = await site.open(t, 'mesh=bunny&n=12');
    const cuts = () => page.locator('#counts').evaluate((counts) => Number(counts.dataset.model));
    const cells = () => page.locator('#counts').evaluate((counts) => counts.dataset.cutCells);
    const [first, atRest] = [await cuts(), await cells()];
    await openPanel(page, 'motion');
    await page.locator('#play-what').selectOption('wave');
    await page.locator('#play').click();
    await eventually(async () => assert.ok((await cuts()) > first + 10));
    assert.match(await textOf(page, '#play-rate'), /^\d+ cuts a second$/);
    await page.locator('#play').click();
    assert.equal(await isReady(page), 'ready');
    const last = await cuts();
    await page.waitForTimeout(300);
    assert.equal(await cuts(), last, 'nothing is cut after the pause');
    assert.match(await page.evaluate(() => location.hash), /pose=wave,/);
    await openPanel(page, 'checks');
    await page.locator('#validate').click();
    await shows(page, '#validation', { pass: true });
    await page.locator('#at-rest').click();
    await eventually(async () => assert.equal(await cells(), atRest));
  });

  test('what is seen can be filmed', async (t) => {
    const page = await site.open(t, 'mesh=torus-knot&n=8');
    await openPanel(page, 'motion');
    await page.locator('#play-what').selectOption('explode');
    await page.locator('#film').click();
    await page.locator('#play').click();
    await page.evaluate(() => {
      window.clears = 0;
      const { clear } = WebGL2RenderingContext.prototype;
      WebGL2RenderingContext.prototype.clear = function (...given) {
        window.clears++;
        clear.apply(this, given);
      };
    });
    await page.waitForFunction(() => window.clears > 40); // a few for each picture, which waits for the one before
    const { name, bytes } = await download(page, '#film');
    assert.equal(name, 'torus-knot-8x4x8.webm');
    assert.deepEqual([...bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3], 'the mark of WebM');
    assert.ok(bytes.length > 10_000);
  });
});
