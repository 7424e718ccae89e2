import { drawing } from './drawing.js';
import { cellShifts, chosenCells } from './selection.js';

function countCorners({ cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets }, cells) {
  let count = 0;
  for (const cell of cells) {
    for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; ++h) {
      const face = cellHalfFaces[h] >> 1;
      count += loopOffsets[faceLoopOffsets[face + 1]] - loopOffsets[faceLoopOffsets[face]];
    }
  }
  return count;
}

/**
 * Writes the ends of a cell's edges from index `out` on and returns where they end. The half-faces of a cell run through an edge equally
 * often in both directions, so that one direction finds all edges; those that more than two half-faces meet in are found again.
 */
function fillCell(vertex, out, cutMesh, cell) {
  const { positions, cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices } = cutMesh;
  const seen = new Set();
  for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; ++h) {
    const face = cellHalfFaces[h] >> 1,
      reversed = (cellHalfFaces[h] & 1) === 1;
    for (let loop = faceLoopOffsets[face]; loop < faceLoopOffsets[face + 1]; ++loop) {
      const begin = loopOffsets[loop],
        end = loopOffsets[loop + 1];
      let from = loopVertices[end - 1];
      for (let at = begin; at < end; ++at) {
        const to = loopVertices[at];
        const key = Math.min(from, to) * (positions.length / 3) + Math.max(from, to);
        if (from < to !== reversed && !seen.has(key)) {
          seen.add(key);
          vertex[out++] = from;
          vertex[out++] = to;
        }
        from = to;
      }
    }
  }
  return out;
}

/** cellEdgeArrays with a shift of its own for every cut-cell (3 per cut-cell). */
export function shiftedCellEdges(cutMesh, options, shifts) {
  const cells = chosenCells(cutMesh, options);
  const count = countCorners(cutMesh, cells); // at least as many as ends of edges
  const vertex = new Uint32Array(count),
    cell = new Uint32Array(count);
  let end = 0;
  for (const owner of cells) {
    const begin = end;
    end = fillCell(vertex, begin, cutMesh, owner);
    cell.fill(owner, begin, end);
  }
  const position = new Float32Array(3 * end);
  for (let i = 0; i < end; ++i) {
    for (let d = 0; d < 3; ++d) position[3 * i + d] = cutMesh.positions[3 * vertex[i] + d] + shifts[3 * cell[i] + d];
  }
  return { position, cell: cell.slice(0, end), vertex: vertex.slice(0, end) };
}

export const cellEdgeArrays = drawing('cellEdgeArrays', [], (cutMesh, options) => {
  return shiftedCellEdges(cutMesh, options, cellShifts(cutMesh, { origin: options.origin }));
});
