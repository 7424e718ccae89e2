// The untouched grid cells as boxes. Their corners are worked out in the shader from a table of boxes; the buffers only say which corners
// make triangles and lines, and are the same for all models. (Instances of a mesh as small as a box are slow.)
import { BufferAttribute, BufferGeometry, Group, LineSegments, Mesh } from 'three';
import type { Model } from '../../../model/cut_model';
import { boxEdges } from '../box';
import { Table } from '../buffers';
import { untouchedColors, type Rgb } from '../colors';
import type { Layer, Look } from '../layer';
import { gridStroke, makeMaterial, type Uniforms } from '../material';
import { paler, type Piece } from '../piece';
import { hasWhole } from '../../../model/volumes';

/**
 * Boxes drawn at most when cells are pulled apart and any box might be seen through the gaps: all of a 50^3 grid, 1.8 million triangles.
 * Of a larger grid only boxes that would also be seen with nothing pulled apart are drawn: their number grows with the surface, about 10^5
 * for 128^3, and the missing ones lie behind them.
 */
const mostBoxes = 150_000;

/** Corners of boxes, by their numbers. */
const triangleCorners = [0, 1, 2].flatMap((d) => {
  const [u, v, far] = [1 << ((d + 1) % 3), 1 << ((d + 2) % 3), 1 << d];
  return [0, v, u | v, 0, u | v, u, far, far | u, 7, far, 7, far | v];
});

export class Untouched implements Layer {
  readonly object = new Group();
  readonly pick: Mesh;
  readonly caster: Mesh;
  count = 0;
  private readonly faces: Mesh;
  private readonly lines: LineSegments;
  /** 8 numbers per box: its min corner, region, size, and its colour as one number. */
  private readonly boxes = new Table((length) => new Float32Array(length));
  private readonly table = { value: this.boxes.texture };

  constructor(uniforms: Uniforms) {
    const own = { boxes: this.table };
    this.faces = new Mesh(new BufferGeometry(), makeMaterial('BOXES', 'FACES', uniforms, own));
    this.pick = new Mesh(this.faces.geometry, makeMaterial('BOXES', 'PICK', uniforms, own));
    this.caster = new Mesh(this.faces.geometry, makeMaterial('BOXES', 'SHADOW', uniforms, own));
    this.lines = new LineSegments(new BufferGeometry(), makeMaterial('BOXES', 'LINES', uniforms, { ...own, ...gridStroke(uniforms) }));
    for (const object of [this.faces, this.pick, this.caster, this.lines]) object.frustumCulled = false;
    this.object.add(this.faces, this.lines);
  }

  dependsOn({ model, settings: { show, volumes, colorBy, sliceMode, explode }, planes }: Look): readonly unknown[] {
    return [model.id, show, hasWhole(volumes), colorBy, sliceMode, planes, explode.cells > 0];
  }

  setLook(look: Look): void {
    const { model, settings } = look;
    const { show } = settings;
    const isShown = show.untouched && hasWhole(settings.volumes) && (show.gridFaces || show.edges);
    const gridCells = isShown ? seenBoxes(look) : new Uint32Array(0);
    this.count = gridCells.length;
    this.object.visible = this.pick.visible = this.count > 0;
    this.faces.visible = show.gridFaces;
    this.caster.visible = this.count > 0 && show.gridFaces;
    this.lines.visible = show.edges;
    this.setBoxes(model, gridCells, untouchedColors(model, settings.colorBy));
    setRange(this.faces.geometry, triangleCorners, this.count);
    setRange(this.lines.geometry, boxEdges, this.count);
  }

  private setBoxes(model: Model, gridCells: Uint32Array, colorOf: ReturnType<typeof untouchedColors>): void {
    const { grid, origin, gridCellRegion } = model;
    this.boxes.resize(2 * gridCells.length);
    this.table.value = this.boxes.texture;
    const { data } = this.boxes;
    for (let box = 0; box < gridCells.length; box++) {
      const gridCell = gridCells[box];
      let rest = gridCell;
      for (let d = 0; d < 3; d++) {
        const c = rest % grid.cells[d];
        rest = (rest - c) / grid.cells[d];
        const planes = grid.planes[d];
        data[8 * box + d] = planes[c] - origin[d];
        data[8 * box + 4 + d] = planes[c + 1] - planes[c];
      }
      const region = gridCellRegion[gridCell];
      const [red, green, blue] = colorOf(gridCell, region);
      data[8 * box + 3] = region;
      data[8 * box + 7] = Math.round(red) + 256 * Math.round(green) + 65536 * Math.round(blue);
    }
  }

  forEachPiece(take: (piece: Piece) => void, only?: { cell: number; box: number }): void {
    if (!this.object.visible || !this.faces.visible) return;
    for (let box = 0; box < this.count; box++) {
      if (only && only.box !== box) continue;
      const [x, y, z, region, dx, dy, dz, packed] = this.boxes.data.subarray(8 * box, 8 * box + 8);
      const corner = (bits: number) => [x + (bits & 1) * dx, y + ((bits >> 1) & 1) * dy, z + (bits >> 2) * dz];
      const color = paler([packed & 255, (packed >> 8) & 255, packed >> 16] as Rgb);
      const middle = [x + dx / 2, y + dy / 2, z + dz / 2];
      for (let at = 0; at < triangleCorners.length; at += 3) {
        take({ corners: triangleCorners.slice(at, at + 3).flatMap(corner), cell: -1, middle, region, color, ownPlane: -1 });
      }
    }
  }
}

/** Lets a geometry draw so many boxes. */
function setRange(geometry: BufferGeometry, corners: readonly number[], boxes: number): void {
  const length = corners.length;
  const room = (geometry.index?.count ?? 0) / length;
  if (boxes > room) {
    const index = new Uint32Array(length * Math.max(boxes, 2 * room));
    for (let at = 0; at < index.length; at++) index[at] = 8 * Math.floor(at / length) + corners[at % length];
    geometry.dispose();
    geometry.setIndex(new BufferAttribute(index, 1));
  }
  geometry.setDrawRange(0, length * boxes);
}

/** Untouched grid cells that are shown and not hidden behind six others. */
function seenBoxes(look: Look): Uint32Array {
  const { model, settings } = look;
  const solid = solidCells(look);
  let shown = 0;
  for (let at = 0; at < solid.length; at++) shown += solid[at];
  const drawAll = settings.explode.cells > 0 && shown <= mostBoxes;
  const boxes = new Uint32Array(shown);
  const [nx, ny, nz] = model.grid.cells;
  let count = 0;
  for (let k = 0, at = 0; k < nz; k++) {
    for (let j = 0; j < ny; j++) {
      const isRim = j === 0 || j === ny - 1 || k === 0 || k === nz - 1;
      for (let i = 0; i < nx; i++, at++) {
        if (!solid[at]) continue;
        const isInner = !drawAll && !isRim && i > 0 && i < nx - 1;
        const beside = () => solid[at - 1] & solid[at + 1] & solid[at - nx] & solid[at + nx] & solid[at - nx * ny] & solid[at + nx * ny];
        if (!isInner || !beside()) boxes[count++] = at;
      }
    }
  }
  return boxes.slice(0, count);
}

/** 1 per untouched grid cell of a shown region that the planes keep: its middle, or in a flat cut any of it. */
function solidCells({ model, settings, regions, planes }: Look): Uint8Array {
  const { grid, origin, gridCellRegion } = model;
  const flat = settings.sliceMode === 'flat';
  const [nx, ny, nz] = grid.cells;
  const solid = new Uint8Array(gridCellRegion.length);
  // normal . x is a sum of one term per axis.
  const termsOf = (n: number, d: number) => {
    return Float64Array.from({ length: grid.cells[d] }, (_, c) => n * (pointOf(grid.planes[d], c, n) - origin[d]));
  };
  const terms = planes.map(({ normal }) => normal.map(termsOf));
  function pointOf(axis: Float64Array, c: number, n: number): number {
    if (!flat) return (axis[c] + axis[c + 1]) / 2;
    return n > 0 ? axis[c] : axis[c + 1];
  }
  for (let k = 0, at = 0; k < nz; k++) {
    for (let j = 0; j < ny; j++) {
      const rests = planes.map(({ offset }, p) => offset - terms[p][1][j] - terms[p][2][k]);
      for (let i = 0; i < nx; i++, at++) {
        const region = gridCellRegion[at];
        if (region < 0 || !regions[region]) continue;
        let kept = 1;
        for (let p = 0; p < rests.length; p++) if (terms[p][0][i] > rests[p] || (flat && terms[p][0][i] === rests[p])) kept = 0;
        solid[at] = kept;
      }
    }
  }
  return solid;
}
