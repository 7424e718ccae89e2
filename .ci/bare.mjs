// The README's first commands in bare Debians, where ../shared/bare.sh is there to make them: what is installed here hides what they forget
// to set up. Of the tests, which have all run by now, a few.
import { existsSync, readFileSync } from 'node:fs';
import { jobs, path, run } from '../tests/steps.mjs';

const bare = path('..', 'shared', 'bare.sh');
const readme = readFileSync(path('README.md'), 'utf8');
const [, packages] = readme.match(/`apt-get install (g\+\+ [^`]+)`/);
const [, line] = readme.match(/^ {4}(cmake -B build .*ctest.*)$/m);

if (existsSync(bare)) {
  run(bare, '--suite', 'bookworm', '--until', 'http://localhost:', path(), 'npm start');
  run(bare, '--suite', 'bookworm', path(), 'npm run build');
  // With a newer compiler, and without precompiled headers, which hide those that a file forgets.
  const strict = line.replace('cmake -B build', 'cmake -B build -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON');
  const tests = `export CMAKE_BUILD_PARALLEL_LEVEL=${jobs}; ${strict} -R "units|cases"`;
  run(bare, '--suite', 'trixie', '--node', 'none', '--with', packages.split(' ').join(','), path(), tests);
}
