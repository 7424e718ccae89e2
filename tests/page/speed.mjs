// Time from a move of the resolution's slider to new buffers, medians of alternating cuts:
//   node tests/page/speed.mjs [--mesh FILE] [--cells N] [--runs R] [--threads T,...] [PAGE ...]
// A PAGE is the folder of a built page (by default web/dist) or an address. With several, say today's page and a former one, each cut of
// one is followed by one of the others, so that other work on the machine slows down all alike; the processor's time of the page's process
// hardly depends on that. With several numbers of threads each page is opened once with each, as on a machine of so many cores that it may
// have these. Without a file the mesh is a torus of 69,696 triangles.
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { launchChromium } from '../chromium.mjs';
import { torus, writeObj } from '../package/meshes.mjs';
import { serveFolder } from '../package/static_server.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    mesh: { type: 'string' },
    cells: { type: 'string', default: '50' },
    runs: { type: 'string', default: '15' },
    threads: { type: 'string', default: '1' },
  },
});
const cells = Number(values.cells);
const numbersOfThreads = values.threads.split(',').map(Number);
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
  await page.waitForFunction(
    () => {
      const model = document.getElementById('counts').dataset.model;
      return model && document.body.dataset.state === 'ready' && document.getElementById('canvas').dataset.model === model;
    },
    null,
    { timeout: 120_000 },
  );
}

/** From the slider's event until the page has the new cut's buffers and shows its numbers: { ms, cpuMs }. */
async function timeOfCut({ page, session }, to) {
  await isDrawn(page);
  const cpu = async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'ProcessTime').value;
  const before = await cpu();
  const ms = await page.evaluate(
    (n) =>
      new Promise((resolve) => {
        const start = performance.now();
        const observer = new MutationObserver(() => {
          observer.disconnect();
          resolve(performance.now() - start);
        });
        observer.observe(document.getElementById('counts'), { attributes: true, attributeFilter: ['data-model'] });
        const slider = document.getElementById('cells');
        slider.value = String(n);
        slider.dispatchEvent(new Event('input', { bubbles: true }));
      }),
    to,
  );
  return { ms, cpuMs: 1000 * ((await cpu()) - before) };
}

async function open(name, threads) {
  const browser = await launchChromium({ smooth: true });
  const page = await browser.newPage({ viewport: { width: 1000, height: 600 } });
  await page.addInitScript((cores) => Object.defineProperty(navigator, 'hardwareConcurrency', { value: cores }), threads + 1);
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  await page.goto(`${await addressOf(name)}#url=${encodeURIComponent(meshUrl)}&n=${cells - 1}`);
  return { name: `${name}, threads: ${threads}`, browser, page, session, times: [] };
}

const opened = [];
try {
  for (const name of pages) for (const threads of numbersOfThreads) opened.push(await open(name, threads));
  for (const tab of opened) for (const n of [cells, cells - 1, cells, cells - 1]) await timeOfCut(tab, n); // the engine still compiles
  for (let run = 0; run < Number(values.runs); ++run) {
    for (const tab of opened) {
      tab.times.push(await timeOfCut(tab, cells));
      await timeOfCut(tab, cells - 1);
    }
  }
  console.log(`${meshName} at N = ${cells}, from slider to new buffers, medians of ${values.runs}`);
  const of = ({ times }, key) => median(times.map((time) => time[key]));
  for (const tab of opened) {
    const share = (key) => (of(opened[0], key) / of(tab, key)).toFixed(2);
    const said = ['ms', 'cpuMs'].map((key) => `${of(tab, key).toFixed(0)} ms (the first page takes ${share(key)} of it)`);
    console.log(`  ${tab.name}: ${said[0]}, of the processor ${said[1]}`);
  }
} finally {
  for (const { browser } of opened) await browser.close();
  for (const server of servers) await server.close();
  rmSync(folder, { recursive: true });
}
