// Which item a step shows: the one asked for, or one on which much can be seen.
import type { CutMesh } from 'mandoline-wasm';
import type { Vector3 } from '../../model/vector';
import type { StepRequest } from '../../model/instead';

function isIndex(value: number | undefined, count: number): value is number {
  return value !== undefined && Number.isInteger(value) && value >= 0 && value < count;
}

function indexOfLargest(values: ArrayLike<number>): number {
  let best = 0;
  for (let k = 1; k < values.length; ++k) if (values[k] > values[best]) best = k;
  return best;
}

/** The triangle with most cut-faces. */
export function chosenTriangle({ faceTriangle, triangleCount }: CutMesh, { triangle }: StepRequest): number {
  if (isIndex(triangle, triangleCount)) return triangle;
  const faces = new Uint32Array(triangleCount);
  for (const t of faceTriangle) if (t >= 0) ++faces[t];
  return indexOfLargest(faces);
}

/** The axial plane with most holes in its faces, then most faces; of an axis, if only that is asked for. */
export function chosenPlane(cutMesh: CutMesh, { axis, plane }: StepRequest): { axis: 0 | 1 | 2; plane: number } {
  const { grid, faceAxis, facePlane, faceLoopOffsets } = cutMesh;
  if (isIndex(axis, 3) && isIndex(plane, grid.cells[axis] + 1)) return { axis, plane };
  const axes = isIndex(axis, 3) ? [axis] : ([0, 1, 2] as const);
  const scores = grid.cells.map((cells) => new Float64Array(cells + 1));
  for (let face = 0; face < faceAxis.length; ++face) {
    if (faceAxis[face] < 0) continue;
    const holes = faceLoopOffsets[face + 1] - faceLoopOffsets[face] - 1;
    scores[faceAxis[face]][facePlane[face]] += 1 + faceAxis.length * holes;
  }
  const best = axes.map((d) => ({ axis: d, plane: indexOfLargest(scores[d]) }));
  return best.reduce((a, b) => (scores[b.axis][b.plane] > scores[a.axis][a.plane] ? b : a));
}

/** The grid cell with most cut-cells, then most half-faces. */
export function chosenGridCell(cutMesh: CutMesh, { gridCell }: StepRequest): Vector3 {
  const { grid, cellGridCell, cellRegion, cellHalfFaceOffsets, cellHalfFaces } = cutMesh;
  if (gridCell?.length === 3 && gridCell.every((index, d) => isIndex(index, grid.cells[d]))) return gridCell;
  const scores = new Map<string, number>();
  let best: Vector3 = [0, 0, 0];
  let highest = 0;
  for (let cell = 0; cell < cellRegion.length; ++cell) {
    const at: Vector3 = [cellGridCell[3 * cell], cellGridCell[3 * cell + 1], cellGridCell[3 * cell + 2]];
    const halfFaces = cellHalfFaceOffsets[cell + 1] - cellHalfFaceOffsets[cell];
    const score = (scores.get(at.join()) ?? 0) + cellHalfFaces.length + halfFaces;
    scores.set(at.join(), score);
    if (score > highest) [highest, best] = [score, at];
  }
  return best;
}
