// npm run orders: how Poisson's equation on the cells converges, and how a cylinder sheds vortices; fails if an order is too low. Arguments go to mandoline-orders, such as --meshes FOLDER.
import { setUp } from './set_up.mjs';
import { build, run } from './steps.mjs';

setUp('orders');
build('build', ['-DCMAKE_BUILD_TYPE=Release', '-DMANDOLINE_BUILD_TESTS=OFF'], 'mandoline-orders');
run('build/mandoline-orders', ...process.argv.slice(2));
