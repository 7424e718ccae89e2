// WebAssembly in the benchmark: it takes its turns, has a column, and has to make as many cut-cells as the native program.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { test } from 'node:test';
import { path, root } from '../steps.mjs';

const program = path('build', 'mandoline-bench');
const skip = existsSync(program) ? false : `there is no native program ${program}`;
const warmCut = 'node tests/package/warm_cut.mjs';

const bench = (...args) => spawnSync(program, ['--cells', '6', '--repetitions', '1', ...args], { cwd: root, encoding: 'utf8' });

test('every cut is timed in WebAssembly, too', { skip }, () => {
  const { cuts } = JSON.parse(bench('--json', '--wasm', warmCut).stdout);
  assert.equal(cuts.length, 3);
  for (const { mesh, wasmMs } of cuts) assert.ok(wasmMs > 0, mesh);
});

test('the table of the README has a column of WebAssembly where it is timed, and all its lines are of one length', { skip }, () => {
  for (const [options, end] of [
    [['--wasm', warmCut], ' two threads, ms | WebAssembly, ms |'],
    [[], ' two threads, ms |'],
  ]) {
    const { stdout } = bench('--markdown', ...options);
    const lines = stdout.split('\n').filter((line) => line.startsWith('|'));
    assert.ok(lines[0].endsWith(end), lines[0]);
    assert.deepEqual(
      lines.map((line) => line.length),
      Array(5).fill(lines[0].length),
    );
    assert.equal(/WebAssembly takes \d+\.\d to \d+\.\d times as long/.test(stdout), options.length > 0);
  }
});

test('a cut is left out where WebAssembly makes another number of cut-cells', { skip }, () => {
  const { status, stderr } = bench('--wasm', 'echo 100 7 #');
  assert.equal(status, 1);
  assert.match(stderr, /left out: cube at N = 6: WebAssembly makes another number of cut-cells: 7\n/);
});
