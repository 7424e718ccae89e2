// The project has one version, which version.h and the package.json files name.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { root } from './environments.mjs';

const read = (...parts) => readFileSync(join(root, ...parts), 'utf8');

test('the same version everywhere', () => {
  const header = read('src', 'include', 'mandoline', 'version.h');
  const number = (part) => header.match(new RegExp(`define MANDOLINE_VERSION_${part} (\\d+)$`, 'm'))[1];
  const version = ['MAJOR', 'MINOR', 'PATCH'].map(number).join('.');
  for (const folder of ['.', 'wasm', 'web']) assert.equal(JSON.parse(read(folder, 'package.json')).version, version, folder);
});
