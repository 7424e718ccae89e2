// The cut-cells: one draw call for all faces, one for all edges.
import { Group, LineSegments, Mesh, Vector3 } from 'three';
import type { BufferGeometry, ShaderMaterial } from 'three';
import { isSheet } from '../../../model/shown';
import type { Model } from '../../../model/cut_model';
import { isBeyond, isBoxBeyond } from '../../../model/planes';
import type { ViewPlane } from '../../../model/slices';
import { emptyGeometry, refill, Table } from '../buffers';
import { cutCellColors, gridFaceColor, type Rgb } from '../colors';
import type { Layer, Look } from '../layer';
import { gridStroke, makeMaterial, stroke, type Purpose, type Uniforms } from '../material';
import { paler, type Piece } from '../piece';
import { isAll, isWithin, shareOf } from '../../../model/volumes';

/** Drawn in two groups: pieces of triangles, and pieces of grid-faces. */
type Faces = Mesh<BufferGeometry, [ShaderMaterial, ShaderMaterial]>;

/** Drawn in three groups: hybrid edges, grid-edges, and pieces of tri-edges. */
type Lines = LineSegments<BufferGeometry, [ShaderMaterial, ShaderMaterial, ShaderMaterial]>;

const triEdgeStrength = 0.16;
/** In pixels. */
const shortestTriEdge = 9;
/** How a cell is looked up: shown, or faint since its volume is not selected. */
const [shown, dimmed] = [255, 64];
/** Of grid-edges as outlines of grid-faces, and as boxes that stand around a sheet. */
const gridEdgeStrength = 0.4;
const boxStrength = 0.06;

export class CutCells implements Layer {
  readonly object = new Group();
  readonly pick: Faces;
  readonly caster: Faces;
  /** The surface alone, faint, behind the pictures of steps. */
  readonly ghost: Faces;
  private readonly geometry = emptyGeometry('normal');
  private readonly faces: Faces;
  private readonly backs: Faces;
  private readonly lines: Lines;
  /** The surface of cells that are not selected. Made, and its shader compiled, when there are such. */
  private dimmed: Faces | null = null;
  /** Mean length of pieces of tri-edges. */
  private readonly triEdgeLength = { value: 1 };
  /** Mean distance of hybrid edges: in a surface that lies in an axial plane, all edges of triangles are such. */
  private readonly hybridEdgeGap = { value: 1 };
  private readonly centers = new Table((length) => new Float32Array(length));
  /** RGB, and whether it is shown, per cell. */
  private readonly looks = new Table((length) => new Uint8Array(length));
  private readonly shifts = new Table((length) => new Float32Array(length));
  private look: Look | null = null;

  constructor(private readonly uniforms: Uniforms) {
    for (const kind of [0, 1]) this.geometry.addGroup(0, Infinity, kind);
    this.faces = this.makeFaces('FACES');
    this.backs = this.makeFaces('BACKS');
    this.backs.visible = false;
    this.pick = this.makeFaces('PICK');
    this.caster = this.makeFaces('SHADOW');
    this.ghost = this.makeFaces('GHOST');
    this.ghost.material[1].visible = false;
    const strokes = [
      gridStroke(uniforms, this.hybridEdgeGap),
      gridStroke(uniforms),
      stroke(triEdgeStrength, this.triEdgeLength, shortestTriEdge),
    ];
    const [hybrid, grid, tri] = strokes.map((own) => makeMaterial('CELLS', 'LINES', uniforms, own));
    this.lines = new LineSegments(emptyGeometry(), [hybrid, grid, tri]);
    this.object.add(this.faces, this.backs, this.lines);
    this.lines.frustumCulled = false;
  }

  private makeFaces(purpose: Purpose): Faces {
    const material = (isSurface: boolean) => makeMaterial('CELLS', purpose, this.uniforms, { isSurface: { value: isSurface } });
    const faces: Faces = new Mesh(this.geometry, [material(true), material(false)]);
    faces.frustumCulled = false;
    return faces;
  }

  private makeDimmed(): Faces {
    const faces = this.makeFaces('DIMMED');
    faces.material[1].visible = false;
    this.object.add(faces);
    return faces;
  }

  setModel(model: Model): void {
    const { triangles, edges } = model;
    const { geometry } = this;
    const attributes = {
      position: { array: triangles.position, size: 3 },
      normal: { array: triangles.normal, size: 4, normalized: true },
      cell: { array: triangles.cell, size: 1 },
    };
    // Those of models that move are needed elsewhere once another has come. Others' are too large to be kept twice.
    const mayKeep = !model.isMoving;
    refill(geometry, attributes, triangles.index, mayKeep);
    geometry.clearGroups();
    geometry.addGroup(0, triangles.surfaceEnd, 0);
    geometry.addGroup(triangles.surfaceEnd, triangles.index.length - triangles.surfaceEnd, 1);
    // What both share is not the lines' to dispose of.
    const lines = this.lines.geometry;
    for (const name of ['position', 'cell']) lines.deleteAttribute(name);
    refill(lines, {}, edges.index, mayKeep);
    for (const name of ['position', 'cell']) lines.setAttribute(name, geometry.getAttribute(name));
    const { hybridEnd, gridEnd, index } = edges;
    lines.clearGroups();
    lines.addGroup(0, hybridEnd, 0);
    lines.addGroup(hybridEnd, gridEnd - hybridEnd, 1);
    lines.addGroup(gridEnd, index.length - gridEnd, 2);
    this.triEdgeLength.value = meanLength(triangles.position, index.subarray(gridEnd));
    this.hybridEdgeGap.value = meanGap(triangles, index.subarray(0, hybridEnd));
    this.uniforms.darkBacks.value = isSheet(model);
    this.setCenters(model);
  }

  private setCenters({ cells: { region, centroid } }: Model): void {
    this.centers.resize(region.length);
    const { data } = this.centers;
    for (let cell = 0; cell < region.length; cell++) {
      for (let d = 0; d < 3; d++) data[4 * cell + d] = centroid[3 * cell + d];
      data[4 * cell + 3] = region[cell];
    }
    this.looks.resize(region.length);
    this.uniforms.cellCenters.value = this.centers.texture;
    this.uniforms.cellLooks.value = this.looks.texture;
  }

  dependsOn({ model, settings: { show, volumes, colorBy } }: Look): readonly unknown[] {
    return [model.id, show, volumes, colorBy];
  }

  setLook(look: Look): void {
    const { model, settings, regions, shifts } = look;
    const { show, volumes, colorBy } = settings;
    this.look = look;
    this.shifts.resize(model.regions.length);
    shifts.forEach((x, at) => (this.shifts.data[4 * Math.floor(at / 3) + (at % 3)] = x));
    this.uniforms.regionShifts.value = this.shifts.texture;
    const { region } = model.cells;
    this.looks.resize(region.length);
    this.looks.data.set(cutCellColors(model, colorBy));
    const hasDimmed = !isAll(volumes);
    for (let cell = 0; cell < region.length; cell++) {
      const isDimmed = hasDimmed && !isWithin(volumes, shareOf(model, cell));
      this.looks.data[4 * cell + 3] = show.cutCells && regions[region[cell]] ? (isDimmed ? dimmed : shown) : 0;
    }
    if (hasDimmed) this.dimmed ??= this.makeDimmed();
    if (this.dimmed) this.dimmed.visible = hasDimmed && show.surface;
    // Of a face between two shown cells only the front is drawn, so neighbours don't fight for its pixels; without the rest of the boundary
    // one looks into cells and sees the backs as well.
    this.backs.visible = !(show.surface && show.gridFaces);
    for (const { material } of [this.faces, this.backs, this.pick, this.caster]) {
      material[0].visible = show.surface;
      material[1].visible = show.gridFaces;
    }
    this.lines.visible = show.edges;
    const { uniforms } = this.lines.material[1];
    uniforms.strength.value = show.gridFaces ? gridEdgeStrength : boxStrength;
    uniforms.lineColor = show.gridFaces ? this.uniforms.lineColor : this.uniforms.boxColor;
  }

  isShown(cell: number): boolean {
    return this.looks.data[4 * cell + 3] === shown;
  }

  colorOf(cell: number): Rgb {
    return this.looks.data.subarray(4 * cell, 4 * cell + 3) as unknown as Rgb;
  }

  forEachPiece(take: (piece: Piece) => void, only?: { cell: number; box: number }): void {
    if (!this.look || only?.cell === -1) return;
    const { model, settings } = this.look;
    const { show, colorBy } = settings;
    const { position, cell: cells, index, surfaceEnd } = model.triangles;
    for (let at = 0; at < index.length; at += 3) {
      const cell = cells[index[at]];
      if (only && only.cell !== cell) continue;
      const isSurface = at < surfaceEnd;
      if (!this.isShown(cell) || !(isSurface ? show.surface : show.gridFaces)) continue;
      const own = this.colorOf(cell);
      const ofGrid = colorBy === 'kind' ? gridFaceColor : paler(own);
      take({
        corners: Array.from(index.subarray(at, at + 3)).flatMap((vertex) => Array.from(position.subarray(3 * vertex, 3 * vertex + 3))),
        middle: model.cells.centroid.subarray(3 * cell, 3 * cell + 3),
        cell,
        region: model.cells.region[cell],
        color: isSurface ? own : ofGrid,
        ownPlane: -1,
      });
    }
  }

  /** Whether the planes leave a part of the cell. */
  private isKept(model: Model, planes: readonly ViewPlane[], flat: boolean, cell: number): boolean {
    const { centroid, gridCell } = model.cells;
    if (!flat) return !isBeyond(planes, centroid[3 * cell], centroid[3 * cell + 1], centroid[3 * cell + 2]);
    const side = (end: number) => model.grid.planes.map((axis, d) => axis[gridCell[3 * cell + d] + end] - model.origin[d]);
    return !isBoxBeyond(planes, side(0), side(1));
  }

  /** How many cut-cells are seen, wholly or in part. */
  count({ model, settings, planes }: Look): number {
    const isFlat = settings.sliceMode === 'flat';
    let count = 0;
    for (let cell = 0; cell < model.cells.region.length; cell++) {
      if (this.isShown(cell) && (planes.length === 0 || this.isKept(model, planes, isFlat, cell))) count++;
    }
    return count;
  }
}

/** Of edges given by their vertices, from at most a thousand of them. */
function meanLength(position: Float32Array, edges: Uint32Array): number {
  const step = 2 * Math.ceil(edges.length / 2000);
  let sum = 0;
  let count = 0;
  for (let at = 0; at < edges.length; at += step) {
    const [a, b] = [3 * edges[at], 3 * edges[at + 1]];
    sum += Math.hypot(position[b] - position[a], position[b + 1] - position[a + 1], position[b + 2] - position[a + 2]);
    count++;
  }
  return count > 0 ? sum / count : 1;
}

/** The side of squares, if edges of that length divide the surface into such. */
function meanGap({ position, index, surfaceEnd }: Model['triangles'], edges: Uint32Array): number {
  const length = (edges.length / 2) * meanLength(position, edges);
  // A square has four sides, each of which is there once for every cell.
  return length > 0 ? (4 * (surfaceEnd / 3) * meanArea(position, index.subarray(0, surfaceEnd))) / length : 1;
}

/** Of triangles given by their vertices, from at most a thousand of them. */
function meanArea(position: Float32Array, triangles: Uint32Array): number {
  const step = 3 * Math.ceil(triangles.length / 3000);
  const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
  let sum = 0;
  let count = 0;
  for (let at = 0; at < triangles.length; at += step) {
    [a, b, c].forEach((corner, k) => corner.fromArray(position, 3 * triangles[at + k]));
    sum += b.sub(a).cross(c.sub(a)).length() / 2;
    count++;
  }
  return count > 0 ? sum / count : 0;
}
