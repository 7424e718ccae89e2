// "Use this in code": what the page says for its state is run as it is, in Node and by the native program, and makes the page's own cells.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';
import { after, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { initPhysics } from 'mandoline-wasm/physics';
import { importBundled } from './bundled.mjs';
import { galleryMesh, mandoline } from './reference.mjs';

const { codeOf } = await importBundled('model/code.ts');
const { fromHash } = await importBundled('model/hash.ts');
const { boundsOf } = await importBundled('model/grid_around.ts');
const { keep, makeCut } = await importBundled('worker/kept.ts');
const { makeModel } = await importBundled('worker/make_model.ts');
const { makeTunnel } = await importBundled('worker/wind/tunnel.ts');
const { SmokeFlow } = await importBundled('worker/wind/smoke.ts');
const pack = { mandoline, physics: await initPhysics() };

const root = fileURLToPath(new URL('../..', import.meta.url));
const program = process.env.MANDOLINE_CLI ?? join(root, 'build', 'mandoline');
const skip = existsSync(program) ? false : `there is no native program ${program}`;
const folder = mkdtempSync(join(tmpdir(), 'mandoline-code-'));
after(() => rmSync(folder, { recursive: true }));
symlinkSync(join(root, 'node_modules'), join(folder, 'node_modules'));

let id = 0;

/** What the page has in the state of a link: the model, and the cells in the wind. */
async function stateOf(hash, name, isReadHere) {
  const { settings, problems } = fromHash(hash);
  assert.deepEqual(problems, []);
  const mesh = await galleryMesh(name);
  const loaded = { id: ++id, name: settings.source.name, ...mesh, bounds: boundsOf(mesh), up: 'y', isReadHere };
  keep(loaded);
  const { grid, snapTolerance, pose } = settings;
  const cut = await makeCut(mandoline, { id, mesh: id, grid, snapTolerance, pose }, { cut: mandoline.cut, tell: () => {} });
  const { slices, sliceMode, wind } = settings;
  const model = makeModel(mandoline, cut, { slices, sliceMode });
  if (wind.smoke) {
    const { flow, smoke } = await SmokeFlow.begin(pack, loaded, { mesh: id, pose, direction: wind.direction });
    flow.end();
    return { settings, model, mesh: cut.mesh, inWind: smoke.cells };
  }
  const tunnel = wind.on ? await makeTunnel(pack, loaded, { mesh: id, pose, cells: wind.cells }) : null;
  return { settings, model, mesh: cut.mesh, inWind: tunnel?.cells.cellVolume.length };
}

/** A folder with the mesh alone, as it is saved from the page. */
async function folderWith(kind, { file }, mesh) {
  const place = join(folder, `${kind}-${id}`);
  mkdirSync(place);
  const content = await mandoline.writeMesh(mesh, 'obj');
  writeFileSync(join(place, file), file.endsWith('.gz') ? gzipSync(content) : content);
  return place;
}

const states = {
  'as the page begins': { hash: '', name: 'bunny', file: 'bunny.obj' },
  'a box of its own and a snap tolerance, with a file whose name shells and JavaScript would misread': {
    hash: `file=${encodeURIComponent("-it's $HOME.obj")}&n=7,6,5&box=-3.5,-3.25,-2,3,3.5,2.125&snap=0.125`,
    name: 'torus-knot',
    file: "-it's $HOME.obj",
    isOpened: true,
  },
  'a packed file whose name has a line break': {
    hash: `file=${encodeURIComponent('two\nlines.obj.gz')}&n=5`,
    name: 'wedge',
    file: 'two\nlines.obj.gz',
    isOpened: true,
  },
  'a file with a name in another script, which neither reads whatever it is called': {
    hash: `file=${encodeURIComponent('模型 é.stl.zip')}&n=5`,
    name: 'wedge',
    file: '模型-é.stl.zip.obj',
    isReadHere: true,
  },
  'a free plane through a corner of the box around the mesh, beside the mesh': {
    hash: 'mesh=nested-spheres&n=8&free=0.82,1,1,1',
    name: 'nested-spheres',
    file: 'nested-spheres.obj',
  },
  'a plane that meets what is outside alone': {
    hash: 'mesh=empty-cone&n=8&x=0.5,1',
    name: 'empty-cone',
    file: 'empty-cone.obj',
  },
  'a grid within the mesh, whose cells are untouched, and a plane': {
    hash: 'mesh=bunny&n=3,3,3&box=-0.5,3,-0.5,0.5,4,0.5&x=0.5,1',
    name: 'bunny',
    file: 'bunny.obj',
    slices: ['x'],
  },
  'slices of an open sheet, whose inside is an estimate': {
    hash: 'mesh=trumpet&n=9&z=0.5,1&y=0.55,-1',
    name: 'trumpet',
    file: 'trumpet.obj',
    slices: ['y', 'z'],
  },
  'an open sheet with pockets that count as inside, and a plane beside them': {
    hash: 'mesh=wavy-plane&n=9&z=0.5,1&y=0.9,1',
    name: 'wavy-plane',
    file: 'wavy-plane.obj',
    slices: ['z'],
  },
  'slices of an open sheet without an inside': {
    hash: 'mesh=wavy-plane&n=2&z=0.5,1&y=0.9,1',
    name: 'wavy-plane',
    file: 'wavy-plane.obj',
    slices: ['y', 'z'],
  },
  'slices along an axis, against one and free, and one beside the mesh': {
    hash: 'mesh=nested-spheres&n=8&x=0.5,1&y=0.6,-1&free=0.52,0.75,0.1,0.65&z=0.999,1',
    name: 'nested-spheres',
    file: 'nested-spheres.obj',
    slices: ['x', 'y', 'free'],
  },
  'an open sheet, whose inside is an estimate, in a wind aslant': {
    hash: 'mesh=trumpet&n=9&wind=1,0.25,-0.5&tunnel=14',
    name: 'trumpet',
    file: 'trumpet.obj',
  },
  'an open sheet in smoke': { hash: 'mesh=trumpet&n=5&wind=0,0,1&smoke=on', name: 'trumpet', file: 'trumpet.obj' },
  'a mesh that moves, of a file that neither reads, in wind': {
    hash: 'file=a%20model.glb&n=8&pose=turn,0.3&wind=0,0,1&tunnel=12',
    name: 'chain',
    file: 'a-model-turn.obj',
  },
};

for (const [what, { hash, name, file, isOpened = false, isReadHere = false, slices = [] }] of Object.entries(states)) {
  describe(what, () => {
    let state, code, byScript;
    const files = ['cells.vtu', ...slices.map((plane) => `slice-${plane}.svg`)];

    test('JavaScript', async () => {
      state = await stateOf(hash, name, isReadHere);
      code = codeOf(state.settings, state.model);
      assert.deepEqual([code.file, code.isOpened], [file, isOpened]);
      byScript = await folderWith('script', code, state.mesh);
      writeFileSync(join(byScript, 'cut.mjs'), code.javascript);
      const output = execFileSync(process.execPath, ['cut.mjs'], { cwd: byScript, encoding: 'utf8' });
      const { cutCells, regions } = state.model.counts;
      const { smoke } = state.settings.wind;
      const lines = [
        `${cutCells} cut-cells, ${regions} regions`,
        ...(state.inWind ? [`${state.inWind} cells in the wind, ${smoke ? 'at time' : 'converged'}`] : []),
      ];
      assert.equal(output.replace(/(?<=at time) [\d.]+/, ''), `${lines.join('\n')}\n`);
      if (state.inWind) files.push('flow.vtu', ...(smoke ? [] : ['streamlines.obj']));
      assert.deepEqual(readdirSync(byScript).sort(), [...files, file, 'cut.mjs'].sort());
    });

    test('the command line makes the same files', { skip }, async () => {
      const byProgram = await folderWith('program', code, state.mesh);
      assert.equal(basename(program), 'mandoline');
      const output = execFileSync('sh', ['-ec', code.commandLine], {
        cwd: byProgram,
        env: { ...process.env, PATH: `${dirname(program)}:${process.env.PATH}` },
        encoding: 'utf8',
        stdio: ['ignore', 'pipe', 'pipe'],
      });
      assert.equal(Number(output.match(/^ *cut-cells +(\d+)$/m)[1]), state.model.counts.cutCells);
      assert.equal(Number(output.match(/^ *regions +(\d+)$/m)[1]), state.model.counts.regions);
      if (state.inWind) assert.equal(Number(output.match(/^cells +(\d+)$/m)[1]), state.inWind);
      assert.deepEqual(readdirSync(byProgram).sort(), [...files, file].sort());
      for (const made of files) assert.ok(readFileSync(join(byProgram, made)).equals(readFileSync(join(byScript, made))), made);
    });
  });
}
