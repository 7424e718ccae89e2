// Builds the package into dist/: compiles the C++ core to WebAssembly and puts the JavaScript and the types beside it. inline.js and
// physics/inline.js get the WebAssembly and the worker's script inside.
// With --tests also builds the C++ tests for Node, for `ctest --test-dir build-wasm`.
// Without Eigen there is no mandoline-wasm/physics, which --whole takes for an error.
// Takes the Emscripten of an activated emsdk if there is one, else that of Debian.
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, readFileSync, readdirSync, realpathSync, rmSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { delimiter, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build as rolldown } from 'rolldown';

const packageFolder = dirname(fileURLToPath(import.meta.url));
const root = dirname(packageFolder);
const build = join(root, 'build-wasm');
const dist = join(packageFolder, 'dist');
const debianModules = '/usr/share/nodejs'; // where Debian keeps what its emcc needs to optimise JavaScript

function toolchainFile() {
  const compilers = (process.env.PATH ?? '')
    .split(delimiter)
    .filter(Boolean)
    .map((folder) => join(folder, 'emcc'))
    .filter(existsSync);
  const folders = [
    process.env.EMSDK && join(process.env.EMSDK, 'upstream', 'emscripten'),
    ...compilers.map((compiler) => dirname(realpathSync(compiler))),
    '/usr/share/emscripten',
  ];
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
  run(
    'cmake',
    '-S',
    root,
    '-B',
    build,
    `-DCMAKE_TOOLCHAIN_FILE=${toolchainFile()}`,
    `-DCMAKE_CROSSCOMPILING_EMULATOR=${process.execPath}`,
    '-DCMAKE_BUILD_TYPE=Release',
    '-DCMAKE_UNITY_BUILD=ON', // in less than half the time
    `-DMANDOLINE_BUILD_TESTS=${tests ? 'ON' : 'OFF'}`,
  );
  run('cmake', '--build', build, '--parallel', String(availableParallelism()));
}

/** The code of a script and of everything that it imports, in one file. */
async function bundle(input, options, output = {}) {
  const { output: chunks } = await rolldown({ input, write: false, logLevel: 'warn', ...options, output });
  return chunks[0].code;
}

/** Puts the WebAssembly of the modules and the worker's script into the text of a folder's inline.js. */
async function fillInline(folder, modules) {
  const file = join(folder, 'inline.js');
  let text = readFileSync(file, 'utf8');
  const put = (place, content) => {
    text = text.replace(`'${place}'`, () => content());
  };
  for (const [name, place] of modules) {
    const gzipped = () => gzipSync(readFileSync(join(place, `${name}.wasm`)), { level: 9 }).toString('base64');
    put(`GZIPPED_${name.toUpperCase()}`, () => `'${gzipped()}'`);
  }
  const script = await bundle(join(folder, 'worker-thread.js'), {}, { minify: true });
  put('WORKER_SCRIPT', () => JSON.stringify(script));
  writeFileSync(file, text);
}

/** A number as WebAssembly has it (LEB128). */
const leb = (number) => (number < 128 ? [number] : [(number % 128) + 128, ...leb(number >>> 7)]);

/** { number, end } of such a number. */
function readLeb(bytes, at) {
  if (bytes[at] < 128) return { number: bytes[at], end: at + 1 };
  const { number, end } = readLeb(bytes, at + 1);
  return { number: number * 128 + (bytes[at] % 128), end };
}

/**
 * The module's bytes with one export more: its memory once again, under a name that tells the module from others of the package
 * (src/load.js). Custom sections would be lost where tools strip modules.
 */
function withName(bytes, name) {
  const [exportSection, memory] = [7, 2];
  for (let at = 8; at < bytes.length; ) {
    const { number: size, end: start } = readLeb(bytes, at + 1);
    const next = start + size;
    if (bytes[at] === exportSection) {
      const { number: count, end: first } = readLeb(bytes, start);
      const text = Buffer.from(`mandoline-wasm/${name}`);
      const more = Buffer.from([...leb(text.length), ...text, memory, 0]);
      const content = Buffer.concat([Buffer.from(leb(count + 1)), bytes.subarray(first, next), more]);
      return Buffer.concat([bytes.subarray(0, at), Buffer.from([exportSection, ...leb(content.length)]), content, bytes.subarray(next)]);
    }
    at = next;
  }
  throw new Error(`${name} has no exports`);
}

function leaveOutPhysics(folder) {
  const message = 'Eigen not found (Debian: apt-get install libeigen3-dev): the package lacks mandoline-wasm/physics.';
  if (process.argv.includes('--whole')) throw new Error(message);
  console.warn(`\n${message}\n`);
  rmSync(join(folder, 'physics'), { recursive: true });
}

/** Makes the package's files, beside each other since some have others inside. Gives their folder. */
async function makeFiles() {
  const folder = join(build, 'package');
  rmSync(folder, { recursive: true, force: true });
  cpSync(join(packageFolder, 'src'), folder, { recursive: true });
  // Emscripten's code says where the .wasm file is, too, for which bundlers would copy it once more.
  const withoutUrl = { transform: { define: { 'import.meta.url': 'undefined' } }, treeshake: false };
  const modules = [
    ['mandoline', folder],
    ['files', join(folder, 'files')],
    ['bricks', join(folder, 'bricks')],
  ];
  if (existsSync(join(build, 'wasm', 'physics.wasm'))) modules.push(['physics', join(folder, 'physics')]);
  else leaveOutPhysics(folder);
  for (const [name, place] of modules) {
    const wasm = `${name}.wasm`;
    writeFileSync(join(place, wasm), withName(readFileSync(join(build, 'wasm', wasm)), wasm));
    writeFileSync(join(place, `${name}.js`), await bundle(join(build, 'wasm', `${name}.js`), withoutUrl));
  }
  for (const place of modules.map(([, one]) => one)) if (existsSync(join(place, 'inline.js'))) await fillInline(place, modules);
  return folder;
}

/** Files are replaced one by one, so that whoever uses the package meanwhile always finds it. */
function assemble(folder) {
  cpSync(folder, dist, { recursive: true });
  cpSync(join(root, 'LICENSE'), join(packageFolder, 'LICENSE'));
  const files = readdirSync(folder, { recursive: true });
  for (const file of readdirSync(dist, { recursive: true })) {
    if (!files.includes(file)) rmSync(join(dist, file), { recursive: true, force: true });
  }
}

compile(process.argv.includes('--tests'));
assemble(await makeFiles());
