import type { CutMesh } from 'mandoline-wasm';

/**
 * Calls back with each edge of a cut-cell and the face that it was found at. The half-faces run through an edge equally often forth and
 * back, so one direction finds it.
 */
export function forEachCellEdge(cutMesh: CutMesh, cell: number, edge: (from: number, to: number, face: number) => void): void {
  const { cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices } = cutMesh;
  for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; h++) {
    const face = cellHalfFaces[h] >> 1;
    const reversed = (cellHalfFaces[h] & 1) === 1;
    for (let loop = faceLoopOffsets[face]; loop < faceLoopOffsets[face + 1]; loop++) {
      const end = loopOffsets[loop + 1];
      let from = loopVertices[end - 1];
      for (let at = loopOffsets[loop]; at < end; at++) {
        const to = loopVertices[at];
        if (from < to !== reversed) edge(from, to, face);
        from = to;
      }
    }
  }
}

/** Edges of a cut-cell, 2 points per edge, less the origin. */
export function cellEdges(cutMesh: CutMesh, cell: number, origin: readonly number[]): Float32Array {
  const points: number[] = [];
  const put = (vertex: number) => origin.forEach((x, d) => points.push(cutMesh.positions[3 * vertex + d] - x));
  forEachCellEdge(cutMesh, cell, (from, to) => {
    put(from);
    put(to);
  });
  return new Float32Array(points);
}
