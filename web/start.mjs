// npm start: cuts a torus knot, validates the result, prints the report, writes the cells for ParaView; then builds the page and opens it.
import { setUp } from '../tests/set_up.mjs';
import { build, run } from '../tests/steps.mjs';

setUp('start');
build('build', ['-DMANDOLINE_BUILD_TESTS=OFF'], 'mandoline-cli');
run('build/mandoline', 'make', 'torus-knot', '-o', 'build/torus-knot.obj');
run('build/mandoline', 'cut', 'build/torus-knot.obj', '--cells', '24', '--validate', '-o', 'build/torus-knot.vtu');
console.log('\nWrote build/torus-knot.vtu: open it in ParaView, or cut a mesh of your own with build/mandoline cut MESH.');

run('npm', 'run', 'build');
const hasDesktop = process.platform !== 'linux' || process.env.DISPLAY || process.env.WAYLAND_DISPLAY;
console.log('\nThe page is served until you press Ctrl+C:');
run('npx', 'vite', 'preview', 'web', ...(hasDesktop ? ['--open'] : []));
