import type { CutMesh } from 'mandoline-wasm';
import { gridPoints, middles, Welder } from './grid_points';
import type { InsideAt, Surface } from './inside';

/** The sides between grid cells whose middle is inside and others, and how many those are. */
export function voxels({ grid }: CutMesh, insideAt: InsideAt): Surface & { untouched: number } {
  const [nx, ny, nz] = grid.cells;
  const inside = insideAt(gridPoints(grid.planes.map(middles)));
  const isIn = (i: number, j: number, k: number) =>
    i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz && inside[i + nx * (j + ny * k)] === 1;
  const welder = new Welder(grid);
  const triangles: number[] = [];
  for (let k = 0; k < nz; k++) {
    for (let j = 0; j < ny; j++) {
      for (let i = 0; i < nx; i++) {
        if (!isIn(i, j, k)) continue;
        for (let axis = 0; axis < 3; axis++) {
          for (const side of [0, 1]) {
            const beside = [i, j, k].map((c, d) => (d === axis ? c + 2 * side - 1 : c));
            if (isIn(beside[0], beside[1], beside[2])) continue;
            const [a, b, c, d] = corners(axis, side).map(([x, y, z]) => welder.vertex(i + x, j + y, k + z));
            triangles.push(a, b, c, a, c, d);
          }
        }
      }
    }
  }
  const untouched = inside.reduce((sum, x) => sum + x, 0);
  return { positions: welder.positions(), triangles: Uint32Array.from(triangles), untouched };
}

/** Of a side of a unit cube, counter-clockwise seen from outside. */
function corners(axis: number, side: number): [number, number, number][] {
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  const around = [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ];
  if (side === 0) around.reverse();
  return around.map(([a, b]) => {
    const corner: [number, number, number] = [0, 0, 0];
    corner[axis] = side;
    corner[u] = a;
    corner[v] = b;
    return corner;
  });
}
