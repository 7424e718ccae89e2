// How often a surface that moves is cut a second, counted to new buffers, and what of it is seen:
//   node tests/page/moving.mjs [--cuts N] [--size WIDTHxHEIGHT]
// The bunny's wave and two rings of 3,840 triangles that pass through each other, at 24 cells. A small picture shows what the cuts alone
// allow where there is no GPU. Every 50th cut is validated on the page.
import assert from 'node:assert/strict';
import { parseArgs } from 'node:util';
import { join, torus, writeObj } from '../package/meshes.mjs';
import { dataOf, isReady, openPanel, shows, startSite } from './page_helpers.mjs';

const { values } = parseArgs({ options: { cuts: { type: 'string', default: '200' }, size: { type: 'string', default: '1000x560' } } });
const [width, height] = values.size.split('x').map(Number);
const cuts = Number(values.cuts);
const batch = 50;

const ring = torus(48, 20);
const rings = join(ring, { ...ring, positions: ring.positions.map((x, i) => (i % 3 === 0 ? x + 1.2 : x)) });
const site = await startSite({ smooth: true, files: { 'rings.obj': writeObj(rings) } });
const ends = [];

const numberOf = async (page, selector, name) => Number((await dataOf(page, selector))[name]);

/** Plays until there are so many more cuts; seconds, pictures. */
async function play(page) {
  const first = await numberOf(page, '#counts', 'model');
  const framesBefore = await numberOf(page, '#canvas', 'frames');
  await page.locator('#play').click();
  await page.waitForFunction((from) => Number(document.getElementById('counts').dataset.model) > from, first);
  const [from, start] = [await numberOf(page, '#counts', 'model'), Date.now()];
  await page.waitForFunction((to) => Number(document.getElementById('counts').dataset.model) >= to, from + batch);
  const seconds = (Date.now() - start) / 1000;
  const frames = (await numberOf(page, '#canvas', 'frames')) - framesBefore;
  await page.locator('#play').click();
  await isReady(page);
  return { seconds, frames };
}

async function measure(name, hash, motion) {
  const t = { after: (end) => ends.push(end) };
  const page = await site.open(t, hash, { panels: ['motion', 'checks'], viewport: { width, height } });
  await openPanel(page, 'motion');
  await page.locator('#play-what').selectOption(motion);
  await play(page);
  let [seconds, frames] = [0, 0];
  const heap = [];
  for (let done = 0; done < cuts; done += batch) {
    const part = await play(page);
    seconds += part.seconds;
    frames += part.frames;
    await page.locator('#validate').click();
    await shows(page, '#validation', { pass: true });
    heap.push(await page.evaluate(() => Math.round(performance.memory.usedJSHeapSize / 2 ** 20)));
  }
  assert.ok(seconds > 0);
  const rate = (count) => (count / seconds).toFixed(1);
  console.log(
    `${name}, ${values.size}: ${rate(cuts)} cuts and ${rate(frames)} pictures a second; heap after each ${batch} cuts, MB: ${heap}`,
  );
}

try {
  await measure('bunny, wave', 'mesh=bunny&n=24', 'wave');
  await measure('rings of 3,840 triangles, passing', `url=${encodeURIComponent(site.meshUrl('rings.obj'))}&n=24`, 'pass');
} finally {
  for (const end of ends) await end();
  await site.close();
}
