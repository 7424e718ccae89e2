// The same mesh and grid in other ways than cut-cells, to be seen beside them.
import type { CutMesh, Mandoline, Mesh } from 'mandoline-wasm';
import type { Comparison, Extent, OtherSurface } from '../../model/comparison';
import type { Cut } from '../kept';
import { marchingCubes } from './cubes';
import { voxels } from './voxels';

/** A surface in world units. */
export interface Surface {
  positions: Float64Array;
  triangles: Uint32Array;
}

/** Per point, 3 numbers each: whether it is inside; not outside the grid. */
export type InsideAt = (points: Float64Array) => Uint8Array;

export function comparison(mandoline: Mandoline, cut: Cut): Comparison {
  const { cutMesh, origin } = cut;
  const insideAt = testInside(mandoline, cutMesh);
  const other = (make: (cutMesh: CutMesh, insideAt: InsideAt) => Surface): OtherSurface => {
    const surface = make(cutMesh, insideAt);
    const position = Float32Array.from(surface.positions, (x, at) => x - origin[at % 3]);
    return { ...extentOf(surface), position, index: surface.triangles };
  };
  return { origin, ways: { voxels: other(voxels), cubes: other(marchingCubes) }, exact: exactExtent(mandoline, cut) };
}

function testInside(mandoline: Mandoline, cutMesh: CutMesh): InsideAt {
  const { isInside } = mandoline.insideRegions(cutMesh, { rule: 'nonZero' });
  return (points) => Uint8Array.from(mandoline.cellsAt(cutMesh, points).region, (region) => (region >= 0 ? isInside[region] : 0));
}

function exactExtent(mandoline: Mandoline, cut: Cut): Extent {
  const { mesh, cutMesh } = cut;
  cut.measures ??= mandoline.measure(mesh, cutMesh);
  const { isInside } = mandoline.insideRegions(cutMesh, { rule: 'nonZero' });
  const volume = cut.measures.regionVolume.reduce((sum, x, region) => sum + isInside[region] * x, 0);
  return { volume, area: extentOf(mandoline.boundary(cutMesh, 'nonZero')).area };
}

/** Enclosed volume, and area. */
export function extentOf({ positions, triangles }: Mesh): Extent {
  let volume = 0;
  let area = 0;
  // From a point nearby, so that few digits are lost far from the origin.
  const [ox, oy, oz] = positions.length > 0 ? positions : [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ax, ay, az] = [positions[a] - ox, positions[a + 1] - oy, positions[a + 2] - oz];
    const [ux, uy, uz] = [positions[b] - positions[a], positions[b + 1] - positions[a + 1], positions[b + 2] - positions[a + 2]];
    const [vx, vy, vz] = [positions[c] - positions[a], positions[c + 1] - positions[a + 1], positions[c + 2] - positions[a + 2]];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    volume += (ax * nx + ay * ny + az * nz) / 6;
    area += Math.hypot(nx, ny, nz) / 2;
  }
  return { volume, area };
}
