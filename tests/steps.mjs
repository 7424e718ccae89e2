// Steps that npm start, npm test, npm run bench and the continuous integration have in common.
import { spawnSync } from 'node:child_process';
import { existsSync, statSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = dirname(dirname(fileURLToPath(import.meta.url)));
export const jobs = String(availableParallelism());

/** Runs a command in the project's folder, its output going to the terminal; ends the program if it fails. */
export function run(command, ...args) {
  console.log(`\n> ${[command, ...args].join(' ')}`);
  const { status, error } = spawnSync(command, args, { cwd: root, stdio: 'inherit' });
  if (error) fail(`can't run ${command}: ${error.message}`);
  if (status !== 0) process.exit(status ?? 1);
}

export function fail(message) {
  console.error(message);
  process.exit(1);
}

const works = (command, ...args) => spawnSync(command, args, { stdio: 'ignore' }).status === 0;
const compiler = process.env.CXX ?? 'c++';
const compiles = (input) => spawnSync(compiler, ['-x', 'c++', '-fsyntax-only', '-'], { input }).status === 0;
const hasHeader = (header) => compiles(`#if !__has_include(<${header}>)\n#error\n#endif\n`);

const tools = {
  'a C++20 compiler': { has: () => works(compiler, '--version'), packages: ['g++'] },
  CMake: { has: () => works('cmake', '--version'), packages: ['cmake'] },
  make: { has: () => works('make', '--version') || works('ninja', '--version'), packages: ['make'] },
  Catch2: { has: () => hasHeader('catch2/catch.hpp') || hasHeader('catch2/catch_all.hpp'), packages: ['catch2'] },
  'pkg-config': { has: () => works('pkg-config', '--version'), packages: ['pkg-config'] },
  Eigen: { has: () => existsSync('/usr/include/eigen3') || existsSync('/usr/local/include/eigen3'), packages: ['libeigen3-dev'] },
  zlib: { has: () => hasHeader('zlib.h'), packages: ['zlib1g-dev'] },
  Emscripten: { has: () => works('emcc', '--version'), packages: ['emscripten'] },
  Chromium: { has: () => works('/usr/bin/chromium', '--version'), packages: ['chromium'] },
  // The version matters: each formats a little differently.
  'clang-format 14': { has: () => works('clang-format-14', '--version'), packages: ['clang-format-14'] },
  'clang-tidy': { has: () => works('clang-tidy', '--version'), packages: ['clang-tidy'] },
  OpenFOAM: { has: () => existsSync('/usr/bin/checkMesh') && existsSync('/usr/share/openfoam'), packages: ['openfoam'] },
  "Debian's VTK for Python": { has: () => works('/usr/bin/python3', '-c', 'import vtk'), packages: ['python3-vtk9'] },
  'clang with libFuzzer': {
    has: () => works('sh', '-c', 'command -v clang++ && ls "$(clang++ -print-resource-dir)"/lib/*/libclang_rt.fuzzer*'),
    packages: ['clang'],
  },
};

/** Makes sure of the tools named, which are keys of `tools`: installs what is missing on Debian and Ubuntu, else says what to install. */
export function setUp(...names) {
  const missing = () => names.filter((name) => !tools[name].has());
  const wanted = missing();
  if (wanted.length === 0) return;
  console.log(`Missing: ${wanted.join(', ')}`);
  const sudo = process.getuid?.() === 0 ? [] : ['sudo'];
  const packages = wanted.flatMap((name) => tools[name].packages);
  if (!existsSync('/usr/bin/apt-get') || (sudo.length && !works('sudo', '-V')))
    fail(`Please install ${wanted.join(', ')} and try again. (On Debian, as root: apt-get install ${packages.join(' ')})`);
  run(...sudo, 'apt-get', 'update');
  run(...sudo, 'apt-get', 'install', '-y', '--no-install-recommends', ...packages);
  const still = missing();
  if (still.length) fail(`apt-get has run, but these are still missing: ${still.join(', ')}`);
}

/** Installs the npm packages that the lock file names, unless they are there. */
export function installPackages() {
  const installed = path('node_modules', '.package-lock.json');
  if (!existsSync(installed) || statSync(installed).mtimeMs < statSync(path('package-lock.json')).mtimeMs) run('npm', 'ci');
}

/** Configures and builds in the folder; further arguments go to CMake. */
export function build(folder, ...options) {
  run('cmake', '-S', '.', '-B', folder, ...options);
  run('cmake', '--build', folder, '--parallel', jobs);
}

export const path = (...parts) => join(root, ...parts);
