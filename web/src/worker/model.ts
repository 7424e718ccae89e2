import type { CutMesh, FaceTriangles, Mandoline, Measures, Mesh, Vector3 } from 'mandoline-wasm';
import type { CellInfo, Model, RegionInfo } from '../model/types';
import { cellBuffers } from './cell_buffers';
import { buffersOf, type Answered } from '../model/protocol';

/** What the worker keeps of a cut besides the cut-mesh. */
export interface Derived {
  origin: Vector3;
  measures: Measures;
  faceTriangles: FaceTriangles;
}

export function derive(mandoline: Mandoline, mesh: Mesh, cutMesh: CutMesh): Derived {
  const { low, high } = gridBox(cutMesh);
  const origin: Vector3 = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
  return { origin, measures: mandoline.measure(mesh, cutMesh), faceTriangles: mandoline.triangulate(cutMesh) };
}

function gridBox({ grid }: CutMesh): { low: number[]; high: number[] } {
  return { low: grid.planes.map((planes) => planes[0]), high: grid.planes.map((planes) => planes[planes.length - 1]) };
}

/** The cut-mesh made ready to be drawn. Nothing of what the worker keeps is handed over. */
export function makeModel(id: number, name: string, mandoline: Mandoline, mesh: Mesh, cutMesh: CutMesh, derived: Derived): Answered<Model> {
  const { origin, measures, faceTriangles } = derived;
  const { low, high } = gridBox(cutMesh);
  const { triangles, edges } = cellBuffers(cutMesh, faceTriangles, origin);
  const cells = cellInfo(cutMesh, derived);
  const gridCellRegion = (cutMesh.gridCellRegion as Int32Array).slice();
  const regions = regionInfo(cutMesh, measures);
  const model: Model = {
    id,
    name,
    grid: cutMesh.grid,
    origin,
    diagonal: Math.hypot(...high.map((x, d) => x - low[d])),
    ...boundsOf(mesh),
    triangleCount: cutMesh.triangleCount,
    droppedTriangles: cutMesh.droppedTriangles.length,
    counts: {
      cutCells: cutMesh.cellRegion.length,
      untouchedCells: regions.reduce((sum, region) => sum + region.untouchedCells, 0),
      faces: cutMesh.faceTriangle.length,
      vertices: cutMesh.positions.length / 3,
      edges: mandoline.cutEdges(mesh, cutMesh).edgeLength.length,
      regions: cutMesh.regionCount,
    },
    stats: cutMesh.stats,
    regions,
    outsideRegion: mandoline.cellAt(cutMesh, [low[0], low[1], low[2]])?.region ?? null,
    cells,
    triangles,
    edges,
    gridCellRegion,
  };
  return { answer: model, transfer: buffersOf(...Object.values(triangles), edges.index, ...Object.values(cells), gridCellRegion) };
}

function cellInfo(cutMesh: CutMesh, { origin, measures }: Derived): CellInfo {
  return {
    region: cutMesh.cellRegion.slice(),
    volume: measures.cellVolume.slice(),
    centroid: Float32Array.from(measures.cellCentroid, (x, at) => x - origin[at % 3]),
    gridCell: cutMesh.cellGridCell.slice(),
  };
}

function regionInfo(cutMesh: CutMesh, measures: Measures): RegionInfo[] {
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

function boundsOf(mesh: Mesh): { meshMin: Vector3; meshMax: Vector3 } {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  const { positions, triangles } = mesh;
  for (let corner = 0; corner < triangles.length; corner++) {
    for (let d = 0; d < 3; d++) {
      const x = positions[3 * triangles[corner] + d];
      if (x < min[d]) min[d] = x;
      if (x > max[d]) max[d] = x;
    }
  }
  return { meshMin: min, meshMax: max };
}
