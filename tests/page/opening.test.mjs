// The opening of a visit without a link: its script, and that it leaves nothing behind.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { importBundled } from './bundled.mjs';
import { dataOf, eventually, shows, startSite } from './page_helpers.mjs';

const { lookAt, momentAt, openingSeconds } = await importBundled('model/opening.ts');
const { defaultSettings } = await importBundled('model/settings.ts');
const { toHash } = await importBundled('model/hash.ts');

const times = Array.from({ length: 401 }, (_, at) => (at * openingSeconds) / 400);
const moments = times.map((seconds) => ({ seconds, ...momentAt(seconds) }));
const first = (is) => moments.find(is).seconds;

test('it lasts four seconds, and begins and ends with the default look', () => {
  assert.equal(openingSeconds, 4);
  for (const seconds of [0, openingSeconds, openingSeconds + 1]) {
    const moment = momentAt(seconds);
    assert.deepEqual({ ...lookAt(defaultSettings(), moment), compare: null }, { ...defaultSettings(), compare: null });
    assert.equal(lookAt(defaultSettings(), moment).compare.way, 'none');
    assert.equal(moment.wind, false);
  }
});

test('it shows the surface alone, then the grid, then cells apart, then wind about all of it', () => {
  const bare = first(({ divider }) => divider === 0);
  const cut = first(({ seconds, divider }) => seconds > bare && divider === 1);
  const apart = first(({ explode }) => explode > 0.3);
  const blown = first(({ wind, explode }) => wind && explode === 0);
  assert.ok(bare < cut && cut < apart && apart < blown, [bare, cut, apart, blown].join());
  for (const { divider, wind, explode } of moments) {
    assert.ok(divider >= 0 && divider <= 1 && explode >= 0 && explode <= 1);
    assert.ok(!wind || divider === 1);
  }
});

test('nothing in it jumps', () => {
  for (const [at, { divider, explode, seconds }] of moments.entries()) {
    if (at === 0) continue;
    assert.ok(Math.abs(divider - moments[at - 1].divider) < 0.06 && Math.abs(explode - moments[at - 1].explode) < 0.06, `at ${seconds} s`);
  }
});

const site = await startSite();
after(() => site.close());

/** A machine that draws sixty pictures a second, by its own clock, which stands still while the picture is divided. */
function quickMachine() {
  let time = performance.now();
  performance.now = () => time;
  const tick = () => {
    if (document.getElementById('canvas')?.dataset.compare !== 'voxels') time += 1000 / 60;
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
  WebGL2RenderingContext.prototype.clientWaitSync = () => WebGL2RenderingContext.CONDITION_SATISFIED;
}

const newPage = (t, options = {}) =>
  site.newPage(t, { viewport: { width: 300, height: 400 }, ...options, onNewPage: (made) => made.addInitScript(quickMachine) });

const open = async (t, { hash = '', ...options } = {}) => {
  const page = await newPage(t, options);
  await page.goto(site.url + hash);
  await page.waitForFunction(() => document.getElementById('canvas').dataset.model === '1');
  return page;
};

/** From now on notes what stands beside the model. */
async function watch(page) {
  await page.locator('#canvas').evaluate((canvas) => {
    window.seen = [];
    const note = () => window.seen.push(canvas.dataset.compare, canvas.dataset.wind);
    new MutationObserver(note).observe(canvas, { attributeFilter: ['data-compare', 'data-wind'] });
  });
}

async function showedModelAlone(page) {
  assert.deepEqual((await page.evaluate(() => window.seen)).filter(Boolean), []);
}

const timeOf = (page) => page.evaluate(() => performance.now());

test('the first touch ends it: settings, link and history are as if it had never been', async (t) => {
  const page = await open(t);
  await shows(page, '#canvas', { compare: 'voxels' });
  assert.equal(await page.locator('.divider').count(), 0);
  await page.keyboard.press('Shift');
  await shows(page, '#canvas', { compare: '', wind: '' });
  await watch(page);
  const pictures = async () => Number((await dataOf(page, '#canvas')).frames);
  let before = -1;
  await eventually(async () => {
    const now = await pictures();
    const rests = now === before;
    before = now;
    assert.ok(rests, 'the picture rests');
  });
  const touched = await timeOf(page);
  await eventually(async () => assert.ok((await timeOf(page)) > touched + 1000));
  await showedModelAlone(page);
  await shows(page, '#canvas', { compare: '', wind: '' });
  assert.equal(new URL(page.url()).hash, toHash(defaultSettings()));
  assert.equal(await page.evaluate(() => history.length), 2); // the empty page and this one
  assert.equal(await page.locator('#explode-cells').inputValue(), '0.06');
});

test('it begins with the first picture, however late that is', async (t) => {
  const page = await newPage(t);
  await page.addInitScript(() => {
    WebGL2RenderingContext.prototype.clientWaitSync = () =>
      WebGL2RenderingContext[window.isInTime ? 'CONDITION_SATISFIED' : 'TIMEOUT_EXPIRED'];
  });
  await page.goto(site.url);
  await page.waitForFunction(() => document.body.dataset.state === 'ready');
  const begin = await timeOf(page);
  await eventually(async () => assert.ok((await timeOf(page)) > begin + 1000));
  await page.evaluate(() => (window.isInTime = true));
  await shows(page, '#canvas', { compare: 'voxels' });
});

test('it is left out where motion is unwanted, in embedded pages and for links', async (t) => {
  for (const options of [{ reducedMotion: 'reduce' }, { hash: '?embed' }, { hash: '#n=8' }]) {
    const page = await open(t, options);
    const begin = await timeOf(page);
    await watch(page);
    await eventually(async () => assert.ok((await timeOf(page)) > begin + 1000));
    await showedModelAlone(page);
  }
});
