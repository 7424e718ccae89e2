// The types as compilers find them, and what linters of packages say.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { makeProject, run, tarball } from './projects.mjs';

const consumer = readFileSync(new URL('../package/consumer.mts', import.meta.url), 'utf8');
const strict = ['--noEmit', '--strict', '--target', 'es2022', '--lib', 'es2022,dom'];
const resolutions = {
  nodenext: ['--module', 'nodenext', 'consumer.mts'],
  bundler: ['--module', 'esnext', '--moduleResolution', 'bundler', 'consumer.ts'],
  node10: ['--module', 'esnext', '--moduleResolution', 'node10', 'consumer.ts'],
};
const versions = { 5.9: 'typescript5', '6.0': 'typescript6', '7.0': 'typescript7' };

for (const [version, compiler] of Object.entries(versions)) {
  for (const [resolution, options] of Object.entries(resolutions)) {
    if (resolution === 'node10' && version === '7.0') continue; // has it no more
    const deprecated = resolution === 'node10' && version === '6.0' ? ['--ignoreDeprecations', '6.0'] : [];

    test(`TypeScript ${version}, ${resolution}`, async () => {
      const folder = makeProject(`typescript ${version} ${resolution}`, { 'consumer.ts': consumer, 'consumer.mts': consumer });
      await run(folder, `${compiler}/bin/tsc`, ...strict, ...deprecated, ...options);
    });
  }
}

test('TypeScript, for Node without the types of browsers', async () => {
  const script = `
import { compiledModule, init } from 'mandoline-wasm';
import { thread } from 'mandoline-wasm/inline';
import { initPhysics } from 'mandoline-wasm/physics';
import { physicsWasm } from 'mandoline-wasm/physics/inline';
import { createWorker as createPhysicsWorker } from 'mandoline-wasm/physics/worker';
import { createWorker } from 'mandoline-wasm/worker';
import { serve } from 'mandoline-wasm/worker-thread';
export const started = [init({ wasm: new Uint8Array(8) }), createWorker({ wasm: await compiledModule(), thread }), serve({})];
export const computing = [initPhysics({ physicsWasm }), createPhysicsWorker({ physicsWasm: new URL('file:///a'), thread })];
`;
  const options = ['--noEmit', '--strict', '--target', 'es2022', '--lib', 'es2022', '--types', 'node', '--module', 'nodenext'];
  await run(makeProject('typescript node', { 'main.mts': script }), 'typescript5/bin/tsc', ...options, 'main.mts');
});

test('publint', async () => {
  assert.match(await run(makeProject('publint', {}), '.bin/publint', tarball, '--strict'), /All good/);
});

test('are the types wrong?', async () => {
  // It is about require() in versions of Node that have none for ES modules.
  const args = [
    tarball,
    '--ignore-rules',
    'cjs-resolves-to-esm',
    '--exclude-entrypoints',
    './mandoline.wasm',
    './files.wasm',
    './bricks.wasm',
    './physics.wasm',
  ];
  await run(makeProject('attw', {}), '.bin/attw', ...args);
});
