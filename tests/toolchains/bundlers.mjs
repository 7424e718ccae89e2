// Bundlers for browsers, and none. What they make has to run in Chromium.
import assert from 'node:assert/strict';
import { copyFileSync, readdirSync, rmSync } from 'node:fs';
import { basename, join } from 'node:path';
import { test } from 'node:test';
import { assertChecked, checkModule, html, ownWorker, pageScript, physics } from './example.mjs';
import { makeProject, openFolder, openServed, run } from './projects.mjs';

const asIs = { 'main.js': pageScript, 'check.js': checkModule() };
const { imports, more } = physics();
// One's own worker comes last: Vite, once it finds what that imports, begins the page anew and fails what is still being loaded.
const withAll = { 'main.js': pageScript, 'check.js': checkModule({ imports, more: more + ownWorker.more }), ...ownWorker.files };
const importInline = "import * as inline from 'mandoline-wasm/inline';";
const inline = { 'main.js': pageScript, 'check.js': checkModule({ imports: importInline, options: 'inline' }) };

/** Copies the .wasm files of these modules beside what was built. */
function copyModules(folder, ...modules) {
  for (const module of modules)
    copyFileSync(join(folder, 'node_modules', 'mandoline-wasm', 'dist', module), join(folder, 'dist', basename(module)));
}

/** The page works, with the .wasm file from the server or without. */
function assertPage({ requests, ...result }, { wasm = true } = {}) {
  assertChecked(result);
  assert.equal(
    requests.some((path) => path.endsWith('.wasm')),
    wasm,
  );
}

const assertQuiet = (output) => assert.doesNotMatch(output, /warning/i);

for (const [version, vite] of [
  [5, 'vite5'],
  [6, 'vite6'],
  [7, 'vite7'],
  [8, 'vite'],
]) {
  const tool = `${vite}/bin/vite.js`;

  test(`Vite ${version}, development`, async () => {
    const folder = makeProject(`${vite} dev`, { 'index.html': html('./main.js'), ...withAll });
    assertChecked(await openServed(folder, tool, (port) => ['--host', '127.0.0.1', '--port', port, '--strictPort']));
  });

  test(`Vite ${version}, build`, async () => {
    const folder = makeProject(`${vite} build`, { 'index.html': html('./main.js'), ...withAll });
    assertQuiet(await run(folder, tool, 'build', '--base', './'));
    assertPage(await openFolder(join(folder, 'dist')));
  });
}

for (const mode of ['development', 'production']) {
  test(`webpack 5, ${mode}, without a warning`, async () => {
    const folder = makeProject(`webpack ${mode}`, {
      'dist/index.html': html('./main.js', { module: false }),
      // Any WebAssembly is larger than what webpack likes to see in production.
      'webpack.config.js': "module.exports = { entry: './main.js', performance: { hints: false } };",
      ...withAll,
    });
    assertQuiet(await run(folder, '.bin/webpack', '--mode', mode));
    assertPage(await openFolder(join(folder, 'dist')));
  });
}

test('webpack 5, a page that starts no worker, without a script for one, nor the module that computes, and with those for files and bricks', async () => {
  const script = `
    import { init } from 'mandoline-wasm';
    init().then(({ version }) => { globalThis.outcome = { version }; }, (error) => { globalThis.outcome = { error: error.message }; });`;
  const folder = makeProject('webpack core', { 'dist/index.html': html('./main.js', { module: false }), 'main.js': script });
  await run(folder, '.bin/webpack', '--mode', 'production', '--entry', './main.js');
  const built = readdirSync(join(folder, 'dist'));
  assert.deepEqual(
    built.filter((file) => file.endsWith('.js')),
    ['main.js'],
  );
  assert.equal(built.filter((file) => file.endsWith('.wasm')).length, 3);
  assert.equal((await openFolder(join(folder, 'dist'))).error, undefined);
});

for (const [name, files] of Object.entries({
  'one worker': asIs,
  'three workers, without shared bundles': {
    ...withAll,
    'package.json': JSON.stringify({ private: true, '@parcel/bundler-default': { disableSharedBundles: true } }),
    'package-lock.json': '{}', // what Parcel knows a project's folder by, and so its package.json
  },
})) {
  test(`Parcel, ${name}`, async () => {
    const folder = makeProject(`parcel ${name}`, { 'index.html': html('./main.js'), ...files });
    assertQuiet(await run(folder, '.bin/parcel', 'build', 'index.html', '--public-url', './', '--no-cache'));
    assertPage(await openFolder(join(folder, 'dist')));
  });
}

test('a plain page with an import map', async () => {
  const dist = './node_modules/mandoline-wasm/dist';
  const imports = { 'mandoline-wasm': `${dist}/index.js`, 'mandoline-wasm/worker': `${dist}/worker.js` };
  const map = `<script type="importmap">${JSON.stringify({ imports })}</script>`;
  assertPage(await openFolder(makeProject('import map', { 'index.html': html('./main.js', { head: map }), ...asIs })));
});

const rollup = (...args) => ['.bin/rollup', ...args, '--plugin', '@rollup/plugin-node-resolve'];
const inlineBuilds = {
  'Rollup, ES module': { command: rollup('main.js', '--file', 'dist/main.js') },
  'Rollup, script': { command: rollup('main.js', '--format', 'iife', '--file', 'dist/main.js'), module: false },
  'esbuild, ES module': { command: ['.bin/esbuild', 'main.js', '--bundle', '--minify', '--format=esm', '--outdir=dist'] },
  'esbuild, script': { command: ['.bin/esbuild', 'main.js', '--bundle', '--outdir=dist'], module: false },
  'bun build': { command: ['.bin/bun', 'build', './main.js', '--outdir', 'dist'] },
};
for (const [name, { command, module }] of Object.entries(inlineBuilds)) {
  test(`${name}, with mandoline-wasm/inline`, async () => {
    const folder = makeProject(`${name} inline`, { 'dist/index.html': html('./main.js', { module }), ...inline });
    assertQuiet(await run(folder, ...command));
    assertPage(await openFolder(join(folder, 'dist')), { wasm: false });
  });
}

test('esbuild, with mandoline-wasm/physics/inline', async () => {
  const computing = physics('inline');
  const check = checkModule({
    imports: `import * as inline from 'mandoline-wasm/physics/inline';\n${computing.imports}`,
    options: 'inline',
    more: computing.more,
  });
  const folder = makeProject('esbuild physics', { 'dist/index.html': html('./main.js'), 'main.js': pageScript, 'check.js': check });
  assertQuiet(await run(folder, '.bin/esbuild', 'main.js', '--bundle', '--format=esm', '--outdir=dist'));
  assertPage(await openFolder(join(folder, 'dist')), { wasm: false });
});

const fileBuilds = {
  Rollup: rollup('--input', 'main.js', '--input', 'mandoline-wasm/worker-thread', '--dir', 'dist'),
  esbuild: ['.bin/esbuild', 'main.js', 'worker-thread=mandoline-wasm/worker-thread', '--bundle', '--format=esm', '--outdir=dist'],
};
for (const [name, command] of Object.entries(fileBuilds)) {
  test(`${name}, with the worker's script as an entry and the modules beside it`, async () => {
    const folder = makeProject(`${name} files`, { 'dist/index.html': html('./main.js'), ...asIs });
    assertQuiet(await run(folder, ...command));
    copyModules(folder, 'mandoline.wasm', 'files/files.wasm', 'bricks/bricks.wasm');
    assertPage(await openFolder(join(folder, 'dist')));
  });

  test(`${name}, with neither, says what is missing`, async () => {
    const folder = makeProject(`${name} neither`, { 'dist/index.html': html('./main.js'), ...asIs });
    await run(folder, ...command);
    rmSync(join(folder, 'dist', 'worker-thread.js'));
    const missing = async () => (await openFolder(join(folder, 'dist'), { expected: /404/ })).error;
    assert.match(await missing(), /\/some\/path\/mandoline\.wasm could not be loaded: the server answered with 404/);
    copyModules(folder, 'mandoline.wasm');
    assert.match(await missing(), /its script worker-thread\.js could not be loaded/);
  });
}

test('esbuild, that computes, with the one script for workers as an entry and all modules beside it', async () => {
  const files = { 'main.js': pageScript, 'check.js': checkModule({ imports, more }) };
  const folder = makeProject('esbuild physics files', { 'dist/index.html': html('./main.js'), ...files });
  const entries = ['main.js', 'worker-thread=mandoline-wasm/physics/worker-thread'];
  assertQuiet(await run(folder, '.bin/esbuild', ...entries, '--bundle', '--format=esm', '--outdir=dist'));
  copyModules(folder, 'mandoline.wasm', 'files/files.wasm', 'bricks/bricks.wasm', 'physics/physics.wasm');
  assertPage(await openFolder(join(folder, 'dist')));
});

test('esbuild, with its loader for files', async () => {
  const check = checkModule({
    imports: `import wasm from 'mandoline-wasm/mandoline.wasm';
      import filesWasm from 'mandoline-wasm/files.wasm';
      import bricksWasm from 'mandoline-wasm/bricks.wasm';
      import { thread } from 'mandoline-wasm/inline';`,
    options: '{ wasm, filesWasm, bricksWasm }',
    workerOptions: '{ wasm, filesWasm, bricksWasm, thread }',
  });
  const folder = makeProject('esbuild loader', { 'dist/index.html': html('./main.js'), 'main.js': pageScript, 'check.js': check });
  assertQuiet(await run(folder, '.bin/esbuild', 'main.js', '--bundle', '--format=esm', '--outdir=dist', '--loader:.wasm=file'));
  assertPage(await openFolder(join(folder, 'dist')));
});
