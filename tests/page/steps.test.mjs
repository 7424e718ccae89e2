import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { init } from 'mandoline-wasm';
import { importBundled } from './bundled.mjs';

const { stepPicture } = await importBundled('worker/steps/index.ts');
const { galleryMesh } = await importBundled('model/gallery/index.ts');
const mandoline = await init();
const kinds = ['triEdges', 'hybridEdges', 'triangleFaces', 'axialPlane', 'gridCell'];

async function subject(name, cells) {
  const mesh = await galleryMesh(name);
  const cutMesh = mandoline.cut(mesh, { cells });
  const faceTriangles = mandoline.triangulate(cutMesh);
  return { mesh, cutMesh, picture: (request, origin = [0, 0, 0]) => stepPicture(mesh, cutMesh, faceTriangles, request, origin) };
}

const minus = (a, b) => a.map((x, d) => x - b[d]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a.reduce((sum, x, d) => sum + x * b[d], 0);

function groups(position, size) {
  return Array.from({ length: position.length / (3 * size) }, (_, k) =>
    Array.from({ length: size }, (_, i) => Array.from(position.subarray(3 * (size * k + i), 3 * (size * k + i + 1)))),
  );
}

const area = (position) => groups(position, 3).reduce((sum, [a, b, c]) => sum + Math.hypot(...cross(minus(b, a), minus(c, a))) / 2, 0);
const volume = (position) => groups(position, 3).reduce((sum, [a, b, c]) => sum + dot(a, cross(b, c)) / 6, 0);
const about = (actual, expected) => assert.ok(Math.abs(actual - expected) < 1e-5 * Math.abs(expected), `${actual} is not ${expected}`);

// All made before the first suite: a runner may take a file for finished while it waits between suites.
const examples = [
  ['bunny', 16],
  ['bunny', 1],
  ['claw', 2],
  ['wavy-plane', 10],
  ['aligned-steps', 22],
  ['moebius-strip', 12],
];
const subjects = await Promise.all(examples.map(([name, cells]) => subject(name, cells)));

for (const [k, [name, cells]] of examples.entries()) {
  const { cutMesh, picture } = subjects[k];
  describe(`${name} at ${cells}`, () => {
    for (const kind of kinds) {
      test(kind, () => {
        const made = picture({ kind });
        assert.equal(made.kind, kind);
        assert.equal(made.choices.request.kind, kind);
        assert.deepEqual(
          made.choices.planes,
          cutMesh.grid.cells.map((n) => n + 1),
        );
        assert.ok(made.radius > 0 && made.center.every(Number.isFinite));
        for (const { position, color } of [made.lines, made.faces, made.points]) {
          assert.equal(position.length, color.length);
          assert.ok(position.every(Number.isFinite) && color.every((c) => c >= 0 && c <= 1.2));
        }
        assert.equal(made.lines.position.length % 6, 0);
        assert.equal(made.faces.position.length % 9, 0);
        assert.ok(made.lines.position.length > 0);
        assert.deepEqual(picture(made.choices.request), made);
      });
    }
  });
}

describe('what is drawn', () => {
  test('cut-faces cover their triangle', async () => {
    const { mesh, picture } = await subject('bunny', 32);
    const { faces, choices } = picture({ kind: 'triangleFaces' });
    const corner = (k) => 3 * mesh.triangles[3 * choices.request.triangle + k];
    const [a, b, c] = [0, 1, 2].map((k) => Array.from(mesh.positions.subarray(corner(k), corner(k) + 3)));
    // Each is drawn at 0.9 of its size.
    about(area(faces.position), (0.81 * Math.hypot(...cross(minus(b, a), minus(c, a)))) / 2);
  });

  test('the frame is the grid cells that hold the triangle, the grid cell, or all of the grid around an axial plane', async () => {
    const { mesh, cutMesh, picture } = await subject('bunny', 32);
    const { planes } = cutMesh.grid;
    const origin = [0.1, 0.2, 0.3];
    const indicesOf = ({ min, max }) =>
      [min, max].map((end) => end.map((x, d) => planes[d].findIndex((plane) => Math.abs(plane - x - origin[d]) < 1e-12)));
    const triangle = 100;
    for (const kind of ['triEdges', 'hybridEdges', 'triangleFaces']) {
      const [from, to] = indicesOf(picture({ kind, triangle }, origin).frame);
      for (let d = 0; d < 3; ++d) {
        const xs = [0, 1, 2].map((k) => mesh.positions[3 * mesh.triangles[3 * triangle + k] + d]);
        const [low, high] = [Math.min(...xs), Math.max(...xs)];
        assert.ok(planes[d][from[d]] <= low && low < planes[d][from[d] + 1], kind);
        assert.ok(planes[d][to[d] - 1] < high && high <= planes[d][to[d]], kind);
      }
    }
    assert.deepEqual(indicesOf(picture({ kind: 'gridCell', gridCell: [3, 4, 5] }, origin).frame), [
      [3, 4, 5],
      [4, 5, 6],
    ]);
    const [from, to] = indicesOf(picture({ kind: 'axialPlane', axis: 2, plane: 7 }, origin).frame);
    assert.deepEqual([from, to], [[0, 0, 0], [...cutMesh.grid.cells]]);
    const { picture: ofClaw } = await subject('claw', 2);
    assert.equal(ofClaw({ kind: 'triEdges' }).frame, null, 'all of the mesh is shown');
  });

  test('cut-cells fill their grid cell', async () => {
    for (const [name, cells] of [
      ['bunny', 16],
      ['oscillator', 2],
      ['nested-spheres', 10],
      ['pages', 8],
    ]) {
      const { cutMesh, picture } = await subject(name, cells);
      about(
        volume(picture({ kind: 'gridCell' }).faces.position),
        cutMesh.grid.spacing.reduce((product, h) => product * h),
      );
    }
  });

  test('faces cover an axial plane that the surface meets everywhere', async () => {
    const { cutMesh, picture } = await subject('oscillator', 2);
    const { faces, choices, text } = picture({ kind: 'axialPlane' });
    assert.deepEqual(choices.request, { kind: 'axialPlane', axis: 1, plane: 1 });
    about(area(faces.position), cutMesh.grid.spacing[0] * cutMesh.grid.spacing[2]);
    assert.match(text, /5 faces, 4 of them with holes/);
  });

  test('triangles in an axial plane are marked', async () => {
    const { picture } = await subject('aligned-steps', 22);
    assert.match(picture({ kind: 'axialPlane', axis: 2, plane: 1 }).text, /Pieces of triangles in the plane/);
    assert.doesNotMatch(picture({ kind: 'axialPlane', axis: 2, plane: 2 }).text, /triangles in the plane/);
  });

  test('hybrid edges and crossings lie in axial planes', async () => {
    const { cutMesh, picture } = await subject('torus-knot', 8);
    const { planes } = cutMesh.grid;
    const near = (x, d) => planes[d].some((plane) => Math.abs(plane - x) < 1e-5);
    for (const [p, q] of groups(picture({ kind: 'hybridEdges' }).lines.position, 2)) {
      assert.ok([0, 1, 2].some((d) => near(p[d], d) && Math.abs(p[d] - q[d]) < 1e-5));
    }
    for (const [p] of groups(picture({ kind: 'triEdges' }).points.position, 1)) assert.ok([0, 1, 2].some((d) => near(p[d], d)));
  });

  test('the crossings of a small mesh are counted', async () => {
    // Each of the six slanted edges ends in the plane, and no edge but the three in it meets it.
    const wedge = (await subject('wedge', 2)).picture({ kind: 'triEdges' });
    assert.match(wedge.text, /^The axial planes cross 9 tri-edges at 0 points.* 3 tri-vertices lie exactly on a plane/);
    assert.equal(wedge.points.position.length, 9);
    assert.match((await subject('wedge', 2)).picture({ kind: 'hybridEdges' }).text, /no hybrid edges/);
  });

  test('an unwelded mesh gives the same', async () => {
    for (const [name, cells] of [
      ['torus-knot', 8],
      ['wedge', 2],
      ['wedge', 7],
    ]) {
      const { mesh, picture } = await subject(name, cells);
      const soup = {
        positions: new Float64Array(Array.from(mesh.triangles).flatMap((v) => Array.from(mesh.positions.subarray(3 * v, 3 * v + 3)))),
        triangles: mesh.triangles.map((_, k) => k),
      };
      const cutMesh = mandoline.cut(soup, { cells });
      const faceTriangles = mandoline.triangulate(cutMesh);
      for (const kind of kinds) assert.equal(stepPicture(soup, cutMesh, faceTriangles, { kind }, [0, 0, 0]).text, picture({ kind }).text);
    }
  });

  test('all is less the origin', async () => {
    const { picture } = await subject('wedge', 8);
    for (const kind of kinds) {
      const [here, there] = [picture({ kind }), picture({ kind }, [1, 2, 3])];
      minus(here.center, there.center).forEach((x, d) => about(x, d + 1));
      about(here.lines.position[1] - there.lines.position[1], 2);
    }
  });
});

describe('requests', () => {
  test('for items that do not exist show another one', async () => {
    const { picture, cutMesh } = await subject('wedge', 4);
    const triangle = picture({ kind: 'triangleFaces', triangle: 6 }).choices.request.triangle;
    assert.ok(triangle >= 0 && triangle < 6);
    assert.ok(picture({ kind: 'triEdges', triangle: 0.5 }).choices.request.triangle < 6);
    const { axis, plane } = picture({ kind: 'axialPlane', axis: 2, plane: 99 }).choices.request;
    assert.ok(axis === 2 && plane <= cutMesh.grid.cells[2]);
    assert.ok(picture({ kind: 'gridCell', gridCell: [-1, 0, 0] }).choices.request.gridCell[0] >= 0);
  });

  test('for grid cells and triangles without cut-faces say so', async () => {
    const { picture } = await subject('bunny', 16);
    assert.match(picture({ kind: 'gridCell', gridCell: [0, 0, 0] }).text, /\(0, 0, 0\) is untouched/);
    const mesh = { positions: new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), triangles: new Uint32Array([0, 1, 2, 0, 1, 1]) };
    const cutMesh = mandoline.cut(mesh, { cells: 4 });
    const picked = stepPicture(mesh, cutMesh, mandoline.triangulate(cutMesh), { kind: 'triangleFaces', triangle: 1 }, [0, 0, 0]);
    assert.match(picked.text, /Triangle 1 has no cut-face/);
  });
});
