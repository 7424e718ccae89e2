// The README's examples that are not of an environment print what they should; those of the environments are run by environments.test.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { after, test } from 'node:test';
import { readmeExample, removeFolders, root } from './environments.mjs';

after(removeFolders);

const outputOf = (example) => execFileSync(process.execPath, ['--input-type=module', '-e', example], { cwd: root, encoding: 'utf8' });

test('computing', () => {
  assert.match(
    outputOf(readmeExample('Compute')),
    /^\d{4} cells, converged, pressure coefficient at least -\d\.\d\n9\d of 100 streamlines leave the grid, \d{4} points\n$/,
  );
  assert.match(outputOf(readmeExample('Compute on it', root)), /^\d{3,5} cells converged \d{4,6} points of streamlines\n$/);
  assert.match(outputOf(readmeExample('From JavaScript', root)), /cut-cells/);
});

test('flows in time', () => {
  assert.match(outputOf(readmeExample('Flows in time')), /^drag \d\.\d\d at time \d\.\d\d, \d{5} cells\n$/);
});

test('surfaces that move', () => {
  const lines = outputOf(readmeExample('Surfaces that move')).trim().split('\n');
  const found = lines.map((line) =>
    line
      .match(/^\d{4} cut-cells, (\d+) of (\d+) bricks kept$/)
      .slice(1)
      .map(Number),
  );
  assert.deepEqual(
    found.map(([kept, bricks]) => kept > bricks / 5),
    [false, true, true],
  );
});

test('large grids', () => {
  const [, cells, bricks] = outputOf(readmeExample('Large grids')).match(/^(\d+) cut-cells in (\d+) bricks, of volume \d\.\d{3}\n$/);
  assert.ok(cells > 10_000 && bricks > 8, `${cells} in ${bricks}`);
});

test('inside', () => {
  assert.match(outputOf(readmeExample('Inside')), /^inside by estimate: 1 of 2 regions\n\d{4} triangles close the surface\n$/);
});

test('errors', () => {
  const [first, second] = outputOf(readmeExample('Errors')).split('\n');
  assert.equal(first, 'nonFiniteCoordinate 2');
  assert.match(second, /Vertex 2.* Repair/);
});
