import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { before, describe, test } from 'node:test';
import { init } from 'mandoline-wasm';
import { TeapotGeometry } from 'three/examples/jsm/geometries/TeapotGeometry.js';
import { importBundled } from './bundled.mjs';

const { gallery, galleryMesh } = await importBundled('model/gallery/index.ts');
const { readPreset } = await importBundled('model/gallery/preset.ts');
const resolutions = [8, 16, 32, 50];

/** What has to come out: regions at a resolution of 32, whether they have winding numbers, and pairs of triangles that cross. Or it is `like` another. */
const expected = {
  bunny: { windings: [0, 1] },
  hilbert: { windings: [0, 1, 0] },
  'wavy-plane': { windings: null },
  'wavy-slab': { windings: [0, 1] },
  wedge: { windings: [0, 1] },
  'empty-cone': { windings: [0, 1, 1] },
  claw: { windings: [0, 1] },
  oscillator: { windings: [0, 1] },
  'nested-spheres': { windings: [0, 1, 0, 1, 0, 1] },
  'thin-bowl': { windings: [0, 1] },
  'double-bubble': { windings: null, regions: 3 },
  'moebius-strip': { windings: null },
  'torus-knot': { windings: [0, 1] },
  chain: { windings: [0, 1, 1, 1] },
  'noisy-sphere': { windings: [0, 1] },
  gears: { windings: [0, 1, 1] },
  'aligned-steps': { windings: [0, 1] },
  trumpet: { windings: null },
  pages: { windings: null },
  crate: { windings: null },
  'crossing-tori': { windings: [0, 1, 1, 2, 2], crossing: 272 },
  'pushed-blob': { windings: [0, 1, -1], crossing: 112 },
  teapot: { windings: null, crossing: 118 },
  'klein-bottle': { windings: null, regions: 2, crossing: 98 },
  'bunny-in-wind': { like: 'bunny' },
  'adaptive-grid': { like: 'bunny' },
  'passing-tori': { like: 'crossing-tori' },
  'turning-gears': { like: 'gears' },
  'boys-surface': { windings: null, regions: 2, crossing: 291 },
};

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Six times the volume of a tetrahedron. */
const volume = (a, b, c, d) => dot(cross(minus(b, a), minus(c, a)), minus(d, a));

/** Whether a segment runs through the inside of a triangle. */
function pierces(p, q, [a, b, c]) {
  const [above, below] = [volume(a, b, c, p), volume(a, b, c, q)];
  if (!(above > 0 && below < 0) && !(above < 0 && below > 0)) return false;
  const sides = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
  return sides.every((side) => side > 0) || sides.every((side) => side < 0);
}

/** Pairs of triangles that share no vertex, one of which has an edge that runs through the other. */
function findIntersections({ positions, triangles }) {
  const corner = (k) => Array.from(positions.subarray(3 * triangles[k], 3 * triangles[k] + 3));
  const items = Array.from({ length: triangles.length / 3 }, (_, t) => {
    const corners = [0, 1, 2].map((k) => corner(3 * t + k));
    const low = [0, 1, 2].map((d) => Math.min(...corners.map((p) => p[d])));
    const high = [0, 1, 2].map((d) => Math.max(...corners.map((p) => p[d])));
    return { t, corners, low, high, places: corners.map(String) };
  }).sort((a, b) => a.low[0] - b.low[0]);
  const edges = [
    [0, 1],
    [1, 2],
    [2, 0],
  ];
  const meets = (a, b) => edges.some(([i, j]) => pierces(a.corners[i], a.corners[j], b.corners));
  const pairs = [];
  for (let i = 0; i < items.length; ++i) {
    const a = items[i];
    for (let j = i + 1; j < items.length && items[j].low[0] <= a.high[0]; ++j) {
      const b = items[j];
      if (b.low[1] > a.high[1] || b.high[1] < a.low[1] || b.low[2] > a.high[2] || b.high[2] < a.low[2]) continue;
      if (a.places.some((place) => b.places.includes(place))) continue;
      if (meets(a, b) || meets(b, a)) pairs.push([a.t, b.t]);
    }
  }
  return pairs;
}

test('an intersection is found', () => {
  const crossing = { positions: new Float64Array([0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 9, 9, 9]), triangles: [0, 1, 2, 3, 4, 5] };
  assert.deepEqual(findIntersections(crossing), [[0, 1]]);
});

test('entries are complete and their names differ', () => {
  assert.deepEqual(gallery.map(({ name }) => name).sort(), Object.keys(expected).sort());
  for (const { name, title, line } of gallery) {
    assert.match(name, /^[a-z-]+$/);
    assert.ok(title.length > 3 && line.endsWith('.') && line.length < 170, name);
  }
});

test('presets are understood as links are', () => {
  for (const entry of gallery) {
    const { settings, problems } = readPreset(entry);
    assert.deepEqual(problems, [], entry.name);
    assert.deepEqual(settings.source, { kind: 'gallery', name: entry.name });
    assert.ok(settings.grid.cells >= 2 && settings.grid.cells <= 32, entry.name);
    assert.doesNotMatch(entry.preset, /mesh=|%/, entry.name);
  }
});

test('every entry has its picture, and all of them are small', () => {
  const folder = new URL('../../web/public/thumbnails/', import.meta.url);
  const files = readdirSync(folder).sort();
  assert.deepEqual(files, gallery.map(({ name }) => `${name}.webp`).sort());
  const pictures = files.map((file) => readFileSync(new URL(file, folder)));
  for (const [at, bytes] of pictures.entries()) assert.match(bytes.toString('latin1', 0, 12), /^RIFF.{4}WEBP$/s, files[at]);
  assert.ok(pictures.reduce((sum, { length }) => sum + length, 0) < 120_000);
});

test('an unknown name is refused', async () => {
  await assert.rejects(galleryMesh('dragon'), /no "dragon" in the gallery/);
  await assert.rejects(galleryMesh('constructor'), /no "constructor"/);
});

for (const entry of gallery) {
  const { name } = entry;
  const { cells } = readPreset(entry).settings.grid;
  const { like } = expected[name];
  if (like) {
    test(`${name} has the mesh of ${like}`, async () => assert.deepEqual(await galleryMesh(name), await galleryMesh(like)));
    continue;
  }
  describe(name, () => {
    let mandoline;
    let mesh;
    before(async () => {
      mandoline = await init();
      mesh = await galleryMesh(name);
    });

    const { crossing = 0 } = expected[name];
    test(`crosses itself in ${crossing} places`, () => {
      assert.equal(findIntersections(mesh).length, crossing);
      assert.equal(mandoline.findIntersections(mesh).counts.crossing, crossing);
    });

    test('is the same every time', async () => assert.deepEqual(await galleryMesh(name), mesh));

    for (const resolution of new Set([...resolutions, cells])) {
      test(`is cut and valid at ${resolution} cells`, async () => {
        const cutMesh = mandoline.cut(mesh, { cells: resolution });
        const { pass, checks } = await mandoline.validate(mesh, cutMesh);
        assert.ok(pass, JSON.stringify(checks.filter((check) => !check.pass)));
        assert.equal(cutMesh.droppedTriangles.length, 0);
        if (resolution !== 32) return;
        const { windings, regions = windings?.length ?? 1 } = expected[name];
        assert.equal(cutMesh.regionCount, regions);
        assert.deepEqual(cutMesh.regionWinding && Array.from(cutMesh.regionWinding).sort(), windings && [...windings].sort());
      });
    }
  });
}

/** Faces of the axial plane y = 0, which halves these meshes, at two cells along y. */
async function middleFaces(name) {
  const mandoline = await init();
  const cutMesh = mandoline.cut(await galleryMesh(name), { cells: 2 });
  const faces = [...cutMesh.faceAxis.keys()].filter((face) => cutMesh.faceAxis[face] === 1 && cutMesh.facePlane[face] === 1);
  assert.equal(cutMesh.grid.cells[1], 2);
  assert.equal(cutMesh.grid.planes[1][1], 0);
  const holes = faces.map((face) => cutMesh.faceLoopOffsets[face + 1] - cutMesh.faceLoopOffsets[face] - 1).sort();
  return { holes, cells: cutMesh.cellRegion.length };
}

test('the difficult cases lie on the plane between two layers of grid cells', async () => {
  assert.deepEqual(await middleFaces('wedge'), { holes: [0, 1], cells: 4 });
  assert.deepEqual(await middleFaces('empty-cone'), { holes: [0, 0, 1, 1], cells: 8 });
  assert.deepEqual((await middleFaces('claw')).holes, [0, 0, 0, 3]);
  assert.deepEqual((await middleFaces('oscillator')).holes, [0, 1, 1, 1, 1]);
});

test("the teapot's points are those of another program that has Newell's patches", async () => {
  const { positions, triangles } = await galleryMesh('teapot');
  const half = 3.15 / 2;
  const other = new TeapotGeometry(half, 8, true, true, true, false, true).getAttribute('position').array;
  const isNear = (x, y, z, points, rise) => {
    for (let at = 0; at < points.length; at += 3) {
      if (Math.abs(points[at] - x) + Math.abs(points[at + 1] + rise - y) + Math.abs(points[at + 2] - z) < 1e-5) return true;
    }
    return false;
  };
  for (let at = 0; at < other.length; at += 3) assert.ok(isNear(other[at], other[at + 1] + half, other[at + 2], positions, 0));
  for (let at = 0; at < positions.length; at += 3) assert.ok(isNear(...positions.subarray(at, at + 3), other, half));
  // Two triangles for each of 8 by 8 squares of 32 patches, but one at the eight poles, where sides of patches are points.
  assert.equal(triangles.length / 3, 32 * 64 * 2 - 8 * 8);
});

test('the teapot is open around its lid, and at both ends of spout and handle', async () => {
  const { openEdges, inconsistentEdges, nonManifoldEdges, zeroAreaTriangles, components } = (await init()).inspect(
    await galleryMesh('teapot'),
  );
  assert.deepEqual(
    { openEdges, inconsistentEdges, nonManifoldEdges, zeroAreaTriangles, components },
    { openEdges: 2 * 32 + 4 * 16, inconsistentEdges: 0, nonManifoldEdges: 0, zeroAreaTriangles: 0, components: 4 },
  );
});
