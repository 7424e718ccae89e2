// The project has one version, which version.h and the package.json files name.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { root } from './environments.mjs';

const read = (...parts) => readFileSync(join(root, ...parts), 'utf8');

test('the same version everywhere', () => {
  const header = read('src', 'include', 'mandoline', 'version.h');
  const version = ['MAJOR', 'MINOR', 'PATCH'].map((part) => header.match(new RegExp(`define MANDOLINE_VERSION_${part} (\\d+)$`, 'm'))[1]).join('.');
  const versionOf = (...parts) => JSON.parse(read(...parts, 'package.json')).version;
  assert.deepEqual({ root: versionOf(), package: versionOf('wasm'), page: versionOf('web') }, { root: version, package: version, page: version });
});
