// Large cuts, which several threads share on machines of enough cores.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { dataOf, download, enter, eventually, isReady, openPanel, shows, startSite } from './page_helpers.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const site = await startSite();
after(() => site.close());
const wedge = await galleryMesh('wedge');
const start = 'mesh=wedge&n=8&free=off&explode=0,0';

/** Opens the page as if there were so many cores; of the threads that cut, the one of this number fails to start. */
function open(t, cores, broken = 0) {
  const onNewPage = (page) =>
    page.addInitScript(
      ({ value, fails }) => {
        Object.defineProperty(navigator, 'hardwareConcurrency', { value });
        let script; // of the threads that cut, the first that are started
        window.threads = 0;
        window.Worker = class extends Worker {
          constructor(url, options) {
            script ??= String(url);
            const isBroken = script === String(url) && ++window.threads === fails;
            super(isBroken ? URL.createObjectURL(new Blob(['throw new Error("broken")'])) : url, options);
          }
        };
      },
      { value: cores, fails: broken },
    );
  return site.open(t, start, { onNewPage, panels: ['cut', 'save'] });
}

const threadsOf = (page) => page.evaluate(() => window.threads);

/** Cuts, and compares all of the cut with what the package gives. */
async function hasCut(page, cells) {
  await enter(page, '#cells-number', cells);
  const { cutMesh } = await cutOf(wedge, { cells });
  await shows(page, '#counts', { cutCells: cutMesh.cellRegion.length, grid: cutMesh.grid.cells.join('x') });
  assert.equal(await isReady(page), 'ready');
  const { bytes } = await download(page, '#save-json');
  assert.ok(bytes.equals(Buffer.from(await mandoline.write(wedge, cutMesh, 'json'))), `N = ${cells}`);
}

test('the first large cut starts more threads, up to four, and is the same as that of one', async (t) => {
  for (const [cores, expected] of [
    [2, 1],
    [16, 4],
  ]) {
    const page = await open(t, cores);
    await hasCut(page, 30);
    assert.equal(await threadsOf(page), 1);
    await hasCut(page, 90);
    await hasCut(page, 95);
    assert.equal(await threadsOf(page), expected, `on ${cores} cores`);
  }
});

test('without a thread that fails the cut is the same', async (t) => {
  const page = await open(t, 4, 3);
  await hasCut(page, 90);
  assert.equal(await threadsOf(page), 3);
  await hasCut(page, 95);
  assert.equal(await threadsOf(page), 3);
});

test('a cut that is cancelled ends all threads; the next large one starts them again', async (t) => {
  const page = await open(t, 3);
  const former = await dataOf(page, '#counts');
  await enter(page, '#cells-number', 250);
  await eventually(async () => assert.equal(await threadsOf(page), 2));
  await page.locator('#cancel').click();
  assert.equal(await isReady(page), 'ready');
  assert.deepEqual(await dataOf(page, '#counts'), former);
  await hasCut(page, 30);
  assert.equal(await threadsOf(page), 3);
  await hasCut(page, 90);
  assert.equal(await threadsOf(page), 4);
});

test('of large cuts that are asked for while another runs the newest is shown', async (t) => {
  const page = await open(t, 3);
  for (const cells of [90, 100, 110]) await enter(page, '#cells-number', cells);
  await hasCut(page, 95);
});

test('a surface that moves is cut by several threads, validly', async (t) => {
  const page = await open(t, 3);
  await hasCut(page, 90);
  const cuts = () => page.locator('#counts').evaluate((counts) => Number(counts.dataset.model));
  const first = await cuts();
  await openPanel(page, 'motion');
  await page.locator('#play-what').selectOption('wave');
  await page.locator('#play').click();
  await eventually(async () => assert.ok((await cuts()) > first + 4));
  await page.locator('#play').click();
  assert.equal(await isReady(page), 'ready');
  await openPanel(page, 'checks');
  await page.locator('#validate').click();
  await shows(page, '#validation', { pass: true });
});
