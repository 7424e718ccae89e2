// What each npm command needs, and how to get it. By itself, `npm run setup` installs what is missing for all of them, and
// `npm run setup -- bench` for one. The commands do the same for themselves where that needs no sudo.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { fail, path, run } from './steps.mjs';

const native = ['a C++20 compiler', 'CMake', 'make', 'zlib', 'fast_float'];
const webAssembly = ['CMake', 'make', 'Emscripten', 'Eigen', 'fast_float', 'the npm packages'];
const needs = {
  start: [...native, ...webAssembly],
  build: webAssembly,
  test: [...native, ...webAssembly, 'pkg-config', 'Catch2', 'pybind11', 'Chromium'],
  bench: [...native, ...webAssembly],
  orders: [...native, 'Eigen'],
  // Of the continuous integration.
  sources: ['clang-format 14', 'the npm packages'],
  checks: ['clang-tidy', 'clang with libFuzzer', 'OpenFOAM', "Debian's VTK for Python", 'MPI'],
};
const all = 'test'; // which needs what any other npm command does

const works = (command, ...args) => spawnSync(command, args, { stdio: 'ignore' }).status === 0;
const compiler = process.env.CXX ?? 'c++';
const compiles = (input) => spawnSync(compiler, ['-std=c++20', '-x', 'c++', '-fsyntax-only', '-'], { input }).status === 0;
const hasHeader = (header) => compiles(`#if !__has_include(<${header}>)\n#error\n#endif\n`);

/** Whether CMake's find_package finds it, as it does in CMakeLists.txt. */
function isFound(name) {
  const folder = mkdtempSync(join(tmpdir(), 'mandoline-'));
  writeFileSync(
    join(folder, 'CMakeLists.txt'),
    `cmake_minimum_required(VERSION 3.20)\nproject(find LANGUAGES NONE)\nfind_package(${name} CONFIG REQUIRED)\n`,
  );
  const found = works('cmake', '-S', folder, '-B', folder);
  rmSync(folder, { recursive: true });
  return found;
}

/** Whether all that the lock file names has been installed since it was last changed. */
function hasNpmPackages() {
  const installed = path('node_modules', '.package-lock.json');
  return existsSync(installed) && statSync(installed).mtimeMs >= statSync(path('package-lock.json')).mtimeMs;
}

// `has`: whether the machine has it. `packages`: of Debian and Ubuntu.
const tools = {
  'a C++20 compiler': { has: () => compiles('#include <concepts>\n#include <span>\n'), packages: ['g++'] },
  CMake: { has: () => works('cmake', '--version'), packages: ['cmake'] },
  make: { has: () => works('make', '--version') || works('ninja', '--version'), packages: ['make'] },
  Catch2: { has: () => hasHeader('catch2/catch.hpp') || hasHeader('catch2/catch_all.hpp'), packages: ['catch2'] },
  'pkg-config': { has: () => works('pkg-config', '--version'), packages: ['pkg-config'] },
  Eigen: { has: () => isFound('Eigen3'), packages: ['libeigen3-dev'] },
  fast_float: { has: () => isFound('FastFloat'), packages: ['libfast-float-dev'] },
  pybind11: {
    has: () => hasHeader('pybind11/pybind11.h') && works('python3-config', '--includes'),
    packages: ['pybind11-dev', 'python3-dev'],
  },
  zlib: { has: () => hasHeader('zlib.h'), packages: ['zlib1g-dev'] },
  Emscripten: { has: () => works('emcc', '--version'), packages: ['emscripten'] },
  Chromium: { has: () => works('/usr/bin/chromium-headless-shell', '--version'), packages: ['chromium-headless-shell'] },
  'the npm packages': { has: hasNpmPackages, install: ['npm', 'ci'] },
  // The version matters: each formats a little differently.
  'clang-format 14': { has: () => works('clang-format-14', '--version'), packages: ['clang-format-14'] },
  'clang-tidy': { has: () => works('clang-tidy', '--version'), packages: ['clang-tidy'] },
  MPI: { has: () => works('mpicxx', '--version') && works('mpiexec', '--version'), packages: ['libopenmpi-dev', 'openmpi-bin'] },
  OpenFOAM: { has: () => existsSync('/usr/bin/checkMesh') && existsSync('/usr/share/openfoam'), packages: ['openfoam'] },
  "Debian's VTK for Python": { has: () => works('/usr/bin/python3', '-c', 'import vtk'), packages: ['python3-vtk9'] },
  'clang with libFuzzer': {
    has: () => works('sh', '-c', 'command -v clang++ && ls "$(clang++ -print-resource-dir)"/lib/*/libclang_rt.fuzzer*'),
    packages: ['clang'],
  },
};

/** Why this version of Node will not do; undefined if it does. `range`: like ^20.19.0 || >=22.12.0 */
export function refuseNode(version, range) {
  const numbers = (text) => text.match(/\d+/g).map(Number);
  const [major, minor] = numbers(version);
  const isFine = range.split('||').some((part) => {
    const [leastMajor, leastMinor] = numbers(part);
    return major === leastMajor ? minor >= leastMinor : major > leastMajor && part.includes('>=');
  });
  if (!isFine) return `Node ${version} will not do: this project needs ${range}. https://nodejs.org has it.`;
}

/**
 * The commands that install tools, or a refusal that says what to do instead. `command` is what needs them; `isRoot`, `hasApt`, `hasSudo`:
 * of the machine; sudo is used only if `maySudo`.
 */
export function planInstallation(missing, command, { isRoot, hasApt, hasSudo, maySudo }) {
  const packages = missing.flatMap((name) => tools[name].packages ?? []);
  const commands = missing.flatMap((name) => (tools[name].install ? [tools[name].install] : []));
  if (packages.length === 0) return { commands };
  const wanted = missing.filter((name) => tools[name].packages).join(', ');
  const apt = ['apt-get', 'install', '-y', '--no-install-recommends', ...packages];
  if (!hasApt || !(isRoot || hasSudo)) return { refusal: `Missing: ${wanted}. Please install them. (Debian, as root: ${apt.join(' ')})` };
  if (!isRoot && !maySudo) return { refusal: `Missing: ${wanted}. To install them with sudo and apt-get: npm run setup -- ${command}` };
  const sudo = isRoot ? [] : ['sudo'];
  return { commands: [[...sudo, 'apt-get', 'update'], [...sudo, ...apt], ...commands] };
}

/** Makes sure of what a command needs, a key of `needs`: says what is missing and installs it, or ends the program with what to do. */
export function setUp(command, { maySudo = false } = {}) {
  const refusal = refuseNode(process.versions.node, JSON.parse(readFileSync(path('package.json'), 'utf8')).engines.node);
  if (refusal) fail(refusal);
  const findMissing = () => [...new Set(needs[command])].filter((name) => !tools[name].has());
  const missing = findMissing();
  if (missing.length === 0) return;
  const machine = { isRoot: process.getuid?.() === 0, hasApt: works('apt-get', '--version'), hasSudo: works('sudo', '-V'), maySudo };
  const plan = planInstallation(missing, command, machine);
  if (plan.refusal) fail(plan.refusal);
  console.log(`Missing: ${missing.join(', ')}. Installing:`);
  for (const [program, ...args] of plan.commands) run(program, ...args);
  const still = findMissing();
  if (still.length) fail(`Installed, but still missing: ${still.join(', ')}`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const names = process.argv.slice(2).filter((name) => name !== '--no-sudo');
  const unknown = names.find((name) => !Object.hasOwn(needs, name));
  if (unknown) fail(`npm run setup: unknown command ${unknown}. One of: ${Object.keys(needs).join(', ')}`);
  for (const name of names.length ? names : [all]) setUp(name, { maySudo: !process.argv.includes('--no-sudo') });
}
