// Every file that the native program writes comes from JavaScript, too, byte by byte, here and from a worker.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join as path } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { createWorker } from 'mandoline-wasm/physics/worker';
import { join, readObj, sheet, torus, writeObj } from './meshes.mjs';

const root = path(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.MANDOLINE_CLI ?? path(root, 'build', 'mandoline');
const skip = existsSync(program) ? false : `there is no native program ${program}`;

const [mandoline, physics, worker] = await Promise.all([init(), initPhysics(), createWorker()]);
const folder = mkdtempSync(path(tmpdir(), 'mandoline-'));
after(() => {
  worker.terminate();
  rmSync(folder, { recursive: true });
});

// Two tori that cross and a sheet through them, which leaves open edges; in two groups.
const made = join(join(torus(24, 12), torus(24, 12, 1.1, 0.3)), sheet([-1, -1], [0.9, 0.8], 0.25));
const text = writeObj(made);
const firstFace = text.indexOf('\nf ') + 1;
const middle = text.indexOf('\nf ', (firstFace + text.length) / 2) + 1;
const grouped = `${text.slice(0, firstFace)}g first\n${text.slice(firstFace, middle)}g second\n${text.slice(middle)}`;
const file = path(folder, 'mesh.obj');
writeFileSync(file, grouped);
const mesh = readObj(grouped);
const groups = await mandoline.readGroups(Buffer.from(grouped), { name: file });

const grid = { min: [-1.9, -1.7, -0.95], max: [1.8, 1.75, 0.9], cells: [19, 17, 11] };
const gridOptions = ['--box', [...grid.min, ...grid.max].join(), '--cells', grid.cells.join()];
const wind = [1, 0.3, -0.2];
const cutMesh = mandoline.cut(mesh, grid);
const cells = physics.cellComplex(mesh, cutMesh, physics.coarsen(cutMesh, { maxLevel: 2 }));

const regions = Uint8Array.from({ length: cutMesh.regionCount }, (_, region) => Number(region === 0));

/** What the program writes to files of these names: a function that reads one, with their folder. */
function native(command, options, names) {
  const here = mkdtempSync(path(folder, 'native-'));
  execFileSync(program, [command, file, ...options, ...names.flatMap((name) => ['-o', path(here, name)])], { stdio: 'pipe' });
  return Object.assign((name) => readFileSync(path(here, name)), { folder: here });
}

function assertSame(bytes, expected, what) {
  assert.ok(bytes instanceof Uint8Array && expected.length > 50, what);
  assert.ok(expected.equals(bytes), `${what}: ${bytes.length} bytes, ${expected.length} bytes`);
}

/** The call's bytes, here and from the worker, are those that the program wrote. */
async function compare(module, call, args, expected) {
  assertSame(await module[call](...args), expected, call);
  assertSame(await worker[call](...args), expected, `${call} in a worker`);
}

test('cut-meshes', { skip }, async () => {
  const formats = ['json', 'mcm', 'vtu', 'obj', 'stl', 'ply'];
  const written = native(
    'cut',
    gridOptions,
    formats.map((format) => `cut.${format}`),
  );
  for (const format of formats) await compare(mandoline, 'write', [mesh, cutMesh, format, { groups }], written(`cut.${format}`));
});

test('cell complexes, all cells or the cut-cells alone', { skip }, async () => {
  const options = [...gridOptions, '--coarsen', '2'];
  const written = native('cut', options, ['cells.json', 'cells.vtu']);
  for (const format of ['json', 'vtu']) {
    await compare(physics, 'writeCells', [cutMesh, cells, format, { groups }], written(`cells.${format}`));
  }
  const ofCut = native('cut', [...options, '--only', 'cut'], ['cells.vtu']);
  await compare(physics, 'writeCells', [cutMesh, cells, 'vtu', { untouched: false }], ofCut('cells.vtu'));
  const faces = native('cut', [...options, '--faces'], ['faces.vtu']);
  await compare(physics, 'writeFaces', [cutMesh, cells, { groups }], faces('faces.vtu'));
});

test('polyMeshes, with groups and without, of all cells or one region', { skip }, async () => {
  for (const [options, given] of [
    [[], { groups }],
    [['--only', 'region=0'], { groups, regions }],
  ]) {
    const written = native('cut', [...gridOptions, '--coarsen', '2', ...options], ['polyMesh']);
    for (const module of [physics, worker]) {
      const files = await module.writePolyMesh(cutMesh, cells, given);
      assert.deepEqual(Object.keys(files).sort(), readdirSync(path(written.folder, 'polyMesh')).sort());
      for (const [name, bytes] of Object.entries(files)) assertSame(bytes, written(`polyMesh/${name}`), name);
    }
  }
});

test('merged cells', { skip }, async () => {
  const merged = physics.mergeSmallCells(cutMesh, cells, { fraction: 0.3 }).cells;
  const options = [...gridOptions, '--coarsen', '2', '--merge', '0.3'];
  const written = native('cut', options, ['cells.vtu', 'polyMesh']);
  await compare(physics, 'writeCells', [cutMesh, merged, 'vtu', {}], written('cells.vtu'));
  for (const [name, bytes] of Object.entries(physics.writePolyMesh(cutMesh, merged, { groups })))
    assertSame(bytes, written(`polyMesh/${name}`), name);
  const faces = native('cut', [...options, '--faces'], ['faces.vtu']);
  await compare(physics, 'writeFaces', [cutMesh, merged, { groups }], faces('faces.vtu'));
});

test('cells without the faces of sheets that end in them', { skip }, async () => {
  const simpleCells = true;
  const written = native('cut', [...gridOptions, '--simple-cells'], ['cut.vtu']);
  await compare(mandoline, 'write', [mesh, cutMesh, 'vtu', { simpleCells }], written('cut.vtu'));
  const ofAll = native('cut', [...gridOptions, '--coarsen', '2', '--simple-cells'], ['cells.vtu', 'polyMesh']);
  await compare(physics, 'writeCells', [cutMesh, cells, 'vtu', { simpleCells }], ofAll('cells.vtu'));
  for (const [name, bytes] of Object.entries(physics.writePolyMesh(cutMesh, cells, { simpleCells, groups })))
    assertSame(bytes, ofAll(`polyMesh/${name}`), name);
  const [simple, whole] = await Promise.all([true, false].map((flag) => mandoline.write(mesh, cutMesh, 'vtu', { simpleCells: flag })));
  assert.ok(simple.length < whole.length);
});

test('walls united, by groups', { skip }, async () => {
  const united = physics.uniteWalls(cutMesh, cells, { angle: 40, groups });
  const written = native('cut', [...gridOptions, '--coarsen', '2', '--unite-walls', '40'], ['cells.json', 'polyMesh']);
  await compare(physics, 'writeCells', [cutMesh, united, 'json', { groups }], written('cells.json'));
  for (const [name, bytes] of Object.entries(physics.writePolyMesh(cutMesh, united, { groups })))
    assertSame(bytes, written(`polyMesh/${name}`), name);
});

test('flows and streamlines', { skip }, async () => {
  const options = [...gridOptions, '--coarsen', '2', '--wind', wind.join()];
  const written = native('flow', [...options, '--streamlines', '40'], ['flow.vtu', 'lines.obj']);
  const { cells: merged } = physics.mergeSmallCells(cutMesh, cells);
  const flow = physics.solveFlow(merged, wind);
  const fields = { phi: flow.phi, velocity: flow.cellVelocity, pressure_coefficient: flow.cellPressure };
  await compare(physics, 'writeCells', [cutMesh, merged, 'vtu', { fields }], written('flow.vtu'));
  const lines = physics.streamlines({ mesh, cutMesh, cells: merged, flow }, physics.inflowSeeds(cutMesh.grid, wind, 40));
  await compare(mandoline, 'writeLines', [lines], written('lines.obj'));
  const ofFaces = { normal_velocity: flow.faceVelocity, normal: merged.faceNormal, area: merged.faceArea };
  const faces = native('flow', [...options, '--faces'], ['faces.vtu']);
  await compare(physics, 'writeFaces', [cutMesh, merged, { fields: ofFaces, groups }], faces('faces.vtu'));
});

test('outlines', { skip }, async () => {
  const offsets = [-0.2, 0.1];
  const formats = ['svg', 'dxf', 'obj'];
  const written = native(
    'slice',
    [...gridOptions, '--heights', offsets.join(), '--only', 'region=0'],
    formats.map((format) => `slice.${format}`),
  );
  const layers = mandoline.outlines(cutMesh, [0, 0, 1], offsets);
  const stack = { normal: [0, 0, 1], offsets, layers };
  for (const format of formats) await compare(mandoline, 'writeOutlines', [stack, format, { regions }], written(`slice.${format}`));
});

test('meshes and their defects', { skip }, async () => {
  const formats = ['obj', 'stl', 'ply', 'off'];
  const written = native(
    'resolve',
    ['--rule', 'positive'],
    formats.map((format) => `resolved.${format}`),
  );
  const solid = mandoline.boundary(mandoline.resolve(mesh));
  for (const format of formats) await compare(mandoline, 'writeMesh', [solid, format], written(`resolved.${format}`));
  await compare(mandoline, 'writeDefects', [mesh, mandoline.inspect(mesh)], native('info', [], ['defects.obj'])('defects.obj'));
});
