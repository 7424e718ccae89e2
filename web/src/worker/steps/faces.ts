// Ways through the faces of a cut-mesh.
import type { Vector3 } from '../../model/vector';
import { pointOf, type Subject } from './picture';

export function facesWhere({ cutMesh }: Subject, holds: (face: number) => boolean): number[] {
  const faces: number[] = [];
  for (let face = 0; face < cutMesh.faceTriangle.length; ++face) if (holds(face)) faces.push(face);
  return faces;
}

/** Vertices of each loop of a face, the outer one first. */
export function loopsOf({ cutMesh }: Subject, face: number): number[][] {
  const { faceLoopOffsets, loopOffsets, loopVertices } = cutMesh;
  const loops: number[][] = [];
  for (let loop = faceLoopOffsets[face]; loop < faceLoopOffsets[face + 1]; ++loop) {
    loops.push(Array.from(loopVertices.subarray(loopOffsets[loop], loopOffsets[loop + 1])));
  }
  return loops;
}

export function loopPoints(subject: Subject, face: number): Vector3[][] {
  return loopsOf(subject, face).map((loop) => loop.map((vertex) => pointOf(subject.cutMesh.positions, vertex)));
}

export function trianglesOf({ cutMesh, faceTriangles }: Subject, face: number): [Vector3, Vector3, Vector3][] {
  const { faceTriangleOffsets, triangles } = faceTriangles;
  const result: [Vector3, Vector3, Vector3][] = [];
  for (let t = faceTriangleOffsets[face]; t < faceTriangleOffsets[face + 1]; ++t) {
    const corner = (k: number) => pointOf(cutMesh.positions, triangles[3 * t + k]);
    result.push([corner(0), corner(1), corner(2)]);
  }
  return result;
}

/** Bits of the axes whose planes hold both vertices. */
export function commonPlanes({ cutMesh }: Subject, u: number, v: number): number {
  const { vertexMask, vertexCell } = cutMesh;
  let common = vertexMask[u] & vertexMask[v];
  for (let d = 0; d < 3; ++d) if (vertexCell[3 * u + d] !== vertexCell[3 * v + d]) common &= ~(1 << d);
  return common;
}

/** Calls back once for each edge of some faces. */
export function forEachEdge(subject: Subject, faces: Iterable<number>, visit: (u: number, v: number) => void): void {
  const vertexCount = subject.cutMesh.positions.length / 3;
  const seen = new Set<number>();
  for (const face of faces) {
    for (const loop of loopsOf(subject, face)) {
      loop.forEach((a, k) => {
        const b = loop[(k + 1) % loop.length];
        const key = Math.min(a, b) * vertexCount + Math.max(a, b);
        if (seen.has(key)) return;
        seen.add(key);
        visit(a, b);
      });
    }
  }
}

export function middleOf(points: readonly Vector3[]): Vector3 {
  const sum = [0, 0, 0];
  for (const p of points) for (let d = 0; d < 3; ++d) sum[d] += p[d];
  return [sum[0] / points.length, sum[1] / points.length, sum[2] / points.length];
}

export function moved(p: Vector3, by: Vector3): Vector3 {
  return [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
}
