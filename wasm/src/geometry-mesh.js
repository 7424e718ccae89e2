import { bad, kindOf } from './arguments.js';
import { named } from './errors.js';

function readPositions(attribute) {
  const positions = new Float64Array(3 * attribute.count);
  for (let i = 0; i < attribute.count; ++i) {
    positions[3 * i] = attribute.getX(i);
    positions[3 * i + 1] = attribute.getY(i);
    positions[3 * i + 2] = attribute.getZ(i);
  }
  return positions;
}

/** As three applies a matrix (elements by columns), with the division by w. */
function move(positions, m) {
  for (let i = 0; i < positions.length; i += 3) {
    const x = positions[i],
      y = positions[i + 1],
      z = positions[i + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    for (let d = 0; d < 3; ++d) positions[i + d] = (m[d] * x + m[d + 4] * y + m[d + 8] * z + m[d + 12]) / w;
  }
}

function readTriangles(index, count) {
  const triangles = new Uint32Array(index ? index.count : count);
  for (let i = 0; i < triangles.length; ++i) triangles[i] = index ? index.getX(i) : i;
  return triangles;
}

function turn(triangles) {
  for (let i = 0; i + 2 < triangles.length; i += 3) [triangles[i + 1], triangles[i + 2]] = [triangles[i + 2], triangles[i + 1]];
}

/** Moved by a matrix. One that mirrors also turns the triangles, as three draws them: outward stays outward. */
export function moved({ positions, triangles }, matrix) {
  const mesh = { positions: positions.slice(), triangles: triangles.slice() };
  move(mesh.positions, matrix.elements);
  if (matrix.determinant() < 0) turn(mesh.triangles);
  return mesh;
}

export const meshFromGeometry = named('meshFromGeometry', (geometry, matrix) => {
  if (geometry?.attributes === undefined) throw bad(`geometry must be a BufferGeometry, not ${kindOf(geometry)}.`);
  const { position } = geometry.attributes;
  if (typeof position?.getX !== 'function') throw bad('The geometry has no positions.');
  const isMatrix = matrix === undefined || matrix === null || (matrix.elements?.length === 16 && typeof matrix.determinant === 'function');
  if (!isMatrix) throw bad(`matrix must be a Matrix4, not ${kindOf(matrix)}.`);
  const mesh = { positions: readPositions(position), triangles: readTriangles(geometry.index, position.count) };
  return matrix ? moved(mesh, matrix) : mesh;
});
