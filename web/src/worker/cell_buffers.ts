import type { CutMesh, FaceTriangles } from 'mandoline-wasm';
import type { Model } from '../model/types';

type Buffers = Pick<Model, 'triangles' | 'edges'>;

/** Triangles and edges of all cut-cells. The faces of a cell share their vertices. */
export function cellBuffers(cutMesh: CutMesh, faceTriangles: FaceTriangles, origin: readonly number[]): Buffers {
  const counts = countBuffers(cutMesh, faceTriangles);
  const made = {
    // Every vertex of a cell is an end of two of its edges at least.
    position: new Float32Array(3 * counts.edges),
    cell: new Uint32Array(counts.edges),
    triangles: new Uint32Array(3 * (counts.surface + counts.grid)),
    edges: new Uint32Array(2 * counts.edges),
  };
  const vertices = fill(made, 3 * counts.surface, cutMesh, faceTriangles, origin);
  return {
    triangles: {
      position: made.position.slice(0, 3 * vertices),
      cell: made.cell.slice(0, vertices),
      index: made.triangles,
      surfaceEnd: 3 * counts.surface,
    },
    edges: { index: made.edges },
  };
}

function countBuffers(cutMesh: CutMesh, { faceTriangleOffsets }: FaceTriangles): { surface: number; grid: number; edges: number } {
  const { cellHalfFaces, faceLoopOffsets, loopOffsets, faceTriangle } = cutMesh;
  const counts = { surface: 0, grid: 0, edges: 0 };
  let corners = 0;
  for (let h = 0; h < cellHalfFaces.length; h++) {
    const face = cellHalfFaces[h] >> 1;
    const triangles = faceTriangleOffsets[face + 1] - faceTriangleOffsets[face];
    if (faceTriangle[face] >= 0) counts.surface += triangles;
    else counts.grid += triangles;
    corners += loopOffsets[faceLoopOffsets[face + 1]] - loopOffsets[faceLoopOffsets[face]];
  }
  counts.edges = corners / 2; // Every edge of a cell is met twice.
  return counts;
}

interface Arrays {
  position: Float32Array;
  cell: Uint32Array;
  triangles: Uint32Array;
  edges: Uint32Array;
}

/**
 * Returns the number of vertices. A vertex has an id in the current cell if its last id is not below the cell's first. The half-faces of a
 * cell traverse an edge equally often in both directions, so that one direction is enough to find it.
 */
function fill(made: Arrays, gridBegin: number, cutMesh: CutMesh, faceTriangles: FaceTriangles, [ox, oy, oz]: readonly number[]): number {
  const { position, cell, triangles, edges } = made;
  const { positions, cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices, faceTriangle } = cutMesh;
  const { faceTriangleOffsets, triangles: corners } = faceTriangles;
  const idOf = new Int32Array(positions.length / 3).fill(-1);
  let vertexEnd = 0;
  let edgeEnd = 0;
  let surfaceEnd = 0;
  let gridEnd = gridBegin;
  for (let owner = 0; owner + 1 < cellHalfFaceOffsets.length; owner++) {
    const first = vertexEnd;
    for (let h = cellHalfFaceOffsets[owner]; h < cellHalfFaceOffsets[owner + 1]; h++) {
      const face = cellHalfFaces[h] >> 1;
      const reversed = (cellHalfFaces[h] & 1) === 1;
      for (let loop = faceLoopOffsets[face]; loop < faceLoopOffsets[face + 1]; loop++) {
        const end = loopOffsets[loop + 1];
        for (let at = loopOffsets[loop]; at < end; at++) {
          const vertex = loopVertices[at];
          if (idOf[vertex] >= first) continue;
          position[3 * vertexEnd] = positions[3 * vertex] - ox;
          position[3 * vertexEnd + 1] = positions[3 * vertex + 1] - oy;
          position[3 * vertexEnd + 2] = positions[3 * vertex + 2] - oz;
          cell[vertexEnd] = owner;
          idOf[vertex] = vertexEnd++;
        }
        let from = loopVertices[end - 1];
        for (let at = loopOffsets[loop]; at < end; at++) {
          const to = loopVertices[at];
          if (from < to !== reversed) {
            edges[edgeEnd++] = idOf[from];
            edges[edgeEnd++] = idOf[to];
          }
          from = to;
        }
      }
      let out = faceTriangle[face] >= 0 ? surfaceEnd : gridEnd;
      const begin = 3 * faceTriangleOffsets[face];
      const end = 3 * faceTriangleOffsets[face + 1];
      // Side 1 sees the face from behind.
      if (reversed) for (let corner = end - 1; corner >= begin; corner--) triangles[out++] = idOf[corners[corner]];
      else for (let corner = begin; corner < end; corner++) triangles[out++] = idOf[corners[corner]];
      if (faceTriangle[face] >= 0) surfaceEnd = out;
      else gridEnd = out;
    }
  }
  return vertexEnd;
}
