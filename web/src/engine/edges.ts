import type { CutMesh } from 'mandoline-wasm';

/** Calls back with each edge of a cut-cell. Its half-faces run through an edge equally often forth and back, so one direction finds it. */
export function forEachCellEdge(cutMesh: CutMesh, cell: number, edge: (from: number, to: number) => void): void {
  const { cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices } = cutMesh;
  for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; h++) {
    const face = cellHalfFaces[h] >> 1;
    const reversed = (cellHalfFaces[h] & 1) === 1;
    for (let loop = faceLoopOffsets[face]; loop < faceLoopOffsets[face + 1]; loop++) {
      const end = loopOffsets[loop + 1];
      let from = loopVertices[end - 1];
      for (let at = loopOffsets[loop]; at < end; at++) {
        const to = loopVertices[at];
        if (from < to !== reversed) edge(from, to);
        from = to;
      }
    }
  }
}

/** Edges of cut-cells, 2 points per edge, less the origin; an edge once for each of its cells. */
export function cellEdges(cutMesh: CutMesh, cells: ArrayLike<number> | null, origin: readonly number[]): { position: Float32Array; cell: Uint32Array } {
  const cellCount = cells?.length ?? cutMesh.cellRegion.length;
  const cellAt = (index: number) => (cells ? cells[index] : index);
  let count = 0;
  for (let index = 0; index < cellCount; index++) forEachCellEdge(cutMesh, cellAt(index), () => count++);
  const position = new Float32Array(6 * count);
  const cell = new Uint32Array(2 * count);
  const { positions } = cutMesh;
  let point = 0;
  const put = (vertex: number, owner: number) => {
    for (let d = 0; d < 3; d++) position[3 * point + d] = positions[3 * vertex + d] - origin[d];
    cell[point++] = owner;
  };
  for (let index = 0; index < cellCount; index++) {
    const owner = cellAt(index);
    forEachCellEdge(cutMesh, owner, (from, to) => {
      put(from, owner);
      put(to, owner);
    });
  }
  return { position, cell };
}
