// Projects of one's own that use the packed package with one toolchain each. The tools are installed as package.json and the lock file say.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { copyFileSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { delimiter, dirname, join } from 'node:path';
import { after } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { launchChromium } from '../chromium.mjs';
import { freePort, openPage, pack, removeFolders, root } from '../package/environments.mjs';
import { serveFolder } from '../package/static_server.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const base = join(root, 'build-toolchains'); // kept, since the tools are many
const tools = join(base, 'node_modules');

const textOf = (file) => (existsSync(file) ? readFileSync(file, 'utf8') : '');

function installTools() {
  const [lock, installed] = [join(here, 'package-lock.json'), join(base, 'installed-lock.json')];
  if (textOf(installed) === textOf(lock)) return;
  rmSync(base, { recursive: true, force: true });
  mkdirSync(base);
  for (const file of ['package.json', 'package-lock.json']) copyFileSync(join(here, file), join(base, file));
  // Not npm ci, which wants the lock file to have each tool's parts for other systems, too.
  execFileSync('npm', ['install', '--no-audit', '--no-fund', '--loglevel', 'error'], { cwd: base, stdio: 'inherit' });
  copyFileSync(lock, installed);
}

installTools();
export const { tarball } = pack();
const browser = await launchChromium();

after(async () => {
  await browser.close();
  removeFolders();
});

/** A new folder with the files and the tarball unpacked where npm puts it. The tools are found in the folder above. */
export function makeProject(name, files) {
  const folder = join(base, 'projects', name.replaceAll(/\W+/g, '-'));
  const installed = join(folder, 'node_modules', 'mandoline-wasm');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(installed, { recursive: true });
  execFileSync('tar', ['-xzf', tarball, '-C', installed, '--strip-components', '1']);
  const all = { 'package.json': JSON.stringify({ name: 'consumer', version: '1.0.0', private: true }), ...files };
  for (const [path, text] of Object.entries(all)) {
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, path), text);
  }
  return folder;
}

const environment = {
  ...process.env,
  PATH: [join(tools, 'node24', 'bin'), process.env.PATH].join(delimiter),
  NODE_OPTIONS: '',
  CI: '1',
  NO_COLOR: '1',
  NEXT_TELEMETRY_DISABLED: '1',
};
delete environment.FORCE_COLOR;

/** Starts a tool, named by its path in node_modules. `output()` is what it has said, `ended` its exit code in the end. */
function start(folder, tool, args) {
  const child = spawn(join(tools, tool), args, { cwd: folder, env: environment, stdio: ['ignore', 'pipe', 'pipe'], detached: true });
  let output = `${tool} ${args.join(' ')}\n`;
  for (const stream of [child.stdout, child.stderr])
    stream.setEncoding('utf8').on('data', (text) => {
      output += text;
    });
  const ended = new Promise((resolve) => child.on('error', (error) => resolve(error.message)).on('close', resolve));
  const stop = () => {
    try {
      process.kill(-child.pid, 'SIGKILL'); // and what it has started
    } catch {} // it has ended
    return ended;
  };
  return { output: () => output, ended, stop };
}

/** Runs a tool, which has to succeed. Returns what it prints. */
export async function run(folder, tool, ...args) {
  const program = start(folder, tool, args);
  const code = await Promise.race([program.ended, sleep(300_000, 'no end', { ref: false })]);
  await program.stop();
  assert.equal(code, 0, program.output());
  return program.output();
}

async function isServed(url, server) {
  let ended = false;
  server.ended.then(() => {
    ended = true;
  });
  for (const end = Date.now() + 120_000; Date.now() < end && !ended; await sleep(100)) {
    if (
      await fetch(url).then(
        ({ ok }) => ok,
        () => false,
      )
    )
      return;
  }
  throw new Error(ended ? 'The server has ended.' : 'The server has no page.');
}

/** What a page says that a tool serves; `args` get the port. The tool must not warn. */
export async function openServed(folder, tool, args) {
  const port = await freePort();
  const url = `http://127.0.0.1:${port}/`;
  const server = start(folder, tool, args(String(port)));
  try {
    await isServed(url, server);
    const outcome = await openPage(browser, url);
    assert.doesNotMatch(server.output(), /\b(warn|error)/i);
    return outcome;
  } catch (error) {
    throw new Error(`${error.message}\n${server.output()}`, { cause: error });
  } finally {
    await server.stop();
  }
}

/** What a page in a folder says, and the addresses that it asks the server for. */
export async function openFolder(folder, options) {
  const server = await serveFolder({ folder, subPath: '/some/path' });
  try {
    return { ...(await openPage(browser, server.url, options)), requests: server.requests.map(({ path }) => path) };
  } finally {
    await server.close();
  }
}
