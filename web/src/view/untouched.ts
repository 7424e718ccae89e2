// The untouched grid cells as instanced boxes.
import { BoxGeometry, EdgesGeometry, Group, InstancedBufferAttribute, InstancedBufferGeometry, LineSegments, Mesh } from 'three';
import type { Model, Settings } from '../types';
import { untouchedColors, type Rgb } from './colors';
import { makeMaterial, type Uniforms } from './material';
import { paler, type Piece } from './piece';
import type { ViewPlane } from './planes';

/**
 * Boxes drawn at most when cells are pulled apart and any box might be seen through the gaps: all of a 50^3 grid, 1.8 million triangles. Of a larger
 * grid only boxes that also are seen when nothing is pulled apart are drawn: their number grows with the surface, about 10^5 for 128^3, and
 * what is missing lies behind them.
 */
const mostBoxes = 150_000;

export class Untouched {
  readonly group = new Group();
  readonly pick: Mesh;
  count = 0;
  private readonly faces: Mesh;
  private readonly lines: LineSegments;
  private readonly box = new BoxGeometry().translate(0.5, 0.5, 0.5);
  private readonly frame = new EdgesGeometry(this.box);

  constructor(uniforms: Uniforms) {
    this.faces = new Mesh(new InstancedBufferGeometry(), makeMaterial('BOXES', 'FACES', uniforms));
    this.pick = new Mesh(this.faces.geometry, makeMaterial('BOXES', 'PICK', uniforms));
    this.lines = new LineSegments(new InstancedBufferGeometry(), makeMaterial('BOXES', 'LINES', uniforms));
    this.lines.renderOrder = 1;
    for (const object of [this.faces, this.pick, this.lines]) object.frustumCulled = false;
    this.group.add(this.faces, this.lines);
  }

  setLook(model: Model, settings: Settings, regions: Uint8Array, planes: readonly ViewPlane[]): void {
    const { show, explode, sliceMode } = settings;
    const wanted = show.untouched && (show.gridFaces || show.edges);
    const boxes = wanted ? seenBoxes(model, regions, planes, sliceMode === 'flat', explode.cells > 0) : new Uint32Array(0);
    this.count = boxes.length;
    this.group.visible = this.pick.visible = this.count > 0;
    this.faces.visible = show.gridFaces;
    this.lines.visible = show.edges;
    this.setBoxes(model, boxes, untouchedColors(model, settings.colorBy));
  }

  forEachPiece(take: (piece: Piece) => void): void {
    if (!this.group.visible || !this.faces.visible) return;
    const { low, size, region, tint } = this.faces.geometry.attributes;
    const { array } = this.box.getAttribute('position');
    const corners = Array.from(this.box.getIndex()?.array ?? [], (vertex) => array.slice(3 * vertex, 3 * vertex + 3));
    for (let box = 0; box < this.count; box++) {
      const at = (unit: ArrayLike<number>) => [0, 1, 2].map((d) => low.array[3 * box + d] + unit[d] * size.array[3 * box + d]);
      const color = paler(tint.array.subarray(4 * box, 4 * box + 3) as unknown as Rgb);
      const middle = at([0.5, 0.5, 0.5]);
      for (let corner = 0; corner < corners.length; corner += 3) {
        take({ corners: corners.slice(corner, corner + 3).flatMap(at), middle, region: region.array[box], color, ownPlane: -1 });
      }
    }
  }

  private setBoxes(model: Model, boxes: Uint32Array, colorOf: ReturnType<typeof untouchedColors>): void {
    const low = new Float32Array(3 * boxes.length);
    const size = new Float32Array(3 * boxes.length);
    const region = new Float32Array(boxes.length);
    const tint = new Uint8Array(4 * boxes.length);
    const { grid, origin, gridCellRegion } = model;
    const [nx, ny] = grid.cells;
    boxes.forEach((gridCell, box) => {
      const at = [gridCell % nx, Math.floor(gridCell / nx) % ny, Math.floor(gridCell / (nx * ny))];
      for (let d = 0; d < 3; d++) {
        low[3 * box + d] = grid.planes[d][at[d]] - origin[d];
        size[3 * box + d] = grid.planes[d][at[d] + 1] - grid.planes[d][at[d]];
      }
      region[box] = gridCellRegion[gridCell];
      tint.set(colorOf(gridCell, region[box]), 4 * box);
    });
    const attributes = {
      low: new InstancedBufferAttribute(low, 3),
      size: new InstancedBufferAttribute(size, 3),
      region: new InstancedBufferAttribute(region, 1),
      tint: new InstancedBufferAttribute(tint, 4, true),
    };
    this.faces.geometry.dispose();
    this.lines.geometry.dispose();
    this.faces.geometry = this.pick.geometry = instanced(this.box, attributes, boxes.length);
    this.lines.geometry = instanced(this.frame, attributes, boxes.length);
  }
}

function instanced(base: BoxGeometry | EdgesGeometry, attributes: Record<string, InstancedBufferAttribute>, count: number): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.index = base.index;
  geometry.setAttribute('position', base.getAttribute('position'));
  for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
  geometry.instanceCount = count;
  return geometry;
}

/** Untouched grid cells that are shown and not hidden behind six others. */
function seenBoxes(model: Model, regions: Uint8Array, planes: readonly ViewPlane[], flat: boolean, pulledApart: boolean): Uint32Array {
  const solid = solidCells(model, regions, planes, flat);
  const shown = solid.reduce((sum, x) => sum + x, 0);
  const drawAll = pulledApart && shown <= mostBoxes;
  const boxes = new Uint32Array(shown);
  const [nx, ny, nz] = model.grid.cells;
  let count = 0;
  for (let k = 0, at = 0; k < nz; k++) {
    for (let j = 0; j < ny; j++) {
      const isRim = j === 0 || j === ny - 1 || k === 0 || k === nz - 1;
      for (let i = 0; i < nx; i++, at++) {
        if (!solid[at]) continue;
        const isHidden =
          !drawAll && !isRim && i > 0 && i < nx - 1 && solid[at - 1] && solid[at + 1] && solid[at - nx] && solid[at + nx] && solid[at - nx * ny] && solid[at + nx * ny];
        if (!isHidden) boxes[count++] = at;
      }
    }
  }
  return boxes.slice(0, count);
}

/** 1 per untouched grid cell of a shown region that the planes keep: its middle, or in a flat cut any of it. */
function solidCells(model: Model, regions: Uint8Array, planes: readonly ViewPlane[], flat: boolean): Uint8Array {
  const { grid, origin, gridCellRegion } = model;
  const [nx, ny, nz] = grid.cells;
  const solid = new Uint8Array(gridCellRegion.length);
  // normal . x is a sum of one term per axis.
  const terms = planes.map(({ normal }) => normal.map((n, d) => Float64Array.from({ length: grid.cells[d] }, (_, c) => n * (pointOf(grid.planes[d], c, n) - origin[d]))));
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
