// The examples of the package's README, run with the packed tarball wherever it promises to work.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { build, createLogger, createServer } from 'vite';
import { launchChromium } from '../chromium.mjs';
import { freePort, makeFolder, openPage, pack, readmeExample, removeFolders, root, runNode } from './environments.mjs';
import { pixelsOf, share } from '../page/pictures.mjs';
import { serveFolder } from './static_server.mjs';

const strict = { 'Content-Security-Policy': "script-src 'self' 'wasm-unsafe-eval'" };
const page = `<!doctype html><html lang="en"><meta charset="utf-8"><title>Test</title><link rel="icon" href="data:,">
  <body><script type="module" src="./main.js"></script>`;
const core = readmeExample('Node');
const worker = readmeExample('Worker');
const three = `${readmeExample('three.js')}\nglobalThis.renderCalls = renderer.info.render.calls;`;
/** Tells the test that the example has come to its end, and with what. */
const withOutcome = (example) => `${example}\nglobalThis.outcome = { regions: cutMesh.regionCount, cells: cutMesh.cellRegion.length };\n`;

let packed, browser;

before(async () => {
  packed = pack();
  browser = await launchChromium();
});

after(async () => {
  await browser?.close();
  removeFolders();
});

function install(files, links) {
  return makeFolder({ tarball: packed.tarball, files, links });
}

function assertCut({ regions, cells }) {
  assert.equal(regions, 2);
  assert.ok(cells > 8);
}

test('the tarball has the package, and is small', () => {
  for (const name of ['index', 'worker', 'three', 'physics/index', 'physics/worker']) {
    for (const end of ['js', 'd.ts']) assert.ok(packed.files.includes(`dist/${name}.${end}`));
  }
  for (const file of packed.files) assert.match(file, /^(dist\/.*|package\.json|README\.md|LICENSE)$/);
  const dist = join(install(), 'node_modules', 'mandoline-wasm', 'dist');
  const gzipped = (name) => gzipSync(readFileSync(join(dist, name)), { level: 9 }).length;
  assert.ok(gzipped('mandoline.wasm') <= 350_000);
  assert.ok(gzipped('files/files.wasm') <= 250_000);
  assert.ok(gzipped('bricks/bricks.wasm') <= 300_000);
  assert.ok(gzipped('physics/physics.wasm') <= 400_000);
});

test('Node, ES modules', () => {
  const folder = install({ 'core.mjs': core, 'worker.mjs': worker, 'inline.mjs': readmeExample('Toolchains') });
  assert.equal(runNode(folder, 'inline.mjs'), '');
  assert.match(runNode(folder, 'core.mjs'), /\d/);
  assert.match(runNode(folder, 'worker.mjs'), /\d/);
});

test('Node, three.js', async () => {
  const script = `
    import { BoxGeometry } from 'three';
    import { init } from 'mandoline-wasm';
    import { cellGeometry, meshFromGeometry } from 'mandoline-wasm/three';
    const { cut, triangulate } = await init();
    const cutMesh = cut(meshFromGeometry(new BoxGeometry()), { cells: 4 });
    console.log(cellGeometry(cutMesh, triangulate(cutMesh)).getAttribute('position').count > 0);`;
  assert.equal(runNode(install({ 'three.mjs': script }, ['three']), 'three.mjs'), 'true');
});

test('Node, CommonJS', async () => {
  const asImport = (example) => example.replace(/^import (\{[^}]*\}) from ('.*?');$/gm, 'const $1 = await import($2);');
  const script = (example) => `'use strict';\nrequire('node:path');\n(async () => {\n${asImport(example)}\n})();\n`;
  const folder = install({ 'core.cjs': script(core), 'worker.cjs': script(worker) });
  assert.match(runNode(folder, 'core.cjs'), /\d/);
  assert.match(runNode(folder, 'worker.cjs'), /\d/);
});

test('Node, worker_threads', async () => {
  const main = `
    import { Worker } from 'node:worker_threads';
    for (const script of ['./core.mjs', './worker.mjs']) {
      await new Promise((resolve, reject) => new Worker(new URL(script, import.meta.url)).on('error', reject).on('exit', resolve));
    }`;
  const output = runNode(install({ 'main.mjs': main, 'core.mjs': core, 'worker.mjs': worker }), 'main.mjs');
  assert.ok(output.split('\n').length >= 2, output);
});

const pages = { core, worker, three };

/** Four things are drawn: faces of cut-cells in colours, those of whole cells in white, and black edges of both. */
const looks = {
  async three(page) {
    const picture = await pixelsOf(page, await page.screenshot());
    const shares = {
      background: share(picture, (r, g, b) => Math.abs(r - 0x8a) + Math.abs(g - 0x8f) + Math.abs(b - 0x96) < 6),
      colored: share(picture, (_, g, b) => g > b + 40),
      white: share(picture, (r, g, b) => Math.min(r, g, b) > 170 && Math.max(r, g, b) - Math.min(r, g, b) < 20),
      black: share(picture, (r, g, b) => Math.max(r, g, b) < 60),
    };
    const least = { background: 0.4, colored: 0.08, white: 0.005, black: 0.02 };
    for (const [name, most] of Object.entries(least)) assert.ok(shares[name] > most, `${name}: ${shares[name]}`);
    assert.equal(await page.evaluate('renderCalls'), 4);
  },
};

/** What Vite warns of, and its options for a folder: no configuration but where things are. */
function viteOptions(folder, base) {
  const warnings = [];
  const customLogger = createLogger('warn');
  for (const level of ['warn', 'warnOnce', 'error']) customLogger[level] = (message) => warnings.push(message);
  return { warnings, options: { root: folder, base, configFile: false, customLogger } };
}

for (const [name, example] of Object.entries(pages)) {
  const links = name === 'three' ? ['three', 'vite'] : ['vite'];

  test(`Vite, development, ${name}`, async () => {
    const folder = install({ 'index.html': page, 'main.js': withOutcome(example) }, links);
    const { warnings, options } = viteOptions(folder, '/some/path/');
    const server = await createServer({ ...options, server: { host: '127.0.0.1', port: await freePort(), strictPort: true } });
    try {
      await server.listen();
      assertCut(await openPage(browser, `http://127.0.0.1:${server.httpServer.address().port}/some/path/`));
      assert.deepEqual(warnings, []);
    } finally {
      await server.close();
    }
  });

  test(`Vite, build, ${name}`, async () => {
    const folder = install({ 'index.html': page, 'main.js': withOutcome(example) }, links);
    const { warnings, options } = viteOptions(folder, './');
    await build({ ...options, build: { chunkSizeWarningLimit: 2000 } }); // in kB: three is that large
    assert.deepEqual(warnings, []);
    const workers = readdirSync(join(folder, 'dist', 'assets')).filter((file) => file.startsWith('worker-thread'));
    assert.equal(workers.length, name === 'worker' ? 1 : 0, 'only pages that start workers have their script');
    const server = await serveFolder({ folder: join(folder, 'dist'), subPath: '/some/path', headers: strict });
    try {
      assertCut(await openPage(browser, server.url, { look: looks[name] }));
    } finally {
      await server.close();
    }
  });
}

/** A page without a build step: modules are named by their paths. */
function plain(example) {
  return example
    .replaceAll(/from 'mandoline-wasm'/g, "from './node_modules/mandoline-wasm/dist/index.js'")
    .replaceAll(/from 'mandoline-wasm\/(\w+)'/g, "from './node_modules/mandoline-wasm/dist/$1.js'");
}

async function openPlain(example, headers, look) {
  const folder = install({ 'index.html': page, 'main.js': plain(withOutcome(example)) });
  const server = await serveFolder({ folder, subPath: '/some/path', headers });
  try {
    return await openPage(browser, server.url, look);
  } finally {
    await server.close();
  }
}

for (const name of ['core', 'worker']) {
  test(`a plain page under a strict content security policy, ${name}`, async () => assertCut(await openPlain(pages[name], strict)));
}

test('without wasm-unsafe-eval a page gets a MandolineError', async () => {
  const script = `
    import { init } from 'mandoline-wasm';
    import { createWorker, describe } from 'mandoline-wasm/worker';
    const codes = [];
    for (const start of [init, createWorker]) await start().catch((error) => codes.push(error.code, describe(error)));
    globalThis.cutMesh = { regionCount: codes, cellRegion: [] };`;
  const { regions } = await openPlain(script, { 'Content-Security-Policy': "script-src 'self'" }, { expected: /Content Security Policy/ });
  assert.equal(regions[0], 'loadFailed');
  assert.equal(regions[2], 'loadFailed');
  assert.match(regions[1], /wasm-unsafe-eval/);
});

/** What a page gets that starts the package with a file of it missing or, with `content`, replaced: it has to name `named`. */
async function failureWithout(file, start, { content, named } = {}) {
  const script = `
    import { init } from 'mandoline-wasm';
    import { createWorker } from 'mandoline-wasm/worker';
    const { code, message } = await ${start}.catch((reason) => reason);
    globalThis.cutMesh = { regionCount: { code, message }, cellRegion: [] };`;
  const folder = install({ 'index.html': page, 'main.js': plain(withOutcome(script)) });
  const path = join(folder, 'node_modules', 'mandoline-wasm', 'dist', file);
  rmSync(path);
  if (content !== undefined) writeFileSync(path, content);
  const server = await serveFolder({ folder });
  try {
    const { regions } = await openPage(browser, server.url, { expected: /404/ });
    assert.equal(regions.code, 'loadFailed');
    assert.ok(regions.message.includes(named ?? `${server.url}node_modules/mandoline-wasm/dist/${file}`), regions.message);
    return regions.message;
  } finally {
    await server.close();
  }
}

test('a worker whose script is missing rejects instead of hanging, and names the script', async () => {
  assert.match(await failureWithout('worker-thread.js', 'createWorker()'), /worker could not be started/);
  const own = "createWorker({ thread: () => new Worker('./node_modules/mandoline-wasm/dist/worker-thread.js', { type: 'module' }) })";
  await failureWithout('worker-thread.js', own, { named: 'its script from options.thread could not be loaded' });
});

test('a missing mandoline.wasm is named with what the server answered', async () => {
  assert.match(await failureWithout('mandoline.wasm', 'init()'), /answered with 404 Not Found\.$/);
  assert.match(await failureWithout('mandoline.wasm', 'createWorker()'), /answered with 404 Not Found\.$/);
});

for (const [name, call] of [
  ['files', 'readGroups(new Uint8Array())'],
  ['bricks', 'createRecutter({ min: [0, 0, 0], max: [1, 1, 1], cells: [1, 1, 1] })'],
]) {
  test(`a missing ${name}.wasm is named when it is first needed`, async () => {
    for (const start of ['init', 'createWorker']) {
      const message = await failureWithout(`${name}/${name}.wasm`, `${start}().then((mandoline) => mandoline.${call})`);
      assert.match(message, /answered with 404 Not Found\.$/);
    }
  });
}

test('a server that answers with a page instead of mandoline.wasm is told from one that has it', async () => {
  assert.match(
    await failureWithout('mandoline.wasm', 'init()', { content: '<!doctype html>' }),
    /answered with HTML instead of WebAssembly\.$/,
  );
  assert.match(await failureWithout('mandoline.wasm', 'init()', { content: '' }), /answered with something else instead of WebAssembly\.$/);
});

for (const options of [
  ['--module', 'nodenext'],
  ['--module', 'esnext', '--moduleResolution', 'bundler'],
]) {
  test(`TypeScript, ${options.at(-1)}`, () => {
    const folder = install({ 'consumer.mts': readFileSync(new URL('consumer.mts', import.meta.url), 'utf8') }, ['@types/three']);
    const compiler = join(root, 'node_modules', 'typescript', 'bin', 'tsc');
    const command = [compiler, '--noEmit', '--strict', '--target', 'es2022', '--lib', 'es2022,dom', ...options, 'consumer.mts'];
    const { status, stdout } = spawnSync(process.execPath, command, { cwd: folder, encoding: 'utf8' });
    assert.equal(stdout, '');
    assert.equal(status, 0);
  });
}
