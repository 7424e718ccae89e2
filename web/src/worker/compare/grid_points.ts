import type { Grid } from 'mandoline-wasm';

export function middles(planes: Float64Array): Float64Array {
  return Float64Array.from({ length: planes.length - 1 }, (_, c) => 0.5 * planes[c] + 0.5 * planes[c + 1]);
}

/** All points with these coordinates, x fastest. */
export function gridPoints([xs, ys, zs]: readonly Float64Array[]): Float64Array {
  const points = new Float64Array(3 * xs.length * ys.length * zs.length);
  let at = 0;
  for (const z of zs) {
    for (const y of ys) {
      for (const x of xs) {
        points[at++] = x;
        points[at++] = y;
        points[at++] = z;
      }
    }
  }
  return points;
}

/** Grid vertices that a surface uses. */
export class Welder {
  private readonly ids = new Map<number, number>();
  private readonly made: number[] = [];

  constructor(private readonly grid: Grid) {}

  vertex(i: number, j: number, k: number): number {
    const { planes } = this.grid;
    const key = i + planes[0].length * (j + planes[1].length * k);
    const known = this.ids.get(key);
    if (known !== undefined) return known;
    this.ids.set(key, this.ids.size);
    this.made.push(planes[0][i], planes[1][j], planes[2][k]);
    return this.ids.size - 1;
  }

  positions(): Float64Array {
    return Float64Array.from(this.made);
  }
}
