// What is shown, as a GLB file.
import { BufferGeometry, Color, Float32BufferAttribute, Group, Mesh, MeshStandardMaterial, Triangle, Vector3 } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';
import { integer } from '../../model/format';
import type { Model } from '../../model/cut_model';
import { pageError, type PageError } from '../../model/failure';
import { isBeyond } from '../../model/planes';
import type { ViewPlane } from '../../model/slices';
import { movedBy } from './explosion';
import type { Layer, Look } from './layer';
import type { Piece } from './piece';

/** More nodes than this take programs minutes to open. */
const mostNodes = 20_000;

/** As one mesh, or with a node for each cell. */
export async function exportGlb(look: Look, layers: readonly Layer[], isByCell: boolean): Promise<Blob> {
  const { name, origin } = look.model;
  const shapes = shownShapes(look, layers, isByCell);
  const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.8 });
  const model = new Group();
  for (const [node, shape] of shapes) {
    const mesh = shape.toMesh(node, material);
    if (mesh) model.add(mesh);
  }
  model.position.fromArray(origin);
  model.name = name;
  const bytes = await new GLTFExporter().parseAsync(model, { binary: true });
  return new Blob([bytes as ArrayBuffer], { type: 'model/gltf-binary' });
}

function tooManyNodes(): PageError {
  const advice = 'Show fewer of them, or save the GLB in which all visible geometry is one object.';
  return pageError('Too many cells for an object each', `More than ${integer(mostNodes)} are shown. ${advice}`);
}

function cellName({ grid, origin }: Model, { cell, middle }: Piece): string {
  if (cell >= 0) return `cell ${cell}`;
  const gridCell = grid.planes.map((planes, d) => planes.findLastIndex((plane) => plane < middle[d] + origin[d]));
  return `grid cell ${gridCell.join(' ')}`;
}

/** Triangles about a place, with flat normals and linear colours. */
class Shape {
  private readonly position: number[] = [];
  private readonly normal: number[] = [];
  private readonly color: number[] = [];
  private readonly triangle = new Triangle();
  private readonly facing = new Vector3();

  constructor(private readonly middle: readonly number[]) {}

  /** A convex polygon about the same place. */
  add(polygon: Float32Array, { r, g, b }: Color): void {
    const { triangle, facing } = this;
    for (let last = 6; last < polygon.length; last += 3) {
      triangle.set(triangle.a.fromArray(polygon), triangle.b.fromArray(polygon, last - 3), triangle.c.fromArray(polygon, last));
      // A triangle that 32 bits have made degenerate has no normal, and can't be seen.
      if (triangle.getNormal(facing).lengthSq() === 0) continue;
      for (const corner of [triangle.a, triangle.b, triangle.c]) {
        this.position.push(corner.x, corner.y, corner.z);
        this.normal.push(facing.x, facing.y, facing.z);
        this.color.push(r, g, b);
      }
    }
  }

  /** Nothing if all of it was cut away. */
  toMesh(name: string, material: MeshStandardMaterial): Mesh | null {
    if (this.position.length === 0) return null;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(this.position, 3));
    geometry.setAttribute('normal', new Float32BufferAttribute(this.normal, 3));
    geometry.setAttribute('color', new Float32BufferAttribute(this.color, 3));
    const mesh = new Mesh(geometry, material);
    mesh.position.fromArray(this.middle);
    mesh.name = name;
    return mesh;
  }
}

/** The triangles that the planes leave, moved by the explosions, by the names of their nodes: all in one, or each cell about its middle. */
function shownShapes(look: Look, layers: readonly Layer[], isByCell: boolean): Map<string, Shape> {
  const { model, settings, planes } = look;
  const isFlat = settings.sliceMode === 'flat';
  const shapes = new Map<string, Shape>();
  const color = new Color();
  const put = (piece: Piece) => {
    const { middle, region } = piece;
    if (!isFlat && isBeyond(planes, middle[0], middle[1], middle[2])) return;
    const polygon = isFlat ? clipped(piece, planes) : piece.corners;
    if (polygon.length === 0) return;
    color.setRGB(piece.color[0] / 255, piece.color[1] / 255, piece.color[2] / 255, 'srgb');
    const shift = movedBy(look, middle, region);
    const name = isByCell ? cellName(model, piece) : model.name;
    const center = isByCell ? shift.map((x, d) => x + middle[d]) : [0, 0, 0];
    const shape = shapes.get(name) ?? new Shape(center);
    shapes.set(name, shape);
    if (shapes.size > mostNodes) throw tooManyNodes();
    shape.add(
      Float32Array.from(polygon, (x, at) => x + shift[at % 3] - center[at % 3]),
      color,
    );
  };
  for (const layer of layers) layer.forEachPiece?.(put);
  return shapes;
}

/** The part of a triangle that all planes but its own leave: a convex polygon, maybe empty. */
function clipped({ corners, ownPlane }: Piece, planes: readonly ViewPlane[]): readonly number[] {
  let polygon = corners;
  planes.forEach((plane, p) => {
    if (p !== ownPlane) polygon = clip(polygon, plane);
  });
  return polygon;
}

function clip(polygon: readonly number[], { normal, offset }: ViewPlane): readonly number[] {
  const height = (at: number) => normal[0] * polygon[at] + normal[1] * polygon[at + 1] + normal[2] * polygon[at + 2] - offset;
  const kept: number[] = [];
  for (let from = 0; from < polygon.length; from += 3) {
    const to = (from + 3) % polygon.length;
    const [a, b] = [height(from), height(to)];
    if (a <= 0) kept.push(polygon[from], polygon[from + 1], polygon[from + 2]);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      for (let d = 0; d < 3; d++) kept.push(polygon[from + d] + (a / (a - b)) * (polygon[to + d] - polygon[from + d]));
    }
  }
  return kept;
}
