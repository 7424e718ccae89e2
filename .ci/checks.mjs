// What the continuous integration does beyond npm test: the package in every toolchain, what OpenFOAM and VTK say of the files, short
// functions, several processes, the same bits from another compiler, fuzz runs, the suite under sanitizers.
import { mkdirSync, readFileSync } from 'node:fs';
import { setUp } from '../tests/set_up.mjs';
import { build, fail, jobs, path, run, runTogether } from '../tests/steps.mjs';
import { scans } from './scans.mjs';
import { checkFunctions } from './sources.mjs';

setUp('checks');

// Neither keeps more than one core busy.
await runTogether(['node', '--test', 'tests/toolchains/toolchains.test.mjs'], ['node', '.ci/files.mjs']);

// Several processes: npm test leaves them out where there is no MPI, which only few need.
build('build', ['-DMANDOLINE_BUILD_TESTS=ON']);
run('ctest', '--test-dir', 'build', '--output-on-failure', '-R', '^mpi');
run('node', '.ci/decomposed.mjs');

// One build of clang's is the other compiler, the sanitizers and the fuzzers: with assertions, yet fast enough for real meshes. It has the
// flags of projects that want no exact arithmetic and no warning; only linking with them would change how the processor rounds.
build('build-clang', [
  '-DCMAKE_CXX_COMPILER=clang++',
  '-DCMAKE_CXX_FLAGS=-ffast-math -Werror',
  '-DCMAKE_EXE_LINKER_FLAGS=-fno-fast-math',
  '-DMANDOLINE_BUILD_FUZZ=ON',
  '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON',
  '-DCMAKE_BUILD_TYPE=Debug',
  '-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1',
]);
checkFunctions('build-clang');

run('build/mandoline', 'make', 'torus-knot', '-o', 'build/torus-knot.obj');
for (const mesh of ['build/torus-knot.obj', ...scans]) {
  const dumps = [
    ['build', '1'],
    ['build', '3'],
    ['build-clang', '1'],
  ].map(([folder, threads]) => {
    run(`${folder}/mandoline`, 'cut', mesh, '--cells', '13', '--threads', threads, '-o', `${folder}/dump.json`);
    return readFileSync(path(folder, 'dump.json'));
  });
  if (!dumps.every((dump) => dump.equals(dumps[0]))) fail(`${mesh} is not cut alike by another number of threads or another compiler.`);
}

for (const corpus of ['corpus', 'reader-corpus', 'mcm-corpus']) mkdirSync(path('build-clang', corpus), { recursive: true });
run('build/mandoline', 'make', 'box', '-o', 'build/box.obj');
run('build/mandoline', 'cut', 'build/box.obj', '--cells', '3', '-o', 'build-clang/mcm-corpus/box.mcm');
const fuzz = ['build-clang/mandoline-fuzz', '-max_total_time=90', '-max_len=256', '-timeout=20', '-print_final_stats=1'];
await runTogether(
  [...fuzz, 'build-clang/corpus', 'tests/fuzz/corpus'],
  ['build-clang/mandoline-fuzz-readers', '-max_total_time=30', '-max_len=2048', '-rss_limit_mb=4096', 'build-clang/reader-corpus'],
  ['build-clang/mandoline-fuzz-mcm', '-max_total_time=20', '-rss_limit_mb=4096', 'build-clang/mcm-corpus'],
);

// Real meshes and soups by the hundred take the sanitizers too long; the fuzzer has just made such soups, and replayed what it once found.
// So do orders of accuracy and flows of many steps, whose code other tests run as well, and cuts in bricks and shares of all sizes, which the
// fuzzer chooses, too.
delete process.env.MANDOLINE_MESHES;
run('ctest', '--test-dir', 'build-clang', '--output-on-failure', '--parallel', jobs, '-E', 'corpus|soups|fuzz|orders|steps|seams');
