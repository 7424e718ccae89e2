// The speed at the surface, on each side of it that wind can reach: that of the cell on this side.
import type { CutMesh, FaceTriangles } from 'mandoline-wasm';
import type { Vector3 } from '../../model/vector';
import type { Shape, Wind } from '../../model/wind';
import type { Velocities } from './flows';
import type { Package } from './package';
import { speedIn } from './speeds';
import type { Surface, Tunnel } from './tunnel';

/** With the points if they are wanted. */
export function surfaceSpeeds({ mandoline }: Package, tunnel: Tunnel, flow: Velocities, withShape: boolean): NonNullable<Wind['surface']> {
  tunnel.surface ??= makeSurface(tunnel.cutMesh, mandoline.triangulate(tunnel.cutMesh), tunnel.isOpen);
  const { cells, cutMesh, surface, origin } = tunnel;
  const speed = smoothSpeeds(surface, cutMesh, speedIn(cells, flow));
  const shape: Shape | null = withShape ? { position: pointsOf(surface, cutMesh, origin), index: surface.index.slice() } : null;
  return { shape, speed };
}

/** At each vertex the mean of the cells around it that are on the same side: the velocity is not the same in all of them. */
function smoothSpeeds({ vertex, cell, side }: Surface, { positions }: CutMesh, speedAt: ReturnType<typeof speedIn>): Float32Array {
  const sums = new Float64Array((2 * positions.length) / 3);
  const counts = new Uint32Array(sums.length);
  for (let point = 0; point < vertex.length; point++) {
    const at = 3 * vertex[point];
    sums[2 * vertex[point] + side[point]] += speedAt(cell[point], positions[at], positions[at + 1], positions[at + 2]);
    counts[2 * vertex[point] + side[point]]++;
  }
  return Float32Array.from(vertex, (of, point) => sums[2 * of + side[point]] / counts[2 * of + side[point]]);
}

function pointsOf({ vertex }: Surface, { positions }: CutMesh, origin: Vector3): Float32Array {
  const position = new Float32Array(3 * vertex.length);
  for (let point = 0; point < vertex.length; point++) {
    for (let d = 0; d < 3; d++) position[3 * point + d] = positions[3 * vertex[point] + d] - origin[d];
  }
  return position;
}

function makeSurface(cutMesh: CutMesh, { faceTriangleOffsets, triangles }: FaceTriangles, isOpen: Uint8Array): Surface {
  const { positions, cellHalfFaceOffsets, cellHalfFaces, faceTriangle, cellRegion } = cutMesh;
  let corners = 0;
  for (const halfFace of cellHalfFaces) {
    if (faceTriangle[halfFace >> 1] >= 0) corners += 3 * (faceTriangleOffsets[(halfFace >> 1) + 1] - faceTriangleOffsets[halfFace >> 1]);
  }
  const index = new Uint32Array(corners);
  const vertexOf = new Uint32Array(corners);
  const cellOf = new Uint32Array(corners);
  const sideOf = new Uint8Array(corners);
  // Of each vertex: its latest point. It is one of the current cell if it isn't below the cell's first.
  const pointOf = new Int32Array(positions.length / 3).fill(-1);
  let [points, length] = [0, 0];
  for (let cell = 0; cell < cellRegion.length; cell++) {
    if (!isOpen[cellRegion[cell]]) continue;
    const first = points;
    for (let h = cellHalfFaceOffsets[cell]; h < cellHalfFaceOffsets[cell + 1]; h++) {
      const face = cellHalfFaces[h] >> 1;
      if (faceTriangle[face] < 0) continue;
      const [begin, end] = [3 * faceTriangleOffsets[face], 3 * faceTriangleOffsets[face + 1]];
      for (let corner = begin; corner < end; corner++) {
        // On side 0 the normal points out of the cell: seen from within, the face is turned around.
        const vertex = triangles[cellHalfFaces[h] & 1 ? corner : begin + end - 1 - corner];
        if (pointOf[vertex] < first) {
          pointOf[vertex] = points;
          vertexOf[points] = vertex;
          sideOf[points] = cellHalfFaces[h] & 1;
          cellOf[points++] = cell;
        }
        index[length++] = pointOf[vertex];
      }
    }
  }
  const [vertex, cell, side] = [vertexOf, cellOf, sideOf].map((array) => array.slice(0, points));
  return { vertex, cell, side, index: index.slice(0, length) } as Surface;
}
