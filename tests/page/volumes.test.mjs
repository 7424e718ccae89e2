// The histogram of volumes, and cells that are chosen by it.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { importBundled } from './bundled.mjs';
import { dataOf, enter, eventually, isReady, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { settledPixels, share } from './pictures.mjs';
import { cutOf, galleryMesh } from './reference.mjs';

const { allVolumes, barWidth, histogram, isWithin, nextLarger } = await importBundled('model/volumes.ts');
const site = await startSite();
after(() => site.close());

/** Inner cut-cells of the torus knot with their shares of a grid cell, the smallest first. */
async function sharesOf(cells) {
  const { cutMesh, measures } = await cutOf(await galleryMesh('torus-knot'), { cells });
  const size = cutMesh.grid.planes.reduce((product, axis) => product * (axis[1] - axis[0]), 1);
  const inner = Array.from(cutMesh.cellRegion.keys()).filter((cell) => cutMesh.regionWinding[cutMesh.cellRegion[cell]] !== 0);
  return inner.map((cell) => ({ cell, share: measures.cellVolume[cell] / size })).sort((a, b) => a.share - b.share);
}

const isColourful = (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) > 70;
const countOf = (shares, least, most) => shares.filter(({ share }) => share >= least && share < most).length;

test('each cell is in one bar: cells without volume, or less by rounding, and those beyond the axis in the first, whole ones in the last', () => {
  const volume = Float64Array.of(0, -1e-20, 1e-30, 1.1e-12, 0.00099, 0.0011, 0.9, 1, 1 + 1e-15);
  const model = {
    grid: { planes: [0, 1, 2].map(() => Float64Array.of(0, 1)) },
    cells: { volume, region: new Uint32Array(volume.length), gridCell: new Int32Array(3 * volume.length) },
  };
  const bars = histogram(model, Uint8Array.of(1));
  assert.equal(Math.max(...histogram(model, Uint8Array.of(0))), 0, 'cells of other regions do not count');
  const filled = [...bars.entries()].filter(([, count]) => count > 0).map(([bar, count]) => [allVolumes[0] + bar * barWidth, count]);
  assert.deepEqual(filled, [
    [-12, 4],
    [-3.25, 1],
    [-3, 1],
    [-0.25, 3],
  ]);
  const walk = [];
  for (let cell = null; walk.length < 5; walk.push(cell)) cell = nextLarger(model, Uint8Array.of(1), [-12, -3.25], cell);
  assert.deepEqual(walk, [1, 0, 2, 3, 1], 'after the largest comes the smallest');
  const within = (range) => [...volume].filter((share) => isWithin(range, share)).length;
  assert.deepEqual([within(allVolumes), within([-12, -3]), within([-3, 0])], [9, 5, 4]);
});

test('a range of volumes leaves its cells; it is said, kept in the link and by another grid, and gone with another mesh', async (t) => {
  const page = await site.open(t, 'mesh=torus-knot&n=12&free=off&explode=0,0&show=surface,gridFaces,edges,untouched,cutCells', {
    panels: ['mesh', 'volumes'],
  });
  const shares = await sharesOf(12);
  const { untouched } = await dataOf(page, '#canvas');
  const whole = share(await settledPixels(page), isColourful);
  await shows(page, '#canvas', { cells: shares.length });
  await shows(page, '#volumes-count', { selected: shares.length, cells: shares.length });
  await slideTo(page, '#volumes-to', -3);
  const few = countOf(shares, 0, 1e-3);
  assert.ok(few > 0 && few < shares.length / 4, `${few} slivers`);
  await shows(page, '#canvas', { cells: few, untouched: 0 });
  await shows(page, '#volumes-count', { selected: few });
  assert.match(await textOf(page, '#volumes-count'), new RegExp(`${few} of ${shares.length} cut-cells.* below 0\\.001 of a grid cell`));
  assert.match(await textOf(page, '#legend'), /only cut-cells below 0\.001 of a grid cell/);
  assert.equal(await page.locator('#volumes .lit').count(), 36);
  const picture = share(await settledPixels(page), isColourful);
  assert.ok(picture > 0 && picture < whole / 3, `the others are faint: ${picture} instead of ${whole}`);

  await page.locator('#pin-smallest').click();
  await shows(page, '#cell-card', { cell: shares[0].cell });
  await page.locator('#pin-smallest').click();
  await shows(page, '#cell-card', { cell: shares[1].cell });

  await page.locator('#volumes-from').focus();
  await page.keyboard.press('End');
  await shows(page, '#canvas', { cells: countOf(shares, 10 ** -0.25, Infinity), untouched });
  await eventually(async () => assert.match(page.url(), /volumes=-0\.25,0/));
  await slideTo(page, '#volumes-to', -1);
  await shows(page, '#canvas', { cells: countOf(shares, 10 ** -1.25, 0.1), untouched: 0 });
  await eventually(async () => assert.match(page.url(), /volumes=-1\.25,-1/));
  await enter(page, '#cells-number', 13);
  await isReady(page);
  await shows(page, '#canvas', { cells: countOf(await sharesOf(13), 10 ** -1.25, 0.1) });

  await eventually(async () => assert.match(page.url(), /n=13/));
  const link = page.url();
  await page.locator('#gallery [data-name="wedge"]').click();
  await isReady(page);
  await eventually(async () => assert.doesNotMatch(page.url(), /volumes=/));
  assert.equal(await page.locator('#volumes-all').isEnabled(), false);
  await page.goto(link);
  await isReady(page);
  await shows(page, '#canvas', { cells: countOf(await sharesOf(13), 10 ** -1.25, 0.1) });
});

test('a range that lies between bars or the wrong way round is not understood', async (t) => {
  for (const range of ['-3.1,-1', '-1,-3']) {
    const page = await site.newPage(t);
    await page.goto(`${site.url}#mesh=wedge&n=2&free=off&volumes=${range}`);
    await page.locator('[data-test=notice]').filter({ hasText: 'volumes' }).waitFor();
    await isReady(page);
    assert.equal(await page.locator('#legend').filter({ hasText: 'only cut-cells' }).count(), 0);
  }
});
