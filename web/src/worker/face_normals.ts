import type { CutMesh } from 'mandoline-wasm';
import type { MeshArrays } from '../model/gallery';

/** A component of a unit vector, as a byte. */
const most = 127;
/** The bits of the highest byte. */
const top = 0xff << 24;
const alike = 24 << 24;

/**
 * Smooth normals of pieces of triangles: 4 bytes x, y, z and 1 in a number per entry of `loopVertices`, interpolated between the normals at
 * the corners of the triangle that the piece belongs to. Those of pieces of grid-faces are 0.
 */
export function faceNormals({ positions, triangles }: MeshArrays, corners: Float32Array, cutMesh: CutMesh): Int32Array {
  const { faceTriangle, faceLoopOffsets, loopOffsets, loopVertices, positions: places } = cutMesh;
  const normals = new Int32Array(loopVertices.length);
  for (let face = 0; face < faceTriangle.length; face++) {
    const corner = 3 * faceTriangle[face];
    if (corner < 0) continue;
    const a = 3 * triangles[corner];
    const b = 3 * triangles[corner + 1];
    const c = 3 * triangles[corner + 2];
    const across = flattest(positions, a, b, c);
    const u = (across + 1) % 3;
    const v = (across + 2) % 3;
    const ax = positions[a + u];
    const ay = positions[a + v];
    const bx = positions[b + u] - ax;
    const by = positions[b + v] - ay;
    const cx = positions[c + u] - ax;
    const cy = positions[c + v] - ay;
    const area = bx * cy - by * cx;
    const from = (3 * corner) | 0;
    const last = loopOffsets[faceLoopOffsets[face + 1]] | 0;
    for (let at = loopOffsets[faceLoopOffsets[face]] | 0; at < last; at++) {
      const vertex = (3 * loopVertices[at]) | 0;
      const px = places[vertex + u] - ax;
      const py = places[vertex + v] - ay;
      const ofB = Math.min(Math.max((px * cy - py * cx) / area, 0), 1);
      const ofC = Math.min(Math.max((bx * py - by * px) / area, 0), 1 - ofB);
      const ofA = 1 - ofB - ofC;
      const x = ofA * corners[from] + ofB * corners[from + 3] + ofC * corners[from + 6];
      const y = ofA * corners[from + 1] + ofB * corners[from + 4] + ofC * corners[from + 7];
      const z = ofA * corners[from + 2] + ofB * corners[from + 5] + ofC * corners[from + 8];
      const scale = most / (Math.sqrt(x * x + y * y + z * z) || 1);
      normals[at] = packed(Math.round(scale * x), Math.round(scale * y), Math.round(scale * z));
    }
  }
  return normals;
}

function packed(x: number, y: number, z: number): number {
  return (x & 255) | ((y & 255) << 8) | ((z & 255) << 16) | (1 << 24);
}

/** Whether two packed normals are nearly the same: the sum of their bytes' differences is small. */
export function areAlike(a: number, b: number): boolean {
  const x = (a << 24) - (b << 24);
  const y = ((a << 16) & top) - ((b << 16) & top);
  const z = ((a << 8) & top) - ((b << 8) & top);
  return Math.abs(x) + Math.abs(y) + Math.abs(z) < alike;
}

/** The axis along which a triangle is seen largest. */
function flattest(positions: Float64Array, a: number, b: number, c: number): number {
  const bx = positions[b] - positions[a];
  const by = positions[b + 1] - positions[a + 1];
  const bz = positions[b + 2] - positions[a + 2];
  const cx = positions[c] - positions[a];
  const cy = positions[c + 1] - positions[a + 1];
  const cz = positions[c + 2] - positions[a + 2];
  const x = Math.abs(by * cz - bz * cy);
  const y = Math.abs(bz * cx - bx * cz);
  const z = Math.abs(bx * cy - by * cx);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}
