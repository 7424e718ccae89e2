// Smooth normals for the picture: at each corner of a triangle, the mean of the triangles around it that bend away from it only a little,
// so that creases stay.
import type { MeshArrays } from '../model/gallery';

/** The cosine of the sharpest bend that is smoothed. */
const sharpest = Math.SQRT1_2;
/** A corner where more triangles meet keeps its triangle's normal: a fan's apex has none that is better, and the work grows with the square. */
const mostAround = 64;

/** Unit normals of triangles' corners, 9 numbers per triangle, on the side of the triangle's own normal; 0 where it has no area. */
export function cornerNormals({ positions, triangles }: MeshArrays): Float32Array {
  const vertexOf = weldedCorners(positions, triangles);
  const { normal, angle } = facets(positions, triangles);
  const around = cornersAround(vertexOf, positions.length / 3);
  const normals = new Float32Array(3 * triangles.length);
  for (let corner = 0; corner < triangles.length; corner++) {
    const own = 3 * Math.floor(corner / 3);
    const nx = normal[own];
    const ny = normal[own + 1];
    const nz = normal[own + 2];
    const begin = around.offsets[vertexOf[corner]];
    const end = around.offsets[vertexOf[corner] + 1];
    let [x, y, z] = [nx, ny, nz];
    if (end - begin <= mostAround) {
      x = y = z = 0;
      for (let at = begin; at < end; at++) {
        const other = around.corners[at];
        const n = 3 * Math.floor(other / 3);
        const cosine = nx * normal[n] + ny * normal[n + 1] + nz * normal[n + 2];
        // A neighbour that is oriented the other way round bends as little.
        if (Math.abs(cosine) < sharpest) continue;
        const weight = cosine < 0 ? -angle[other] : angle[other];
        x += weight * normal[n];
        y += weight * normal[n + 1];
        z += weight * normal[n + 2];
      }
    }
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    normals[3 * corner] = x / length;
    normals[3 * corner + 1] = y / length;
    normals[3 * corner + 2] = z / length;
  }
  return normals;
}

/** Per triangle its unit normal, 0 without area; per corner its angle. */
function facets(positions: Float64Array, triangles: Uint32Array): { normal: Float32Array; angle: Float32Array } {
  const normal = new Float32Array(triangles.length);
  const angle = new Float32Array(triangles.length);
  const edge = new Float64Array(9);
  for (let corner = 0; corner < triangles.length; corner += 3) {
    for (let k = 0; k < 3; k++) {
      const from = 3 * triangles[corner + k];
      const to = 3 * triangles[corner + ((k + 1) % 3)];
      for (let d = 0; d < 3; d++) edge[3 * k + d] = positions[to + d] - positions[from + d];
    }
    const x = edge[1] * edge[5] - edge[2] * edge[4];
    const y = edge[2] * edge[3] - edge[0] * edge[5];
    const z = edge[0] * edge[4] - edge[1] * edge[3];
    const doubleArea = Math.sqrt(x * x + y * y + z * z);
    if (doubleArea === 0) continue;
    normal[corner] = x / doubleArea;
    normal[corner + 1] = y / doubleArea;
    normal[corner + 2] = z / doubleArea;
    for (let k = 0; k < 3; k++) {
      const out = 3 * k;
      const back = 3 * ((k + 2) % 3);
      const cosine = -(edge[out] * edge[back] + edge[out + 1] * edge[back + 1] + edge[out + 2] * edge[back + 2]);
      angle[corner + k] = Math.atan2(doubleArea, cosine);
    }
  }
  return { normal, angle };
}

/** Per corner, the lowest vertex at its place: files often have a vertex for each triangle. */
function weldedCorners(positions: Float64Array, triangles: Uint32Array): Uint32Array {
  const count = positions.length / 3;
  const mask = 2 ** Math.ceil(Math.log2(2 * count + 1)) - 1;
  const slots = new Int32Array(mask + 1).fill(-1);
  const welded = new Uint32Array(count);
  const places = Float64Array.from(positions, (x) => x + 0); // -0 is 0
  const bits = new Int32Array(places.buffer);
  for (let vertex = 0; vertex < count; vertex++) {
    let slot = 0;
    for (let at = 6 * vertex; at < 6 * vertex + 6; at++) slot = Math.imul(slot ^ bits[at], 0x9e3779b1) ^ (slot >>> 15);
    slot &= mask;
    while (slots[slot] >= 0 && !isSame(places, slots[slot], vertex)) slot = (slot + 1) & mask;
    if (slots[slot] < 0) slots[slot] = vertex;
    welded[vertex] = slots[slot];
  }
  return triangles.map((vertex) => welded[vertex]);
}

function isSame(positions: Float64Array, a: number, b: number): boolean {
  return (
    positions[3 * a] === positions[3 * b] && positions[3 * a + 1] === positions[3 * b + 1] && positions[3 * a + 2] === positions[3 * b + 2]
  );
}

/** The corners at each vertex, as offsets and items. */
function cornersAround(vertexOf: Uint32Array, vertices: number): { offsets: Uint32Array; corners: Uint32Array } {
  const offsets = new Uint32Array(vertices + 1);
  for (const vertex of vertexOf) offsets[vertex + 1]++;
  for (let vertex = 0; vertex < vertices; vertex++) offsets[vertex + 1] += offsets[vertex];
  const next = offsets.slice();
  const corners = new Uint32Array(vertexOf.length);
  vertexOf.forEach((vertex, corner) => (corners[next[vertex]++] = corner));
  return { offsets, corners };
}
