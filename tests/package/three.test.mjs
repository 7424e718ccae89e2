import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init } from 'mandoline-wasm';
import {
  cellArrays,
  cellColors,
  cellEdgeArrays,
  cellEdgeGeometry,
  cellGeometry,
  edgeGeometry,
  idColor,
  kindColors,
  meshFromGeometry,
  outsideColor,
  regionColor,
  sliceGeometry,
  untouchedCells,
  untouchedEdgeGeometry,
  untouchedGeometry,
  volumeColor,
  windingColor,
} from 'mandoline-wasm/three';
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CylinderGeometry,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Matrix4,
  SphereGeometry,
  TorusGeometry,
} from 'three';
import { mergeVertices } from 'three/addons/utils/BufferGeometryUtils.js';
import { box, sheet, torus, volumeOf } from './meshes.mjs';

const three = await import('mandoline-wasm/three');
const mandoline = await init();
const mesh = torus(24, 16);
const cutMesh = mandoline.cut(mesh, { cells: 7 });
const faceTriangles = mandoline.triangulate(cutMesh);
const measures = mandoline.measure(mesh, cutMesh);
const cellCount = cutMesh.cellRegion.length;

const corner = (array, i) => [array[3 * i], array[3 * i + 1], array[3 * i + 2]];
const minus = (a, b) => a.map((x, d) => x - b[d]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** By the divergence theorem, per cell. */
function volumes({ position, cell }) {
  const result = new Float64Array(cellCount);
  for (let i = 0; i < cell.length; i += 3) {
    result[cell[i]] += dot(corner(position, i), cross(corner(position, i + 1), corner(position, i + 2))) / 6;
  }
  return result;
}

function assertClose(actual, expected, tolerance, what) {
  assert.equal(actual.length, expected.length, what);
  for (let i = 0; i < actual.length; ++i) {
    if (!(Math.abs(actual[i] - expected[i]) <= tolerance)) assert.fail(`${what}[${i}]: ${actual[i]} instead of ${expected[i]}`);
  }
}

test('the triangles of every cell enclose its volume, seen from outside', () => {
  const arrays = cellArrays(cutMesh, faceTriangles);
  assertClose(volumes(arrays), measures.cellVolume, 1e-6, 'volume');
  for (let i = 0; i < arrays.cell.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => corner(arrays.position, i + k));
    const normal = cross(minus(b, a), minus(c, a));
    assert.ok(Math.abs(Math.hypot(...corner(arrays.normal, i)) - 1) < 1e-6);
    const area = Math.hypot(...normal);
    if (area > 1e-4) assert.ok(dot(normal, corner(arrays.normal, i)) > 0.999 * area);
    for (const key of ['cell', 'face']) assert.ok(arrays[key][i] === arrays[key][i + 1] && arrays[key][i] === arrays[key][i + 2]);
    const { cellHalfFaceOffsets: offsets, cellHalfFaces } = cutMesh;
    const own = cellHalfFaces.subarray(offsets[arrays.cell[i]], offsets[arrays.cell[i] + 1]);
    assert.ok(own.some((halfFace) => halfFace >> 1 === arrays.face[i]));
  }
});

test('both sides of a face between two cut-cells are there', () => {
  const { faceCells } = mandoline.adjacency(cutMesh);
  const { face, cell } = cellArrays(cutMesh, faceTriangles);
  const owners = Array.from(cutMesh.faceTriangle, () => new Set());
  for (let i = 0; i < face.length; i += 3) owners[face[i]].add(cell[i]);
  owners.forEach((found, f) => {
    const expected = new Set([faceCells[2 * f], faceCells[2 * f + 1]].filter((owner) => owner >= 0));
    assert.deepEqual(found, expected);
  });
});

test('pieces of triangles and pieces of grid-faces together are all', () => {
  const [all, surface, grid] = ['all', 'surface', 'grid'].map((faces) => cellArrays(cutMesh, faceTriangles, { faces }));
  assert.equal(surface.cell.length + grid.cell.length, all.cell.length);
  assert.ok(surface.face.every((face) => cutMesh.faceTriangle[face] >= 0));
  assert.ok(grid.face.every((face) => cutMesh.faceTriangle[face] < 0));
  assert.ok(surface.cell.length > 0 && grid.cell.length > 0);
});

test('chosen cells come alone, in that order', () => {
  const { cell } = cellArrays(cutMesh, faceTriangles, { cells: [5, 2] });
  assert.deepEqual(
    cell.filter((id, i) => id !== cell[i - 1]),
    Uint32Array.of(5, 2),
  );
  assert.equal(cellArrays(cutMesh, faceTriangles, { cells: [] }).position.length, 0);
  for (const bad of [-1, cellCount, 0.5, NaN]) {
    assert.throws(() => cellArrays(cutMesh, faceTriangles, { cells: [0, bad] }), { code: 'badArgument', element: 1 });
  }
  assert.throws(() => cellArrays(cutMesh, faceTriangles, { faces: 'some' }), { code: 'badArgument' });
});

test('the origin is subtracted before rounding', () => {
  const far = 2 ** 26;
  const cube = box([far, 0, 0], [far + 1, 1, 1]);
  const cut = mandoline.cut(cube, { min: [far - 0.5, -0.5, -0.5], max: [far + 1.75, 1.75, 1.75], cells: [3, 3, 3] });
  const { position } = cellArrays(cut, mandoline.triangulate(cut), { origin: [far, 0, 0] });
  const found = new Set(position.filter((_, i) => i % 3 === 0));
  assert.deepEqual(
    [...found].sort((a, b) => a - b),
    [-0.5, 0, 0.25, 1, 1.75],
  );
});

test('a geometry has colours, and explodes cell by cell', () => {
  const still = cellGeometry(cutMesh, faceTriangles);
  assert.ok(still instanceof BufferGeometry);
  assert.deepEqual(Object.keys(still.attributes).sort(), ['cell', 'color', 'face', 'normal', 'position']);
  const arrays = cellArrays(cutMesh, faceTriangles);
  for (const key of Object.keys(arrays)) assert.deepEqual(still.getAttribute(key).array, arrays[key]);
  const moved = cellGeometry(cutMesh, faceTriangles, { measures, explode: 0.5 });
  const center = cutMesh.grid.planes.map((axis) => (axis[0] + axis.at(-1)) / 2);
  const { cell } = arrays;
  const expected = arrays.position.map((x, i) => x + 0.5 * (measures.cellCentroid[3 * cell[Math.floor(i / 3)] + (i % 3)] - center[i % 3]));
  assertClose(moved.getAttribute('position').array, expected, 1e-6, 'position');
  assert.throws(() => cellGeometry(cutMesh, faceTriangles, { explode: 0.5 }), { code: 'badArgument' });
  const cellColor = cellColors(cutMesh, 'region');
  const vertex = cell.length - 1;
  assert.deepEqual(corner(still.getAttribute('color').array, vertex), corner(cellColor, cell[vertex]));
});

test('colours tell what they are asked for', () => {
  for (const colorBy of ['region', 'winding', 'cell', 'volume']) {
    const colors = cellColors(cutMesh, colorBy, measures);
    assert.equal(colors.length, 3 * cellCount);
    assert.ok(colors.every((value) => value >= 0 && value <= 1));
    assert.deepEqual(colors, cellColors(cutMesh, colorBy, measures));
  }
  const { cellRegion } = cutMesh;
  const regionColors = cellColors(cutMesh, 'region');
  for (let cell = 0; cell < cellCount; ++cell) {
    const same = String(corner(regionColors, cell)) === String(corner(regionColors, 0));
    assert.equal(same, cellRegion[cell] === cellRegion[0]);
  }
  const luminance = (colors, cell) => dot(corner(colors, cell), [0.2126, 0.7152, 0.0722]);
  const byVolume = cellColors(cutMesh, 'volume', measures);
  const order = [...cellRegion.keys()].sort((a, b) => measures.cellVolume[a] - measures.cellVolume[b]);
  order.slice(1).forEach((cell, i) => assert.ok(luminance(byVolume, cell) >= luminance(byVolume, order[i]) - 1e-6));
  assert.ok(luminance(byVolume, order.at(-1)) > 4 * luminance(byVolume, order[0]));
  const byCell = cellColors(cutMesh, 'cell');
  assert.ok(new Set(Array.from(cellRegion, (_, cell) => String(corner(byCell, cell)))).size > 0.9 * cellCount);
  assert.throws(() => cellColors(cutMesh, 'volume'), { code: 'badArgument' });
  assert.throws(() => cellColors(cutMesh, 'taste'), { code: 'badArgument' });
});

test('winding numbers of either sign differ from none and from each other', () => {
  const regionWinding = Int32Array.of(-1, 0, 1, 2);
  const made = { cellRegion: Uint32Array.of(0, 1, 2, 3), regionWinding };
  const colors = cellColors(made, 'winding');
  assert.equal(new Set([0, 1, 2, 3].map((cell) => String(corner(colors, cell)))).size, 4);
  const open = cellColors({ ...made, regionWinding: null }, 'winding');
  assert.deepEqual(corner(open, 0), corner(open, 3));
});

test('the first regions differ for people without red or green cones', () => {
  const colors = cellColors({ cellRegion: Uint32Array.of(0, 1, 2, 3, 4, 5, 6) }, 'region');
  // Viénot, Brettel, Mollon 1999, on linear RGB.
  const sights = [
    [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
    [
      [0.11238, 0.88762, 0],
      [0.11238, 0.88762, 0],
      [0.00401, -0.00401, 1],
    ],
    [
      [0.29275, 0.70725, 0],
      [0.29275, 0.70725, 0],
      [-0.02234, 0.02234, 1],
    ],
  ];
  for (const sight of sights) {
    const seen = (cell) => sight.map((row) => Math.cbrt(dot(row, corner(colors, cell))));
    for (let a = 0; a < 7; ++a) {
      for (let b = 0; b < a; ++b) assert.ok(Math.hypot(...minus(seen(a), seen(b))) > 0.08, `regions ${a} and ${b}`);
    }
  }
});

/** The edges of a cut-cell, each once, as "lower higher". */
function edgesOfCell({ cellHalfFaceOffsets, cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices }, cell) {
  const edges = new Set();
  for (const halfFace of cellHalfFaces.subarray(cellHalfFaceOffsets[cell], cellHalfFaceOffsets[cell + 1])) {
    for (let loop = faceLoopOffsets[halfFace >> 1]; loop < faceLoopOffsets[(halfFace >> 1) + 1]; ++loop) {
      const vertices = loopVertices.subarray(loopOffsets[loop], loopOffsets[loop + 1]);
      vertices.forEach((a, i) => edges.add([a, vertices.at(i - 1)].sort((x, y) => x - y).join(' ')));
    }
  }
  return edges;
}

function assertEdges(made, edges) {
  const { vertex, cell, position } = edges;
  const found = Array.from(made.cellRegion, () => []);
  for (let i = 0; i < vertex.length; i += 2) {
    assert.equal(cell[i], cell[i + 1]);
    found[cell[i]].push([vertex[i], vertex[i + 1]].sort((x, y) => x - y).join(' '));
  }
  found.forEach((list, owner) => assert.deepEqual(list.sort(), [...edgesOfCell(made, owner)].sort(), `edges of cell ${owner}`));
  vertex.forEach((id, i) => assert.deepEqual(corner(position, i), corner(made.positions, id).map(Math.fround)));
}

test('every cut-cell has each of its edges once', () => {
  assertEdges(cutMesh, cellEdgeArrays(cutMesh));
});

test('edges of a sheet that ends within a cell come once, though it is seen from both sides', () => {
  const inside = mandoline.cut(sheet([0.25, 0.25], [0.75, 0.75], 0.5), {
    planes: [
      [0, 1],
      [0, 1],
      [0, 1],
    ],
  });
  assert.equal(inside.cellRegion.length, 1);
  const edges = cellEdgeArrays(inside);
  assertEdges(inside, edges);
  assert.equal(edges.vertex.length, 2 * (12 + 5), 'a box and two triangles');
});

/** Where vertices of a geometry are, those from `begin` to `end`. */
function cornersOf(geometry, begin = 0, end = geometry.getAttribute('position').count) {
  const { array } = geometry.getAttribute('position');
  return new Set(Array.from({ length: end - begin }, (_, i) => String(corner(array, begin + i))));
}

/** The eight corners of a box, moved by `shift` and rounded. */
function boxCorners(min, max, shift) {
  return new Set(
    [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => {
      return String(min.map((x, d) => Math.fround(((bits >> d) & 1 ? max[d] : x) + shift[d])));
    }),
  );
}

test('edges of chosen cells explode as their faces do', () => {
  const center = cutMesh.grid.planes.map((axis) => (axis[0] + axis.at(-1)) / 2);
  const options = { cells: [7, 3], origin: [1, 2, 3], explode: 0.5, measures };
  const geometry = cellEdgeGeometry(cutMesh, options);
  assert.ok(geometry instanceof BufferGeometry);
  const { position, cell } = cellEdgeArrays(cutMesh, options);
  assert.deepEqual(
    cell.filter((id, i) => id !== cell[i - 1]),
    Uint32Array.of(7, 3),
  );
  assert.deepEqual(geometry.getAttribute('cell').array, cell);
  const expected = position.map((x, i) => x + 0.5 * (measures.cellCentroid[3 * cell[Math.floor(i / 3)] + (i % 3)] - center[i % 3]));
  assertClose(geometry.getAttribute('position').array, expected, 1e-6, 'position');
  assert.deepEqual(cornersOf(geometry), cornersOf(cellGeometry(cutMesh, faceTriangles, options)), 'edges and faces meet');
});

test('cells are chosen by region, too', () => {
  const inside = cutMesh.regionWinding.indexOf(1);
  const isInside = (cell) => cutMesh.cellRegion[cell] === inside;
  const cells = [...cutMesh.cellRegion.keys()].filter(isInside);
  assert.ok(cells.length > 0 && cells.length < cellCount);
  assert.deepEqual(cellArrays(cutMesh, faceTriangles, { regions: [inside] }), cellArrays(cutMesh, faceTriangles, { cells }));
  assert.deepEqual(cellEdgeArrays(cutMesh, { regions: [inside] }), cellEdgeArrays(cutMesh, { cells }));
  const both = cellArrays(cutMesh, faceTriangles, { regions: [inside], cells: [...cutMesh.cellRegion.keys()].reverse() });
  assert.deepEqual(both, cellArrays(cutMesh, faceTriangles, { cells: cells.reverse() }));
  assert.equal(cellArrays(cutMesh, faceTriangles, { regions: [] }).cell.length, 0);
});

test('untouched cells are the grid cells that no cut-cells replace', () => {
  const {
    cells: [nx, ny, nz],
  } = cutMesh.grid;
  const expected = { gridCell: [], region: [] };
  for (let at = 0; at < nx * ny * nz; ++at) {
    if (cutMesh.gridCellRegion[at] < 0) continue;
    expected.gridCell.push(at % nx, Math.floor(at / nx) % ny, Math.floor(at / (nx * ny)));
    expected.region.push(cutMesh.gridCellRegion[at]);
  }
  const all = untouchedCells(cutMesh);
  assert.deepEqual(all, { gridCell: Int32Array.from(expected.gridCell), region: Uint32Array.from(expected.region) });
  const counts = [0, 1].map((region) => untouchedCells(cutMesh, { regions: [region] }).region.length);
  assert.ok(counts.every((count) => count > 0));
  assert.equal(counts[0] + counts[1], all.region.length);
  for (let region = 0; region < 2; ++region) {
    assert.ok(untouchedCells(cutMesh, { regions: [region] }).region.every((id) => id === region));
  }
});

/** Of a grid that is graded, so that boxes differ. */
function gradedCut() {
  const planes = [
    [-1, -0.5, 0.25, 1.5, 2],
    [-1, 0, 0.75, 2, 3, 3.5],
    [-2, -0.25, 0.5, 1.5, 2],
  ];
  const cube = box([-0.25, 0.25, -0.5], [1.75, 2.5, 1.75]);
  return { cube, cut: mandoline.cut(cube, { planes }), planes };
}

test('untouched cells are drawn as boxes in their places, seen from outside', () => {
  const { cut, planes } = gradedCut();
  const geometry = untouchedGeometry(cut);
  const { gridCell } = untouchedCells(cut);
  const {
    index,
    attributes: { position, normal, color },
  } = geometry;
  const count = gridCell.length / 3;
  assert.ok(count > 10);
  assert.deepEqual([index.count, position.count, normal.count, color.count], [36 * count, 24 * count, 24 * count, 24 * count]);
  for (let b = 0; b < count; ++b) {
    const [min, max] = [0, 1].map((end) => corner(gridCell, b).map((c, d) => planes[d][c + end]));
    assert.deepEqual(cornersOf(geometry, 24 * b, 24 * (b + 1)), boxCorners(min, max, [0, 0, 0]));
    let enclosed = 0;
    for (let t = 36 * b; t < 36 * (b + 1); t += 3) {
      const ids = [0, 1, 2].map((k) => index.getX(t + k));
      assert.ok(ids.every((id) => id >= 24 * b && id < 24 * (b + 1)));
      const [p, q, r] = ids.map((id) => corner(position.array, id));
      const area = cross(minus(q, p), minus(r, p));
      for (const id of ids) assert.ok(Math.abs(dot(area, corner(normal.array, id)) - Math.hypot(...area)) < 1e-6);
      enclosed += dot(p, cross(q, r)) / 6;
    }
    assert.ok(Math.abs(enclosed - min.reduce((product, x, d) => product * (max[d] - x), 1)) < 1e-5);
  }
});

test('boxes explode about the centre of the grid, and their edges with them', () => {
  const { cut, planes } = gradedCut();
  const options = { regions: [cut.regionWinding.indexOf(0)], origin: [1, 2, 3], explode: 0.5 };
  const { gridCell } = untouchedCells(cut, options);
  const [faces, edges] = [untouchedGeometry(cut, options), untouchedEdgeGeometry(cut, options)];
  const count = gridCell.length / 3;
  assert.ok(count > 10);
  assert.equal(edges.index.count, 24 * count);
  for (let b = 0; b < count; ++b) {
    const [min, max] = [0, 1].map((end) => corner(gridCell, b).map((c, d) => planes[d][c + end]));
    const shift = min.map((x, d) => 0.5 * ((x + max[d]) / 2 - (planes[d][0] + planes[d].at(-1)) / 2) - options.origin[d]);
    const expected = boxCorners(min, max, shift);
    assert.deepEqual(cornersOf(faces, 24 * b, 24 * (b + 1)), expected);
    assert.deepEqual(cornersOf(edges, 8 * b, 8 * (b + 1)), expected);
    const lines = new Set();
    for (let i = 24 * b; i < 24 * (b + 1); i += 2) {
      const ends = [0, 1].map((end) => corner(edges.getAttribute('position').array, edges.index.getX(i + end)));
      assert.equal(minus(...ends).filter((x) => x !== 0).length, 1, 'along an axis');
      lines.add(ends.map(String).sort().join(' '));
    }
    assert.equal(lines.size, 12);
  }
});

test('untouched cells have the colours of a slice through them', () => {
  for (const colorBy of ['region', 'winding', 'cell', 'volume']) {
    const slice = mandoline.slice(cutMesh, { normal: [1, 2, 2], offset: 0.3 });
    const sliced = sliceGeometry(cutMesh, slice, { colorBy, measures }).getAttribute('color').array;
    const { array } = untouchedGeometry(cutMesh, { colorBy, measures }).getAttribute('color');
    const { gridCell } = untouchedCells(cutMesh);
    const boxOf = new Map(Array.from({ length: gridCell.length / 3 }, (_, b) => [String(corner(gridCell, b)), b]));
    let compared = 0;
    slice.polygonCell.forEach((cell, polygon) => {
      if (cell >= 0) return;
      const b = boxOf.get(String(corner(slice.polygonGridCell, polygon)));
      const expected = corner(sliced, 3 * slice.polygonTriangleOffsets[polygon]);
      for (let i = 24 * b; i < 24 * (b + 1); ++i) assert.deepEqual(corner(array, i), expected);
      ++compared;
    });
    assert.ok(compared > 5, `${compared} compared`);
  }
});

test("what can't be drawn is refused in the name of the call", () => {
  const calls = {
    cellArrays: (options) => cellArrays(cutMesh, faceTriangles, options),
    cellGeometry: (options) => cellGeometry(cutMesh, faceTriangles, options),
    cellEdgeArrays: (options) => cellEdgeArrays(cutMesh, options),
    cellEdgeGeometry: (options) => cellEdgeGeometry(cutMesh, options),
    untouchedCells: (options) => untouchedCells(cutMesh, options),
    untouchedGeometry: (options) => untouchedGeometry(cutMesh, options),
    untouchedEdgeGeometry: (options) => untouchedEdgeGeometry(cutMesh, options),
  };
  for (const [stage, call] of Object.entries(calls)) {
    assert.throws(() => call({ regions: [0, 2] }), { code: 'badArgument', stage, element: 1, message: /regions\[1\] is 2/ });
    assert.throws(() => call({ regions: 1 }), { code: 'badArgument', stage, message: /regions must be an array/ });
    if (stage.startsWith('untouched')) continue;
    assert.throws(() => call({ cells: [cellCount] }), { code: 'badArgument', stage, element: 0 });
    if (stage.endsWith('Geometry')) assert.throws(() => call({ explode: 1 }), { code: 'badArgument', stage, message: /measures/ });
  }
  assert.throws(() => untouchedGeometry(cutMesh, { colorBy: 'volume' }), { code: 'badArgument', stage: 'untouchedGeometry' });
});

test('wrong arguments are named', () => {
  const detached = structuredClone(cutMesh.positions);
  structuredClone(detached, { transfer: [detached.buffer] });
  const other = mandoline.cut(mesh, { cells: 5 });
  const slice = mandoline.slice(cutMesh, { normal: [0, 0, 1], offset: 0 });
  const cases = {
    cellGeometry: [
      [[], /^cutMesh must be an object, not undefined/],
      [[{ ...cutMesh, positions: detached }, faceTriangles], /^cutMesh\.positions is detached/],
      [[{ ...cutMesh, cellRegion: [0] }, faceTriangles], /^cutMesh\.cellRegion must be a Uint32Array, not an array/],
      [[{ ...cutMesh, grid: undefined }, faceTriangles], /^cutMesh\.grid must be an object/],
      [[cutMesh], /^faceTriangles must be an object, not undefined/],
      [[cutMesh, mandoline.triangulate(other)], /^faceTriangles is of another cut-mesh\.$/],
      [[cutMesh, { ...mandoline.triangulate(other), madeFrom: undefined }], /^faceTriangles .*: it has \d+ faces, not \d+\.$/],
      [[cutMesh, faceTriangles, 7], /^options must be an object, not 7/],
      [[cutMesh, faceTriangles, { explode: '1' }], /^options\.explode must be a number, not string/],
      [[cutMesh, faceTriangles, { origin: [0, 0] }], /^options\.origin must have three numbers, not 2/],
      [[cutMesh, faceTriangles, { colorBy: 'taste' }], /^options\.colorBy must be "region", .* not "taste"/],
      [[cutMesh, faceTriangles, { measures: mandoline.measure(mesh, other) }], /^options\.measures is of another cut-mesh/],
    ],
    cellEdgeArrays: [[[null], /^cutMesh must be an object, not null/]],
    cellColors: [[[cutMesh], /^colorBy must be "region", .* not undefined/]],
    untouchedGeometry: [[[{ ...cutMesh, runBegin: undefined }], /^cutMesh\.runBegin must be a Int32Array/]],
    edgeGeometry: [[[cutMesh, cutMesh], /^cutEdges\.edgeVertices must be a Uint32Array, not undefined/]],
    sliceGeometry: [
      [[cutMesh], /^slice must be an object/],
      [[cutMesh, { ...slice, polygonCell: null }], /^slice\.polygonCell must be a Int32Array, not null/],
    ],
    meshFromGeometry: [
      [[], /^geometry must be a BufferGeometry, not undefined/],
      [[new BufferGeometry().setAttribute('normal', new BufferAttribute(new Float32Array(3), 3))], /^The geometry has no positions/],
      [[new BoxGeometry(), [1, 0, 0]], /^matrix must be a Matrix4, not an array/],
    ],
  };
  for (const [stage, calls] of Object.entries(cases)) {
    for (const [given, message] of calls) {
      assert.throws(() => three[stage](...given), { name: 'MandolineError', code: 'badArgument', stage, message });
    }
  }
});

test('edges are lines between vertices of the cut-mesh', () => {
  const cutEdges = mandoline.cutEdges(mesh, cutMesh);
  const origin = [1, 2, 3];
  const geometry = edgeGeometry(cutMesh, cutEdges, origin);
  assert.deepEqual(geometry.index.array, cutEdges.edgeVertices);
  const position = geometry.getAttribute('position');
  for (let edge = 0; edge < cutEdges.edgeLength.length; ++edge) {
    const [a, b] = [0, 1].map((end) => geometry.index.getX(2 * edge + end));
    const length = Math.hypot(...minus(corner(position.array, a), corner(position.array, b)));
    assert.ok(Math.abs(length - cutEdges.edgeLength[edge]) < 1e-5);
  }
  assertClose(corner(position.array, 7), minus(corner(cutMesh.positions, 7), origin), 1e-6, 'position');
});

test('a slice is filled, in its plane, in the colours of its cells', () => {
  const plane = { normal: [1, 2, 2], offset: 0.3 };
  const slice = mandoline.slice(cutMesh, plane);
  const origin = [0.25, -0.5, 1];
  const geometry = sliceGeometry(cutMesh, slice, { colorBy: 'volume', measures, origin });
  const [position, normal, color, cell] = ['position', 'normal', 'color', 'cell'].map((name) => geometry.getAttribute(name).array);
  assert.equal(cell.length, slice.triangles.length);
  for (let i = 0; i < cell.length; ++i) {
    assert.ok(Math.abs(dot(plane.normal, corner(position, i)) + dot(plane.normal, origin) - plane.offset) < 1e-5);
    assertClose(corner(normal, i), [1 / 3, 2 / 3, 2 / 3], 1e-6, 'normal');
  }
  const colors = cellColors(cutMesh, 'volume', measures);
  const cut = cell.findIndex((id) => id >= 0),
    untouched = cell.indexOf(-1);
  assert.deepEqual(corner(color, cut), corner(colors, cell[cut]));
  assert.ok(untouched >= 0);
  for (const colorBy of ['region', 'winding', 'cell']) {
    assert.ok(
      sliceGeometry(cutMesh, slice, { colorBy })
        .getAttribute('color')
        .array.every((x) => x >= 0 && x <= 1),
    );
  }
});

test('a slice fills the box of the grid', () => {
  const geometry = sliceGeometry(cutMesh, mandoline.slice(cutMesh, { normal: [0, 0, 3], offset: 0.3 }));
  const { array } = geometry.getAttribute('position');
  let area = 0;
  for (let i = 0; i < array.length / 3; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => corner(array, i + k));
    area += cross(minus(b, a), minus(c, a))[2] / 2;
  }
  const [width, height] = cutMesh.grid.planes.map((axis) => axis.at(-1) - axis[0]);
  assert.ok(Math.abs(area - width * height) < 1e-5);
});

test('meshes come from indexed, unindexed and interleaved geometries', () => {
  const geometry = new BoxGeometry(1, 2, 3);
  const indexed = meshFromGeometry(geometry);
  const unindexed = meshFromGeometry(geometry.toNonIndexed());
  assert.equal(unindexed.positions.length, 108);
  for (const made of [indexed, unindexed]) assert.ok(Math.abs(volumeOf(made) - 6) < 1e-12);
  assert.equal(mandoline.cut(unindexed, { cells: 6 }).regionCount, 2);
  const buffer = new InterleavedBuffer(Float32Array.of(0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9), 4);
  const interleaved = new BufferGeometry().setAttribute('position', new InterleavedBufferAttribute(buffer, 3, 0));
  const expected = { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), triangles: Uint32Array.of(0, 1, 2) };
  assert.deepEqual(meshFromGeometry(interleaved), expected);
  const bytes = new BufferGeometry().setAttribute('position', new BufferAttribute(Uint8Array.of(0, 0, 0, 255, 0, 0, 0, 255, 0), 3, true));
  assert.deepEqual(meshFromGeometry(bytes).positions, Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0));
  assert.throws(() => meshFromGeometry(new BufferGeometry()), { code: 'badArgument' });
});

test('seams that miss themselves by a rounding close when their vertices are merged', () => {
  const geometries = [new SphereGeometry(1, 16, 12), new TorusGeometry(1, 0.4, 12, 24), new CylinderGeometry(1, 1, 2, 16)];
  for (const geometry of geometries) {
    assert.equal(mandoline.cut(meshFromGeometry(geometry), { cells: 6 }).regionWinding, null);
    const mesh = meshFromGeometry(mergeVertices(geometry.deleteAttribute('normal').deleteAttribute('uv')));
    assert.deepEqual([...mandoline.cut(mesh, { cells: 6 }).regionWinding].sort(), [0, 1]);
  }
});

test('a matrix moves the mesh; one that mirrors leaves it outward', () => {
  const geometry = new SphereGeometry(1, 16, 12);
  const whole = volumeOf(meshFromGeometry(geometry));
  const moved = meshFromGeometry(geometry, new Matrix4().makeTranslation(5, 6, 7).multiply(new Matrix4().makeScale(2, 1, 1)));
  assert.ok(Math.abs(volumeOf(moved) - 2 * whole) < 1e-6);
  assertClose(corner(moved.positions, 0), [5, 7, 7], 1e-6, 'position');
  assert.ok(Math.abs(volumeOf(meshFromGeometry(geometry, new Matrix4().makeScale(-1, 1, 1))) - whole) < 1e-6);
});

test('colours one by one are those of cellColors, and colours of kinds are told apart', () => {
  const made = { cellRegion: Uint32Array.of(0, 1, 2), regionWinding: Int32Array.of(0, 1, -1) };
  const measures = { cellVolume: Float64Array.of(1, 2, 4) };
  const expected = {
    region: [0, 1, 2].map(regionColor),
    winding: [0, 1, -1].map(windingColor),
    cell: [0, 1, 2].map(idColor),
    volume: [0, 0.5, 1].map(volumeColor),
  };
  for (const [colorBy, colors] of Object.entries(expected)) {
    assert.deepEqual(cellColors(made, colorBy, measures), Float32Array.from(colors.flat()), colorBy);
  }
  const apart = [...Object.values(kindColors), outsideColor];
  assert.equal(new Set(apart.map(String)).size, apart.length);
});
