// Angular's own build, of a page without components: what counts is how it takes the package along.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { assertChecked, checkModule, html, pageScript, physics } from './example.mjs';
import { makeProject, openFolder, run } from './projects.mjs';

const compilerOptions = { target: 'es2022', module: 'preserve', moduleResolution: 'bundler', allowJs: true, skipLibCheck: true };

/** What the page says. `options` are those of the build in angular.json. */
async function buildAndOpen(name, files, options = {}) {
  const build = {
    builder: '@angular/build:application',
    options: { browser: 'main.js', tsConfig: 'tsconfig.json', outputPath: { base: 'dist', browser: '' }, baseHref: './', ...options },
  };
  const projects = { page: { projectType: 'application', root: '', architect: { build } } };
  const folder = makeProject(name, {
    'angular.json': JSON.stringify({ version: 1, cli: { analytics: false }, projects }),
    'tsconfig.json': JSON.stringify({ compilerOptions, files: ['main.js'] }),
    'src/index.html': html('').replace(/<script.*<\/script>/, ''), // Angular adds it
    'main.js': pageScript,
    ...files,
  });
  assert.doesNotMatch(await run(folder, '@angular/cli/bin/ng.js', 'build'), /warning/i);
  return openFolder(join(folder, 'dist'));
}

test('Angular, with mandoline-wasm/physics/inline', async () => {
  const { imports, more } = physics('inline');
  const importInline = "import * as inline from 'mandoline-wasm/physics/inline';";
  const check = checkModule({ imports: `${importInline}\n${imports}`, options: 'inline', more });
  assertChecked(await buildAndOpen('angular inline', { 'check.js': check }));
});

test('Angular, with a script of its own for workers and the .wasm files as assets', async () => {
  const thread = "{ thread: () => new Worker(new URL('./thread.js', import.meta.url), { type: 'module' }) }";
  const { imports, more } = physics('', thread);
  const files = {
    'check.js': checkModule({ imports, workerOptions: thread, more }),
    'thread.js': "import 'mandoline-wasm/physics/worker-thread';\n",
  };
  const dist = 'node_modules/mandoline-wasm/dist';
  const assets = [
    { glob: 'mandoline.wasm', input: dist, output: '.' },
    { glob: 'files.wasm', input: `${dist}/files`, output: '.' },
    { glob: 'bricks.wasm', input: `${dist}/bricks`, output: '.' },
    { glob: 'physics.wasm', input: `${dist}/physics`, output: '.' },
  ];
  assertChecked(await buildAndOpen('angular files', files, { assets, webWorkerTsConfig: 'tsconfig.json' }));
});
