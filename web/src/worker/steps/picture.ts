import type { CutMesh, FaceTriangles, Grid } from 'mandoline-wasm';
import type { Bounds } from '../../model/grid_around';
import type { Vector3 } from '../../model/vector';
import type { MeshArrays } from '../../model/gallery/mesh';
import type { StepPicture, StepRequest } from '../../model/instead';
import type { Color } from './colors';

/** What every step works on. */
export interface Subject {
  mesh: MeshArrays;
  cutMesh: CutMesh;
  faceTriangles: FaceTriangles;
  origin: Vector3;
}

export function pointOf(positions: Float64Array, vertex: number): Vector3 {
  return [positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]];
}

class Colored {
  readonly #position: number[] = [];
  readonly #color: number[] = [];

  add(points: readonly Vector3[], color: Color): void {
    for (const point of points) {
      for (let d = 0; d < 3; ++d) {
        this.#position.push(point[d]);
        this.#color.push(color[d]);
      }
    }
  }

  arrays(): { position: Float32Array; color: Float32Array } {
    return { position: new Float32Array(this.#position), color: new Float32Array(this.#color) };
  }
}

/** Gathers what a step draws, in world units, and takes the origin off. */
export class Drawing {
  readonly #origin: Vector3;
  readonly #parts = { lines: new Colored(), faces: new Colored(), points: new Colored() };
  readonly #min = [Infinity, Infinity, Infinity];
  readonly #max = [-Infinity, -Infinity, -Infinity];

  constructor(origin: Vector3) {
    this.#origin = origin;
  }

  line(a: Vector3, b: Vector3, color: Color): void {
    this.#add('lines', [a, b], color);
  }

  triangle(a: Vector3, b: Vector3, c: Vector3, color: Color): void {
    this.#add('faces', [a, b, c], color);
  }

  point(p: Vector3, color: Color): void {
    this.#add('points', [p], color);
  }

  polygon(points: readonly Vector3[], color: Color): void {
    points.forEach((p, k) => this.line(p, points[(k + 1) % points.length], color));
  }

  /** The twelve edges of an axis-aligned box. */
  box(min: Vector3, max: Vector3, color: Color): void {
    const corner = (bits: number): Vector3 => [bits & 1 ? max[0] : min[0], bits & 2 ? max[1] : min[1], bits & 4 ? max[2] : min[2]];
    for (let bits = 0; bits < 8; ++bits) for (const bit of [1, 2, 4]) if (!(bits & bit)) this.line(corner(bits), corner(bits | bit), color);
  }

  /** `framed` are points of what is shown, unless that is the whole mesh. */
  finish(text: string, request: StepRequest, { cutMesh }: Subject, framed: readonly Vector3[] | null): StepPicture {
    const { cells } = cutMesh.grid;
    const [min, max] =
      this.#min[0] <= this.#max[0]
        ? [this.#min, this.#max]
        : [
            [0, 0, 0],
            [0, 0, 0],
          ];
    return {
      kind: request.kind,
      text,
      lines: this.#parts.lines.arrays(),
      faces: this.#parts.faces.arrays(),
      points: this.#parts.points.arrays(),
      center: [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2],
      radius: Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) / 2,
      frame: framed && frameOf(cutMesh.grid, framed, this.#origin),
      choices: { triangles: cutMesh.triangleCount, planes: [cells[0] + 1, cells[1] + 1, cells[2] + 1], request },
    };
  }

  #add(part: 'lines' | 'faces' | 'points', points: readonly Vector3[], color: Color): void {
    const moved = points.map((p): Vector3 => [p[0] - this.#origin[0], p[1] - this.#origin[1], p[2] - this.#origin[2]]);
    for (const p of moved) {
      for (let d = 0; d < 3; ++d) {
        this.#min[d] = Math.min(this.#min[d], p[d]);
        this.#max[d] = Math.max(this.#max[d], p[d]);
      }
    }
    this.#parts[part].add(moved, color);
  }
}

/** The box of the grid cells that hold some points. */
function frameOf({ planes }: Grid, points: readonly Vector3[], origin: Vector3): Bounds {
  const ends = planes.map((axis, d) => {
    const [low, high] = [Math.min(...points.map((p) => p[d])), Math.max(...points.map((p) => p[d]))];
    const last = axis.length - 1;
    const from = Math.max(
      0,
      Math.min(
        last - 1,
        axis.findLastIndex((plane) => plane <= low),
      ),
    );
    const to = axis.findIndex((plane) => plane >= high);
    return [axis[from] - origin[d], axis[Math.max(from + 1, to < 0 ? last : to)] - origin[d]];
  });
  return { min: [ends[0][0], ends[1][0], ends[2][0]], max: [ends[0][1], ends[1][1], ends[2][1]] };
}
