import type { Grid } from 'mandoline-wasm';
import type { InsideAt, Surface } from '.';
import { gridPoints } from './grid_points';
import { cubeCases, cubeEdges } from './marching_cubes';

/** Halvings of a grid-edge to find where it crosses the surface. */
const halvings = 20;

/** Marching cubes from what is inside at the grid's vertices, at their best: with vertices where grid-edges cross the surface. */
export function marchingCubes(grid: Grid, insideAt: InsideAt): Surface {
  const points = gridPoints(grid.planes);
  const inside = insideAt(points);
  const [nx, ny, nz] = grid.cells;
  const steps = [1, nx + 1, (nx + 1) * (ny + 1)];
  const cornerSteps = [0, 1, 2, 3, 4, 5, 6, 7].map((b) => (b & 1) * steps[0] + ((b >> 1) & 1) * steps[1] + (b >> 2) * steps[2]);
  /** Grid-edges that cross the surface, each as its low end and axis: 3 * vertex + axis. */
  const ids = new Map<number, number>();
  const triangles: number[] = [];
  for (let k = 0; k < nz; k++) {
    for (let j = 0; j < ny; j++) {
      for (let i = 0; i < nx; i++) {
        const first = i * steps[0] + j * steps[1] + k * steps[2];
        let corners = 0;
        for (let b = 0; b < 8; b++) corners |= inside[first + cornerSteps[b]] << b;
        for (const edge of cubeCases[corners]) {
          const key = 3 * (first + cornerSteps[cubeEdges[edge][0]]) + Math.floor(edge / 4);
          const id = ids.get(key) ?? ids.size;
          ids.set(key, id);
          triangles.push(id);
        }
      }
    }
  }
  return { positions: crossings([...ids.keys()], points, steps, insideAt), triangles: Uint32Array.from(triangles) };
}

/** Where grid-edges from inside to outside cross the surface, or one of the places if there are several. */
function crossings(edges: readonly number[], points: Float64Array, steps: readonly number[], insideAt: InsideAt): Float64Array {
  const ends = [0, 1].map((end) => {
    return Float64Array.from({ length: 3 * edges.length }, (_, at) => {
      const edge = edges[Math.floor(at / 3)];
      return points[3 * (Math.floor(edge / 3) + end * steps[edge % 3]) + (at % 3)];
    });
  });
  const isIn = insideAt(ends[0]);
  const middle = new Float64Array(3 * edges.length);
  for (let halving = 0; halving < halvings; halving++) {
    for (let at = 0; at < middle.length; at++) middle[at] = 0.5 * ends[0][at] + 0.5 * ends[1][at];
    insideAt(middle).forEach((side, edge) => {
      const nearer = side === isIn[edge] ? ends[0] : ends[1];
      for (let at = 3 * edge; at < 3 * edge + 3; at++) nearer[at] = middle[at];
    });
  }
  return middle;
}
