import type { CutMesh, FaceTriangles } from 'mandoline-wasm';
import type { Model } from '../model/types';
import { forEachCellEdge } from './edges';

type Buffers = Pick<Model, 'triangles' | 'edges'>;

/** Triangles and edges of all cut-cells. The faces of a cell share their vertices; pieces of triangles and of grid-faces have their own. */
export function cellBuffers(cutMesh: CutMesh, faceTriangles: FaceTriangles, origin: readonly number[]): Buffers {
  const { vertices, triangles, edges } = countBuffers(cutMesh, faceTriangles);
  const position = new Float32Array(3 * vertices);
  const cell = new Uint32Array(vertices);
  const surface = new Uint8Array(vertices);
  const triangleIndex = new Uint32Array(3 * triangles);
  const edgeIndex = new Uint32Array(2 * edges);
  const { positions } = cutMesh;
  const idOf = new Uint32Array(2 * (positions.length / 3));
  let [vertexEnd, triangleEnd, edgeEnd] = [0, 0, 0];
  walk(cutMesh, {
    vertex: (vertex, isSurface, owner) => {
      for (let d = 0; d < 3; d++) position[3 * vertexEnd + d] = positions[3 * vertex + d] - origin[d];
      cell[vertexEnd] = owner;
      surface[vertexEnd] = isSurface;
      idOf[2 * vertex + isSurface] = vertexEnd++;
    },
    edge: (from, to, isSurface) => {
      edgeIndex[edgeEnd++] = idOf[2 * from + isSurface];
      edgeIndex[edgeEnd++] = idOf[2 * to + isSurface];
    },
    halfFace: (face, side, isSurface) => {
      for (let t = faceTriangles.faceTriangleOffsets[face]; t < faceTriangles.faceTriangleOffsets[face + 1]; t++) {
        // Side 1 sees the face from behind.
        for (let k = 0; k < 3; k++) {
          const vertex = faceTriangles.triangles[3 * t + (side === 0 ? k : 2 - k)];
          triangleIndex[triangleEnd++] = idOf[2 * vertex + isSurface];
        }
      }
    },
  });
  return { triangles: { position, cell, surface, index: triangleIndex }, edges: { index: edgeIndex } };
}

function countBuffers(cutMesh: CutMesh, { faceTriangleOffsets }: FaceTriangles): { vertices: number; triangles: number; edges: number } {
  const { faceLoopOffsets, loopOffsets } = cutMesh;
  const counts = { vertices: 0, triangles: 0, edges: 0 };
  walk(cutMesh, {
    vertex: () => counts.vertices++,
    halfFace: (face) => {
      counts.triangles += faceTriangleOffsets[face + 1] - faceTriangleOffsets[face];
      // Every edge of a cell is met twice.
      counts.edges += (loopOffsets[faceLoopOffsets[face + 1]] - loopOffsets[faceLoopOffsets[face]]) / 2;
    },
  });
  return counts;
}

interface Visitor {
  /** A vertex that the faces of this kind have not had in this cell. */
  vertex(vertex: number, isSurface: 0 | 1, cell: number): void;
  /** After its vertices. */
  halfFace(face: number, side: number, isSurface: 0 | 1): void;
  /** After its vertices; of a kind of faces that has both ends. */
  edge?(from: number, to: number, isSurface: 0 | 1): void;
}

function walk(cutMesh: CutMesh, visitor: Visitor): void {
  const { cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices, faceTriangle } = cutMesh;
  const isPieceOfTriangle = (face: number) => (faceTriangle[face] >= 0 ? 1 : 0);
  const visitEdge = (from: number, to: number, face: number) => visitor.edge?.(from, to, isPieceOfTriangle(face));
  const lastCell = new Int32Array(2 * (cutMesh.positions.length / 3)).fill(-1);
  for (let cell = 0; cell + 1 < cellHalfFaceOffsets.length; cell++) {
    for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; h++) {
      const face = cellHalfFaces[h] >> 1;
      const side = cellHalfFaces[h] & 1;
      const isSurface = isPieceOfTriangle(face);
      for (let loop = faceLoopOffsets[face]; loop < faceLoopOffsets[face + 1]; loop++) {
        for (let at = loopOffsets[loop]; at < loopOffsets[loop + 1]; at++) {
          const vertex = loopVertices[at];
          if (lastCell[2 * vertex + isSurface] === cell) continue;
          lastCell[2 * vertex + isSurface] = cell;
          visitor.vertex(vertex, isSurface, cell);
        }
      }
      visitor.halfFace(face, side, isSurface);
    }
    if (visitor.edge) forEachCellEdge(cutMesh, cell, visitEdge);
  }
}
