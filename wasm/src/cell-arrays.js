import { drawing } from './drawing.js';
import { cellShifts, chosenCells } from './selection.js';

/** Per face whether to take it. */
function facesToTake({ faceTriangle }, faces) {
  const [surface, grid] = [faces !== 'grid', faces !== 'surface'].map(Number);
  const taken = new Uint8Array(faceTriangle.length);
  for (let face = 0; face < taken.length; ++face) taken[face] = faceTriangle[face] >= 0 ? surface : grid;
  return taken;
}

function countTriangles({ cellHalfFaceOffsets, cellHalfFaces }, { faceTriangleOffsets }, cells, taken) {
  let count = 0;
  for (let i = 0; i < cells.length; ++i) {
    for (let h = cellHalfFaceOffsets[cells[i]]; h < cellHalfFaceOffsets[cells[i] + 1]; ++h) {
      const face = cellHalfFaces[h] >> 1;
      if (taken[face]) count += faceTriangleOffsets[face + 1] - faceTriangleOffsets[face];
    }
  }
  return count;
}

/** 3 per face, unit: of all its triangles together, so that slivers among them don't matter. */
function faceNormals({ positions, faceTriangle }, { faceTriangleOffsets, triangles }) {
  const normals = new Float32Array(3 * faceTriangle.length);
  for (let face = 0; face < faceTriangle.length; ++face) {
    let x = 0,
      y = 0,
      z = 0;
    for (let t = 3 * faceTriangleOffsets[face]; t < 3 * faceTriangleOffsets[face + 1]; t += 3) {
      const a = 3 * triangles[t],
        b = 3 * triangles[t + 1],
        c = 3 * triangles[t + 2];
      const ax = positions[a],
        ay = positions[a + 1],
        az = positions[a + 2];
      const ux = positions[b] - ax,
        uy = positions[b + 1] - ay,
        uz = positions[b + 2] - az;
      const vx = positions[c] - ax,
        vy = positions[c + 1] - ay,
        vz = positions[c + 2] - az;
      x += uy * vz - uz * vy;
      y += uz * vx - ux * vz;
      z += ux * vy - uy * vx;
    }
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    normals[3 * face] = x / length;
    normals[3 * face + 1] = y / length;
    normals[3 * face + 2] = z / length;
  }
  return normals;
}

/** Writes the triangles of the cells' half-faces one after another; those of side 1 run backwards. */
function fill({ position, normal, cell, face }, cutMesh, { faceTriangleOffsets, triangles }, { cells, taken, normals, shifts }) {
  const { positions, cellHalfFaceOffsets, cellHalfFaces } = cutMesh;
  let out = 0;
  for (let i = 0; i < cells.length; ++i) {
    const owner = cells[i];
    const sx = shifts[3 * owner],
      sy = shifts[3 * owner + 1],
      sz = shifts[3 * owner + 2];
    for (let h = cellHalfFaceOffsets[owner]; h < cellHalfFaceOffsets[owner + 1]; ++h) {
      const f = cellHalfFaces[h] >> 1,
        reversed = cellHalfFaces[h] & 1;
      if (!taken[f]) continue;
      const step = reversed ? -1 : 1;
      const nx = step * normals[3 * f],
        ny = step * normals[3 * f + 1],
        nz = step * normals[3 * f + 2];
      const begin = 3 * faceTriangleOffsets[f],
        end = 3 * faceTriangleOffsets[f + 1];
      for (let corner = reversed ? end - 1 : begin; corner >= begin && corner < end; corner += step, ++out) {
        const vertex = 3 * triangles[corner];
        position[3 * out] = positions[vertex] + sx;
        position[3 * out + 1] = positions[vertex + 1] + sy;
        position[3 * out + 2] = positions[vertex + 2] + sz;
        normal[3 * out] = nx;
        normal[3 * out + 1] = ny;
        normal[3 * out + 2] = nz;
        cell[out] = owner;
        face[out] = f;
      }
    }
  }
}

/** cellArrays with a shift of its own for every cut-cell (3 per cut-cell). */
export function shiftedCellArrays(cutMesh, faceTriangles, options, shifts) {
  const cells = chosenCells(cutMesh, options);
  const taken = facesToTake(cutMesh, options.faces);
  const count = 3 * countTriangles(cutMesh, faceTriangles, cells, taken);
  const result = {
    position: new Float32Array(3 * count),
    normal: new Float32Array(3 * count),
    cell: new Uint32Array(count),
    face: new Uint32Array(count),
  };
  fill(result, cutMesh, faceTriangles, { cells, taken, normals: faceNormals(cutMesh, faceTriangles), shifts });
  return result;
}

export const cellArrays = drawing('cellArrays', ['faceTriangles'], (cutMesh, faceTriangles, options) => {
  return shiftedCellArrays(cutMesh, faceTriangles, options, cellShifts(cutMesh, { origin: options.origin }));
});
