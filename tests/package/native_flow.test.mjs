// The native program, on one thread or many, and the WebAssembly modules compute the same bits: cells, flows and streamlines.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join as path } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gunzipSync } from 'node:zlib';
import { init } from 'mandoline-wasm';
import { initPhysics } from 'mandoline-wasm/physics';
import { meshFolder, meshList, skipWithoutMeshes } from '../mesh_folder.mjs';
import { box, join, readObj, readVtu, sheet, torus, waves, writeObj } from './meshes.mjs';

const root = path(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.MANDOLINE_CLI ?? path(root, 'build', 'mandoline');
const skip = existsSync(program) ? false : `there is no native program ${program}`;

const [{ cut }, physics] = await Promise.all([init(), initPhysics()]);
const folder = mkdtempSync(path(tmpdir(), 'mandoline-'));
after(() => rmSync(folder, { recursive: true }));

const wind = [1, 0.3, -0.2];
const lineCount = 60;

/** 13 grid cells along each axis, some beside the mesh. */
function gridAbout({ positions }) {
  const along = [0, 1, 2].map((d) => positions.filter((_, i) => i % 3 === d));
  const [low, high] = [along.map((numbers) => Math.min(...numbers)), along.map((numbers) => Math.max(...numbers))];
  const margin = 0.3 * Math.max(...high.map((x, d) => x - low[d]));
  return { min: low.map((x) => x - margin), max: high.map((x) => x + margin), cells: [13, 13, 13] };
}

/** The cells as the program writes them, on three threads. */
function nativeCells(file, { min, max, cells }, maxLevel, fraction) {
  const json = path(folder, 'cells.json');
  const grid = ['--box', [...min, ...max].join(), '--cells', cells.join(), '--coarsen', String(maxLevel)];
  execFileSync(program, ['cut', file, ...grid, '--merge', String(fraction), '--threads', '3', '-o', json], { stdio: 'pipe' });
  return JSON.parse(readFileSync(json));
}

/** What the program writes, on one thread and on three: { report, arrays, lines }. */
function nativeFlow(file, { min, max, cells }, maxLevel, farField) {
  const [report, vtu, obj] = ['report.json', 'flow.vtu', 'lines.obj'].map((name) => path(folder, name));
  const grid = ['--box', [...min, ...max].join(), '--cells', cells.join(), '--coarsen', String(maxLevel)];
  const runs = ['1', '3'].map((threads) => {
    const lines = ['--streamlines', String(lineCount), ...(farField ? ['--far-field'] : [])];
    const args = ['flow', file, '--wind', wind.join(), ...grid, '--threads', threads, ...lines];
    execFileSync(program, [...args, '--report', report, '-o', vtu, '-o', obj], { stdio: 'pipe' });
    return [report, vtu, obj].map((name) => readFileSync(name));
  });
  for (const i of [0, 1, 2]) assert.ok(runs[0][i].equals(runs[1][i]), `${file}: one thread and three`);
  return { report: JSON.parse(readFileSync(report)), arrays: readVtu(readFileSync(vtu)), lines: readFileSync(obj, 'utf8') };
}

/** Streamlines as the program writes them. */
function linesOf({ points, offsets }) {
  const vertices = Array.from({ length: points.length / 3 }, (_, i) => [...points.subarray(3 * i, 3 * i + 3)]);
  const lines = [];
  for (let l = 0; l + 1 < offsets.length; ++l) {
    const ids = Array.from({ length: offsets[l + 1] - offsets[l] }, (_, i) => offsets[l] + i + 1);
    if (ids.length > 1) lines.push(ids);
  }
  return { vertices, lines };
}

function readLines(text) {
  const rows = text.split('\n').map((line) => line.split(' '));
  const numbers = (letter) => rows.filter(([first]) => first === letter).map((row) => row.slice(1).map(Number));
  return { vertices: numbers('v'), lines: numbers('l') };
}

/** To the bit, signs of zeros included. */
function assertSame(values, expected, what) {
  assert.equal(values.length, expected.length, what);
  const wrong = expected.findIndex((value, i) => !Object.is(value, values[i]));
  assert.equal(wrong, -1, `${what}[${wrong}]: ${values[wrong]}, ${expected[wrong]}`);
}

const meshes = {
  torus: torus(50, 25),
  box: box([-0.7, -0.6, -0.5], [0.7, 0.6, 0.5]),
  sheet: sheet([-1, -1], [0.9, 0.8], 0.125),
  waves: waves(30),
  'crossing tori': join(torus(30, 15), torus(30, 15, 1.1, 0.3)),
};
const grid = { min: [-1.9, -1.7, -0.95], max: [1.8, 1.75, 0.9], cells: [19, 17, 11] };

function compare(file, mesh, grid, maxLevel, farField) {
  const { report, arrays, lines } = nativeFlow(file, grid, maxLevel, farField);
  const cutMesh = cut(mesh, grid);
  const single = physics.cellComplex(mesh, cutMesh, physics.coarsen(cutMesh, { maxLevel }));
  const { cells } = physics.mergeSmallCells(cutMesh, single);
  for (const [fraction, all] of [
    [0, single],
    [0.2, cells],
  ]) {
    const { format, version, faceTriangle, ...written } = nativeCells(file, grid, maxLevel, fraction);
    assert.deepEqual([format, version], ['mandoline-cell-complex', 1]);
    assertSame(faceTriangle, cutMesh.faceTriangle, 'faceTriangle');
    assert.deepEqual(Object.keys(written).sort(), Object.keys(all).sort());
    for (const [name, values] of Object.entries(all)) {
      if (!ArrayBuffer.isView(values)) assert.equal(written[name], values, name);
      else assertSame(written[name], values, name);
    }
  }
  const flow = physics.solveFlow(cells, wind, { farField });
  const { status, cutCells, cells: cellCount, faces, throttled, residuals } = report;
  assert.equal(flow.status, 'converged');
  assert.deepEqual([status, cutCells, cellCount, faces], ['ok', cells.cutCells, cells.cellRegion.length, cells.faceTag.length]);
  assertSame(throttled, flow.throttled, 'throttled');
  assertSame(residuals, flow.residuals, 'residuals');
  assertSame(arrays.volume, cells.cellVolume, 'volume');
  assertSame(arrays.phi, flow.phi, 'phi');
  assertSame(arrays.velocity, flow.cellVelocity, 'velocity');
  assertSame(arrays.pressure_coefficient, flow.cellPressure, 'pressure');
  const followed = linesOf(physics.streamlines({ mesh, cutMesh, cells, flow }, physics.inflowSeeds(cutMesh.grid, wind, lineCount)));
  const { vertices, lines: polylines } = readLines(lines);
  assert.ok(polylines.length > lineCount / 2);
  assertSame(vertices.flat(), followed.vertices.flat(), 'points of streamlines');
  assert.deepEqual(polylines, followed.lines);
}

for (const [name, made] of Object.entries(meshes)) {
  test(name, { skip }, () => {
    const file = path(folder, `${name}.obj`);
    writeFileSync(file, writeObj(made));
    const mesh = readObj(readFileSync(file, 'utf8'));
    for (const maxLevel of [0, 3]) compare(file, mesh, grid, maxLevel, maxLevel === 3);
  });
}

test('real meshes', { skip: skip || skipWithoutMeshes }, (t) => {
  const names = meshList()
    .filter((mesh) => Number(mesh.F) <= 10000)
    .map((mesh) => mesh.file)
    .filter((_, i) => i % 25 === 0);
  for (const [i, name] of names.entries()) {
    const file = path(meshFolder, name);
    const mesh = readObj(gunzipSync(readFileSync(file)).toString());
    compare(file, mesh, gridAbout(mesh), 3, i % 2 === 1);
  }
  t.diagnostic(`${names.length} meshes`);
  assert.ok(names.length > 3);
});
