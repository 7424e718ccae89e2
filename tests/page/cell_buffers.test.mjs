// The buffers that the page draws: smooth normals with creases, and edges by kind.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { box, torus } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { galleryMesh, mandoline } from './reference.mjs';

const { cornerNormals } = await importBundled('worker/corner_normals.ts');
const { faceNormals } = await importBundled('worker/face_normals.ts');
const { cellBuffers } = await importBundled('worker/cell_buffers.ts');

const origin = [0.1, -0.2, 0.3];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
const three = (array, at) => Array.from(array.subarray(3 * at, 3 * at + 3));

/** The normal of the torus of radii 1 and 0.4 about z, at a point of it. */
function torusNormal([x, y, z]) {
  const around = Math.hypot(x, y);
  return unit([x - x / around, y - y / around, z]);
}

/** The same triangles, each with vertices of its own. */
function unshared({ positions, triangles }) {
  return {
    positions: Float64Array.from([...triangles].flatMap((vertex) => three(positions, vertex))),
    triangles: triangles.map((_, at) => at),
  };
}

/** The same triangles, every other one turned over. */
function turned({ positions, triangles }) {
  return {
    positions,
    triangles: triangles.map((vertex, at) => (at % 6 === 1 ? triangles[at + 1] : at % 6 === 2 ? triangles[at - 1] : vertex)),
  };
}

describe('normals at the corners of triangles', () => {
  const smooth = torus(48, 24);
  for (const [name, mesh] of Object.entries({
    'a torus': smooth,
    'triangles that share no vertices': unshared(smooth),
    'triangles turned over': turned(smooth),
  })) {
    test(`${name}: those of the surface`, () => {
      const normals = cornerNormals(mesh);
      mesh.triangles.forEach((vertex, corner) => {
        const isTurned = mesh.triangles !== smooth.triangles && name.endsWith('over') && corner % 6 < 3;
        const along = dot(three(normals, corner), torusNormal(three(mesh.positions, vertex)));
        assert.ok((isTurned ? -along : along) > 0.999, `corner ${corner}: ${along}`);
      });
    });
  }

  test('a box keeps its creases', () => {
    const mesh = box([0, 0, 0], [1, 2, 3]);
    const normals = cornerNormals(mesh);
    for (let corner = 0; corner < mesh.triangles.length; corner++) {
      const normal = three(normals, corner);
      assert.deepEqual(normal.map((x) => Math.abs(x)).sort(), [0, 0, 1]);
      assert.deepEqual(normal, three(normals, corner - (corner % 6)), 'one normal per side');
    }
  });

  test('a triangle without area has none', () => {
    const mesh = { positions: new Float64Array([0, 0, 0, 1, 0, 0, 2, 0, 0]), triangles: new Uint32Array([0, 1, 2]) };
    assert.deepEqual([...cornerNormals(mesh)], new Array(9).fill(0));
  });
});

function buffersOf(mesh, grid) {
  const cutMesh = mandoline.cut(mesh, grid);
  const normals = faceNormals(mesh, cornerNormals(mesh), cutMesh);
  return { cutMesh, ...cellBuffers(cutMesh, mandoline.triangulate(cutMesh), normals, origin) };
}

describe('buffers', () => {
  test('vertices at the surface have its normals, all others none', () => {
    const { triangles } = buffersOf(torus(96, 48), { cells: 10 });
    const atSurface = new Set(triangles.index.subarray(0, triangles.surfaceEnd));
    triangles.cell.forEach((_, vertex) => {
      const normal = Array.from(triangles.normal.subarray(4 * vertex, 4 * vertex + 4));
      if (!atSurface.has(vertex)) return assert.deepEqual(normal, [0, 0, 0, 0]);
      const point = three(triangles.position, vertex).map((x, d) => x + origin[d]);
      assert.ok(dot(unit(normal.slice(0, 3)), torusNormal(point)) > 0.995, `vertex ${vertex}`);
      return assert.equal(normal[3], 1);
    });
  });

  test('each side of a crease has vertices of its own', () => {
    const { triangles } = buffersOf(box([0, 0, 0], [1, 1, 1]), { min: [-0.5, -0.5, -0.5], max: [1.5, 1.5, 1.5], cells: [2, 2, 2] });
    for (let at = 0; at < triangles.surfaceEnd; at += 3) {
      const [a, b, c] = Array.from(triangles.index.subarray(at, at + 3), (vertex) => three(triangles.position, vertex));
      const [u, v] = [b.map((x, d) => x - a[d]), c.map((x, d) => x - a[d])];
      const facet = unit([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]);
      for (const vertex of triangles.index.subarray(at, at + 3)) {
        assert.ok(
          Math.abs(dot(facet, Array.from(triangles.normal.subarray(4 * vertex, 4 * vertex + 3)))) > 126.9,
          'normals are those of the sides',
        );
      }
    }
  });

  // Meshes without vertices or edges so near to a plane that 32 bits can't tell.
  for (const name of ['bunny', 'nested-spheres', 'noisy-sphere']) {
    test(`${name}: edges by kind, each once per cell`, async () => {
      const { cutMesh, triangles, edges } = buffersOf(await galleryMesh(name), { cells: 12 });
      const counts = { hybrid: edges.hybridEnd, grid: edges.gridEnd - edges.hybridEnd, tri: edges.index.length - edges.gridEnd };
      for (const [kind, count] of Object.entries(counts)) assert.ok(count > 0 && count % 2 === 0, `${count} ends of ${kind} edges`);
      const { planes } = cutMesh.grid;
      const isOn = (x, d) => planes[d].some((plane) => Math.fround(plane - origin[d]) === x);
      for (let at = 0; at < edges.index.length; at += 2) {
        const [from, to] = [edges.index[at], edges.index[at + 1]];
        assert.equal(triangles.cell[from], triangles.cell[to]);
        const [p, q] = [three(triangles.position, from), three(triangles.position, to)];
        const inPlanes = [0, 1, 2].filter((d) => p[d] === q[d] && isOn(p[d], d)).length;
        assert.equal(inPlanes, at < edges.hybridEnd ? 1 : at < edges.gridEnd ? 2 : 0, `edge ${at / 2}`);
      }
      const { faceLoopOffsets, loopOffsets } = cutMesh;
      const cornersOf = (face) => loopOffsets[faceLoopOffsets[face + 1]] - loopOffsets[faceLoopOffsets[face]];
      const ends = cutMesh.cellHalfFaces.reduce((sum, halfFace) => sum + cornersOf(halfFace >> 1), 0);
      assert.equal(edges.index.length, ends, 'an edge has two ends and is met by two half-faces of its cell');
    });
  }
});
