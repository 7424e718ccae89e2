// The native program, on one thread or many, and the WebAssembly module give the same bits: every array of the dump, the grid, and what is
// counted on the way; resolved meshes and boundaries; estimates of open meshes; on made meshes and on real ones.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join as path } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { gunzipSync } from 'node:zlib';
import { init } from 'mandoline-wasm';
import { meshFolder, meshList, skipWithoutMeshes } from '../mesh_folder.mjs';
import { box, join, readObj, sheet, torus, waves, writeObj } from './meshes.mjs';

const root = path(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.MANDOLINE_CLI ?? path(root, 'build', 'mandoline');
const mostTriangles = 20000; // so that the test takes a minute or two
const skip = existsSync(program) ? false : `there is no native program ${program}`;

const { boundary, cut, estimateInside, resolve, write } = await init();
const folder = mkdtempSync(path(tmpdir(), 'mandoline-'));
after(() => rmSync(folder, { recursive: true }));

/** The dump and the report that the program writes, or what it says if it refuses the mesh. */
async function nativeCut(file, cells, options = []) {
  const dumps = [];
  const report = path(folder, 'report.json');
  for (const threads of ['1', '3']) {
    dumps.push(path(folder, `dump-${threads}.json`));
    const args = ['cut', file, '--cells', String(cells), '--threads', threads, ...options, '-o', dumps.at(-1), '--report', report];
    try {
      await promisify(execFile)(program, args);
    } catch (error) {
      assert.equal(error.code, 1, error.message);
      return { refusal: error.stderr };
    }
  }
  const [dump, onThreads] = dumps.map((name) => readFileSync(name));
  assert.ok(dump.equals(onThreads), `${file} at N = ${cells}: one thread and three`);
  return { dump: JSON.parse(dump), report: JSON.parse(readFileSync(report)) };
}

const same = (a, b) => Object.is(a, b) || (Array.isArray(a) && a.length === b.length && a.every((x, i) => same(x, b[i])));

/** Whether every array of the dump has the same doubles and integers (down to the sign of a zero) as the cut-mesh. */
function assertSame(dump, cutMesh, what) {
  const optional = ['regionWinding', 'regionPartWinding', 'regionParity', 'regionInsideness'];
  const { grid, format, version, triangleCount, snapTolerance, madeFrom, fingerprint, ...arrays } = dump;
  assert.deepEqual([snapTolerance, madeFrom, fingerprint], [cutMesh.snapTolerance, cutMesh.madeFrom, cutMesh.fingerprint]);
  assert.deepEqual([format, version, triangleCount], ['mandoline-cut-mesh', 2, cutMesh.triangleCount]);
  assert.ok(
    same(
      grid.planes,
      cutMesh.grid.planes.map((planes) => [...planes]),
    ),
    `${what}: grid`,
  );
  for (const name of ['origin', 'spacing', 'cells']) assert.ok(same(grid[name], cutMesh.grid[name]), `${what}: grid.${name}`);
  for (const name of optional) {
    const numbers = cutMesh[name] ? [...cutMesh[name]] : Array(cutMesh.regionCount).fill(null);
    assert.ok(same(arrays[name], numbers), `${what}: ${name}`);
    delete arrays[name];
  }
  const typedArrays = Object.keys(cutMesh).filter((key) => ArrayBuffer.isView(cutMesh[key]) && !optional.includes(key));
  assert.deepEqual(Object.keys(arrays).sort(), typedArrays.sort(), `${what}: which arrays`);
  for (const [key, values] of Object.entries(arrays)) {
    assert.equal(values.length, cutMesh[key].length, `${what}: ${key}`);
    const wrong = values.findIndex((value, i) => !Object.is(value, cutMesh[key][i]));
    assert.equal(wrong, -1, `${what}: ${key}[${wrong}]`);
  }
}

/**
 * Whether the report counts the same as the statistics of the cut-mesh. Not exactFallbacks: to sort, C++ libraries don't compare the same.
 */
function assertSameCounts(report, { stats, ...cutMesh }, what) {
  const { cutCells, vertices, faces, loops, regions, droppedTriangles, untouchedCells, cells, ...counted } = report.counts;
  for (const [name, count] of Object.entries(counted)) assert.equal(count, stats[name], `${what}: ${name}`);
  assert.equal(report.largestSnap, stats.largestSnap, `${what}: largestSnap`);
  const { pairs, curves, madeVertices, ms, ...kinds } = report.intersections;
  assert.deepEqual(kinds, stats.intersections, `${what}: intersections`);
  assert.deepEqual([curves, madeVertices], [stats.intersectionCurves, stats.madeVertices], what);
  assert.equal(madeVertices, cutMesh.madeVertices.length, what);
  assert.deepEqual(
    [cutCells, vertices, faces, loops, regions, droppedTriangles],
    [
      cutMesh.cellRegion.length,
      cutMesh.vertexMask.length,
      cutMesh.faceTriangle.length,
      cutMesh.loopOffsets.length - 1,
      cutMesh.regionCount,
      cutMesh.droppedTriangles.length,
    ],
    what,
  );
  assert.equal(untouchedCells, cutMesh.gridCellRegion.filter((region) => region >= 0).length, what);
  assert.equal(cells, cutCells + untouchedCells, what);
}

/** Whether it could be cut. */
async function compare(file, mesh, cells) {
  const what = `${file} at N = ${cells}`;
  const { dump, report, refusal } = await nativeCut(file, cells);
  let cutMesh;
  try {
    cutMesh = cut(mesh, { cells });
  } catch (error) {
    assert.equal(error.code, 'selfIntersection', what);
    assert.ok(refusal?.includes(error.message), `${what}: ${error.message} / ${refusal}`);
    return false;
  }
  assert.equal(refusal, undefined, what);
  assertSame(dump, cutMesh, what);
  assertSameCounts(report, cutMesh, what);
  return true;
}

const pairsInWords = (counts) =>
  Object.entries(counts)
    .filter(([, n]) => n > 0)
    .map(([kind, n]) => `${n} ${kind}`)
    .join(', ') || '0';

/** Whether the program resolves a mesh to the same triangles, and finds the same boundary by each rule. */
async function compareResolved(file, mesh) {
  const resolved = resolve(mesh);
  const results = [[[], resolved]];
  for (const [word, rule] of [
    ['positive', 'positive'],
    ['non-zero', 'nonZero'],
    ['odd', 'odd'],
  ]) {
    if (resolved.frontWinding || resolved.frontParity) results.push([['--rule', word], boundary(resolved, rule)]);
  }
  for (const [options, { positions, triangles }] of results) {
    const what = `${file} resolved ${options.join(' ')}`;
    const written = path(folder, 'resolved.obj');
    const { stderr } = await promisify(execFile)(program, ['resolve', file, ...options, '-o', written]);
    const native = readObj(readFileSync(written, 'utf8'));
    assert.ok(same([...native.positions], [...positions]), `${what}: positions`);
    assert.ok(same([...native.triangles], [...triangles]), `${what}: triangles`);
    assert.ok(stderr.includes(`that met: ${pairsInWords(resolved.stats.intersections)}\n`), `${what}: ${stderr}`);
    assert.ok(stderr.includes(`rounding of vertices: ${pairsInWords(resolved.remaining)}\n`), `${what}: ${stderr}`);
  }
}

/** Whether the program estimates the same insideness, and divides regions alike. */
async function compareEstimated(file, mesh, cells) {
  const cutMesh = cut(mesh, { cells });
  if (cutMesh.openTriangles.length === 0) return false;
  for (const threshold of [0.5, 0.25]) {
    const { dump } = await nativeCut(file, cells, ['--inside-threshold', String(threshold)]);
    const { gridCellRegion, ...arrays } = dump;
    assertSame(arrays, estimateInside(mesh, cutMesh, { threshold }), `${file} at N = ${cells}, estimated`);
  }
  return true;
}

/** With a triangle once more, and one without area. */
function withDropped({ positions, triangles }) {
  return { positions, triangles: Uint32Array.of(...triangles, ...triangles.slice(0, 3), triangles[0], triangles[1], triangles[0]) };
}

test('made meshes', { skip }, async () => {
  const meshes = {
    box: box([0, 0, 0], [1, 2, 3]),
    torus: torus(70, 35),
    waves: waves(40),
    nested: join(torus(40, 20, 1, 0.4), torus(40, 20, 1, 0.3)),
    bubble: join(box([-2, -2, -1], [1, 2, 1]), torus(12, 6, 0.02, 0.01)),
    'dropped triangles': withDropped(torus(40, 20)),
    'crossing boxes': join(box([1, 1, 1], [3, 3, 3]), box([2, 2, 2], [4, 4, 4])),
    'crossing tori': join(torus(40, 20), torus(40, 20, 1.1, 0.3)),
    'overlapping sheets': join(sheet([0, 0], [2, 2], 0.5), sheet([1, 1], [3, 3], 0.5)),
    twice: join(torus(12, 6), torus(12, 6)),
  };
  for (const [name, made] of Object.entries(meshes)) {
    const file = path(folder, `${name}.obj`);
    writeFileSync(file, writeObj(made));
    const mesh = readObj(readFileSync(file, 'utf8'));
    for (const cells of [1, 13, 32]) assert.ok(await compare(file, mesh, cells));
    await compareResolved(file, mesh);
    assert.equal(await compareEstimated(file, mesh, 13), ['waves', 'dropped triangles', 'overlapping sheets'].includes(name), name);
    const cutMesh = cut(mesh, { cells: 13 });
    assertSame(JSON.parse(new TextDecoder().decode(await write(mesh, cutMesh, 'json'))), cutMesh, `${name}.json`);
    for (const format of ['json', 'mcm', 'vtu', 'obj', 'stl', 'ply']) {
      const written = path(folder, `cut.${format}`);
      await promisify(execFile)(program, ['cut', file, '--cells', '13', '-o', written]);
      assert.ok(readFileSync(written).equals(await write(mesh, cutMesh, format)), `${name}.${format}`);
    }
  }
});

test('real meshes', { skip: skip || skipWithoutMeshes }, async (t) => {
  let cuts = 0;
  let refusals = 0;
  let estimates = 0;
  const meshes = meshList()
    .filter((mesh) => Number(mesh.F) <= mostTriangles)
    .map((mesh) => mesh.file);
  for (const name of meshes) {
    const file = path(meshFolder, name);
    const mesh = readObj(gunzipSync(readFileSync(file)).toString());
    for (const cells of [13, 32]) (await compare(file, mesh, cells)) ? ++cuts : ++refusals;
    await compareResolved(file, mesh);
    if (await compareEstimated(file, mesh, 13)) ++estimates;
  }
  t.diagnostic(`${meshes.length} meshes: ${cuts} cuts equal, ${refusals} refused alike; ${estimates} open meshes estimated alike`);
  assert.ok(cuts > meshes.length);
});
