// Engines that run the package without a browser, from its files or within one.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { assertChecked, checkModule, physics, print } from './example.mjs';
import { makeProject, run } from './projects.mjs';

const module = checkModule() + print;
const computing = checkModule(physics()) + print;
const imports = /^import (\{.*?\}) from (.*?);\n/gm;
const asRequire = (text) => text.replaceAll(imports, 'const $1 = require($2);\n').replace('export ', '');
const asImport = (text) => {
  const awaited = [...text.matchAll(imports)].map(([, names, from]) => `\n  const ${names} = await import(${from});`);
  return text.replaceAll(imports, '').replace('export async function check() {', `async function check() {${awaited.join('')}`);
};
const scripts = {
  'ES modules': ['main.mjs', computing],
  'CommonJS, require()': ['main.cjs', asRequire(module)],
  'CommonJS, import()': ['main.cjs', asImport(module)],
};
const engines = {
  'Node 20': ['node20/bin/node'],
  'Node 22': ['node22/bin/node'],
  'Node 24': ['node24/bin/node'],
  Bun: ['.bin/bun', 'run'],
  Deno: ['.bin/deno', 'run', '--allow-read', '--allow-env'],
};

/** What is printed last. */
const resultOf = (output) => JSON.parse(output.trim().split('\n').at(-1));

for (const [engine, command] of Object.entries(engines)) {
  for (const [how, [file, script]] of Object.entries(scripts)) {
    test(`${engine}, ${how}`, async () => {
      const folder = makeProject(`${engine}, ${how}`, { [file]: script });
      assertChecked(resultOf(await run(folder, ...command, file)));
    });
  }
}

for (const format of ['esm', 'cjs']) {
  test(`a server's bundle by esbuild, ${format}, that nothing lies beside`, async () => {
    const folder = makeProject(`server ${format}`, { 'main.js': computing });
    const file = join(folder, '..', `bundle.${format === 'esm' ? 'mjs' : 'cjs'}`);
    const output = await run(folder, '.bin/esbuild', 'main.js', '--bundle', '--platform=node', `--format=${format}`, `--outfile=${file}`);
    assert.doesNotMatch(output, /warn/i);
    assertChecked(resultOf(await run(folder, 'node20/bin/node', file)));
  });
}
