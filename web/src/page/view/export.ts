// What is shown, as a GLB file.
import { BufferGeometry, Color, Float32BufferAttribute, Mesh, MeshStandardMaterial, Triangle, Vector3 } from 'three';
import type { Layer, Look } from './layer';
import type { Piece } from './piece';
import { isBeyond, type ViewPlane } from '../../model/planes';

export function loadGltfExporter() {
  return import('three/examples/jsm/exporters/GLTFExporter.js');
}

export async function exportGlb(look: Look, layers: readonly Layer[]): Promise<Blob> {
  const mesh = new Mesh(shownTriangles(look, layers), new MeshStandardMaterial({ vertexColors: true, roughness: 0.8 }));
  mesh.position.fromArray(look.model.origin);
  mesh.name = look.model.name;
  const { GLTFExporter } = await loadGltfExporter();
  const bytes = await new GLTFExporter().parseAsync(mesh, { binary: true });
  return new Blob([bytes as ArrayBuffer], { type: 'model/gltf-binary' });
}

/** The triangles that the planes leave, moved by the explosions, with flat normals and linear colours. */
function shownTriangles({ settings, planes, shifts }: Look, layers: readonly Layer[]): BufferGeometry {
  const isFlat = settings.sliceMode === 'flat';
  const position: number[] = [];
  const normal: number[] = [];
  const color: number[] = [];
  const linear = new Color();
  const triangle = new Triangle();
  const facing = new Vector3();
  const put = (piece: Piece) => {
    if (!isFlat && isBeyond(planes, piece.middle[0], piece.middle[1], piece.middle[2])) return;
    const polygon = isFlat ? clipped(piece, planes) : piece.corners;
    linear.setRGB(piece.color[0] / 255, piece.color[1] / 255, piece.color[2] / 255, 'srgb');
    const shift = [0, 1, 2].map((d) => settings.explode.cells * piece.middle[d] + settings.explode.regions * shifts[3 * piece.region + d]);
    const moved = Float32Array.from(polygon, (x, at) => x + shift[at % 3]);
    for (let last = 6; last < moved.length; last += 3) {
      triangle.set(triangle.a.fromArray(moved), triangle.b.fromArray(moved, last - 3), triangle.c.fromArray(moved, last));
      // A triangle that 32 bits have made degenerate has no normal, and can't be seen.
      if (triangle.getNormal(facing).lengthSq() === 0) continue;
      for (const corner of [triangle.a, triangle.b, triangle.c]) {
        position.push(corner.x, corner.y, corner.z);
        normal.push(facing.x, facing.y, facing.z);
        color.push(linear.r, linear.g, linear.b);
      }
    }
  };
  for (const layer of layers) layer.forEachPiece?.(put);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(position, 3));
  geometry.setAttribute('normal', new Float32BufferAttribute(normal, 3));
  geometry.setAttribute('color', new Float32BufferAttribute(color, 3));
  return geometry;
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
