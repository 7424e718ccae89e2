// The cut-cells: one draw call for all faces, one for all edges.
import { BufferAttribute, BufferGeometry, Float32BufferAttribute, Group, LineSegments, Mesh } from 'three';
import type { DataTexture, ShaderMaterial } from 'three';
import type { Model, Settings } from '../../model/types';
import { cutCellColors, gridFaceColor, type Rgb } from './colors';
import { regionShifts } from './look';
import { makeMaterial, makeTable, type Purpose, type Uniforms } from './material';
import { paler, type Piece } from './piece';
import { isBeyond, isBoxBeyond, type ViewPlane } from './planes';

/** Drawn in two groups: pieces of triangles, and pieces of grid-faces. */
type Faces = Mesh<BufferGeometry, [ShaderMaterial, ShaderMaterial]>;

export class CutCells {
  readonly group = new Group();
  readonly pick: Faces;
  readonly ghost: Faces;
  /** RGB, and whether it is shown, per cell. */
  looks = new Uint8Array(0);
  private readonly faces: Faces;
  private readonly backs: Faces;
  private readonly lines: LineSegments;
  /** 3 per region: how it moves in an explosion by region. */
  shifts: Float32Array = new Float32Array(0);
  private tables: DataTexture[] = [];
  private looksTexture: DataTexture | null = null;

  constructor(private readonly uniforms: Uniforms) {
    const empty = new BufferGeometry();
    for (const kind of [0, 1]) empty.addGroup(0, Infinity, kind);
    const makeFaces = (purpose: Purpose): Faces => {
      const material = (isSurface: boolean) => makeMaterial('CELLS', purpose, uniforms, { isSurface: { value: isSurface } });
      return new Mesh(empty, [material(true), material(false)]);
    };
    this.faces = makeFaces('FACES');
    this.backs = makeFaces('BACKS');
    this.pick = makeFaces('PICK');
    this.ghost = makeFaces('GHOST');
    this.ghost.material[1].visible = false;
    this.lines = new LineSegments(new BufferGeometry(), makeMaterial('CELLS', 'LINES', uniforms));
    this.group.add(this.faces, this.backs, this.lines);
    for (const object of [this.faces, this.backs, this.pick, this.ghost, this.lines]) object.frustumCulled = false;
  }

  setModel(model: Model): void {
    const { triangles, edges } = model;
    this.faces.geometry.dispose();
    this.lines.geometry.dispose();
    const faces = new BufferGeometry();
    faces.setAttribute('position', new BufferAttribute(triangles.position, 3));
    faces.setAttribute('cell', new BufferAttribute(triangles.cell, 1));
    faces.setIndex(new BufferAttribute(triangles.index, 1));
    faces.addGroup(0, triangles.surfaceEnd, 0);
    faces.addGroup(triangles.surfaceEnd, triangles.index.length - triangles.surfaceEnd, 1);
    for (const mesh of [this.faces, this.backs, this.pick, this.ghost]) mesh.geometry = faces;
    const lines = new BufferGeometry();
    for (const name of ['position', 'cell']) lines.setAttribute(name, faces.getAttribute(name));
    lines.setIndex(new BufferAttribute(edges.index, 1));
    this.lines.geometry = lines;
    this.makeTables(model);
  }

  private makeTables(model: Model): void {
    for (const table of this.tables) table.dispose();
    const { region, centroid } = model.cells;
    const centers = makeTable(region.length, (length) => new Float32Array(length));
    for (let cell = 0; cell < region.length; cell++) {
      for (let d = 0; d < 3; d++) centers.data[4 * cell + d] = centroid[3 * cell + d];
      centers.data[4 * cell + 3] = region[cell];
    }
    const looks = makeTable(region.length, (length) => new Uint8Array(length));
    const shifts = makeTable(model.regions.length, (length) => new Float32Array(length));
    this.shifts = regionShifts(model);
    this.shifts.forEach((x, at) => (shifts.data[4 * Math.floor(at / 3) + (at % 3)] = x));
    this.tables = [centers.texture, looks.texture, shifts.texture];
    this.looks = looks.data;
    this.looksTexture = looks.texture;
    this.uniforms.cellCenters.value = centers.texture;
    this.uniforms.cellLooks.value = looks.texture;
    this.uniforms.regionShifts.value = shifts.texture;
  }

  setLook(model: Model, settings: Settings, regions: Uint8Array): void {
    const { show, colorBy } = settings;
    this.looks.set(cutCellColors(model, colorBy));
    const { region } = model.cells;
    for (let cell = 0; cell < region.length; cell++) this.looks[4 * cell + 3] = show.cutCells && regions[region[cell]] ? 255 : 0;
    if (this.looksTexture) this.looksTexture.needsUpdate = true;
    // Of a face between two shown cells only the front is drawn, so neighbours don't fight for its pixels; without the rest of the boundary
    // one looks into cells and sees the backs as well.
    this.backs.visible = !(show.surface && show.gridFaces);
    for (const { material } of [this.faces, this.backs, this.pick]) {
      material[0].visible = show.surface;
      material[1].visible = show.gridFaces;
    }
    this.lines.visible = show.edges;
  }

  forEachPiece(model: Model, { show, colorBy }: Settings, take: (piece: Piece) => void): void {
    const { position, cell: cells, index, surfaceEnd } = model.triangles;
    for (let at = 0; at < index.length; at += 3) {
      const cell = cells[index[at]];
      const isSurface = at < surfaceEnd;
      if (!this.isShown(cell) || !(isSurface ? show.surface : show.gridFaces)) continue;
      const own = this.looks.subarray(4 * cell, 4 * cell + 3) as unknown as Rgb;
      const ofGrid = colorBy === 'kind' ? gridFaceColor : paler(own);
      take({
        corners: Array.from(index.subarray(at, at + 3)).flatMap((vertex) => Array.from(position.subarray(3 * vertex, 3 * vertex + 3))),
        middle: model.cells.centroid.subarray(3 * cell, 3 * cell + 3),
        region: model.cells.region[cell],
        color: isSurface ? own : ofGrid,
        ownPlane: -1,
      });
    }
  }

  isShown(cell: number): boolean {
    return this.looks[4 * cell + 3] > 0;
  }

  /** Whether the planes leave a part of the cell. */
  isKept(model: Model, planes: readonly ViewPlane[], flat: boolean, cell: number): boolean {
    const { centroid, gridCell } = model.cells;
    if (!flat) return !isBeyond(planes, centroid[3 * cell], centroid[3 * cell + 1], centroid[3 * cell + 2]);
    const side = (end: number) => model.grid.planes.map((axis, d) => axis[gridCell[3 * cell + d] + end] - model.origin[d]);
    return !isBoxBeyond(planes, side(0), side(1));
  }

  /** How many cut-cells are seen, wholly or in part. */
  count(model: Model, planes: readonly ViewPlane[], flat: boolean): number {
    let count = 0;
    for (let cell = 0; cell < model.cells.region.length; cell++) {
      if (this.isShown(cell) && (planes.length === 0 || this.isKept(model, planes, flat, cell))) count++;
    }
    return count;
  }
}

/** A geometry of plain line segments. */
export function lineGeometry(position: Float32Array | number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(position, 3));
  return geometry;
}
