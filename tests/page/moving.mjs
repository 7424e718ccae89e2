// How often a surface that moves is cut a second, counted to new buffers, and whether memory grows:
//   node tests/page/moving.mjs [--cuts N] [--size WIDTHxHEIGHT] [--no-drawing] [--only bunny|rings]
// The bunny's wave and two rings of 3,840 triangles that pass through each other, at 24 cells. A cut counts once its buffers are with the
// GPU. Where there is none, pictures are drawn by the processors that cut: --no-drawing leaves out what fills pixels of the canvas, and
// nothing else, to tell what a GPU would leave. Every 50th cut is validated on the page; memory is that after garbage has been collected.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { loadavg } from 'node:os';
import { parseArgs } from 'node:util';
import { join, torus, writeObj } from '../package/meshes.mjs';
import { isReady, openPanel, shows, startSite } from './page_helpers.mjs';

const { values } = parseArgs({
  options: {
    cuts: { type: 'string', default: '200' },
    size: { type: 'string', default: '1000x560' },
    'no-drawing': { type: 'boolean', default: false },
    only: { type: 'string' },
  },
});
const [width, height] = values.size.split('x').map(Number);
const cuts = Number(values.cuts);
const batch = 50;

const ring = torus(48, 20);
const rings = join(ring, { ...ring, positions: ring.positions.map((x, i) => (i % 3 === 0 ? x + 1.2 : x)) });
const site = await startSite({ smooth: true, files: { 'rings.obj': writeObj(rings) } });

/** Runs in the page before its scripts: counts models that come to be drawn. Their buffers are filled before the first draw call. */
function watchDrawing({ isDrawn }) {
  window.modelsDrawn = new Set();
  for (const name of ['clear', 'drawArrays', 'drawElements', 'drawArraysInstanced', 'drawElementsInstanced']) {
    const draw = WebGL2RenderingContext.prototype[name];
    WebGL2RenderingContext.prototype[name] = function (...given) {
      if (name !== 'clear' && this.canvas.dataset?.model) window.modelsDrawn.add(this.canvas.dataset.model);
      if (isDrawn) draw.apply(this, given);
    };
  }
}

/** Plays until so many more models have come to be drawn. Gives seconds. */
async function play(page) {
  const drawn = () => page.evaluate(() => window.modelsDrawn.size);
  const reach = (count) => page.waitForFunction((least) => window.modelsDrawn.size >= least, count);
  const first = await drawn();
  await page.locator('#play').click();
  await reach(first + 1);
  const [from, start] = [await drawn(), performance.now()];
  await reach(from + batch);
  const count = (await drawn()) - from;
  const seconds = (performance.now() - start) / 1000;
  await page.locator('#play').click();
  await isReady(page);
  return seconds * (batch / count);
}

/** In MB: the page's heap, and what its process and that of the GPU hold, the worker's WebAssembly memory included. */
async function memoryOf(page) {
  const session = await page.context().newCDPSession(page);
  await session.send('HeapProfiler.collectGarbage');
  await session.detach();
  const browser = await page.context().browser().newBrowserCDPSession();
  const { processInfo } = await browser.send('SystemInfo.getProcessInfo');
  await browser.detach();
  const resident = (type) =>
    processInfo
      .filter((process) => process.type === type)
      .reduce((sum, { id }) => sum + Number(/RssAnon:\s*(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))[1]) / 1024, 0);
  const heap = await page.evaluate(() => performance.memory.usedJSHeapSize / 2 ** 20);
  return { heap, page: resident('renderer'), gpu: resident('GPU') };
}

async function measure(name, hash, motion) {
  const ends = [];
  const page = await site.open({ after: (end) => ends.push(end) }, hash, {
    panels: ['motion', 'checks'],
    viewport: { width, height },
    onNewPage: (made) => made.addInitScript(watchDrawing, { isDrawn: !values['no-drawing'] }),
  });
  await openPanel(page, 'motion');
  await page.locator('#play-what').selectOption(motion);
  await play(page);
  let seconds = 0;
  const memory = [];
  for (let done = 0; done < cuts; done += batch) {
    seconds += await play(page);
    await page.locator('#validate').click();
    await shows(page, '#validation', { pass: true });
    memory.push(await memoryOf(page));
  }
  for (const end of ends) await end();
  assert.ok(seconds > 0);
  const how = `${values.size}${values['no-drawing'] ? ', nothing drawn' : ''}, load ${loadavg()[0].toFixed(1)}`;
  console.log(`${name}, ${how}: ${(cuts / seconds).toFixed(1)} cuts a second to new buffers`);
  console.log(`  MB after each ${batch} valid cuts`);
  for (const what of ['heap', 'page', 'gpu']) console.log(`    ${what}: ${memory.map((at) => at[what].toFixed(1)).join(' ')}`);
}

try {
  if (values.only !== 'rings') await measure('bunny, wave', 'mesh=bunny&n=24', 'wave');
  if (values.only !== 'bunny') {
    await measure('rings of 3,840 triangles, passing', `url=${encodeURIComponent(site.meshUrl('rings.obj'))}&n=24`, 'pass');
  }
} finally {
  await site.close();
}
