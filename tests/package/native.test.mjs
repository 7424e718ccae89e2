// The native program and the WebAssembly module give the same bits: every array of the dump, on made meshes and on real ones.
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
import { box, join, readObj, torus, waves, writeObj } from './meshes.mjs';

const root = path(dirname(fileURLToPath(import.meta.url)), '..', '..');
const program = process.env.MANDOLINE_CLI ?? path(root, 'build', 'mandoline');
const mostTriangles = 20000; // so that the test takes a minute or two
const skip = existsSync(program) ? false : `there is no native program ${program}`;

const { cut, write } = await init();
const folder = mkdtempSync(path(tmpdir(), 'mandoline-'));
after(() => rmSync(folder, { recursive: true }));

/** The dump that the program writes, or what it says if it refuses the mesh. */
async function nativeDump(file, cells) {
  const output = path(folder, 'dump.json');
  try {
    await promisify(execFile)(program, ['cut', file, '--cells', String(cells), '--threads', '1', '-o', output]);
  } catch (error) {
    assert.equal(error.code, 1, error.message);
    return { refusal: error.stderr };
  }
  return JSON.parse(readFileSync(output, 'utf8'));
}

const same = (a, b) => Object.is(a, b) || (Array.isArray(a) && a.length === b.length && a.every((x, i) => same(x, b[i])));

/** Whether every array of the dump has the same doubles and integers (down to the sign of a zero) as the cut-mesh. */
function assertSame(dump, cutMesh, what) {
  const { grid, format, version, triangleCount, regionWinding, ...arrays } = dump;
  assert.deepEqual([format, version, triangleCount], ['mandoline-cut-mesh', 1, cutMesh.triangleCount]);
  assert.ok(same(grid.planes, cutMesh.grid.planes.map((planes) => [...planes])), `${what}: grid`);
  assert.ok(same([grid.origin, grid.spacing, grid.cells], [cutMesh.grid.origin, cutMesh.grid.spacing, cutMesh.grid.cells]), `${what}: grid`);
  assert.ok(same(regionWinding, cutMesh.regionWinding ? [...cutMesh.regionWinding] : Array(cutMesh.regionCount).fill(null)), `${what}: regionWinding`);
  const typedArrays = Object.keys(cutMesh).filter((key) => ArrayBuffer.isView(cutMesh[key]) && key !== 'regionWinding');
  assert.deepEqual(Object.keys(arrays).sort(), typedArrays.sort(), `${what}: which arrays`);
  for (const [key, values] of Object.entries(arrays)) {
    assert.equal(values.length, cutMesh[key].length, `${what}: ${key}`);
    const wrong = values.findIndex((value, i) => !Object.is(value, cutMesh[key][i]));
    assert.equal(wrong, -1, `${what}: ${key}[${wrong}]`);
  }
}

/** Whether it could be cut. */
async function compare(file, mesh, cells) {
  const what = `${file} at N = ${cells}`;
  const dump = await nativeDump(file, cells);
  let cutMesh;
  try {
    cutMesh = cut(mesh, { cells });
  } catch (error) {
    assert.equal(error.code, 'selfIntersection', what);
    assert.ok(dump.refusal?.includes(error.message), `${what}: ${error.message} / ${dump.refusal}`);
    return false;
  }
  assert.equal(dump.refusal, undefined, what);
  assertSame(dump, cutMesh, what);
  return true;
}

test('made meshes', { skip }, async () => {
  const meshes = {
    box: box([0, 0, 0], [1, 2, 3]),
    torus: torus(70, 35),
    waves: waves(40),
    nested: join(torus(40, 20, 1, 0.4), torus(40, 20, 1, 0.3)),
  };
  for (const [name, made] of Object.entries(meshes)) {
    const file = path(folder, `${name}.obj`);
    writeFileSync(file, writeObj(made));
    const mesh = readObj(readFileSync(file, 'utf8'));
    for (const cells of [1, 13, 32]) assert.ok(await compare(file, mesh, cells));
    const cutMesh = cut(mesh, { cells: 13 });
    assertSame(JSON.parse(new TextDecoder().decode(write(mesh, cutMesh, 'json'))), cutMesh, `${name}.json`);
  }
});

test('real meshes', { skip: skip || skipWithoutMeshes }, async (t) => {
  let cuts = 0;
  let refusals = 0;
  const meshes = meshList().filter((mesh) => Number(mesh.F) <= mostTriangles).map((mesh) => mesh.file);
  for (const name of meshes) {
    const file = path(meshFolder, name);
    const mesh = readObj(gunzipSync(readFileSync(file)).toString());
    for (const cells of [13, 32]) (await compare(file, mesh, cells)) ? ++cuts : ++refusals;
  }
  t.diagnostic(`${meshes.length} meshes: ${cuts} cuts equal, ${refusals} refused alike`);
  assert.ok(cuts > meshes.length);
});
