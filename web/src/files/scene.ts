import { InstancedMesh, Matrix4, Mesh, type BufferGeometry, type Object3D } from 'three';
import { flipped, merged, type MeshArrays } from '../gallery/mesh';
import { Flaw } from './flaw';

/** Triangles of a geometry moved by a matrix; those of a mirrored one are turned, so that their outer side stays outside. */
function moved(geometry: BufferGeometry, matrix: Matrix4, name: string): MeshArrays {
  const source = geometry.getAttribute('position');
  const m = matrix.elements;
  const positions = new Float64Array(3 * source.count);
  for (let v = 0; v < source.count; ++v) {
    const [x, y, z] = [source.getX(v), source.getY(v), source.getZ(v)];
    for (let d = 0; d < 3; ++d) {
      const value = m[d] * x + m[4 + d] * y + m[8 + d] * z + m[12 + d];
      if (!Number.isFinite(value)) throw new Flaw(`${name}: point ${v} has a coordinate that is not a finite number.`);
      positions[3 * v + d] = value;
    }
  }
  const corners = geometry.index ?? null;
  const count = Math.floor((corners ? corners.count : source.count) / 3) * 3;
  const triangles = Uint32Array.from({ length: count }, (_, k) => (corners ? corners.getX(k) : k));
  const wrong = triangles.findIndex((v) => v >= source.count);
  if (wrong >= 0) {
    const triangle = Math.floor(wrong / 3);
    throw new Flaw(`${name}: triangle ${triangle} names point ${triangles[wrong]}, but there are ${source.count} points, numbered from 0.`);
  }
  return matrix.determinant() < 0 ? flipped({ positions, triangles }) : { positions, triangles };
}

/** All triangles of what one of three's loaders made, each mesh at its place. Points and lines are left out. */
export function sceneTriangles(root: Object3D): MeshArrays {
  root.updateMatrixWorld(true);
  const parts: MeshArrays[] = [];
  root.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    const name = object.name ? `Mesh "${object.name}"` : 'A mesh';
    if (!object.geometry.getAttribute('position')) return;
    if (!(object instanceof InstancedMesh)) return void parts.push(moved(object.geometry, object.matrixWorld, name));
    const instance = new Matrix4();
    for (let k = 0; k < object.count; ++k) {
      object.getMatrixAt(k, instance);
      parts.push(moved(object.geometry, instance.premultiply(object.matrixWorld), name));
    }
  });
  return parts.length === 1 ? parts[0] : merged(...parts);
}
