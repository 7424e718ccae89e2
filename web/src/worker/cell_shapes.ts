import type { CutMesh, FaceTriangles } from 'mandoline-wasm';

export interface CellShapes {
  volume: Float64Array;
  /** 3 per cell, less the origin. */
  centroid: Float32Array;
}

/** A sum this much smaller than its terms together has lost the digits that a picture needs. */
const fewestDigits = 1e-9;

/**
 * Volumes and centroids of cut-cells for a picture, from the triangles that are drawn: a fraction of the work of the package's measures,
 * which are accurate however thin a cell is. Of the thinnest cells the centroid is the mean of the corners of their faces.
 */
export function cellShapes(cutMesh: CutMesh, faceTriangles: FaceTriangles, origin: readonly number[]): CellShapes {
  const { grid, cellHalfFaceOffsets, cellHalfFaces, cellRegion } = cutMesh;
  const moments = faceMoments(cutMesh, faceTriangles, origin);
  // Centroids that lie in one plane must not be told apart by their last digits.
  const step = 2 ** (Math.floor(Math.log2(Math.max(...grid.planes.map((axis) => axis[axis.length - 1] - axis[0])))) - 36);
  const rounded = (x: number) => step * Math.round(x / step);
  const volume = new Float64Array(cellRegion.length);
  const centroid = new Float32Array(3 * cellRegion.length);
  for (let cell = 0; cell < cellRegion.length; cell++) {
    let sum = 0,
      x = 0,
      y = 0,
      z = 0,
      magnitude = 0;
    for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; h++) {
      const sign = cellHalfFaces[h] & 1 ? -1 : 1;
      const at = 4 * (cellHalfFaces[h] >> 1);
      sum += sign * moments[at];
      magnitude += Math.abs(moments[at]);
      x += sign * moments[at + 1];
      y += sign * moments[at + 2];
      z += sign * moments[at + 3];
    }
    volume[cell] = Math.max(sum, 0) / 6;
    if (sum > fewestDigits * magnitude) {
      centroid[3 * cell] = rounded(x / (4 * sum));
      centroid[3 * cell + 1] = rounded(y / (4 * sum));
      centroid[3 * cell + 2] = rounded(z / (4 * sum));
    } else centroid.set(meanCorner(cutMesh, cell, origin), 3 * cell);
  }
  return { volume, centroid };
}

/** 4 per face: six times the volume of the pyramid over it from the origin, and 24 times the integral of each coordinate in that. */
function faceMoments({ positions, faceTriangle }: CutMesh, faceTriangles: FaceTriangles, [ox, oy, oz]: readonly number[]): Float64Array {
  const { faceTriangleOffsets, triangles } = faceTriangles;
  const moments = new Float64Array(4 * faceTriangle.length);
  for (let face = 0; face < faceTriangle.length; face++) {
    let sum = 0,
      x = 0,
      y = 0,
      z = 0;
    for (let t = 3 * faceTriangleOffsets[face]; t < 3 * faceTriangleOffsets[face + 1]; t += 3) {
      const a = 3 * triangles[t],
        b = 3 * triangles[t + 1],
        c = 3 * triangles[t + 2];
      const ax = positions[a] - ox,
        ay = positions[a + 1] - oy,
        az = positions[a + 2] - oz;
      const bx = positions[b] - ox,
        by = positions[b + 1] - oy,
        bz = positions[b + 2] - oz;
      const cx = positions[c] - ox,
        cy = positions[c + 1] - oy,
        cz = positions[c + 2] - oz;
      const product = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
      sum += product;
      x += product * (ax + bx + cx);
      y += product * (ay + by + cy);
      z += product * (az + bz + cz);
    }
    moments[4 * face] = sum;
    moments[4 * face + 1] = x;
    moments[4 * face + 2] = y;
    moments[4 * face + 3] = z;
  }
  return moments;
}

function meanCorner(cutMesh: CutMesh, cell: number, origin: readonly number[]): number[] {
  const { positions, cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices } = cutMesh;
  const sum = [0, 0, 0];
  let count = 0;
  for (const halfFace of cellHalfFaces.subarray(cellHalfFaceOffsets[cell], cellHalfFaceOffsets[cell + 1])) {
    const [begin, end] = [faceLoopOffsets[halfFace >> 1], faceLoopOffsets[(halfFace >> 1) + 1]];
    for (const vertex of loopVertices.subarray(loopOffsets[begin], loopOffsets[end])) {
      for (let d = 0; d < 3; d++) sum[d] += positions[3 * vertex + d] - origin[d];
      count++;
    }
  }
  return sum.map((x) => x / count);
}
