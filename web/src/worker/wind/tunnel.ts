// A mesh in a box of cells through which wind can blow: a cut of its own, with octree cells away from the surface.
import type { CutMesh, GridInput } from 'mandoline-wasm';
import type { CellComplex, Flow } from 'mandoline-wasm/physics';
import type { LoadedMesh } from '../../model/calls';
import { pageError } from '../../model/failure';
import { gridAround } from '../../model/grid_around';
import type { Vector3 } from '../../model/vector';
import { mostWindCells, windMargin, type WindRequest } from '../../model/wind';
import { posed } from '../posed';
import type { Package } from './package';

/** Triangles of the surface, seen from the cells beside it. A cell's points are its own. */
export interface Surface {
  /** Of the cut-mesh, per point. */
  vertex: Uint32Array;
  /** Per point. */
  cell: Uint32Array;
  /** Per point: the side of a triangle of the input that it is seen from, 0 or 1. */
  side: Uint8Array;
  /** 3 points per triangle. */
  index: Uint32Array;
}

export interface Tunnel {
  /** Of the mesh, its pose and the size. */
  key: string;
  mesh: LoadedMesh;
  cutMesh: CutMesh;
  cells: CellComplex;
  origin: Vector3;
  /** As openRegions() has it: nothing flows in the others. */
  isOpen: Uint8Array;
  /** Flows of winds of length 1 that were solved: along x, y and z, and in the latest direction besides. */
  axes: (Flow | null)[];
  other: Flow | null;
  /** Made when it is first drawn. */
  surface: Surface | null;
}

export type Site = Pick<WindRequest, 'mesh' | 'pose' | 'cells'>;

/** Of the same site every tunnel is the same. */
export function keyOf({ mesh, pose, cells }: Site): string {
  return JSON.stringify([mesh, pose, cells]);
}

export async function makeTunnel({ mandoline, physics }: Package, loaded: LoadedMesh, site: Site): Promise<Tunnel> {
  const { pose, cells: size } = site;
  if (size > mostWindCells) {
    const detail = `It has ${size} cells along its longest side; the page takes up to ${mostWindCells}. The library has no such limit.`;
    throw pageError('The grid of the wind tunnel is too fine', detail);
  }
  const mesh = posed(mandoline, loaded, pose);
  // A tunnel stays where it is while the mesh in it moves.
  const grid = pose ? (gridAround(mesh.bounds, size, windMargin) as GridInput) : { cells: size, margin: windMargin };
  const cutMesh = mandoline.cut(mesh, grid, { gridCellRegion: false });
  const cells = await physics.cellComplex(mesh, cutMesh, await physics.coarsen(cutMesh));
  const [x, y, z] = cutMesh.grid.planes.map((planes) => (planes[0] + planes[planes.length - 1]) / 2);
  const isOpen = openRegions(cells, cutMesh.regionCount);
  return {
    key: keyOf(site),
    mesh,
    cutMesh,
    cells,
    origin: [x, y, z],
    isOpen,
    axes: [null, null, null],
    other: null,
    surface: null,
  };
}

/** Tags of faces below this are the sides of the box. */
const innerTag = 6;

/** Per region: 1 if it reaches a side of the box. */
export function openRegions({ faceTag, faceCells, cellRegion }: CellComplex, count: number): Uint8Array {
  const isOpen = new Uint8Array(count);
  for (let face = 0; face < faceTag.length; face++) {
    if (faceTag[face] < innerTag) isOpen[cellRegion[Math.max(faceCells[2 * face], faceCells[2 * face + 1])]] = 1;
  }
  return isOpen;
}
