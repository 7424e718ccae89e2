// The filled polygons where slice planes cut cells flat.
import { Group, LineSegments, Mesh, type BufferGeometry } from 'three';
import type { Slice } from 'mandoline-wasm';
import type { Model } from '../../../model/cut_model';
import type { Settings } from '../../../model/settings';
import { emptyGeometry, refill } from '../buffers';
import { insideColor, untouchedColors, type Rgb } from '../colors';
import type { Layer, Look } from '../layer';
import { gridStroke, makeMaterial, type Uniforms } from '../material';
import type { Piece } from '../piece';
import { hasWhole } from '../../../model/volumes';
import type { CutCells } from './cut_cells';

interface Cap {
  faces: Mesh;
  pick: Mesh;
  lines: LineSegments;
}

export class Caps implements Layer {
  readonly object = new Group();
  readonly pick = new Group();
  /** Polygons drawn. */
  count = 0;
  private readonly caps: Cap[];

  constructor(
    uniforms: Uniforms,
    private readonly cells: CutCells,
  ) {
    this.caps = [0, 1, 2, 3].map((ownPlane) => this.makeCap(uniforms, ownPlane));
  }

  private makeCap(uniforms: Uniforms, ownPlane: number): Cap {
    const own = { ownPlane: { value: ownPlane } };
    const faces = new Mesh(emptyGeometry(), makeMaterial('CAPS', 'FACES', uniforms, own));
    const pick = new Mesh(faces.geometry, makeMaterial('CAPS', 'PICK', uniforms, own));
    const lines = new LineSegments(emptyGeometry(), makeMaterial('CAPS', 'LINES', uniforms, { ...own, ...gridStroke(uniforms) }));
    for (const object of [faces, pick, lines]) object.frustumCulled = false;
    this.object.add(faces, lines);
    this.pick.add(pick);
    return { faces, pick, lines };
  }

  dependsOn({ model, settings: { show, volumes, colorBy }, caps }: Look): readonly unknown[] {
    return [model.id, show, volumes, colorBy, caps.id];
  }

  /** Draws the polygons of cells that are shown. */
  setLook(look: Look): void {
    const { model, settings, caps } = look;
    this.count = 0;
    this.caps.forEach((cap, p) => {
      const slice = caps.slices[p];
      cap.faces.visible = cap.pick.visible = slice !== undefined;
      cap.lines.visible = slice !== undefined && settings.show.edges;
      if (!slice) return;
      const { polygons, ...table } = this.section(look, slice);
      this.count += polygons.length;
      fillCap(cap.faces.geometry, model, slice, table, trianglePoints(slice, polygons));
      fillCap(cap.lines.geometry, model, slice, table, outlinePoints(slice, polygons));
    });
  }

  /** The polygons of a slice that are shown, and their looks. */
  section({ model, settings, regions }: Look, slice: Slice): Section {
    const { cells } = this;
    const showsUntouched = settings.show.untouched && hasWhole(settings.volumes);
    const isShown = (cell: number, region: number) => (cell >= 0 ? cells.isShown(cell) : showsUntouched && regions[region] > 0);
    const polygons = Array.from(slice.polygonCell.keys()).filter((polygon) => {
      return isShown(slice.polygonCell[polygon], slice.polygonRegion[polygon]);
    });
    return { polygons, ...polygonTable(model, settings, cells, slice) };
  }

  forEachPiece(take: (piece: Piece) => void, only?: { cell: number; box: number }): void {
    if (only && only.box >= 0) return;
    this.caps.forEach(({ faces }, ownPlane) => {
      if (!faces.visible) return;
      const { position, center, region, tint, owner } = faces.geometry.attributes;
      for (let vertex = 0; vertex < faces.geometry.drawRange.count; vertex += 3) {
        if (only && owner.array[vertex] !== only.cell) continue;
        take({
          corners: Array.from(position.array.subarray(3 * vertex, 3 * vertex + 9)),
          middle: center.array.subarray(3 * vertex, 3 * vertex + 3),
          cell: owner.array[vertex],
          region: region.array[vertex],
          color: tint.array.subarray(4 * vertex, 4 * vertex + 3) as unknown as Rgb,
          ownPlane,
        });
      }
    });
  }
}

/** What all points of a polygon share. */
interface PolygonTable {
  /** 3 per polygon: the centre of its cell. */
  center: Float32Array;
  /** 4 per polygon. */
  tint: Uint8Array;
}

interface Section extends PolygonTable {
  polygons: readonly number[];
}

function polygonTable(model: Model, settings: Settings, cells: CutCells, slice: Slice): PolygonTable {
  const { grid, origin } = model;
  const [nx, ny] = grid.cells;
  const colorOf = untouchedColors(model, settings.colorBy);
  const { polygonCell, polygonGridCell, polygonRegion } = slice;
  const center = new Float32Array(3 * polygonCell.length);
  const tint = new Uint8Array(4 * polygonCell.length).fill(255);
  polygonCell.forEach((cell, polygon) => {
    if (cell >= 0) {
      center.set(model.cells.centroid.subarray(3 * cell, 3 * cell + 3), 3 * polygon);
      tint.set(settings.colorBy === 'kind' ? insideColor : cells.colorOf(cell), 4 * polygon);
      return;
    }
    const [i, j, k] = polygonGridCell.subarray(3 * polygon, 3 * polygon + 3);
    [i, j, k].forEach((c, d) => (center[3 * polygon + d] = (grid.planes[d][c] + grid.planes[d][c + 1]) / 2 - origin[d]));
    tint.set(colorOf(i + nx * (j + ny * k), polygonRegion[polygon]), 4 * polygon);
  });
  return { center, tint };
}

/** Points to draw, and the polygon that each belongs to. */
interface Points {
  point: Uint32Array;
  polygon: Uint32Array;
}

function trianglePoints(slice: Slice, polygons: readonly number[]): Points {
  const { polygonTriangleOffsets: offsets, triangles } = slice;
  const count = 3 * polygons.reduce((sum, polygon) => sum + offsets[polygon + 1] - offsets[polygon], 0);
  const points: Points = { point: new Uint32Array(count), polygon: new Uint32Array(count) };
  let at = 0;
  for (const polygon of polygons) {
    const own = triangles.subarray(3 * offsets[polygon], 3 * offsets[polygon + 1]);
    points.point.set(own, at);
    points.polygon.fill(polygon, at, at + own.length);
    at += own.length;
  }
  return points;
}

function outlinePoints(slice: Slice, polygons: readonly number[]): Points {
  const { polygonLoopOffsets, loopOffsets, loopPoints } = slice;
  const beginOf = (polygon: number) => loopOffsets[polygonLoopOffsets[polygon]];
  const count = 2 * polygons.reduce((sum, polygon) => sum + beginOf(polygon + 1) - beginOf(polygon), 0);
  const points: Points = { point: new Uint32Array(count), polygon: new Uint32Array(count) };
  let at = 0;
  for (const polygon of polygons) {
    const begin = at;
    for (let loop = polygonLoopOffsets[polygon]; loop < polygonLoopOffsets[polygon + 1]; loop++) {
      let from = loopPoints[loopOffsets[loop + 1] - 1];
      for (let corner = loopOffsets[loop]; corner < loopOffsets[loop + 1]; corner++) {
        points.point[at++] = from;
        points.point[at++] = from = loopPoints[corner];
      }
    }
    points.polygon.fill(polygon, begin, at);
  }
  return points;
}

function fillCap(geometry: BufferGeometry, model: Model, slice: Slice, table: PolygonTable, { point, polygon }: Points): void {
  const position = new Float32Array(3 * point.length);
  const center = new Float32Array(3 * point.length);
  const tint = new Uint8Array(4 * point.length);
  const region = new Float32Array(point.length);
  const owner = new Float32Array(point.length);
  for (let at = 0; at < point.length; at++) {
    for (let d = 0; d < 3; d++) {
      position[3 * at + d] = slice.positions[3 * point[at] + d] - model.origin[d];
      center[3 * at + d] = table.center[3 * polygon[at] + d];
      tint[4 * at + d] = table.tint[4 * polygon[at] + d];
    }
    region[at] = slice.polygonRegion[polygon[at]];
    owner[at] = slice.polygonCell[polygon[at]];
  }
  refill(geometry, {
    position: { array: position, size: 3 },
    center: { array: center, size: 3 },
    region: { array: region, size: 1 },
    tint: { array: tint, size: 4, normalized: true },
    owner: { array: owner, size: 1 },
  });
}
