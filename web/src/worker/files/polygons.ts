import type { MeshArrays } from '../../model/gallery/mesh';
import { Flaw } from './flaw';

/** Gathers points and polygons, which become fans of triangles about their first corner. */
export class Polygons {
  readonly #positions: number[] = [];
  readonly #triangles: number[] = [];

  get pointCount(): number {
    return this.#positions.length / 3;
  }

  addPoint(x: number, y: number, z: number): void {
    this.#positions.push(x, y, z);
  }

  /** `where` starts the message if a corner is no point, or if there are too few. */
  addPolygon(corners: readonly number[], where: () => string): void {
    if (corners.length < 3) throw new Flaw(`${where()}: a face needs three corners, and this one has ${corners.length}.`);
    for (const corner of corners) {
      if (Number.isInteger(corner) && corner >= 0 && corner < this.pointCount) continue;
      throw new Flaw(`${where()}: a face names point ${corner}, but there are ${this.pointCount} points, numbered from 0.`);
    }
    for (let k = 2; k < corners.length; ++k) this.#triangles.push(corners[0], corners[k - 1], corners[k]);
  }

  mesh(): MeshArrays {
    return { positions: new Float64Array(this.#positions), triangles: new Uint32Array(this.#triangles) };
  }
}
