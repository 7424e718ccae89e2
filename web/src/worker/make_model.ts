// What the page gets of a cut: ready to be drawn, in arrays of its own.
import type { CellDrawing, CutMesh, InsideRegions, Mandoline } from 'mandoline-wasm';
import type { Caps, CellInfo, Model, RegionInfo } from '../model/cut_model';
import { flatPlanes, inWorld } from '../model/planes';
import type { Slicing } from '../model/settings';
import type { Cut } from './kept';

/** Buffers of models that the page does not need any more. */
let spare: ArrayBuffer[] = [];

/** The next model of a surface that moves is written into these. */
export function reuseLater(buffers: ArrayBuffer[]): void {
  spare = buffers;
}

export function makeModel(mandoline: Mandoline, cut: Cut, slicing: Slicing): Model {
  const { recipe, mesh, cutMesh, origin, estimateMs } = cut;
  const { planes } = cutMesh.grid;
  const isMoving = recipe.pose !== null;
  const drawing = mandoline.cellDrawing(mesh, cutMesh, { origin, reuse: isMoving ? spare : undefined });
  spare = [];
  const cells = cellInfo(cutMesh, drawing);
  const inside = mandoline.insideRegions(cutMesh, { rule: 'nonZero' });
  const regions = regionInfo(cutMesh, inside, cells);
  return {
    id: recipe.id,
    isMoving,
    name: mesh.name,
    grid: structuredClone(cutMesh.grid),
    origin,
    diagonal: Math.hypot(...planes.map((axis) => axis[axis.length - 1] - axis[0])),
    meshMin: mesh.bounds.min,
    meshMax: mesh.bounds.max,
    up: mesh.up,
    isReadHere: mesh.isReadHere,
    triangleCount: cutMesh.triangleCount,
    droppedTriangles: cutMesh.droppedTriangles.length,
    counts: {
      cutCells: cutMesh.cellRegion.length,
      untouchedCells: regions.reduce((sum, region) => sum + region.untouchedCells, 0),
      faces: cutMesh.faceTriangle.length,
      vertices: cutMesh.positions.length / 3,
      regions: cutMesh.regionCount,
    },
    stats: cutMesh.stats,
    crossings: recipe.snapTolerance > 0 ? mandoline.findIntersections(mesh, { maxPairs: 0 }).counts : cutMesh.stats.intersections,
    estimateMs,
    regions,
    insideBy: inside.by,
    outsideRegion: regions.find(({ isInside }) => !isInside)?.id ?? null,
    cells,
    ...drawn(drawing),
    gridCellRegion: gridCellRegion(cutMesh),
    caps: capsOf(mandoline, cut, slicing),
  };
}

/** A model without its caps is better than none: the page asks for them once more, and tells why they can't be made. */
function capsOf(mandoline: Mandoline, { cutMesh, origin }: Cut, slicing: Slicing): Caps | null {
  const planes = flatPlanes(cutMesh, slicing);
  if (planes.length === 0) return null;
  try {
    return { planes, slices: inWorld(planes, origin).map((plane) => mandoline.slice(cutMesh, plane, { untouched: true })) };
  } catch {
    return null;
  }
}

function cellInfo(cutMesh: CutMesh, { cellVolume, cellCentroid }: CellDrawing): CellInfo {
  return { region: cutMesh.cellRegion.slice(), volume: cellVolume, centroid: cellCentroid, gridCell: cutMesh.cellGridCell.slice() };
}

function drawn(drawing: CellDrawing): Pick<Model, 'triangles' | 'edges'> {
  const { positions, normals, vertexCell, triangles, surfaceTriangles, edges, hybridEdges, gridEdges } = drawing;
  return {
    triangles: { position: positions, normal: normals, cell: vertexCell, index: triangles, surfaceEnd: 3 * surfaceTriangles },
    edges: { index: edges, hybridEnd: 2 * hybridEdges, gridEnd: 2 * (hybridEdges + gridEdges) },
  };
}

function regionInfo(cutMesh: CutMesh, { isInside }: InsideRegions, { volume }: CellInfo): RegionInfo[] {
  const { cellRegion, regionCount, regionWinding, regionInsideness } = cutMesh;
  const regions = Array.from({ length: regionCount }, (_, id) => ({
    id,
    isInside: isInside[id] === 1,
    winding: regionWinding?.[id] ?? null,
    insideness: regionInsideness?.[id] ?? null,
    volume: 0,
    cutCells: 0,
    untouchedCells: 0,
  }));
  cellRegion.forEach((region, cell) => {
    regions[region].cutCells++;
    regions[region].volume += volume[cell];
  });
  addUntouched(cutMesh, regions);
  return regions;
}

function addUntouched({ grid, rowRunOffsets, runBegin, runEnd, runRegion }: CutMesh, regions: RegionInfo[]): void {
  const [xs, ys, zs] = grid.planes;
  for (let row = 0; row + 1 < rowRunOffsets.length; row++) {
    const j = row % grid.cells[1];
    const k = (row - j) / grid.cells[1];
    const area = (ys[j + 1] - ys[j]) * (zs[k + 1] - zs[k]);
    for (let run = rowRunOffsets[row]; run < rowRunOffsets[row + 1]; run++) {
      const region = regions[runRegion[run]];
      region.untouchedCells += runEnd[run] - runBegin[run];
      region.volume += area * (xs[runEnd[run]] - xs[runBegin[run]]);
    }
  }
}

/** Region of each grid cell, x fastest; -1 where it is cut. */
function gridCellRegion({ grid, rowRunOffsets, runBegin, runEnd, runRegion }: CutMesh): Int32Array {
  const [nx, ny, nz] = grid.cells;
  const regions = new Int32Array(nx * ny * nz).fill(-1);
  for (let row = 0; row < ny * nz; row++) {
    for (let run = rowRunOffsets[row]; run < rowRunOffsets[row + 1]; run++) {
      regions.fill(runRegion[run], nx * row + runBegin[run], nx * row + runEnd[run]);
    }
  }
  return regions;
}
