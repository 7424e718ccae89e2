// How long the page is blocked. Numbers are printed, for they tell of the machine, too; what is asserted can't depend on it.
import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { dataOf, eventually, isReady, shows, slideTo, startSite } from './page_helpers.mjs';
import { cutOf, galleryMesh } from './reference.mjs';

const site = await startSite();
after(() => site.close());

test('the bunny at 50 cells is cut and drawn while the slider moves', async (t) => {
  const page = await site.open(t, 'mesh=bunny&n=44', {
    onNewPage: (made) =>
      made.addInitScript(() => {
        window.longTasks = [];
        new PerformanceObserver((list) =>
          window.longTasks.push(...list.getEntries().map(({ startTime, duration }) => [startTime, duration])),
        ).observe({ type: 'longtask', buffered: true });
        window.shaders = [];
        const { shaderSource } = WebGL2RenderingContext.prototype;
        WebGL2RenderingContext.prototype.shaderSource = function (shader, source) {
          if (source.includes('gl_Position'))
            window.shaders.push(source.match(/(?<=#define )(CELLS|FACES|BACKS|LINES|PICK|SHADOW|GHOST)\b/g)?.join(' '));
          return shaderSource.call(this, shader, source);
        };
      }),
  });
  const longest = async () => {
    const durations = await page.evaluate(() => window.longTasks.splice(0).map(([, duration]) => duration));
    return `${durations.length} tasks of the main thread took over 50 ms, the longest ${Math.round(Math.max(0, ...durations))} ms`;
  };
  t.diagnostic(`while the page loads: ${await longest()}`);
  const slider = page.locator('#cells');
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await slider.boundingBox();
  const at = (cells) => x + 8 + ((width - 16) * (cells - 1)) / 127;
  const first = Number((await dataOf(page, '#canvas')).model);
  await page.mouse.move(at(44), y + height / 2);
  await page.mouse.down();
  for (const cells of [45, 46, 47, 48, 49, 50, 51, 52, 53, 54]) {
    const frames = Number((await dataOf(page, '#canvas')).frames);
    await page.mouse.move(at(cells), y + height / 2);
    await eventually(async () => {
      assert.ok(Number((await dataOf(page, '#canvas')).frames) > frames, 'a picture comes while the button is down');
    });
  }
  for (const cells of [53, 52, 51, 50]) await page.mouse.move(at(cells), y + height / 2);
  await page.mouse.up();
  assert.equal(await isReady(page), 'ready');
  const drawn = Number((await dataOf(page, '#canvas')).model);
  assert.ok(drawn > first);
  const purposes = ['BACKS', 'FACES', 'GHOST', 'LINES', 'PICK', 'SHADOW'].map((purpose) => `CELLS ${purpose}`);
  await eventually(async () => {
    const ofCells = await page.evaluate(() => window.shaders.filter((defines) => defines?.startsWith('CELLS')));
    assert.deepEqual(ofCells.sort(), purposes, 'each shader is compiled once, those that no picture has needed once the last one stands');
  });
  t.diagnostic(`while the slider moves from 44 to 54 and back to 50: ${await longest()}`);
  const cells = Number(await slider.inputValue());
  await shows(page, '#counts', { grid: (await cutOf(await galleryMesh('bunny'), { cells })).cutMesh.grid.cells.join('x') });
});

test('on a slow machine pictures come all along a drag, from one worker', async (t) => {
  const page = await site.open(t, 'mesh=wedge&n=4', {
    onNewPage: (made) =>
      made.addInitScript(() => {
        // Each call reaches the worker late, as if the one before had taken so long.
        window.workers = 0;
        window.Worker = class extends Worker {
          constructor(...given) {
            super(...given);
            ++window.workers;
          }
          postMessage(...given) {
            setTimeout(() => super.postMessage(...given), 800);
          }
        };
      }),
  });
  const models = () => page.evaluate(() => Number(document.getElementById('counts').dataset.model));
  const [first, workers] = [await models(), await page.evaluate(() => window.workers)];
  for (let step = 0; step < 40; ++step) {
    await slideTo(page, '#cells', 5 + (step % 20));
    await page.waitForTimeout(100);
  }
  const shown = (await models()) - first;
  assert.ok(shown >= 2, `${shown} pictures came while the slider moved for 4 s`);
  await slideTo(page, '#cells', 7);
  assert.equal(await isReady(page), 'ready');
  await shows(page, '#counts', { grid: (await cutOf(await galleryMesh('wedge'), { cells: 7 })).cutMesh.grid.cells.join('x') });
  assert.equal(await page.evaluate(() => window.workers), workers, 'no worker was thrown away');
});

/**
 * Runs in the page before its scripts: lists what is asked about programs before the GPU is known to have linked them, which waits for it:
 * what their shaders define, and who asks. Before there is a model, three.js draws the background alone, with a small program of its own.
 */
function watchPrograms() {
  window.askedEarly = [];
  Error.stackTraceLimit = 30;
  const { prototype } = WebGL2RenderingContext;
  const linkedAt = new WeakMap();
  const fencedAt = new WeakMap();
  const definesIn = new WeakMap();
  let [time, done] = [0, 0];
  const watch = (name, after) => {
    const call = prototype[name];
    prototype[name] = function (...given) {
      const result = call.apply(this, given);
      after(result, ...given);
      return result;
    };
  };
  watch('shaderSource', (_, shader, source) => definesIn.set(shader, source.match(/(?<=#define )[A-Z_]{4,}/g)?.join(' ')));
  watch('attachShader', (_, program, shader) => definesIn.set(program, definesIn.get(program) ?? definesIn.get(shader)));
  watch('linkProgram', (_, program) => linkedAt.set(program, ++time));
  watch('fenceSync', (fence) => fencedAt.set(fence, ++time));
  watch('clientWaitSync', (state, fence) => {
    if (state !== WebGL2RenderingContext.TIMEOUT_EXPIRED) done = Math.max(done, fencedAt.get(fence));
  });
  watch('getProgramParameter', (_, program) => {
    const isEarly = linkedAt.get(program) > done;
    if (isEarly && document.getElementById('canvas').dataset.model) window.askedEarly.push(new Error(definesIn.get(program)).stack);
  });
}

for (const [name, hash] of [
  ['the first picture', 'mesh=bunny&n=8'],
  ['a flat cut', 'mesh=bunny&n=8&z=0.5,1&slice=flat'],
  ['a wind', 'mesh=wedge&wind=1,0,0&flow=speed&tunnel=16'],
]) {
  test(`the page does not wait for shaders of ${name}, nor of its shadow and of what comes later, also while its size changes and a pointer moves over it`, async (t) => {
    const page = await site.newPage(t, { onNewPage: (made) => made.addInitScript(watchPrograms) });
    await page.goto(`${site.url}#${hash}`);
    for (let step = 0; step < 60; ++step) {
      await page.setViewportSize({ width: 1000 - 10 * (step % 2), height: 521 });
      await page.mouse.move(500 + (step % 7), 260);
      await page.waitForTimeout(50);
    }
    if (hash.includes('wind')) await shows(page, '#canvas', { wind: '1,0,0' });
    await shows(page, '#canvas', { shadow: 'drawn' });
    await page.waitForTimeout(1000);
    assert.deepEqual(await page.evaluate(() => window.askedEarly), []);
  });
}
