// What the continuous integration does beyond npm test: the package in every toolchain, format and shape of the sources, the same bits from
// another compiler, a fuzz run, the suite under sanitizers.
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { meshFolder } from '../tests/mesh_folder.mjs';
import { build, fail, jobs, path, run, setUp } from '../tests/steps.mjs';
import { checkSources } from './sources.mjs';

const debug = ['-DCMAKE_BUILD_TYPE=Debug', '-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1']; // with assertions, yet fast enough for real meshes

setUp('clang-format 14', 'clang-tidy', 'clang with libFuzzer');

run('node', '--test', 'tests/toolchains/toolchains.test.mjs');

const clang = '-DCMAKE_CXX_COMPILER=clang++';
const noTests = '-DMANDOLINE_BUILD_TESTS=OFF';
build('build-clang', clang, noTests, '-DCMAKE_BUILD_TYPE=Debug', '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON');
checkSources('build-clang');

const scans = meshFolder ? ['common_spot', 'common_fandisk', 'codim_feline'].map((name) => join(meshFolder, `${name}.obj.gz`)) : [];
run('build/mandoline', 'make', 'torus-knot', '-o', 'build/torus-knot.obj');
for (const mesh of ['build/torus-knot.obj', ...scans.filter((scan) => existsSync(scan))]) {
  const dumps = [['build', '1'], ['build', '3'], ['build-clang', '1']].map(([folder, threads]) => {
    run(`${folder}/mandoline`, 'cut', mesh, '--cells', '13', '--threads', threads, '-o', `${folder}/dump.json`);
    return readFileSync(path(folder, 'dump.json'));
  });
  if (!dumps.every((dump) => dump.equals(dumps[0]))) fail(`${mesh} is not cut alike by another number of threads or another compiler.`);
}

build('build-fuzz', clang, noTests, '-DMANDOLINE_BUILD_FUZZ=ON', '-DMANDOLINE_BUILD_CLI=OFF', ...debug);
mkdirSync(path('build-fuzz', 'corpus'), { recursive: true });
run('build-fuzz/mandoline-fuzz', '-max_total_time=90', '-max_len=256', '-timeout=20', '-print_final_stats=1',
  'build-fuzz/corpus', 'tests/fuzz_corpus');
mkdirSync(path('build-fuzz', 'reader-corpus'), { recursive: true });
run('build-fuzz/mandoline-fuzz-readers', '-max_total_time=30', '-max_len=2048', '-rss_limit_mb=4096', 'build-fuzz/reader-corpus');

build('build-sanitize', '-DMANDOLINE_SANITIZE=ON', ...debug);
run('ctest', '--test-dir', 'build-sanitize', '--output-on-failure', '--parallel', jobs, '-E', 'corpus(32|64)');
