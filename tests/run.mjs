// npm test: builds and runs everything: the C++ tests, natively and as WebAssembly, those of the npm package, and those of the page.
import { build, installPackages, jobs, run, setUp } from './steps.mjs';

setUp('a C++20 compiler', 'CMake', 'make', 'Catch2', 'zlib', 'Emscripten', 'Chromium');
build('build', '-DMANDOLINE_BUILD_TESTS=ON');
run('ctest', '--test-dir', 'build', '--output-on-failure', '--parallel', jobs);

installPackages();
run('node', 'wasm/build.mjs', '--tests');
run('ctest', '--test-dir', 'build-wasm', '--output-on-failure', '--parallel', jobs);
run('npm', 'run', 'build', '-w', 'web');
run('node', '--test', 'tests/package/', 'tests/page/');
