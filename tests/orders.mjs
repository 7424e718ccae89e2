// npm run orders: how Poisson's equation on the cells converges. Arguments go to mandoline-orders, such as --meshes FOLDER.
import { build, run, setUp } from './steps.mjs';

setUp('a C++20 compiler', 'CMake', 'make', 'zlib', 'Eigen');
build('build', '-DCMAKE_BUILD_TYPE=Release', '-DMANDOLINE_BUILD_TESTS=OFF');
run('build/mandoline-orders', ...process.argv.slice(2));
