import type { Mesh } from 'mandoline-wasm';
import type { Vector3 } from './vector';

export interface Bounds {
  min: Vector3;
  max: Vector3;
}

/** Cubic cells around the mesh, `cells` along its longest side; or a box with its own counts. */
export type GridSettings = { cells: number } | { min: Vector3; max: Vector3; cells: Vector3 };

/** The box around all triangles; the origin if there is none. */
export function boundsOf({ positions, triangles }: Mesh): Bounds {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let corner = 0; corner < triangles.length; corner++) {
    for (let d = 0; d < 3; d++) {
      const x = positions[3 * triangles[corner] + d];
      if (x < min[d]) min[d] = x;
      if (x > max[d]) max[d] = x;
    }
  }
  return min[0] <= max[0] ? { min, max } : { min: [0, 0, 0], max: [0, 0, 0] };
}

/** The box and the counts of the package's grid of `cells` cubic cells along the longest side of the mesh, up to rounding. */
export function gridAround({ min, max }: Bounds, cells: number, margin = 0.05): { min: Vector3; max: Vector3; cells: Vector3 } {
  const longest = Math.max(...max.map((x, d) => x - min[d])) || 1;
  const size = ((1 + 2 * margin) * longest) / cells;
  const axes = [0, 1, 2].map((d) => {
    const count = Math.min(Math.max(Math.ceil(((max[d] - min[d] + 2 * margin * longest) / size) * (1 - 1e-12)), 1), cells);
    const middle = 0.5 * min[d] + 0.5 * max[d];
    return { min: middle - 0.5 * size * count, max: middle + 0.5 * size * count, count };
  });
  const each = (key: 'min' | 'max' | 'count'): Vector3 => [axes[0][key], axes[1][key], axes[2][key]];
  return { min: each('min'), max: each('max'), cells: each('count') };
}
