// The README's example of errors says what it prints; those of the environments are run by environments.test.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { after, test } from 'node:test';
import { readmeExample, removeFolders, root } from './environments.mjs';

after(removeFolders);

test('errors', () => {
  const output = execFileSync(process.execPath, ['--input-type=module', '-e', readmeExample('Errors')], { cwd: root, encoding: 'utf8' });
  const [first, second] = output.split('\n');
  assert.equal(first, 'nonFiniteCoordinate 2');
  assert.match(second, /Vertex 2.* Repair/);
});
