// The README's first commands in a bare Debian, where ../shared/bare.sh is there to make one: what is installed here hides what they forget
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
  const tests = `export CMAKE_BUILD_PARALLEL_LEVEL=${jobs}; ${line} -R "units|cases"`;
  run(bare, '--suite', 'bookworm', '--node', 'none', '--with', packages.split(' ').join(','), path(), tests);
}
