// What the continuous integration does beyond npm test: the suite under sanitizers and a fuzz run.
import { mkdirSync } from 'node:fs';
import { build, jobs, path, run, setUp } from './steps.mjs';

const debug = ['-DCMAKE_BUILD_TYPE=Debug', '-DCMAKE_CXX_FLAGS_DEBUG=-O1 -g1']; // with assertions, yet fast enough for real meshes

setUp('clang with libFuzzer');
build('build-fuzz', '-DCMAKE_CXX_COMPILER=clang++', '-DMANDOLINE_BUILD_FUZZ=ON', '-DMANDOLINE_BUILD_TESTS=OFF', '-DMANDOLINE_BUILD_CLI=OFF', ...debug);
mkdirSync(path('build-fuzz', 'corpus'), { recursive: true });
run('build-fuzz/mandoline-fuzz', '-max_total_time=90', '-max_len=256', '-timeout=20', '-print_final_stats=1', 'build-fuzz/corpus', 'tests/fuzz_corpus');

build('build-sanitize', '-DMANDOLINE_SANITIZE=ON', ...debug);
run('ctest', '--test-dir', 'build-sanitize', '--output-on-failure', '--parallel', jobs, '-E', 'corpus(32|64)');
