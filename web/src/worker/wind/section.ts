// A plane through the cells of a tunnel: cut-cells and octree cells, with the speed in them.
import type { Slice } from 'mandoline-wasm';
import type { Vector3 } from '../../model/vector';
import type { Wind, WindRequest } from '../../model/wind';
import type { Velocities } from './flows';
import type { Package } from './package';
import { speedIn } from './speeds';
import type { Tunnel } from './tunnel';

type Section = Wind['sections'][number];
type Plane = WindRequest['planes'][number];

/** Adds points of a cell, triangles between points that were added, and edges between points of a cell. */
class SectionMaker {
  private readonly position: number[] = [];
  private readonly speed: number[] = [];
  private readonly index: number[] = [];
  private readonly edges: number[] = [];
  private readonly speedAt: ReturnType<typeof speedIn>;

  constructor(
    private readonly tunnel: Tunnel,
    flow: Velocities,
  ) {
    this.speedAt = speedIn(tunnel.cells, flow);
  }

  /** Returns the number of the first point. */
  addPoints(cell: number, points: readonly Vector3[]): number {
    const first = this.speed.length;
    const isOpen = this.tunnel.isOpen[this.tunnel.cells.cellRegion[cell]];
    for (const [x, y, z] of points) {
      this.speed.push(isOpen ? this.speedAt(cell, x, y, z) : -1);
      this.position.push(...this.moved([x, y, z]));
    }
    return first;
  }

  addTriangle(a: number, b: number, c: number): void {
    this.index.push(a, b, c);
  }

  addLoop(points: readonly Vector3[]): void {
    points.forEach((point, at) => this.edges.push(...this.moved(point), ...this.moved(points[(at + 1) % points.length])));
  }

  private moved(point: Vector3): Vector3 {
    return point.map((x, d) => x - this.tunnel.origin[d]);
  }

  make(plane: Plane): Section {
    return {
      plane,
      shape: { position: Float32Array.from(this.position), index: Uint32Array.from(this.index) },
      speed: Float32Array.from(this.speed),
      edges: Float32Array.from(this.edges),
    };
  }
}

export function section({ mandoline }: Package, tunnel: Tunnel, flow: Velocities, plane: Plane): Section {
  const maker = new SectionMaker(tunnel, flow);
  const [x, y, z] = plane.normal;
  addCutCells(maker, mandoline.slice(tunnel.cutMesh, { normal: [x, y, z], offset: plane.offset }, { untouched: false }));
  addOctreeCells(maker, tunnel, plane);
  return maker.make(plane);
}

function addCutCells(maker: SectionMaker, slice: Slice): void {
  const { polygonCell, polygonLoopOffsets, loopOffsets, loopPoints, polygonTriangleOffsets, triangles, positions } = slice;
  const pointAt = (point: number): Vector3 => [positions[3 * point], positions[3 * point + 1], positions[3 * point + 2]];
  for (let polygon = 0; polygon < polygonCell.length; polygon++) {
    const own = triangles.subarray(3 * polygonTriangleOffsets[polygon], 3 * polygonTriangleOffsets[polygon + 1]);
    const first = maker.addPoints(polygonCell[polygon], Array.from(own, pointAt));
    for (let at = 0; at < own.length; at += 3) maker.addTriangle(first + at, first + at + 1, first + at + 2);
    for (let loop = polygonLoopOffsets[polygon]; loop < polygonLoopOffsets[polygon + 1]; loop++) {
      maker.addLoop(Array.from(loopPoints.subarray(loopOffsets[loop], loopOffsets[loop + 1]), pointAt));
    }
  }
}

function addOctreeCells(maker: SectionMaker, { cells, cutMesh }: Tunnel, plane: Plane): void {
  const { planes, cells: counts } = cutMesh.grid;
  for (let cell = cells.cutCells; cell < cells.cellRegion.length; cell++) {
    const ends = [0, 1, 2].map((d) => {
      const low = cells.cellCorner[3 * cell + d];
      return [planes[d][low], planes[d][Math.min(low + 2 ** cells.cellLevel[cell], counts[d])]];
    });
    const polygon = boxPolygon(ends, plane);
    if (polygon.length < 3) continue;
    const first = maker.addPoints(cell, polygon);
    for (let at = 2; at < polygon.length; at++) maker.addTriangle(first, first + at - 1, first + at);
    maker.addLoop(polygon);
  }
}

/** The convex polygon in which a plane cuts a box, whose sides it enters where they are on it or beyond it. */
function boxPolygon(ends: readonly (readonly number[])[], { normal, offset }: Plane): Vector3[] {
  const corner = (bits: number): Vector3 => ends.map((end, d) => end[(bits >> d) & 1]);
  const heights = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => corner(bits).reduce((sum, x, d) => sum + x * normal[d], -offset));
  if (heights.every((height) => height >= 0) || heights.every((height) => height < 0)) return [];
  const points: Vector3[] = [];
  for (let from = 0; from < 8; from++) {
    for (const bit of [1, 2, 4]) {
      const to = from | bit;
      if (to === from || heights[from] >= 0 === heights[to] >= 0) continue;
      const share = heights[from] / (heights[from] - heights[to]);
      const [a, b] = [corner(from), corner(to)];
      points.push(a.map((x, d) => x + share * (b[d] - x)));
    }
  }
  return inOrder(points, normal);
}

/** Around their middle. */
function inOrder(points: Vector3[], normal: Vector3): Vector3[] {
  const middle = [0, 1, 2].map((d) => points.reduce((sum, point) => sum + point[d], 0) / points.length);
  const across = normal.map(Math.abs).indexOf(Math.max(...normal.map(Math.abs)));
  const [u, v] = [(across + 1) % 3, (across + 2) % 3];
  const angle = (point: Vector3) => Math.atan2(point[v] - middle[v], point[u] - middle[u]);
  return points.sort((a, b) => angle(a) - angle(b));
}
