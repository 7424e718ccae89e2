// The same mesh in other ways than the cut-cells that are shown, to be seen beside them.
import type { CutMesh, Mandoline, Mesh } from 'mandoline-wasm';
import type { Comparison, Extent, GridPlanes, Inside, OtherGridWay, OtherSurface } from '../../model/comparison';
import type { Vector3 } from '../../model/vector';
import type { Cut } from '../kept';
import { marchingCubes } from './cubes';
import type { InsideAt, Surface } from './inside';
import { voxels } from './voxels';

/** A cut of the same mesh with another grid. */
export interface OtherCut {
  way: OtherGridWay;
  cut: Cut;
}

export function comparison(mandoline: Mandoline, cut: Cut, other: OtherCut | null): Comparison {
  const { cutMesh, origin } = cut;
  const insideAt = testInside(mandoline, cutMesh);
  const drawn = ({ positions, triangles }: Surface, { grid }: CutMesh) => ({
    position: Float32Array.from(positions, (x, at) => x - origin[at % 3]),
    index: triangles,
    grid: planesOf(grid, origin),
  });
  const sameGrid = ({ untouched, ...surface }: Surface & { untouched: number | null }): OtherSurface => ({
    ...extentOf(surface),
    cells: untouched === null ? null : { cut: 0, untouched },
    ...drawn(surface, cutMesh),
  });
  const ways: Comparison['ways'] = {
    voxels: sameGrid(voxels(cutMesh, insideAt)),
    cubes: sameGrid({ ...marchingCubes(cutMesh, insideAt), untouched: null }),
  };
  const { surface: _, ...exact } = exactInside(mandoline, cut);
  if (other) {
    const { surface, ...inside } = exactInside(mandoline, other.cut);
    ways[other.way] = { ...inside, ...drawn(surface, other.cut.cutMesh) };
  }
  return { origin, ways, exact };
}

function planesOf({ planes, cells }: CutMesh['grid'], origin: Vector3): GridPlanes {
  const low = planes.map((axis, d) => axis[0] - origin[d]);
  return { low, step: planes.map((axis) => axis[1] - axis[0]), cells: [cells[0], cells[1], cells[2]] };
}

function testInside(mandoline: Mandoline, cutMesh: CutMesh): InsideAt {
  const { isInside } = mandoline.insideRegions(cutMesh, { rule: 'nonZero' });
  return (points) => Uint8Array.from(mandoline.cellsAt(cutMesh, points).region, (region) => (region >= 0 ? isInside[region] : 0));
}

function exactInside(mandoline: Mandoline, cut: Cut): Inside & { surface: Surface } {
  const { mesh, cutMesh } = cut;
  cut.measures ??= mandoline.measure(mesh, cutMesh);
  const { isInside } = mandoline.insideRegions(cutMesh, { rule: 'nonZero' });
  const volume = cut.measures.regionVolume.reduce((sum, x, region) => sum + isInside[region] * x, 0);
  const surface = mandoline.boundary(cutMesh, 'nonZero');
  return { volume, area: extentOf(surface).area, cells: countInside(cutMesh, isInside), surface };
}

function countInside({ cellRegion, runBegin, runEnd, runRegion }: CutMesh, isInside: Uint8Array): { cut: number; untouched: number } {
  const untouched = runRegion.reduce((sum, region, run) => sum + isInside[region] * (runEnd[run] - runBegin[run]), 0);
  return { cut: cellRegion.reduce((sum, region) => sum + isInside[region], 0), untouched };
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
