import type { Mesh, Vector3 } from 'mandoline-wasm';

export interface Bounds {
  min: Vector3;
  max: Vector3;
}

/** The box around all triangles. */
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
  return { min, max };
}
