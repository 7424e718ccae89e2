// The triangles of what three.js draws, and its loaders make: a whole scene, or a part of one.
import { bad, kindOf } from './arguments.js';
import { named } from './errors.js';
import { meshFromGeometry, moved } from './geometry-mesh.js';

const called = (object) => (object.name ? `Mesh "${object.name}"` : `A mesh without a name (${object.type})`);

/** As the vertex shader would have them, before the matrix of the mesh: by morph targets and bones. */
function deformedPositions(object) {
  const { count } = object.geometry.attributes.position;
  const positions = new Float64Array(3 * count);
  const place = object.position.clone();
  for (let i = 0; i < count; ++i) object.getVertexPosition(i, place).toArray(positions, 3 * i);
  return positions;
}

/** What can be drawn of a geometry: a last triangle that lacks corners is left out, as three does. */
function trianglesOf(object) {
  const mesh = meshFromGeometry(object.geometry);
  const triangles = mesh.triangles.subarray(0, mesh.triangles.length - (mesh.triangles.length % 3));
  const count = mesh.positions.length / 3;
  const wrong = triangles.findIndex((id) => id >= count);
  if (wrong >= 0) {
    const triangle = Math.floor(wrong / 3);
    const message = `${called(object)}: triangle ${triangle} refers to vertex ${triangles[wrong]}, but there are ${count}, from 0 on.`;
    throw bad(message, 'badIndex', triangle);
  }
  const isDeformed = object.isSkinnedMesh || Object.keys(object.geometry.morphAttributes).includes('position');
  return { positions: isDeformed ? deformedPositions(object) : mesh.positions, triangles };
}

/** A mesh of an Object3D: one part, or one for each instance. */
function partsOf(object) {
  const name = called(object);
  if (object.isBatchedMesh) {
    const message = `${name} is a BatchedMesh, which meshFromObject does not take: give the meshes that it was made of.`;
    throw bad(message);
  }
  const matrices = Array.from({ length: object.isInstancedMesh ? object.count : 1 }, (_, k) => {
    const matrix = object.matrixWorld.clone();
    if (object.isInstancedMesh) object.getMatrixAt(k, matrix);
    return object.isInstancedMesh ? matrix.premultiply(object.matrixWorld) : matrix;
  });
  const mesh = trianglesOf(object);
  return matrices.map((matrix) => {
    const part = moved(mesh, matrix);
    const infinite = part.positions.findIndex((x) => !Number.isFinite(x));
    if (infinite < 0) return part;
    const vertex = Math.floor(infinite / 3);
    const message = `${name}: vertex ${vertex} has a coordinate that is not a finite number.`;
    throw bad(message, 'nonFiniteCoordinate', vertex);
  });
}

function merged(parts) {
  const sum = (key) => parts.reduce((length, part) => length + part[key].length, 0);
  const positions = new Float64Array(sum('positions'));
  const triangles = new Uint32Array(sum('triangles'));
  let [vertex, corner] = [0, 0];
  for (const part of parts) {
    positions.set(part.positions, 3 * vertex);
    for (const id of part.triangles) triangles[corner++] = vertex + id;
    vertex += part.positions.length / 3;
  }
  return { positions, triangles };
}

/** The meshes of an object: itself, and those visible in it. */
function meshesIn(object) {
  const meshes = [];
  const add = (child) => {
    if (child.isBatchedMesh || (child.isMesh && child.geometry?.attributes?.position)) meshes.push(child);
    for (const inner of child.children) if (inner.visible) add(inner);
  };
  add(object);
  return meshes;
}

export const meshFromObject = named('meshFromObject', (object) => {
  if (!object?.isObject3D) {
    const hint = object?.scene?.isObject3D ? ': give its scene' : '';
    throw bad(`object must be an Object3D of three.js, not ${kindOf(object)}${hint}.`);
  }
  let root = object;
  while (root.parent) root = root.parent;
  root.updateMatrixWorld(); // bones may lie elsewhere in the scene
  return merged(meshesIn(object).flatMap(partsOf));
});
