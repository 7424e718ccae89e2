// Builds the package into dist/: compiles the C++ core to WebAssembly and puts the JavaScript and the types beside it.
// With --tests also builds the C++ tests for Node, for `ctest --test-dir build-wasm`.
// Takes the Emscripten of an activated emsdk if there is one, else that of Debian.
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readdirSync, realpathSync, rmSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { basename, delimiter, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const packageFolder = dirname(fileURLToPath(import.meta.url));
const root = dirname(packageFolder);
const build = join(root, 'build-wasm');
const dist = join(packageFolder, 'dist');
const debianModules = '/usr/share/nodejs'; // where Debian keeps what its emcc needs to optimise JavaScript

function toolchainFile() {
  const candidates = (process.env.PATH ?? '').split(delimiter).filter((folder) => folder && existsSync(join(folder, 'emcc')));
  const folders = [process.env.EMSDK && join(process.env.EMSDK, 'upstream', 'emscripten'), ...candidates.map((folder) => dirname(realpathSync(join(folder, 'emcc')))),
    '/usr/share/emscripten'];
  const files = folders.filter(Boolean).map((folder) => join(folder, 'cmake', 'Modules', 'Platform', 'Emscripten.cmake'));
  const file = files.find((candidate) => existsSync(candidate));
  if (!file) throw new Error('Emscripten not found. Install it (Debian: apt-get install emscripten) or activate an emsdk.');
  return file;
}

function run(command, ...args) {
  const nodePath = [process.env.NODE_PATH, existsSync(debianModules) && debianModules].filter(Boolean).join(delimiter);
  execFileSync(command, args, { stdio: 'inherit', env: { ...process.env, ...(nodePath && { NODE_PATH: nodePath }) } });
}

function compile(tests) {
  run('cmake', '-S', root, '-B', build, `-DCMAKE_TOOLCHAIN_FILE=${toolchainFile()}`, `-DCMAKE_CROSSCOMPILING_EMULATOR=${process.execPath}`,
    '-DCMAKE_BUILD_TYPE=Release', `-DMANDOLINE_BUILD_TESTS=${tests ? 'ON' : 'OFF'}`);
  run('cmake', '--build', build, '--parallel', String(availableParallelism()), '--target', 'mandoline-wasm', ...(tests ? ['mandoline-tests'] : []));
}

/** Files are replaced one by one, so that whoever uses the package meanwhile always finds it. */
function assemble() {
  mkdirSync(dist, { recursive: true });
  const source = join(packageFolder, 'src');
  const compiled = ['mandoline.js', 'mandoline.wasm'].map((file) => join(build, 'wasm', file));
  const files = [...readdirSync(source).map((file) => join(source, file)), ...compiled];
  for (const file of files) cpSync(file, join(dist, basename(file)));
  const kept = new Set(files.map((file) => basename(file)));
  cpSync(join(root, 'LICENSE'), join(packageFolder, 'LICENSE'));
  for (const file of readdirSync(dist)) if (!kept.has(file)) rmSync(join(dist, file), { recursive: true });
}

compile(process.argv.includes('--tests'));
assemble();
