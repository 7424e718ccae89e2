// Time from a move of the resolution's slider to new buffers, medians of alternating cuts:
//   node tests/page/speed.mjs [--mesh FILE] [--cells N] [--runs R] [PAGE ...]
// A PAGE is the folder of a built page (by default web/dist) or an address. With several, say today's page and a former one, each cut of
// one is followed by one of the others, so that other work on the machine slows down all alike. Without a file the mesh is a torus of
// 69,696 triangles.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { chromium } from 'playwright-core';
import { torus, writeObj } from '../package/meshes.mjs';
import { serveFolder } from '../package/static_server.mjs';
import { browserArgs } from './page_helpers.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { mesh: { type: 'string' }, cells: { type: 'string', default: '50' }, runs: { type: 'string', default: '15' } },
});
const cells = Number(values.cells);
const pages = positionals.length > 0 ? positionals : [fileURLToPath(new URL('../../web/dist', import.meta.url))];
const median = (times) => [...times].sort((a, b) => a - b)[times.length >> 1];

const folder = mkdtempSync(join(tmpdir(), 'mandoline-speed-'));
const meshName = values.mesh ? basename(values.mesh) : 'torus.obj';
writeFileSync(join(folder, meshName), values.mesh ? readFileSync(values.mesh) : writeObj(torus(264, 132)));
const servers = [await serveFolder({ folder, headers: { 'Access-Control-Allow-Origin': '*' } })];
const meshUrl = servers[0].url + meshName;

async function addressOf(page) {
  if (/^https?:/.test(page)) return page;
  servers.push(await serveFolder({ folder: page }));
  return servers.at(-1).url;
}

async function isDrawn(page) {
  await page.waitForFunction(() => {
    const model = document.getElementById('counts').dataset.model;
    return model && document.body.dataset.state === 'ready' && document.getElementById('canvas').dataset.model === model;
  }, null, { timeout: 120_000 });
}

/** In ms, from the slider's event until the page has the new cut's buffers and shows its numbers. */
async function timeOfCut(page, to) {
  await isDrawn(page);
  return page.evaluate((n) => new Promise((resolve) => {
    const start = performance.now();
    const observer = new MutationObserver(() => {
      observer.disconnect();
      resolve(performance.now() - start);
    });
    observer.observe(document.getElementById('counts'), { attributes: true, attributeFilter: ['data-model'] });
    const slider = document.getElementById('cells');
    slider.value = String(n);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }), to);
}

const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: browserArgs });
try {
  const opened = [];
  for (const name of pages) {
    const page = await browser.newPage({ viewport: { width: 1000, height: 600 } });
    await page.goto(`${await addressOf(name)}#url=${encodeURIComponent(meshUrl)}&n=${cells - 1}`);
    opened.push({ name, page, times: [] });
    for (const n of [cells, cells - 1]) await timeOfCut(page, n); // the engine still compiles
  }
  for (let run = 0; run < Number(values.runs); ++run) {
    for (const { page, times } of opened) {
      await page.bringToFront();
      times.push(await timeOfCut(page, cells));
      await timeOfCut(page, cells - 1);
    }
  }
  const first = median(opened[0].times);
  console.log(`${meshName} at N = ${cells}, from slider to new buffers, medians of ${values.runs}`);
  for (const { name, times } of opened) {
    const share = (first / median(times)).toFixed(2);
    console.log(`  ${name}: ${median(times).toFixed(0)} ms, least ${Math.min(...times).toFixed(0)} ms; the first page takes ${share} of the median`);
  }
} finally {
  await browser.close();
  for (const server of servers) await server.close();
  rmSync(folder, { recursive: true });
}
