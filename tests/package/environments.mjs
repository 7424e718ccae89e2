// The packed package in empty folders, and pages that use it in Chromium.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../..', import.meta.url));
const packageFolder = join(root, 'wasm');
const base = mkdtempSync(join(tmpdir(), 'mandoline-'));

/** Packs the package once. Returns the tarball's path, its size and the names of its files. */
export function pack() {
  const output = execFileSync('npm', ['pack', '--json', '--pack-destination', base], { cwd: packageFolder, stdio: 'pipe' });
  const [{ filename, files }] = JSON.parse(output);
  const tarball = join(base, filename);
  return { tarball, size: statSync(tarball).size, files: files.map(({ path }) => path) };
}

/** A new folder with the tarball installed, the given files, and links to those of the project's other dependencies that are named. */
export function makeFolder({ tarball, files = {}, links = [] }) {
  const folder = mkdtempSync(join(base, 'folder-'));
  writeFileSync(join(folder, 'package.json'), JSON.stringify({ name: 'consumer', version: '1.0.0', private: true }));
  execFileSync('npm', ['install', tarball, '--offline', '--no-audit', '--no-fund'], { cwd: folder, stdio: 'pipe' });
  for (const name of links) {
    mkdirSync(dirname(join(folder, 'node_modules', name)), { recursive: true });
    symlinkSync(join(root, 'node_modules', name), join(folder, 'node_modules', name));
  }
  for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
  return folder;
}

export function removeFolders() {
  rmSync(base, { recursive: true, force: true });
}

/** What a script prints, run by Node in its folder. */
export function runNode(folder, script) {
  return execFileSync(process.execPath, [script], { cwd: folder, encoding: 'utf8', timeout: 30_000 }).trim();
}

/** The first fenced block of JavaScript, or of a page, below a heading of the package's README or of another one. */
export function readmeExample(heading, folder = packageFolder) {
  const readme = readFileSync(join(folder, 'README.md'), 'utf8');
  const section = readme.split(/^#+ /m).find((text) => text.split('\n', 1)[0].trim() === heading);
  const block = section?.match(/^```(?:js|html)\n(.*?)^```/ms);
  if (!block) throw new Error(`README.md has no example below "${heading}".`);
  return block[1];
}

export async function freePort() {
  const server = createServer();
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  const { port } = server.address();
  await new Promise((closed) => server.close(closed));
  return port;
}

/** Servers for development may load a page again, when they find that it needs more than they thought. */
async function outcomeOf(page) {
  for (;;) {
    try {
      const found = await page.waitForFunction(() => 'outcome' in globalThis && { outcome: globalThis.outcome }, null, { timeout: 60_000 });
      return (await found.jsonValue()).outcome;
    } catch (error) {
      if (!/navigation|context was destroyed|JSHandle is disposed/i.test(error.message)) throw error;
    }
  }
}

/**
 * Opens the page and resolves to what its script assigns to `globalThis.outcome`. All complaints of the page are thrown, unless it is
 * expected. `look` gets the page at the end.
 */
export async function openPage(browser, url, { expected = /^$/, look = () => {} } = {}) {
  const page = await browser.newPage();
  const complaints = [];
  const complain = (text) => expected.test(text) || complaints.push(text);
  page.on('pageerror', (error) => complain(String(error)));
  page.on('console', (message) => {
    if (['error', 'warning'].includes(message.type())) complain(`${message.text()} (${message.location().url})`);
  });
  try {
    await page.goto(url);
    const outcome = await outcomeOf(page);
    await look(page);
    if (complaints.length > 0) throw new Error('The page complains.');
    return outcome;
  } catch (error) {
    throw new Error([error.message, ...complaints].join('\n'), { cause: error });
  } finally {
    await page.close();
  }
}
