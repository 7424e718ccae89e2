import type { Adjacency, CutMesh, Mandoline } from 'mandoline-wasm';
import { cellArrays, cellEdgeArrays, type CellEdgeArrays } from 'mandoline-wasm/three';
import { pageError } from '../model/failure';
import type { CellCard } from '../model/cut_model';
import { faceTrianglesOf, type Cut } from './kept';

export function cellCard(mandoline: Mandoline, cut: Cut, cell: number): CellCard {
  const { cutMesh, mesh, origin } = cut;
  checkCell(cutMesh, cell);
  cut.measures ??= mandoline.measure(mesh, cutMesh);
  cut.adjacency ??= mandoline.adjacency(cutMesh);
  const { measures, adjacency } = cut;
  const region = cutMesh.cellRegion[cell];
  const faces = facesOf(cutMesh, cell);
  const { position, normal, face } = cellArrays(cutMesh, faceTrianglesOf(mandoline, cut), { cells: [cell], origin });
  const edges = cellEdgeArrays(cutMesh, { cells: [cell], origin });
  return {
    cell,
    gridCell: [cutMesh.cellGridCell[3 * cell], cutMesh.cellGridCell[3 * cell + 1], cutMesh.cellGridCell[3 * cell + 2]],
    region,
    volume: measures.cellVolume[cell],
    centroid: [measures.cellCentroid[3 * cell], measures.cellCentroid[3 * cell + 1], measures.cellCentroid[3 * cell + 2]],
    faces: faces.length,
    surfaceFaces: faces.filter((own) => cutMesh.faceTriangle[own] >= 0).length,
    ...shellsOf(cutMesh, faces, edges),
    neighbours: Array.from(adjacency.cellCells.subarray(adjacency.cellCellOffsets[cell], adjacency.cellCellOffsets[cell + 1])),
    untouchedNeighbours: new Set(faces.flatMap((own) => untouchedBeside(adjacency, own))).size,
    triangles: { position, normal, surface: Uint8Array.from(face, (own) => (cutMesh.faceTriangle[own] >= 0 ? 1 : 0)) },
    edges: edges.position,
  };
}

function checkCell({ cellRegion }: CutMesh, cell: number): void {
  if (Number.isInteger(cell) && cell >= 0 && cell < cellRegion.length) return;
  throw pageError('There is no such cell', `The cut-mesh has ${cellRegion.length} cut-cells.`);
}

/** Faces of a cell; one that has the cell on both sides counts twice, as it is seen. */
function facesOf(cutMesh: CutMesh, cell: number): number[] {
  const halfFaces = cutMesh.cellHalfFaces.subarray(cutMesh.cellHalfFaceOffsets[cell], cutMesh.cellHalfFaceOffsets[cell + 1]);
  return Array.from(halfFaces, (halfFace) => halfFace >> 1);
}

function untouchedBeside({ faceGridCells }: Adjacency, face: number): number[] {
  return [faceGridCells[2 * face], faceGridCells[2 * face + 1]].filter((gridCell) => gridCell >= 0);
}

/** Counts a cell's vertices and its shells: parts of its boundary that no edges connect. */
function shellsOf(cutMesh: CutMesh, faces: readonly number[], edges: CellEdgeArrays): { vertices: number; cavities: number } {
  const leader = new Map<number, number>();
  const find = (vertex: number): number => {
    let at = vertex;
    for (let up = leader.get(at); up !== undefined && up !== at; up = leader.get(at)) at = up;
    leader.set(vertex, at);
    return at;
  };
  for (let i = 0; i < edges.vertex.length; i += 2) leader.set(find(edges.vertex[i]), find(edges.vertex[i + 1]));
  // The loops of a face with holes belong together, though no edge leads from one to the other.
  for (const face of faces) {
    const first = cutMesh.loopVertices[cutMesh.loopOffsets[cutMesh.faceLoopOffsets[face]]];
    for (let loop = cutMesh.faceLoopOffsets[face] + 1; loop < cutMesh.faceLoopOffsets[face + 1]; loop++) {
      leader.set(find(cutMesh.loopVertices[cutMesh.loopOffsets[loop]]), find(first));
    }
  }
  const vertices = [...leader.keys()];
  return { vertices: vertices.length, cavities: new Set(vertices.map(find)).size - 1 };
}
