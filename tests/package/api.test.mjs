// The calls of the package against results worked out by hand.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { compiledModule, describe, init, MandolineError } from 'mandoline-wasm';
import { assertClosed, box, gut, join, sheet, torus, volumeOf } from './meshes.mjs';

const mandoline = await init();

/** A cube around the middle vertex of a grid of 2 x 2 x 2 cells: every grid cell has a corner of it and the rest. */
const cube = box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]);
const grid = { min: [0, 0, 0], max: [2, 2, 2], cells: [2, 2, 2] };
const twoBoxes = join(box([1, 1, 1], [3, 3, 3]), box([2, 2, 2], [4, 4, 4]));

function areaOf(positions, triangles) {
  let area = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((j) => positions.subarray(3 * triangles[i + j], 3 * triangles[i + j] + 3));
    const u = b.map((x, d) => x - a[d]);
    const v = c.map((x, d) => x - a[d]);
    area += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return area;
}

test('init gives the same promise every time', async () => {
  assert.equal(init(), init({ wasm: 'elsewhere' }));
  assert.ok((await compiledModule()) instanceof WebAssembly.Module);
  assert.match(mandoline.version, /^\d+\.\d+\.\d+$/);
});

test('a cube across eight grid cells', async () => {
  const cut = mandoline.cut(cube, grid);
  assert.equal(cut.cellRegion.length, 16);
  assert.equal(cut.faceTriangle.length, 36 + 24 + 24); // a side's two triangles fall into six pieces; inner grid-faces into two
  assert.equal(cut.faceTriangle.filter((t) => t >= 0).length, 36);
  assert.deepEqual([...cut.regionWinding].sort(), [0, 1]);
  assert.deepEqual([...cut.gridCellRegion], Array(8).fill(-1));
  assert.equal(cut.triangleCount, 12);
  assert.equal(cut.droppedTriangles.length, 0);

  const inside = cut.regionWinding.indexOf(1);
  const measures = mandoline.measure(cube, cut);
  cut.cellRegion.forEach((region, cell) => assert.equal(measures.cellVolume[cell], region === inside ? 0.125 : 0.875));
  assert.equal(measures.regionVolume[inside], 1);
  assert.equal(measures.regionVolume[1 - inside], 7);
  assert.equal(
    measures.faceArea.reduce((sum, area) => sum + area),
    6 + 12 + 24,
  );

  const { cellCells, cellCellOffsets, faceCells, faceGridCells } = mandoline.adjacency(cut);
  // Three of its kind, and the rest.
  for (let cell = 0; cell < 16; ++cell) assert.equal(cellCellOffsets[cell + 1] - cellCellOffsets[cell], 4);
  assert.equal(cellCells.length, 64);
  assert.equal(faceCells.filter((cell) => cell < 0).length, 24);
  assert.ok(faceGridCells.every((cell) => cell === -1));

  const edges = mandoline.cutEdges(cube, cut);
  assert.equal(edges.edgeVertices.length, 2 * edges.edgeLength.length);
  // Grid-edges, the cube's edges, its diagonals, and where it crosses the three inner planes.
  const length = 54 * 1 + 12 + 6 * Math.SQRT2 + 3 * 4;
  assert.ok(Math.abs(edges.edgeLength.reduce((sum, x) => sum + x) - length) < 1e-12);

  const validation = await mandoline.validate(cube, cut);
  assert.equal(validation.pass, true);
  assert.ok(validation.checks.length > 5);

  const { triangles, faceTriangleOffsets } = mandoline.triangulate(cut);
  assert.equal(faceTriangleOffsets.length, cut.faceTriangle.length + 1);
  assert.equal(faceTriangleOffsets.at(-1) * 3, triangles.length);
  const cell = cut.cellRegion.indexOf(inside);
  const surfaceOfCell = mandoline.triangulate(cut, { cell });
  assertClosed({ triangles: surfaceOfCell });
  assert.equal(areaOf(cut.positions, surfaceOfCell), 1.5);
  const surface = mandoline.triangulate(cut, { region: inside });
  assertClosed({ triangles: surface });
  assert.ok(Math.abs(areaOf(cut.positions, surface) - 6) < 1e-12);
});

test('a drawing has all cut-cells, less the origin', () => {
  const cut = mandoline.cut(cube, grid);
  const { positions, normals, vertexCell, triangles, surfaceTriangles, edges, hybridEdges, gridEdges, ...shapes } = mandoline.cellDrawing(
    cube,
    cut,
    { origin: [1, 1, 1] },
  );
  assert.equal(vertexCell.length * 3, positions.length);
  assert.equal(vertexCell.length * 4, normals.length);
  assert.ok(positions instanceof Float32Array && positions.every((x) => Math.abs(x) <= 1));
  for (let i = 0; i < 3 * surfaceTriangles; ++i) assert.equal(normals[4 * triangles[i] + 3], 1);
  assert.equal(areaOf(positions, triangles.subarray(0, 3 * surfaceTriangles)), 2 * 6, 'the surface from both sides');
  assert.equal(areaOf(positions, triangles), 2 * (6 + 12) + 24);
  // On each side of the cube two planes make four, each of which has four cells; diagonals and the cube's own edges lie in no plane.
  assert.equal(hybridEdges, 6 * 4 * 4);
  assert.ok(gridEdges > 0 && edges.length / 2 > hybridEdges + gridEdges);
  assert.deepEqual([...new Set(shapes.cellVolume)].sort(), [0.125, 0.875]);
  assert.equal(shapes.cellCentroid.length, 3 * cut.cellRegion.length);
  assert.equal(shapes.madeFrom, cut.fingerprint);
});

test('arrays are written into buffers that are given back', () => {
  const buffersOf = (result) => Object.values(result).flatMap((array) => (ArrayBuffer.isView(array) ? [array.buffer] : []));
  const ring = torus(24, 12);
  const moved = { ...ring, positions: Float64Array.from(ring.positions, (x) => x + 0.0625) };
  const around = { min: [-2, -2, -1], max: [2, 2, 1], cells: [8, 8, 4] };
  const wanted = mandoline.cut(moved, around);
  const wantedDrawing = mandoline.cellDrawing(moved, wanted);
  const first = mandoline.cut(ring, around, { reuse: [] });
  const firstDrawing = mandoline.cellDrawing(ring, first, { reuse: [] });
  const [known, drawn] = [buffersOf(first), buffersOf(firstDrawing)];
  const second = mandoline.cut(moved, around, { reuse: known });
  const drawing = mandoline.cellDrawing(moved, second, { reuse: drawn });
  const { stats: _, ...plain } = second;
  const { stats: __, ...wantedPlain } = wanted;
  assert.deepEqual(plain, wantedPlain);
  assert.deepEqual(drawing, wantedDrawing);
  const used = buffersOf(second);
  assert.ok(used.every((buffer) => buffer.byteLength === 0 || known.includes(buffer)));
  assert.ok(buffersOf(drawing).every((buffer) => drawn.includes(buffer)));
  assert.equal(new Set(used).size, used.length, 'each once');

  structuredClone(null, { transfer: buffersOf(second) });
  assert.deepEqual(mandoline.cut(moved, around, { reuse: used }).positions, wanted.positions, 'those that are gone are left out');
  assert.throws(() => mandoline.cut(cube, grid, { reuse: known[0] }), { code: 'badArgument', message: /^options\.reuse must be an array/ });
  assert.throws(() => mandoline.cut(cube, grid, { reuse: [wanted.positions] }), {
    code: 'badArgument',
    message: /^options\.reuse\[0\] must be an ArrayBuffer, not Float64Array/,
  });
});

test('points are found in their cells', () => {
  const cut = mandoline.cut(cube, grid);
  const inside = cut.regionWinding.indexOf(1);
  const place = mandoline.cellAt(cut, [0.75, 1.25, 0.75]);
  assert.deepEqual(place.gridCell, [0, 1, 0]);
  assert.equal(place.region, inside);
  assert.equal(cut.cellRegion[place.cell], inside);
  assert.deepEqual([...cut.cellGridCell.slice(3 * place.cell, 3 * place.cell + 3)], [0, 1, 0]);
  assert.equal(mandoline.cellAt(cut, [3, 0, 0]), null);
  const many = mandoline.cellsAt(cut, [0.75, 1.25, 0.75, 0.1, 0.1, 0.1, 3, 0, 0]);
  assert.equal(many.cell[0], place.cell);
  assert.deepEqual([...many.region], [inside, 1 - inside, -1]);
  assert.deepEqual([...many.gridCell], [0, 1, 0, 0, 0, 0, -1, -1, -1]);
});

test('a slice has the polygons of all cells', () => {
  const cut = mandoline.cut(cube, { min: [0, 0, 0], max: [4, 2, 2], cells: [4, 2, 2] });
  const inside = cut.regionWinding.indexOf(1);
  const areas = (slice) => {
    const sums = [0, 0];
    slice.polygonRegion.forEach((region, p) => {
      const [begin, end] = [slice.polygonTriangleOffsets[p], slice.polygonTriangleOffsets[p + 1]];
      sums[region] += areaOf(slice.positions, slice.triangles.subarray(3 * begin, 3 * end));
    });
    return [sums[inside], sums[1 - inside]];
  };
  const slice = mandoline.slice(cut, { normal: [0, 0, 2], offset: 2.5 });
  assert.deepEqual(areas(slice), [1, 7]);
  assert.deepEqual([...slice.polygonCell].filter((cell) => cell < 0).length, 4);
  assert.ok(slice.positions.every((x, i) => i % 3 < 2 || x === 1.25));
  assert.deepEqual(areas(mandoline.slice(cut, { normal: [0, 0, 2], offset: 2.5 }, { untouched: false })), [1, 3]);
});

test('slices of parallel planes are those of single calls, in their order', () => {
  const cut = mandoline.cut(cube, grid);
  const offsets = [1.7, 0.6, 1, 9];
  const slices = mandoline.slices(cut, [0, 0, 1], offsets, { untouched: false });
  assert.deepEqual(
    slices,
    offsets.map((offset) => mandoline.slice(cut, { normal: [0, 0, 1], offset }, { untouched: false })),
  );
  assert.deepEqual(mandoline.slices(cut, [0, 0, 1], []), []);
});

test('an outline has no seams between cells', () => {
  const cut = mandoline.cut(cube, grid);
  const [outlines, beside] = mandoline.outlines(cut, [0, 0, 1], [0.7, 9]);
  const inside = outlines.polygonRegion.indexOf(cut.regionWinding.indexOf(1));
  const [first, last] = [outlines.polygonLoopOffsets[inside], outlines.polygonLoopOffsets[inside + 1]];
  assert.equal(last - first, 1);
  const loop = outlines.loopPoints.subarray(outlines.loopOffsets[first], outlines.loopOffsets[last]);
  const at = [...loop].map((p) => [...outlines.positions.subarray(3 * p, 3 * p + 3)]);
  for (const [x, y, z] of at) assert.ok(z === 0.7 && (x === 0.5 || x === 1.5 || y === 0.5 || y === 1.5));
  const area = at.reduce((sum, [x, y], i) => sum + (x * at[(i + 1) % at.length][1] - at[(i + 1) % at.length][0] * y) / 2, 0);
  assert.ok(Math.abs(area - 1) < 1e-12);
  assert.equal(outlines.slitRegion.length, 0);
  assert.equal(beside.polygonRegion.length, 0);
});

test('measuring and validating tell their progress and can be cancelled', async () => {
  const mesh = torus(60, 30);
  const cut = mandoline.cut(mesh, { cells: 20 });
  for (const name of ['measure', 'validate']) {
    const seen = [];
    const whole = await mandoline[name](mesh, cut, {
      progress: (state) => {
        seen.push(state);
      },
    });
    assert.deepEqual(whole, await mandoline[name](mesh, cut));
    assert.ok(seen.length > 0 && seen.every(({ done, total, stageIndex, stageCount }) => done <= total && stageIndex < stageCount), name);
    await assert.rejects(async () => mandoline[name](mesh, cut, { progress: () => false }), { code: 'cancelled', stage: name });
    const own = new Error('mine');
    await assert.rejects(
      async () =>
        mandoline[name](mesh, cut, {
          progress() {
            throw own;
          },
        }),
      (error) => error === own,
    );
    const many = () => {
      for (let i = 0; i < 20; ++i) mandoline.cut(cube, grid);
    };
    assert.deepEqual(await mandoline[name](mesh, mandoline.cut(mesh, { cells: 20 }), { progress: many }), whole); // while its twin is let go
  }
});

test('a cube that is a grid cell', async () => {
  const aligned = box([1, 1, 1], [2, 2, 2]);
  const cut = mandoline.cut(aligned, { origin: [0, 0, 0], spacing: [1, 1, 1], cells: [3, 3, 3] });
  const inside = cut.regionWinding.indexOf(1);
  const { regionVolume } = mandoline.measure(aligned, cut);
  assert.deepEqual([regionVolume[inside], regionVolume[1 - inside]], [1, 26]);
  assert.ok(cut.faceTriangle.every((t, f) => t < 0 || cut.faceAxis[f] >= 0));
  assert.equal((await mandoline.validate(aligned, cut)).pass, true);
});

test('an open sheet has no winding numbers', async () => {
  const mesh = sheet([-1, -1], [2, 2], 0.5);
  const cut = mandoline.cut(mesh, { min: [0, 0, 0], max: [1, 1, 1], cells: [1, 1, 1] });
  assert.equal(cut.regionWinding, null);
  assert.equal(cut.regionCount, 2);
  assert.deepEqual([...mandoline.measure(mesh, cut).cellVolume], [0.5, 0.5]);
  assert.equal((await mandoline.validate(mesh, cut)).pass, true);
});

test('a sheet that ends within a cell cuts it partly', async () => {
  const mesh = sheet([-1, -1], [0.5, 2], 0.5);
  const cut = mandoline.cut(mesh, { min: [0, 0, 0], max: [1, 1, 1], cells: [1, 1, 1] });
  assert.equal(cut.regionCount, 1);
  assert.deepEqual([...mandoline.measure(mesh, cut).cellVolume], [1]);
  assert.equal((await mandoline.validate(mesh, cut)).pass, true);
});

test('all kinds of grids and arrays give the same cut', () => {
  const planes = [[0, 1, 2], new Float64Array([0, 1, 2]), new Float32Array([0, 1, 2])];
  const expected = mandoline.cut(cube, grid);
  const plain = { positions: [...cube.positions], triangles: [...cube.triangles] };
  const others = [
    mandoline.cut(plain, grid),
    mandoline.cut({ positions: new Float32Array(cube.positions), triangles: new Uint16Array(cube.triangles) }, grid),
    mandoline.cut(
      { positions: cube.positions, triangles: new Int32Array(cube.triangles) },
      { origin: [0, 0, 0], spacing: [1, 1, 1], cells: [2, 2, 2] },
    ),
    mandoline.cut(cube, { planes }),
    mandoline.cut(cube, expected.grid),
  ];
  for (const other of others) {
    assert.deepEqual({ ...other, grid: other.grid.planes, stats: 0 }, { ...expected, grid: expected.grid.planes, stats: 0 });
  }
  assert.deepEqual(others[4].grid, expected.grid);
  assert.equal(others[3].grid.spacing, null);
});

test('a grid around the mesh has a margin and cubic cells', () => {
  const { grid: around } = mandoline.cut(box([0, 0, 0], [1, 0.5, 0.25]), { cells: 11 });
  around.spacing.forEach((spacing) => assert.ok(Math.abs(spacing - 0.1) < 1e-15));
  assert.deepEqual(around.cells, [11, 6, 4]);
  const { grid: wide } = mandoline.cut(box([0, 0, 0], [1, 0.5, 0.25]), { cells: 20, margin: 2 });
  assert.deepEqual(wide.spacing, [0.25, 0.25, 0.25]);
  assert.deepEqual(wide.cells, [20, 18, 17]);
});

test('gridCellRegion may be left out', async () => {
  const cut = mandoline.cut(cube, grid, { gridCellRegion: false });
  assert.equal('gridCellRegion' in cut, false);
  assert.equal((await mandoline.validate(cube, cut)).pass, true);
});

test('the same input gives the same bits after any other cuts', () => {
  const mesh = torus(60, 30);
  const { stats: _, ...first } = mandoline.cut(mesh, { cells: 17 });
  mandoline.cut(cube, { cells: 40 });
  const { stats: __, ...second } = mandoline.cut(mesh, { cells: 17 });
  assert.deepEqual(second, first);
});

test('results can be cloned and transferred, and arguments stay as they are', async () => {
  const mesh = torus(20, 10);
  const before = structuredClone(mesh);
  const cut = mandoline.cut(mesh, { cells: 8 });
  const copy = structuredClone(cut);
  await mandoline.validate(mesh, cut);
  mandoline.measure(mesh, cut);
  await mandoline.write(mesh, cut, 'vtu');
  mandoline.slice(cut, { normal: [0, 0, 1], offset: 0 });
  assert.deepEqual(mesh, before);
  assert.deepEqual(cut, copy);
  const buffers = Object.values(cut)
    .filter((value) => ArrayBuffer.isView(value))
    .map((array) => array.buffer);
  assert.equal(new Set(buffers).size, buffers.length);
  const moved = structuredClone(cut, { transfer: buffers });
  assert.deepEqual(moved, copy);
  assert.equal(cut.positions.length, 0);
});

test('snapping moves vertices onto planes', async () => {
  const nearly = box([0.5, 0.5, 1.01], [1.5, 1.5, 1.5]);
  const cut = mandoline.cut(nearly, grid, { snapTolerance: 0.05 });
  assert.equal(cut.stats.snappedVertices, 4);
  assert.equal(cut.snapTolerance, 0.05);
  assert.ok(Math.abs(cut.stats.largestSnap - 0.01) < 1e-12);
  assert.equal((await mandoline.validate(nearly, cut)).pass, true);
  assert.equal((await mandoline.validate(nearly, { ...cut, snapTolerance: 0 })).pass, false);
});

test('files', async () => {
  const cut = mandoline.cut(cube, grid);
  const text = async (format) => new TextDecoder().decode(await mandoline.write(cube, cut, format));
  const dump = JSON.parse(await text('json'));
  assert.equal(dump.format, 'mandoline-cut-mesh');
  for (const [key, value] of Object.entries(dump)) {
    if (Array.isArray(value)) assert.deepEqual(value, cut[key] ? [...cut[key]] : Array(cut.regionCount).fill(null), key);
  }
  assert.match(await text('vtu'), /^<\?xml.*NumberOfCells="16"/s);
  const obj = await text('obj');
  assert.match(obj, /^g region_/);
  assert.equal(obj.match(/^f /gm).length, 36);
});

test('files of some regions, and without untouched cells', async () => {
  const cut = mandoline.cut(cube, grid);
  const text = async (format, options) => new TextDecoder().decode(await mandoline.write(cube, cut, format, options));
  const cells = async (options) => Number(/NumberOfCells="(\d+)"/.exec(await text('vtu', options))[1]);
  const inside = Array.from(cut.regionWinding, (winding) => winding === 1);
  const all = await cells();
  assert.equal(await cells({ untouched: false }), cut.cellRegion.length);
  const count = await cells({ regions: inside });
  assert.equal(count + (await cells({ regions: Uint8Array.from(inside, (flag) => !flag) })), all);
  assert.ok(count > 0 && count < all);
  const region = inside.indexOf(true);
  assert.deepEqual((await text('obj', { regions: inside })).match(/^g .*$/gm), [`g region_${region}`]);
});

test('writing tells its progress and can be cancelled', async () => {
  const mesh = torus(100, 50);
  const cut = mandoline.cut(mesh, { cells: 20 });
  for (const format of ['json', 'vtu', 'obj']) {
    const seen = [];
    const whole = await mandoline.write(mesh, cut, format, {
      progress: (state) => {
        seen.push(state);
      },
    });
    assert.deepEqual(whole, await mandoline.write(mesh, cut, format));
    const { stageIndex, stageCount, done, total } = seen.at(-1);
    assert.deepEqual([stageIndex, done], [stageCount - 1, total], format);
    await assert.rejects(mandoline.write(mesh, cut, format, { progress: () => false }), { code: 'cancelled', stage: 'write' });
    const own = new Error('mine');
    await assert.rejects(
      async () =>
        mandoline.write(mesh, cut, format, {
          progress() {
            throw own;
          },
        }),
      (error) => error === own,
    );
  }
});

test('doubles in files read back identically', async () => {
  const tiny = 1e-300;
  const mesh = box([0.1 * tiny, -tiny, -0], [tiny / 3, 1e-7 * tiny, 1e21 * tiny]);
  const cut = mandoline.cut(mesh, { cells: 2 });
  assert.deepEqual(JSON.parse(new TextDecoder().decode(await mandoline.write(mesh, cut, 'json'))).positions, [...cut.positions]);
  assert.ok(cut.positions.some((x) => Object.is(x, -0)) && cut.positions.some((x) => x !== 0 && Math.abs(x) < 1e-300));
});

test('progress runs through all stages', () => {
  const seen = [];
  const cut = mandoline.cut(
    torus(100, 50),
    { cells: 20 },
    {
      progress: (state) => {
        seen.push(state);
      },
    },
  );
  const stages = [...new Set(seen.map(({ stage }) => stage))];
  assert.deepEqual(
    stages,
    cut.stats.stages.map(({ stage }) => stage),
  );
  for (const { stage, stageIndex, stageCount, done, total } of seen) {
    assert.equal(stages[stageIndex], stage);
    assert.equal(stageCount, stages.length);
    assert.ok(done >= 0 && done <= total);
  }
});

test('returning false cancels; what a callback throws reaches the caller; both leave the module usable', async () => {
  const mesh = torus(40, 20);
  let calls = 0;
  const cancelled = () =>
    mandoline.cut(
      mesh,
      { cells: 10 },
      {
        progress: ({ stage }) => {
          ++calls;
          return stage !== 'bricks';
        },
      },
    );
  assert.throws(cancelled, { name: 'MandolineError', code: 'cancelled', stage: 'bricks' });
  const after = calls;
  const own = new Error('mine');
  assert.throws(
    () =>
      mandoline.cut(
        mesh,
        { cells: 10 },
        {
          progress() {
            throw own;
          },
        },
      ),
    (error) => error === own,
  );
  assert.equal(calls, after);
  assert.equal((await mandoline.validate(mesh, mandoline.cut(mesh, { cells: 10 }))).pass, true);
});

test('a callback may cut, too', () => {
  let inner;
  const outer = mandoline.cut(cube, grid, {
    progress: () => {
      inner ??= mandoline.cut(cube, grid);
    },
  });
  assert.deepEqual(inner.positions, outer.positions);
});

test('two boxes that overlap are cut as if they had been resolved', async () => {
  const cutMesh = mandoline.cut(twoBoxes, { min: [0, 0, 0], max: [5, 5, 5], cells: [5, 5, 5] });
  const { regionVolume } = mandoline.measure(twoBoxes, cutMesh);
  const regions = [...cutMesh.regionWinding].map((winding, region) => `${winding}: ${regionVolume[region]}`);
  assert.deepEqual(regions.sort(), ['0: 110', '1: 7', '1: 7', '2: 1']);
  assert.ok((await mandoline.validate(twoBoxes, cutMesh)).pass);
  const { counts, pairTriangles, pairKinds, pairPointOffsets, positions } = mandoline.findIntersections(twoBoxes);
  assert.deepEqual(cutMesh.stats.intersections, counts);
  assert.equal(counts.crossing + counts.touching, pairKinds.length);
  assert.equal(pairTriangles.length, 2 * pairKinds.length);
  assert.equal(positions.length, 3 * pairPointOffsets.at(-1));
  assert.ok(positions.every((x) => x >= 2 && x <= 3));
  assert.equal(cutMesh.stats.madeVertices, cutMesh.madeVertices.length);
  assert.equal(cutMesh.madeVertexParents.length, 4 * cutMesh.madeVertexKinds.length);
});

test('a turned triangle is found by its edges, and turned back', () => {
  const triangles = Uint32Array.from(twoBoxes.triangles);
  [triangles[1], triangles[2]] = [triangles[2], triangles[1]];
  const turned = { ...twoBoxes, triangles };
  const info = mandoline.inspect(turned);
  assert.deepEqual([info.closed, info.oriented, info.inconsistentEdges, info.components], [true, false, 3, 2]);
  assert.deepEqual([...info.componentOriented], [0, 1]);
  assert.deepEqual([...info.defectKind], [2, 2, 2]);
  assert.deepEqual([...info.defectPlace, ...info.placeComponent], [0, 0, 0, 0]);
  assert.equal(mandoline.cut(turned, { cells: 3 }).regionWinding, null);
  const { mesh, turnedTriangles, trianglePatch, patchFacing } = mandoline.orient(turned);
  assert.deepEqual([...turnedTriangles], [0]);
  assert.deepEqual([...patchFacing], [0, 0]);
  assert.deepEqual([trianglePatch[0], trianglePatch.at(-1)], [0, 1]);
  assert.deepEqual([...mesh.triangles], [...twoBoxes.triangles]);
  assert.ok(mandoline.inspect(mesh).oriented);
  assert.throws(() => mandoline.orient({ positions: [], triangles: [] }), { code: 'emptyMesh' });
});

test('a mesh is oriented as it is prepared, and goes with its cut-meshes so', async () => {
  const triangles = Uint32Array.from(twoBoxes.triangles);
  [triangles[1], triangles[2]] = [triangles[2], triangles[1]];
  const turned = { ...twoBoxes, triangles };
  const prepared = mandoline.prepare(turned, { orient: true });
  assert.deepEqual(prepared, twoBoxes);
  const cutMesh = mandoline.cut(prepared, { cells: 3 });
  const { stats: _, ...expected } = mandoline.cut(twoBoxes, { cells: 3 });
  assert.deepEqual({ ...cutMesh, stats: undefined }, { ...expected, stats: undefined });
  assert.ok((await mandoline.validate(prepared, cutMesh)).pass);
  assert.equal(mandoline.cut(mandoline.prepare(turned), { cells: 3 }).regionWinding, null);
  for (let i = 0; i < 20; ++i) mandoline.cut(cube, grid); // to which the twin gives way
  assert.deepEqual(mandoline.cut(prepared, { cells: 3 }).regionWinding, expected.regionWinding);
  assert.throws(() => mandoline.prepare(turned, { orient: 1 }), { code: 'badArgument', message: /^options\.orient must be true or false/ });
  assert.throws(() => mandoline.prepare({ positions: [], triangles: [] }, { orient: true }), { code: 'emptyMesh', stage: 'input' });
});

test('a prepared mesh is cut as the mesh itself, and without its arrays', () => {
  const prepared = gut(mandoline.prepare(twoBoxes));
  for (const cells of [3, 8]) {
    const [{ stats, ...expected }, { stats: fewer, ...cutMesh }] = [mandoline.cut(twoBoxes, { cells }), mandoline.cut(prepared, { cells })];
    assert.deepEqual(cutMesh, expected);
    assert.deepEqual(fewer.intersections, stats.intersections);
    assert.deepEqual(
      fewer.stages.map(({ stage }) => stage),
      stats.stages.slice(2).map(({ stage }) => stage),
    );
  }
  assert.deepEqual(mandoline.prepare(twoBoxes), twoBoxes);
  assert.throws(() => mandoline.prepare(twoBoxes, { intersections: 'refuse' }), { code: 'selfIntersection', stage: 'intersections' });
  assert.throws(() => mandoline.prepare(twoBoxes, { progress: () => false }), { code: 'cancelled' });
});

test('crossing boxes are resolved into triangles that know their parents', () => {
  const resolved = mandoline.resolve(twoBoxes);
  const { positions, triangles, vertexTriVertex, remaining, stats } = resolved;
  const { parentOffsets, parents, parentSigns, frontWinding, backWinding } = resolved;
  const n = triangles.length / 3;
  assert.deepEqual(stats.intersections, mandoline.findIntersections(twoBoxes).counts);
  assert.deepEqual(remaining, { crossing: 0, touching: 0, overlapping: 0, folded: 0, identical: 0 });
  assert.deepEqual(mandoline.findIntersections(resolved).counts, remaining);
  assert.deepEqual([parentOffsets.length, frontWinding.length, backWinding.length], [n + 1, n, n]);
  assert.equal(parents.length, n); // no two of the boxes' triangles lie on each other
  assert.ok(parentSigns.every((sign) => sign === 1));
  assert.equal(volumeOf(resolved), 16); // both boxes, and what they share once more
  const areas = new Float64Array(24);
  for (let t = 0; t < n; ++t) areas[parents[t]] += areaOf(positions, triangles.subarray(3 * t, 3 * t + 3));
  assert.ok(areas.every((area) => area === 2)); // half a side each
  vertexTriVertex.forEach((v, i) => {
    if (v >= 0) assert.deepEqual(positions.slice(3 * i, 3 * i + 3), twoBoxes.positions.slice(3 * v, 3 * v + 3));
  });
  assert.equal(vertexTriVertex.filter((v) => v >= 0).length, 16);
  frontWinding.forEach((front, t) => assert.equal(backWinding[t] - front, 1));
});

test('the boundary of overlapping parts by each rule, of the resolved mesh and of a cut-mesh', () => {
  const grids = { min: [0, 0, 0], max: [5, 5, 5], cells: [5, 5, 5] };
  for (const [rule, volume] of [
    [undefined, 15],
    ['positive', 15],
    ['nonZero', 15],
    ['odd', 14],
  ]) {
    for (const mesh of [mandoline.resolve(twoBoxes), mandoline.cut(twoBoxes, grids)]) {
      const boundary = mandoline.boundary(mesh, rule);
      assert.equal(volumeOf(boundary), volume);
      assertClosed(boundary);
      assert.deepEqual(mandoline.boundary({ ...mesh }, rule), boundary);
    }
  }
  const turned = { ...twoBoxes, triangles: twoBoxes.triangles.slice().reverse() };
  assert.deepEqual(mandoline.boundary(mandoline.resolve(turned)), { positions: new Float64Array(), triangles: new Uint32Array() });
  assert.equal(volumeOf(mandoline.boundary(mandoline.resolve(turned), 'nonZero')), 15);
});

test('the boundary of a solid that reaches the sides of the grid is closed by them', () => {
  const cutMesh = mandoline.cut(twoBoxes, { min: [1.25, 1.5, 1], max: [3.75, 5, 2.5], cells: [5, 7, 3] });
  for (const [rule, volume] of [
    ['positive', 5.1875],
    ['odd', 4.6875],
  ]) {
    const boundary = mandoline.boundary(cutMesh, rule);
    assert.equal(volumeOf(boundary), volume);
    assertClosed(boundary);
  }
});

test('triangles that lie on each other are one with several parents', () => {
  const cubeTwice = join(cube, { ...cube, triangles: cube.triangles.slice().reverse() });
  const { triangles, parentOffsets, parents, parentSigns, frontWinding, backWinding } = mandoline.resolve(cubeTwice);
  assert.equal(triangles.length, 36);
  assert.deepEqual(
    [...parentOffsets],
    Array.from({ length: 13 }, (_, t) => 2 * t),
  );
  assert.ok(parentSigns.every((sign, i) => sign === (i % 2 ? -1 : 1)));
  assert.deepEqual(
    [...parents].sort((a, b) => a - b),
    Array.from({ length: 24 }, (_, t) => t),
  );
  assert.ok([...frontWinding, ...backWinding].every((winding) => winding === 0));
});

test('a mesh without winding numbers is resolved, and has no boundary', () => {
  const sheets = join(sheet([0, 0], [2, 2], 0.5), sheet([1, 1], [3, 3], 0.5));
  const resolved = mandoline.resolve(sheets);
  assert.deepEqual([resolved.frontWinding, resolved.backWinding], [null, null]);
  assert.equal(areaOf(resolved.positions, resolved.triangles), 7);
  assert.equal(resolved.stats.intersections.overlapping > 0, true);
});

test('rounded vertices that meet again are counted', () => {
  const crossing = join(torus(40, 20), torus(40, 20, 1.1, 0.3));
  const resolved = mandoline.resolve(crossing);
  assert.deepEqual(mandoline.findIntersections(resolved).counts, resolved.remaining);
  assert.throws(() => mandoline.resolve(crossing, { progress: () => false }), { code: 'cancelled' });
  assert.throws(() => mandoline.resolve({ positions: [], triangles: [] }), { code: 'emptyMesh', stage: 'input' });
});

test('sheets that overlap share faces with two parents', () => {
  const sheets = join(sheet([0, 0], [2, 2], 0.5), sheet([1, 1], [3, 3], 0.5));
  const cutMesh = mandoline.cut(sheets, { min: [-1, -1, 0], max: [4, 4, 1], cells: [5, 5, 1] });
  const { faceArea } = mandoline.measure(sheets, cutMesh);
  const { faceParentOffsets, faceParents, faceParentSigns, faceTriangle } = cutMesh;
  let shared = 0;
  faceTriangle.forEach((triangle, face) => {
    const parents = faceParents.slice(faceParentOffsets[face], faceParentOffsets[face + 1]);
    assert.equal(triangle, parents.length > 0 ? parents[0] : -1);
    if (parents.length === 2) shared += faceArea[face];
  });
  assert.equal(shared, 1);
  assert.ok(faceParentSigns.every((sign) => sign === 1));
});

test('the listed pairs have a cap, the counted ones have none', () => {
  const twice = join(torus(12, 6), torus(12, 6));
  const { counts, pairKinds, pairPointOffsets } = mandoline.findIntersections(twice, { maxPairs: 5 });
  assert.equal(counts.identical, 144);
  assert.deepEqual([pairKinds.length, pairPointOffsets.length], [5, 6]);
  assert.deepEqual(mandoline.findIntersections(twice, { maxPairs: 0 }).counts, counts);
});

test('a cut-mesh of version 0.1.0 has its triangles as the only parents', async () => {
  const mesh = torus(24, 12);
  const cutMesh = mandoline.cut(mesh, { cells: 6 });
  const { faceParentOffsets, faceParents, faceParentSigns, madeVertices, madeVertexKinds, madeVertexParents, ...old } = cutMesh;
  assert.ok((await mandoline.validate(mesh, old)).pass);
  assert.deepEqual(mandoline.measure(mesh, old), mandoline.measure(mesh, cutMesh));
});

test('failures are named', () => {
  const finite = box([0, 0, 0], [1, 1, 1]);
  const broken = { ...finite, positions: finite.positions.slice() };
  broken.positions[7] = NaN;
  const crossing = join(sheet([0, 0], [1, 1], 0.5), { positions: [0.5, 0.5, 0, 0.6, 0.5, 1, 0.5, 0.6, 1], triangles: [0, 1, 2] });
  const cases = [
    [() => mandoline.cut({ positions: [], triangles: [] }, { cells: 3 }), { code: 'emptyMesh', stage: 'input' }],
    [() => mandoline.cut({ positions: [0, 0], triangles: [0, 0, 0] }, { cells: 3 }), { code: 'badArrays' }],
    [() => mandoline.cut({ ...finite, triangles: [0, 1, 2, 0, 1, 8] }, { cells: 3 }), { code: 'badIndex', element: 1 }],
    [() => mandoline.cut({ ...finite, triangles: [0, 1, -1] }, { cells: 3 }), { code: 'badIndex', element: 0 }],
    [() => mandoline.cut({ ...finite, triangles: [0, 1, 2 ** 32] }, { cells: 3 }), { code: 'badIndex', element: 0 }],
    [() => mandoline.cut(broken, { cells: 3 }), { code: 'nonFiniteCoordinate', element: 2 }],
    [() => mandoline.cut(finite, { cells: 0 }), { code: 'badGrid', stage: 'input' }],
    [() => mandoline.cut(finite, { cells: 4, margin: NaN }), { code: 'badGrid', stage: 'input' }],
    [() => mandoline.cut(finite, { cells: 4, margin: '1' }), { code: 'badArgument' }],
    [() => mandoline.cut(finite, { cells: -(2 ** 70) }), { code: 'badGrid' }],
    [
      () =>
        mandoline.cut(finite, {
          planes: [
            [0, 1],
            [0, 0],
            [0, 1],
          ],
        }),
      { code: 'badGrid', element: 1 },
    ],
    [
      () =>
        mandoline.cut(finite, {
          planes: [
            [0, 1],
            [0, 1],
            [0, NaN],
          ],
        }),
      { code: 'badGrid', element: 2 },
    ],
    [() => mandoline.cut(finite, { cells: 2 ** 70 }), { code: 'gridTooLarge' }],
    [() => mandoline.cut(finite, { cells: 3 }, { snapTolerance: 0.5 }), { code: 'badOption' }],
    [() => mandoline.cut(finite, { cells: 3 }, { snapTolerance: NaN }), { code: 'badOption' }],
    [
      () => mandoline.cut(crossing, { cells: 16 }, { intersections: 'refuse' }),
      { code: 'selfIntersection', element2: 2, stage: 'intersections' },
    ],
    [() => mandoline.findIntersections(broken), { code: 'nonFiniteCoordinate', element: 2, stage: 'findIntersections' }],
  ];
  for (const [call, expected] of cases) {
    assert.throws(call, (error) => {
      assert.ok(error instanceof MandolineError && error instanceof Error);
      for (const [key, value] of Object.entries(expected)) assert.equal(error[key], value, `${error.code}: ${error.message}`);
      assert.ok(describe(error).startsWith(error.message));
      assert.ok(describe(error).length > error.message.length + 20);
      return true;
    });
  }
});

test('describe takes any value that was caught', () => {
  assert.equal(describe(new TypeError('no')), 'TypeError: no');
  assert.equal(describe('text'), 'text');
  assert.equal(describe(undefined), 'undefined');
  const fault = { code: 'internalError', message: 'No way.', stage: 'bricks', element: -1, element2: -1 };
  assert.match(describe(fault), /^No way\. It happened in bricks\. Please report/);
});

test('describe says nothing twice', () => {
  const said = (call) => {
    try {
      call();
    } catch (error) {
      return describe(error);
    }
    return assert.fail('nothing was thrown');
  };
  const crossing = join(box([0, 0, 0], [1, 1, 1]), box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]));
  const intersection = said(() => mandoline.cut(crossing, { cells: 8 }, { intersections: 'refuse' }));
  const pattern = /^Triangles \d+ and \d+ meet other than in a shared vertex or edge, the first of \d+ pairs that do\. Cut with/;
  assert.match(intersection, pattern);
  assert.equal(intersection.match(/\d+/g).length, 3, 'two triangles and the number of pairs');
  assert.doesNotMatch(intersection, /regions|may meet/);
  const nonFinite = said(() => mandoline.cut({ positions: [0, 0, 0, 1, 0, 0, 0, 1, NaN], triangles: [0, 1, 2] }, { cells: 8 }));
  assert.equal(nonFinite, 'Vertex 2 has a coordinate that is not finite. Repair or leave out that vertex and its triangles.');
  const badIndex = said(() => mandoline.cut({ positions: [0, 0, 0], triangles: [0, 0, 7] }, { cells: 8 }));
  assert.equal(badIndex.match(/vert/gi).length, 2, badIndex);
});
