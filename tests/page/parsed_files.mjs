// Mesh files as the worker reads them, and a mesh to write into them.
import assert from 'node:assert/strict';
import { init } from 'mandoline-wasm';
import { importBundled } from './bundled.mjs';

const { readMesh } = await importBundled('worker/load.ts');
const mandoline = await init();

function toBytes(content) {
  const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : new Uint8Array(content);
  return bytes.slice().buffer;
}

export const parse = (name, content) => readMesh(mandoline, toBytes(content), name);

/** Corners of all triangles as numbers. */
export function corners({ positions, triangles }) {
  return Array.from(triangles, (v) => Array.from(positions.subarray(3 * v, 3 * v + 3)));
}

/** Rejects with an error that the page can show: the file in its title, what and where in its detail. */
export async function refuses(name, content, detail) {
  await assert.rejects(parse(name, content), (error) => {
    assert.equal(error.title, `${name} can't be read`);
    assert.match(error.detail, detail);
    return true;
  });
}

// A tetrahedron whose coordinates single precision holds.
export const points = [
  [0, 0, 0],
  [1.5, 0, 0],
  [0, 2.25, 0],
  [0, 0, -3.125],
];
export const faces = [
  [0, 1, 2],
  [0, 3, 1],
  [1, 3, 2],
  [2, 3, 0],
];
export const expectedCorners = faces.flat().map((v) => points[v]);
