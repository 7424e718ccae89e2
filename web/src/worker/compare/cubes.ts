import type { CutMesh } from 'mandoline-wasm';
import { gridPoints } from './grid_points';
import type { InsideAt, Surface } from './inside';
import { cubeCases, cubeEdges } from './marching_cubes';

/** Grid-edges that cross the surface, each as its low end and axis, 3 * vertex + axis; all grid vertices, and from one to the next by axis. */
interface Crossed {
  edges: readonly number[];
  points: Float64Array;
  steps: readonly number[];
}

/** Halvings of a grid-edge to find where it crosses the surface. */
const halvings = 20;

/**
 * Marching cubes from what is inside at the grid's vertices, at their best: with vertices where grid-edges cross the surface. Around the grid
 * there are cells without thickness, whose outer vertices are outside, so that the grid's sides close what is inside.
 */
export function marchingCubes(cutMesh: CutMesh, insideAt: InsideAt): Surface {
  const { planes, cells } = cutMesh.grid;
  const [nx, ny, nz] = cells;
  const points = gridPoints(planes.map((axis) => Float64Array.of(axis[0], ...axis, axis[axis.length - 1])));
  const steps = [1, nx + 3, (nx + 3) * (ny + 3)];
  const isOuter = (vertex: number) => cells.some((n, d) => (Math.floor(vertex / steps[d]) % (n + 3)) % (n + 2) === 0);
  const inside = insideAt(points).map((isIn, vertex) => (isIn && !isOuter(vertex) ? 1 : 0));
  const cornerSteps = [0, 1, 2, 3, 4, 5, 6, 7].map((b) => (b & 1) * steps[0] + ((b >> 1) & 1) * steps[1] + (b >> 2) * steps[2]);
  /** Vertices of the surface by the grid-edges on which they lie. */
  const ids = new Map<number, number>();
  const triangles: number[] = [];
  const crossingOf = (first: number, edge: number): number => {
    const key = 3 * (first + cornerSteps[cubeEdges[edge][0]]) + Math.floor(edge / 4);
    const id = ids.get(key) ?? ids.size;
    ids.set(key, id);
    return id;
  };
  for (let k = 0; k < nz + 2; k++) {
    for (let j = 0; j < ny + 2; j++) {
      for (let i = 0; i < nx + 2; i++) {
        const first = i * steps[0] + j * steps[1] + k * steps[2];
        let corners = 0;
        for (let b = 0; b < 8; b++) corners |= inside[first + cornerSteps[b]] << b;
        for (const polygon of cubeCases[corners]) {
          const loop = polygon.map((edge) => crossingOf(first, edge));
          for (let at = 1; at + 1 < loop.length; at++) triangles.push(loop[0], loop[at], loop[at + 1]);
        }
      }
    }
  }
  return { positions: crossings({ edges: [...ids.keys()], points, steps }, cutMesh, insideAt), triangles: Uint32Array.from(triangles) };
}

/** Where grid-edges from inside to outside cross the surface, or one of the places if there are several. */
function crossings({ edges, points, steps }: Crossed, cutMesh: CutMesh, insideAt: InsideAt): Float64Array {
  const known = cutVertices(cutMesh, steps);
  const vertexOn = (edge: number) => known.get(edge) ?? -1;
  const others = edges.filter((edge) => vertexOn(edge) < 0);
  const places = halved({ edges: others, points, steps }, insideAt);
  const ranks = new Map(others.map((edge, rank) => [edge, rank]));
  const placeOf = (edge: number) => {
    const rank = ranks.get(edge);
    const [from, at] = rank === undefined ? [cutMesh.positions, vertexOn(edge)] : [places, rank];
    return from.subarray(3 * at, 3 * at + 3);
  };
  return Float64Array.from(edges.flatMap((edge) => [...placeOf(edge)]));
}

/** Per grid-edge that the surface meets: the cut-vertex, or -1 if there are several. */
function cutVertices({ vertexMask, vertexCell }: CutMesh, steps: readonly number[]): Map<number, number> {
  const found = new Map<number, number>();
  vertexMask.forEach((mask, vertex) => {
    const axis = [6, 5, 3].indexOf(mask); // on planes of the two other axes
    if (axis < 0) return;
    const edge = 3 * steps.reduce((sum, step, d) => sum + step * (vertexCell[3 * vertex + d] + 1), 0) + axis;
    found.set(edge, found.has(edge) ? -1 : vertex);
  });
  return found;
}

/** The same by halving grid-edges. */
function halved({ edges, points, steps }: Crossed, insideAt: InsideAt): Float64Array {
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
