import { meshFromGeometry } from 'mandoline-wasm/three';
import { InstancedMesh, Matrix4, Mesh, type BufferGeometry, type Object3D } from 'three';
import { merged, type MeshArrays } from '../model/gallery/mesh';

/** Triangles of a geometry moved by a matrix, without an incomplete last one. */
function moved(geometry: BufferGeometry, matrix: Matrix4, name: string): MeshArrays {
  const { positions, triangles } = meshFromGeometry(geometry, matrix);
  const infinite = positions.findIndex((x) => !Number.isFinite(x));
  if (infinite >= 0) throw new Error(`${name}: point ${Math.floor(infinite / 3)} has a coordinate that is not a finite number.`);
  const whole = triangles.subarray(0, triangles.length - (triangles.length % 3));
  const points = positions.length / 3;
  const wrong = whole.findIndex((v) => v >= points);
  if (wrong >= 0) {
    const triangle = Math.floor(wrong / 3);
    throw new Error(`${name}: triangle ${triangle} names point ${whole[wrong]}, but there are ${points} points, numbered from 0.`);
  }
  return { positions, triangles: whole };
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
