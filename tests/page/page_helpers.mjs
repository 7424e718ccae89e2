// The built page in Chromium, and what can be seen of it. Waits are for states, never for times.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { launchChromium } from '../chromium.mjs';
import { serveFolder } from '../package/static_server.mjs';

const builtPage = process.env.MANDOLINE_PAGE ?? fileURLToPath(new URL('../../web/dist', import.meta.url));
const patience = 60_000;

/**
 * The page below a sub-path of one server, and `files` (contents by name) on another that lets other pages read them. Tests that compare
 * pictures ask for `smooth` ones.
 */
export async function startSite({ files = {}, smooth } = {}) {
  const folder = mkdtempSync(join(tmpdir(), 'mandoline-page-'));
  for (const [name, content] of Object.entries(files)) writeFileSync(join(folder, name), content);
  const host = await serveFolder({ folder: builtPage, subPath: '/some/sub-path/' });
  const meshes = await serveFolder({ folder, headers: { 'Access-Control-Allow-Origin': '*' } });
  const browser = await launchChromium({ smooth });
  return {
    url: host.url,
    host,
    meshUrl: (name) => meshes.url + name,
    /**
     * Opens the page with a link's hash, waits for its first cut and opens panels. A complaint that isn't expected fails the test.
     */
    async open(t, hash = '', { panels = ['cut', 'view'], ...options } = {}) {
      const page = await newPage(t, browser, options);
      await page.goto(host.url + (hash ? `#${hash}` : ''));
      await isReady(page);
      for (const id of panels) await openPanel(page, id);
      return page;
    },
    newPage: (t, options) => newPage(t, browser, options),
    async close() {
      await browser.close();
      await Promise.all([host.close(), meshes.close()]);
      rmSync(folder, { recursive: true, force: true });
    },
  };
}

async function newPage(t, browser, { expectedProblem = null, onNewPage = async () => {}, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1000, height: 521 }, ...options });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  page.problems = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && page.problems.push(message.text()));
  page.on('pageerror', (error) => page.problems.push(String(error)));
  t.after(async () => {
    await context.close();
    assert.deepEqual(
      page.problems.filter((problem) => !expectedProblem?.test(problem)),
      [],
      'the console is silent',
    );
  });
  await onNewPage(page);
  return page;
}

/** Waits until nothing is under way and the newest cut is drawn; the answer is "ready" or "error". */
export async function isReady(page) {
  await page.waitForFunction(() => {
    const { model } = document.getElementById('canvas').dataset;
    return document.body.dataset.state !== 'busy' && (model ?? '') === (document.getElementById('counts').dataset.model ?? '');
  });
  return page.evaluate(() => document.body.dataset.state);
}

/** Tries until the check no longer throws. */
export async function eventually(check, patienceMs = patience) {
  const end = Date.now() + patienceMs;
  for (;;) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() > end) throw error;
    }
    await new Promise((again) => setTimeout(again, 40));
  }
}

export async function dataOf(page, selector) {
  return page.locator(selector).evaluate((element) => ({ ...element.dataset }));
}

/** Waits until the data attributes of an element say this. */
export async function shows(page, selector, expected) {
  const wanted = Object.fromEntries(Object.entries(expected).map(([key, value]) => [key, String(value)]));
  await eventually(async () => {
    const data = await dataOf(page, selector);
    assert.deepEqual(Object.fromEntries(Object.keys(wanted).map((key) => [key, data[key]])), wanted);
  });
}

export async function textOf(page, selector) {
  return (await page.locator(selector).innerText()).replaceAll(/\s+/g, ' ');
}

/** Opens a panel that may be closed, or folded away with the others. */
export async function openPanel(page, id) {
  const all = page.locator('#panels-toggle');
  if ((await all.getAttribute('aria-expanded')) === 'false') await all.click();
  const toggle = page.locator(`#${id}-toggle`);
  if ((await toggle.getAttribute('aria-expanded')) === 'false') await toggle.click();
}

/** Moves a slider as a drag does: one value. */
export async function slideTo(page, selector, value) {
  await page.locator(selector).evaluate((input, to) => {
    input.value = String(to);
    input.dispatchEvent(new Event('input', { bubbles: true }));
  }, value);
}

/** Types a number and leaves the field. */
export async function enter(page, selector, value) {
  await page.locator(selector).fill(String(value));
  await page.locator(selector).press('Enter');
}

/** Clicks what saves a file, and gives the file. */
export async function download(page, selector) {
  const [saved] = await Promise.all([page.waitForEvent('download'), page.locator(selector).click()]);
  const chunks = [];
  for await (const chunk of await saved.createReadStream()) chunks.push(chunk);
  return { name: saved.suggestedFilename(), bytes: Buffer.concat(chunks) };
}
