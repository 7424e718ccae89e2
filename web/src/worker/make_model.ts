// What the page gets of a cut: ready to be drawn, in arrays of its own.
import type { Mandoline } from 'mandoline-wasm';
import type { CellInfo, Model, RegionInfo } from '../model/types';
import { cellBuffers } from './cell_buffers';
import type { Cut } from './kept';

export function makeModel(mandoline: Mandoline, name: string, cut: Cut): Model {
  const { recipe, bounds, cutMesh, origin } = cut;
  const { planes } = cutMesh.grid;
  const regions = regionInfo(cut);
  return {
    id: recipe.id,
    name,
    grid: structuredClone(cutMesh.grid),
    origin,
    diagonal: Math.hypot(...planes.map((axis) => axis[axis.length - 1] - axis[0])),
    meshMin: bounds.min,
    meshMax: bounds.max,
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
    regions,
    outsideRegion: mandoline.cellAt(cutMesh, [planes[0][0], planes[1][0], planes[2][0]])?.region ?? null,
    cells: cellInfo(cut),
    ...cellBuffers(cutMesh, cut.faceTriangles, origin),
    gridCellRegion: (cutMesh.gridCellRegion as Int32Array).slice(),
  };
}

function cellInfo({ cutMesh, origin, measures }: Cut): CellInfo {
  return {
    region: cutMesh.cellRegion.slice(),
    volume: measures.cellVolume.slice(),
    centroid: Float32Array.from(measures.cellCentroid, (x, at) => x - origin[at % 3]),
    gridCell: cutMesh.cellGridCell.slice(),
  };
}

function regionInfo({ cutMesh, measures }: Cut): RegionInfo[] {
  const regions = Array.from({ length: cutMesh.regionCount }, (_, id) => ({
    id,
    winding: cutMesh.regionWinding?.[id] ?? null,
    volume: measures.regionVolume[id],
    cutCells: 0,
    untouchedCells: 0,
  }));
  for (const region of cutMesh.cellRegion) regions[region].cutCells++;
  cutMesh.runRegion.forEach((region, run) => (regions[region].untouchedCells += cutMesh.runEnd[run] - cutMesh.runBegin[run]));
  return regions;
}
