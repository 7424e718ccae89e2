// The filled polygons where slice planes cut cells flat.
import { BufferAttribute, BufferGeometry, Group, LineSegments, Mesh } from 'three';
import type { Slice } from 'mandoline-wasm';
import type { Model, Settings } from '../types';
import { insideColor, untouchedColors, type Rgb } from './colors';
import type { CutCells } from './cut_cells';
import { makeMaterial, type Uniforms } from './material';
import type { Piece } from './piece';

interface Cap {
  faces: Mesh;
  pick: Mesh;
  lines: LineSegments;
}

export class Caps {
  readonly group = new Group();
  readonly pick = new Group();
  /** Polygons drawn. */
  count = 0;
  private readonly caps: Cap[];

  constructor(uniforms: Uniforms) {
    this.caps = [0, 1, 2, 3].map((ownPlane) => this.makeCap(uniforms, ownPlane));
  }

  private makeCap(uniforms: Uniforms, ownPlane: number): Cap {
    const own = { ownPlane: { value: ownPlane } };
    const faces = new Mesh(new BufferGeometry(), makeMaterial('CAPS', 'FACES', uniforms, own));
    const pick = new Mesh(faces.geometry, makeMaterial('CAPS', 'PICK', uniforms, own));
    const lines = new LineSegments(new BufferGeometry(), makeMaterial('CAPS', 'LINES', uniforms, own));
    lines.renderOrder = 1;
    for (const object of [faces, pick, lines]) object.frustumCulled = false;
    this.group.add(faces, lines);
    this.pick.add(pick);
    return { faces, pick, lines };
  }

  /** Takes the slices by the planes in their order, of which the polygons of shown cells are drawn. */
  set(model: Model, settings: Settings, regions: Uint8Array, cells: CutCells, slices: readonly Slice[]): void {
    const isShown = (cell: number, region: number) => (cell >= 0 ? cells.isShown(cell) : settings.show.untouched && regions[region] > 0);
    this.count = 0;
    this.caps.forEach((cap, p) => {
      const slice = slices[p];
      cap.faces.visible = cap.pick.visible = slice !== undefined;
      cap.lines.visible = slice !== undefined && settings.show.edges;
      if (!slice) return;
      const polygons = Array.from(slice.polygonCell.keys()).filter((polygon) => isShown(slice.polygonCell[polygon], slice.polygonRegion[polygon]));
      this.count += polygons.length;
      const about = polygonAttributes(model, settings, cells, slice);
      replace(cap.faces, capGeometry(model, slice, about, polygons, trianglePoints));
      cap.pick.geometry = cap.faces.geometry;
      replace(cap.lines, capGeometry(model, slice, about, polygons, outlinePoints));
    });
  }

  forEachPiece(take: (piece: Piece) => void): void {
    this.caps.forEach(({ faces }, ownPlane) => {
      if (!faces.visible) return;
      const { position, center, region, tint } = faces.geometry.attributes;
      for (let vertex = 0; vertex < region.count; vertex += 3) {
        take({
          corners: Array.from(position.array.subarray(3 * vertex, 3 * vertex + 9)),
          middle: center.array.subarray(3 * vertex, 3 * vertex + 3),
          region: region.array[vertex],
          color: tint.array.subarray(4 * vertex, 4 * vertex + 3) as unknown as Rgb,
          ownPlane,
        });
      }
    });
  }
}

function replace(object: Mesh | LineSegments, geometry: BufferGeometry): void {
  object.geometry.dispose();
  object.geometry = geometry;
}

/** What all points of a polygon share. */
interface PolygonAttributes {
  center: (polygon: number) => ArrayLike<number>;
  tint: (polygon: number) => ArrayLike<number>;
}

function polygonAttributes(model: Model, settings: Settings, cells: CutCells, slice: Slice): PolygonAttributes {
  const { grid, origin } = model;
  const [nx, ny] = grid.cells;
  const colorOf = untouchedColors(model, settings.colorBy);
  const gridCell = (polygon: number) => slice.polygonGridCell.subarray(3 * polygon, 3 * polygon + 3);
  return {
    center: (polygon) => {
      const cell = slice.polygonCell[polygon];
      if (cell >= 0) return model.cells.centroid.subarray(3 * cell, 3 * cell + 3);
      return Array.from(gridCell(polygon), (c, d) => (grid.planes[d][c] + grid.planes[d][c + 1]) / 2 - origin[d]);
    },
    tint: (polygon) => {
      const cell = slice.polygonCell[polygon];
      if (cell >= 0) return settings.colorBy === 'kind' ? insideColor : cells.looks.subarray(4 * cell, 4 * cell + 3);
      const [i, j, k] = gridCell(polygon);
      return colorOf(i + nx * (j + ny * k), slice.polygonRegion[polygon]);
    },
  };
}

function* trianglePoints(slice: Slice, polygon: number): Generator<number> {
  for (let at = 3 * slice.polygonTriangleOffsets[polygon]; at < 3 * slice.polygonTriangleOffsets[polygon + 1]; at++) yield slice.triangles[at];
}

function* outlinePoints(slice: Slice, polygon: number): Generator<number> {
  for (let loop = slice.polygonLoopOffsets[polygon]; loop < slice.polygonLoopOffsets[polygon + 1]; loop++) {
    const points = slice.loopPoints.subarray(slice.loopOffsets[loop], slice.loopOffsets[loop + 1]);
    for (let at = 0; at < points.length; at++) {
      yield points[at];
      yield points[(at + 1) % points.length];
    }
  }
}

function capGeometry(
  model: Model,
  slice: Slice,
  about: PolygonAttributes,
  polygons: readonly number[],
  pointsOf: (slice: Slice, polygon: number) => Iterable<number>,
): BufferGeometry {
  const position: number[] = [];
  const center: number[] = [];
  const region: number[] = [];
  const tint: number[] = [];
  const owner: number[] = [];
  for (const polygon of polygons) {
    const c = about.center(polygon);
    const t = about.tint(polygon);
    for (const point of pointsOf(slice, polygon)) {
      for (let d = 0; d < 3; d++) position.push(slice.positions[3 * point + d] - model.origin[d]);
      center.push(c[0], c[1], c[2]);
      tint.push(t[0], t[1], t[2], 255);
      region.push(slice.polygonRegion[polygon]);
      owner.push(slice.polygonCell[polygon]);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(position), 3));
  geometry.setAttribute('center', new BufferAttribute(new Float32Array(center), 3));
  geometry.setAttribute('region', new BufferAttribute(new Float32Array(region), 1));
  geometry.setAttribute('tint', new BufferAttribute(new Uint8Array(tint), 4, true));
  geometry.setAttribute('owner', new BufferAttribute(new Float32Array(owner), 1));
  return geometry;
}
