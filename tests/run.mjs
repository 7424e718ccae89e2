// npm test: builds and runs everything: the C++ tests, natively and as WebAssembly, those of the npm package, and those of the page.
// MANDOLINE_MESHES names a folder of meshes for the tests that use one (see mesh_folder.mjs).
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { meshFolder } from './mesh_folder.mjs';
import { setUp } from './set_up.mjs';
import { build, jobs, path, run } from './steps.mjs';

const results = [];
/** What a test waits for in vain is no reason to wait for ever. In s; the longest take four minutes. */
const longest = 900;

/** A file for the results of a group of tests, in JUnit's format. */
function resultFile(name) {
  const file = path('build', `${name}-tests.xml`);
  results.push(file);
  return file;
}

function runCtest(folder) {
  run(
    'ctest',
    '--test-dir',
    folder,
    '--output-on-failure',
    '--parallel',
    jobs,
    '--timeout',
    String(longest),
    '--output-junit',
    resultFile(folder),
  );
}

if (meshFolder) process.env.MANDOLINE_MESHES = resolve(meshFolder); // tests run in other folders
setUp('test');
build('build', ['-DMANDOLINE_BUILD_TESTS=ON']);
runCtest('build');

run('node', 'wasm/build.mjs', '--tests');
runCtest('build-wasm');
run('npm', 'run', 'build', '-w', 'web');
run(
  'node',
  '--test',
  `--test-timeout=${1000 * longest}`,
  `--test-concurrency=${jobs}`, // files at a time: of two processors the browser's drawing leaves one idle now and then
  '--test-reporter=spec',
  '--test-reporter-destination=stdout',
  '--test-reporter=junit',
  `--test-reporter-destination=${resultFile('npm')}`,
  'tests/set_up.test.mjs',
  'tests/package/',
  'tests/page/',
);

const skipped = results.reduce((sum, file) => sum + readFileSync(file, 'utf8').split('<skipped').length - 1, 0);
console.log(`\nAll tests passed${skipped ? `, but ${skipped} were SKIPPED` : ''}.`);
if (!meshFolder) console.log('Those of real meshes need a folder of them, named by the environment variable MANDOLINE_MESHES.');
