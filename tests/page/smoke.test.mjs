// Smoke in the wind tunnel: it flows, its wake swings, and it ends with all that it took.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { initPhysics } from 'mandoline-wasm/physics';
import { box } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { dataOf, eventually, isReady, openPanel, shows, startSite, textOf } from './page_helpers.mjs';
import { mandoline } from './reference.mjs';

const { SmokeFlow } = await importBundled('worker/wind/smoke.ts');
const { Tracer, particles } = await importBundled('page/view/wind/tracer.ts');
const { SmokeClock } = await importBundled('page/smoke.ts');
const { boundsOf } = await importBundled('model/grid_around.ts');
const pack = { mandoline, physics: await initPhysics() };
const site = await startSite();
after(() => site.close());

const link = 'mesh=wedge&explode=0,0&wind=1,0,0&smoke=on';
const cube = box([-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]);
const begin = (mesh, direction = [1, 0, 0], from = pack) =>
  SmokeFlow.begin(from, { ...mesh, id: 1, name: 'any', bounds: boundsOf(mesh) }, { mesh: 1, pose: null, direction });

/** The velocity in the cell of a place, which is relative to the middle of the mesh. */
function velocityAt({ corner, side, counts }, { velocity }, place) {
  const [x, y, z] = place.map((p, d) => Math.floor((p - corner[d]) / side));
  const at = 3 * (x + counts[0] * (y + counts[1] * z));
  return [...velocity.subarray(at, at + 3)];
}

const numbersOf = (page) => textOf(page, '#wind-numbers');
const timeOf = async (page) => Number(/time ([\d.]+)/.exec(await numbersOf(page))?.[1]);

test('about a cube the wind is that far away, nothing moves in the cube, and the wake swings', async (t) => {
  const { flow, smoke } = await begin(cube);
  const far = velocityAt(smoke, smoke.begin, [-0.9, 0, 0]);
  assert.ok(far[0] > 0.5 && far[0] < 1.2, String(far));
  assert.deepEqual(velocityAt(smoke, smoke.begin, [0, 0, 0]), [0, 0, 0]);
  const aside = [];
  const clock = performance.now();
  let steps = 0;
  for (let { time } = smoke.begin; time < 2.4; ++steps) {
    const state = flow.step();
    ({ time } = state);
    assert.ok(Number.isFinite(state.drag) && state.lift >= 0);
    if (time > 1.2) aside.push(velocityAt(smoke, state, [1.1, 0.2, 0.2])[1]);
  }
  t.diagnostic(`${((1000 * steps) / (performance.now() - clock)).toFixed(1)} steps a second, ${smoke.counts.join(' x ')} cells`);
  const range = Math.max(...aside) - Math.min(...aside);
  t.diagnostic(`the velocity across the wind behind the cube changes by ${range.toFixed(3)}`);
  assert.ok(range > 0.1);
  flow.end();
});

test('particles follow the flow and begin anew where they leave it', async () => {
  const { flow, smoke } = await begin(cube, [0, 0, 1]);
  const tracer = new Tracer(smoke);
  const [from, to] = [smoke.begin, flow.step()];
  const before = tracer.head.slice();
  tracer.advance({ from, to, share: 0.5, time: (from.time + to.time) / 2 });
  const moved = Array.from({ length: particles }, (_, p) => tracer.head[4 * p + 2] - before[4 * p + 2]);
  const along = moved.filter((dz) => dz > 0 && dz < to.time).length;
  assert.ok(along > 0.9 * particles, `${along} of ${particles} move along the wind`);
  for (let time = to.time; time < 4; time += 0.05) tracer.advance({ from: to, to, share: 0, time });
  const isIn = Array.from({ length: particles }, (_, p) =>
    [0, 1, 2].every((d) => {
      const cell = (tracer.head[4 * p + d] - smoke.corner[d]) / smoke.side;
      return cell > -1 && cell < smoke.counts[d] + 1; // those that have just left are still there
    }),
  );
  assert.ok(isIn.every(Boolean));
  flow.end();
});

test('the smoke moves on evenly, however states come', async () => {
  const smoke = { size: 1, begin: { time: 0 } };
  let asked = 0;
  const waiting = [];
  const engine = { smokeStep: () => new Promise((resolve) => waiting.push(() => resolve({ time: 0.03 * ++asked }))) };
  const states = [];
  const clock = new SmokeClock(engine, smoke, { state: (state) => states.push(state), error: assert.fail });
  const paces = [];
  for (let frame = 0; frame < 600; ++frame) {
    const before = clock.advance(0).time;
    paces.push(60 * (clock.advance(1 / 60).time - before));
    if (frame % (frame % 20 < 10 ? 4 : 6) === 0) waiting.shift()?.(); // ten states a second and fifteen, by turns
    await new Promise((resolve) => {
      setTimeout(resolve);
    });
  }
  const late = paces.slice(300);
  const mean = late.reduce((sum, pace) => sum + pace) / late.length;
  assert.ok(mean > 0.3 && mean < 0.5, `${mean}`);
  for (const pace of late) assert.ok(Math.abs(pace - mean) < 0.2 * mean, `${pace} of ${mean}`);
  clock.end();
});

test('a step that fails is said in words', async () => {
  const createFlowStepper = async (...given) => {
    const stepper = pack.physics.createFlowStepper(...given);
    return { ...stepper, step: () => ({ status: 'breakdown' }) };
  };
  const { flow } = await begin(cube, [1, 0, 0], { mandoline, physics: { ...pack.physics, createFlowStepper } });
  assert.throws(() => flow.step(), { title: 'The smoke has stopped', detail: /came to rest, or its numbers/ });
  flow.end();
});

test('it begins with a link, flows, and ends with its thread', async (t) => {
  const page = await site.open(t, link, { panels: ['wind'] });
  await shows(page, '#canvas', { smoke: '1,0,0', wind: '' });
  await eventually(async () => assert.match(await numbersOf(page), /grid \d+ × \d+ × \d+ cells .* steps [\d.]+ a second .* drag/));
  t.diagnostic(await numbersOf(page));
  assert.match(await textOf(page, '#legend'), /speed, wind = 1 0 0.5 1 1.5 2 and above/);
  const time = await timeOf(page);
  await eventually(async () => assert.ok((await timeOf(page)) > time + 0.05));
  const threads = page.workers().length;
  await page.locator('#wind-on').uncheck();
  await shows(page, '#canvas', { smoke: '' });
  await eventually(async () => assert.equal(page.workers().length, threads - 1));
  assert.equal(await numbersOf(page), '');
  assert.match(page.url(), /smoke=on/);
});

test('lines and smoke take turns, and the wind is turned', async (t) => {
  const page = await site.open(t, 'mesh=wedge&explode=0,0&wind=1,0,0&tunnel=16', { panels: ['wind'] });
  await shows(page, '#canvas', { smoke: '', wind: '1,0,0' });
  await page.locator('#wind-flow-smoke').check();
  await shows(page, '#canvas', { smoke: '1,0,0', wind: '' });
  assert.equal(await page.locator('#wind-cells').count(), 0);
  await eventually(() => assert.match(page.url(), /smoke=on/));
  await page.locator('#wind-heading').press('ArrowRight');
  await eventually(async () => assert.match((await dataOf(page, '#canvas')).smoke, /^0\.99/));
  await page.locator('#wind-flow-lines').check();
  await eventually(async () => assert.match((await dataOf(page, '#canvas')).wind, /^0\.99/));
  await shows(page, '#canvas', { smoke: '' });
});

test('another mesh, an open one, has smoke of its own', async (t) => {
  const page = await site.open(t, link, { panels: ['wind'] });
  await shows(page, '#canvas', { smoke: '1,0,0' });
  const before = /grid ([\d× ]+) cells/.exec(await numbersOf(page))?.[1];
  await page.evaluate((hash) => (location.hash = hash), link.replace('wedge', 'wavy-plane'));
  await shows(page, '#mesh-line', { name: 'wavy-plane' });
  assert.equal(await isReady(page), 'ready');
  await eventually(async () => {
    assert.match(await numbersOf(page), /steps [\d.]+ a second/);
    assert.notEqual(/grid ([\d× ]+) cells/.exec(await numbersOf(page))?.[1], before);
  });
  await shows(page, '#canvas', { smoke: '1,0,0' });
});

test('under reduced motion it is a still picture', async (t) => {
  const page = await site.open(t, link, { reducedMotion: 'reduce', panels: ['wind'] });
  await shows(page, '#canvas', { smoke: '1,0,0' });
  const quiet = async () => {
    const [{ frames }, time] = [await dataOf(page, '#canvas'), await timeOf(page)];
    assert.ok(time > 1);
    await page.waitForTimeout(1500);
    assert.deepEqual([(await dataOf(page, '#canvas')).frames, await timeOf(page)], [frames, time]);
  };
  await eventually(quiet, 120_000);
});

test('where it can not be loaded the page says so', async (t) => {
  const page = await site.newPage(t, { expectedProblem: /physics|ERR_FAILED/ });
  await page.route(/physics.*\.wasm/, (route) => route.abort());
  await page.goto(`${site.url}#${link}`);
  await isReady(page);
  await eventually(async () => assert.match(await textOf(page, '#alerts'), /can't be started/));
  await shows(page, '#canvas', { smoke: '' });
  await page.unrouteAll({ behavior: 'wait' });
  await openPanel(page, 'wind');
  await page.locator('#wind-heading').press('ArrowRight');
  await eventually(async () => assert.match((await dataOf(page, '#canvas')).smoke, /^0\.99/));
});

test('where what keeps its time can not be loaded the page says so', async (t) => {
  const page = await site.newPage(t, { expectedProblem: /ERR_FAILED/ });
  const refuse = async (route) => {
    const response = await route.fetch();
    if ((await response.text()).includes('.smokeStep(')) await route.abort();
    else await route.fulfill({ response });
  };
  await page.route(/\/smoke-.*\.js/, refuse);
  await page.goto(`${site.url}#${link}`);
  await isReady(page);
  await eventually(async () => assert.match(await textOf(page, '#alerts'), /smoke/));
  await openPanel(page, 'wind');
  assert.equal(await page.locator('#wind-numbers').getAttribute('aria-busy'), 'false');
  await page.unrouteAll({ behavior: 'wait' });
  await page.locator('#wind-heading').press('ArrowRight');
  await eventually(async () => assert.match((await dataOf(page, '#canvas')).smoke, /^0\.99/));
});
