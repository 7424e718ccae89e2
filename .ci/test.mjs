// npm test: builds and runs everything.
import { build, jobs, run, setUp } from './steps.mjs';

setUp('a C++20 compiler', 'CMake', 'make', 'Catch2', 'zlib');
build('build', '-DMANDOLINE_BUILD_TESTS=ON');
run('ctest', '--test-dir', 'build', '--output-on-failure', '--parallel', jobs);
