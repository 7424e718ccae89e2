// The README's first commands in bare Debians, where ../shared/bare.sh is there to make them: what is installed here hides what they forget
// to set up.
import { existsSync, readFileSync } from 'node:fs';
import { jobs, path, run, runTogether } from '../tests/steps.mjs';

const bare = path('..', 'shared', 'bare.sh');
const readme = readFileSync(path('README.md'), 'utf8');
const [, packages] = readme.match(/`apt-get install (g\+\+ [^`]+)`/);
const [, line] = readme.match(/^ {4}(cmake -B build .*ctest.*)$/m);

// npm start goes on for ever: what comes next begins once the page is served. Nothing is optimized, which takes long.
const start = 'npm start >/root/start.log & until grep -q http://localhost: /root/start.log; do kill -0 $! || break; sleep 1; done';
const served = `export EMCC_CFLAGS=-O0; ${start}; cat /root/start.log; kill $! && npm run build`;

// With a newer compiler, and without precompiled headers, which hide those that a file forgets. Tests are left out: compiling them takes long.
const quick = '-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DMANDOLINE_BUILD_TESTS=OFF';
const [builds] = line.replace('cmake -B build', `cmake -B build ${quick}`).split(' && ctest');
const cuts = 'build/mandoline make box -o box.obj && build/mandoline cut box.obj --cells 4 -o box.vtu';
const native = `export CMAKE_BUILD_PARALLEL_LEVEL=${jobs}; ${builds} && ${cuts}`;

if (existsSync(bare)) {
  run(bare, '--suite', 'bookworm', path(), 'true'); // installs what makes bare Debians, which two at a time could not
  // Much of their time they wait for packages, or for one core.
  await runTogether(
    [bare, '--suite', 'bookworm', path(), served],
    [bare, '--suite', 'trixie', '--node', 'none', '--with', packages.split(/\s+/).join(','), path(), native],
  );
}
