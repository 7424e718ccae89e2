// npm start: builds, cuts a torus knot, validates the result, prints the report and writes the cells for ParaView.
import { build, run, setUp } from './steps.mjs';
import { writeTorusKnot } from './torus_knot.mjs';

setUp('a C++20 compiler', 'CMake', 'make', 'zlib');
build('build', '-DMANDOLINE_BUILD_TESTS=OFF');
run('build/mandoline', 'cut', writeTorusKnot('build'), '--cells', '24', '--validate', '-o', 'build/torus-knot.vtu');
console.log('\nWrote build/torus-knot.vtu: open it in ParaView, or cut a mesh of your own with build/mandoline cut MESH.');
