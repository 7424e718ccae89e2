// Wrong arguments end in a named error that says which one, and nothing else happens.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { init, MandolineError } from 'mandoline-wasm';
import { box, sheet, torus } from './meshes.mjs';

const mandoline = await init();
const mesh = box([0.5, 0.5, 0.5], [1.5, 1.5, 1.5]);
const grid = { min: [0, 0, 0], max: [2, 2, 2], cells: [2, 2, 2] };
const cutMesh = mandoline.cut(mesh, grid);

function detached(array) {
  const copy = array.slice();
  structuredClone(copy, { transfer: [copy.buffer] });
  return copy;
}

/** A copy of a fixed length in a buffer that has become shorter. */
function outOfBounds(array) {
  const buffer = new ArrayBuffer(array.byteLength, { maxByteLength: array.byteLength });
  const copy = new array.constructor(buffer, 0, array.length);
  buffer.resize(1);
  return copy;
}

/** Whether it throws, or promises to. */
async function assertBad(call, pattern) {
  await assert.rejects(
    async () => call(),
    (error) => {
      assert.ok(error instanceof MandolineError, `${error.stack}`);
      assert.equal(error.code, 'badArgument', error.message);
      assert.match(error.message, pattern);
      assert.notEqual(error.stage, '');
      return true;
    },
  );
}

test('meshes', async () => {
  const cases = [
    [undefined, /^mesh must be an object, not undefined/],
    [null, /^mesh must be an object, not null/],
    [{}, /^mesh\.positions must be an array of numbers, not undefined/],
    [{ ...mesh, positions: 'text' }, /^mesh\.positions .* not string/],
    [{ ...mesh, positions: new BigInt64Array(3) }, /^mesh\.positions/],
    [{ ...mesh, positions: [0, '1', 2] }, /^mesh\.positions\[1\] must be a number, not string/],
    [{ ...mesh, positions: [0, undefined, 2] }, /^mesh\.positions\[1\]/],
    [{ ...mesh, positions: detached(mesh.positions) }, /^mesh\.positions is detached/],
    [{ ...mesh, triangles: detached(mesh.triangles) }, /^mesh\.triangles is detached/],
    [{ ...mesh, positions: outOfBounds(mesh.positions) }, /^mesh\.positions is detached or out of bounds/],
    [{ ...mesh, triangles: outOfBounds(mesh.triangles) }, /^mesh\.triangles is detached or out of bounds/],
    [{ ...mesh, triangles: new Float32Array(3) }, /^mesh\.triangles must be an array of tri-vertex ids, not Float32Array/],
    [{ ...mesh, triangles: new ArrayBuffer(12) }, /^mesh\.triangles/],
    [{ ...mesh, triangles: new DataView(new ArrayBuffer(12)) }, /^mesh\.triangles/],
    [{ ...mesh, triangles: [0, 1, 1.5] }, /^mesh\.triangles\[2\] must be a whole number, not 1\.5/],
    [{ ...mesh, triangles: [0, 1, NaN] }, /^mesh\.triangles\[2\]/],
    [{ ...mesh, triangles: [0, 1, '2'] }, /^mesh\.triangles\[2\]/],
    [{ ...mesh, triangles: [[0, 1, 2]] }, /^mesh\.triangles\[0\] must be a whole number, not an array/],
  ];
  for (const [wrong, pattern] of cases) {
    await assertBad(() => mandoline.cut(wrong, grid), pattern);
    await assertBad(() => mandoline.measure(wrong, cutMesh), pattern);
    await assertBad(() => mandoline.validate(wrong, cutMesh), pattern);
  }
});

test('grids', async () => {
  const cases = [
    [undefined, /^grid must be an object/],
    [32, /^grid must be an object, not 32/],
    [{}, /^grid\.cells must be a whole number, not undefined/],
    [{ cells: '32' }, /^grid\.cells must be a whole number, not string/],
    [{ cells: 1.5 }, /^grid\.cells .* not 1\.5/],
    [{ cells: NaN }, /^grid\.cells/],
    [{ cells: [2, 2, 2] }, /^grid\.cells must be a whole number, not an array/],
    [{ ...grid, cells: 4 }, /^grid\.cells must have three numbers/],
    [{ ...grid, cells: [2, 2, 2.5] }, /^grid\.cells\[2\]/],
    [{ ...grid, min: [0, 0] }, /^grid\.min must have three numbers, not 2/],
    [{ ...grid, max: undefined }, /^grid\.max/],
    [{ ...grid, max: [1, 2, null] }, /^grid\.max\[2\] must be a number, not null/],
    [{ spacing: [1, 1, 1], cells: [1, 1, 1] }, /^grid\.origin/],
    [{ planes: [[0, 1], undefined, [0, 1]] }, /^grid\.planes\[1\] must be an array of numbers, not undefined/],
    [
      {
        planes: [
          [0, 1],
          [0, 1],
        ],
      },
      /^grid\.planes must have the planes of three axes/,
    ],
    [
      {
        planes: [
          [0, 1],
          [0, 1],
          [0, '1'],
        ],
      },
      /^grid\.planes\[2\]\[1\]/,
    ],
    [{ planes: [[0, 1], [0, 1], 7] }, /^grid\.planes\[2\]/],
    [{ planes: [[0, 1], [0, 1], { length: -1 }] }, /^grid\.planes\[2\]/],
  ];
  for (const [wrong, pattern] of cases) await assertBad(() => mandoline.cut(mesh, wrong), pattern);
});

test('a margin is not negative, as on the command line', () => {
  for (const margin of [-0.1, -0.6, NaN, Infinity, 1e7]) {
    assert.throws(() => mandoline.cut(mesh, { cells: 4, margin }), {
      code: 'badGrid',
      stage: 'input',
      message: /^grid\.margin must be from 0/,
    });
  }
  assert.equal(mandoline.cut(mesh, { cells: 4, margin: 0 }).grid.planes[0][0], 0.5);
});

test('a grid that is too large is told', () => {
  const cases = [
    [{ cells: 2 ** 25 }, /^The grid's x axis has .* Asked for were 33554432 cells along the longest side of the mesh\.$/],
    [{ ...grid, cells: [1, 2 ** 25, 3] }, /^The grid's y axis has .* Asked for were 1 x 33554432 x 3 cells\.$/],
    [{ ...grid, cells: [1, 2 ** 15, 2 ** 14] }, /rows of cells\. Asked for were 1 x 32768 x 16384 cells\.$/],
  ];
  for (const [wrong, message] of cases) assert.throws(() => mandoline.cut(mesh, wrong), { code: 'gridTooLarge', stage: 'input', message });
});

test('options', async () => {
  const cases = [
    [null, /^options must be an object/],
    [3, /^options must be an object/],
    [{ snapTolerance: '0' }, /^options\.snapTolerance must be a number, not string/],
    [{ progress: {} }, /^options\.progress must be a function/],
    [{ gridCellRegion: 1 }, /^options\.gridCellRegion must be true or false/],
    [{ intersections: 'never' }, /^options\.intersections must be "resolve", "refuse" or "assumeNone", not "never"/],
    [{ intersections: null }, /^options\.intersections must be .*, not null/],
  ];
  for (const [wrong, pattern] of cases) await assertBad(() => mandoline.cut(mesh, grid, wrong), pattern);
  await assertBad(() => mandoline.findIntersections(mesh, { maxPairs: -1 }), /^options\.maxPairs must be at least 0, not -1/);
  await assertBad(() => mandoline.findIntersections(mesh, { maxPairs: 1.5 }), /^options\.maxPairs must be a whole number/);
  for (const snapTolerance of [-1, 0.5, NaN, Infinity]) {
    assert.throws(() => mandoline.cut(mesh, grid, { snapTolerance }), { code: 'badOption', stage: 'input' });
  }
});

const calls = {
  validate: (wrong) => mandoline.validate(mesh, wrong),
  measure: (wrong) => mandoline.measure(mesh, wrong),
  cutEdges: (wrong) => mandoline.cutEdges(mesh, wrong),
  adjacency: (wrong) => mandoline.adjacency(wrong),
  cellDrawing: (wrong) => mandoline.cellDrawing(mesh, wrong),
  triangulate: (wrong) => mandoline.triangulate(wrong),
  'triangulate one cell': (wrong) => mandoline.triangulate(wrong, { cell: 0 }),
  'triangulate one region': (wrong) => mandoline.triangulate(wrong, { region: 0 }),
  cellAt: (wrong) => mandoline.cellAt(wrong, [0.6, 0.6, 0.6]),
  cellsAt: (wrong) => mandoline.cellsAt(wrong, [0.6, 0.6, 0.6]),
  slice: (wrong) => mandoline.slice(wrong, { normal: [1, 1, 1], offset: 2 }),
  insideRegions: (wrong) => mandoline.insideRegions(wrong),
  estimateInside: (wrong) => mandoline.estimateInside(mesh, wrong),
  'write json': (wrong) => mandoline.write(mesh, wrong, 'json'),
  'write vtu': (wrong) => mandoline.write(mesh, wrong, 'vtu'),
  'write obj': (wrong) => mandoline.write(mesh, wrong, 'obj'),
};
const takesMesh = (name) => /validate|measure|cutEdges|estimateInside|vtu/.test(name);
const arrays = Object.keys(cutMesh).filter((key) => ArrayBuffer.isView(cutMesh[key]) && key !== 'gridCellRegion');

for (const [name, call] of Object.entries(calls)) {
  test(`${name} of a value that is not a cut-mesh`, async () => {
    await assertBad(() => call(undefined), /^cutMesh must be an object/);
    await assertBad(() => call({}), /^cutMesh\.grid must be an object/);
    await assertBad(() => call({ ...cutMesh, grid: {} }), /^cutMesh\.grid\.planes/);
    await assertBad(() => call({ ...cutMesh, regionCount: -1 }), /^cutMesh\.regionCount/);
    await assertBad(() => call({ ...cutMesh, regionCount: '2' }), /^cutMesh\.regionCount/);
    await assertBad(() => call({ ...cutMesh, triangleCount: undefined }), /^cutMesh\.triangleCount/);
    await assertBad(() => call({ ...cutMesh, regionWinding: undefined }), /^cutMesh\.regionWinding/);
    for (const key of arrays) {
      await assertBad(() => call({ ...cutMesh, [key]: undefined }), new RegExp(`^cutMesh\\.${key} must be a \\w+Array, not undefined`));
      await assertBad(() => call({ ...cutMesh, [key]: [...cutMesh[key]] }), new RegExp(`^cutMesh\\.${key} must be a`));
      if (cutMesh[key].length === 0) continue;
      await assertBad(() => call({ ...cutMesh, [key]: detached(cutMesh[key]) }), new RegExp(`^cutMesh\\.${key} is detached`));
      await assertBad(() => call({ ...cutMesh, [key]: outOfBounds(cutMesh[key]) }), new RegExp(`^cutMesh\\.${key} is .* out of bounds`));
    }
  });

  test(`${name} of arrays of wrong lengths or with ids out of range`, async () => {
    const damages = [];
    for (const key of arrays) {
      const array = cutMesh[key];
      if (array.length === 0) continue;
      damages.push([key, array.slice(1)], [key, array.slice(0, 0)], [key, Object.getPrototypeOf(array).constructor.of(...array, 1)]);
      const anything = ['positions', 'regionWinding', 'faceAxis', ...(takesMesh(name) ? [] : ['vertexTriVertex', 'vertexParents'])];
      if (!anything.includes(key)) damages.push([key, array.map(() => 0x7fffffff)]);
    }
    damages.push(['positions', cutMesh.positions.map(() => NaN)], ['faceAxis', cutMesh.faceAxis.map(() => 3)]);
    damages.push(['cellHalfFaceOffsets', cutMesh.cellHalfFaceOffsets.map((x, i) => (i % 2 ? 0 : x))]);
    for (const planes of [[0], [2, 1, 0]]) damages.push(['grid', { ...cutMesh.grid, planes: [[0, 1, 2], [0, 1, 2], planes] }]);
    for (const [key, value] of damages) {
      const damaged = { ...cutMesh, [key]: value };
      if (name === 'validate') {
        assert.equal((await call(damaged)).pass, false, key);
      } else {
        await assertBad(() => call(damaged), /don't fit together|there are only|is not the one that the cut-mesh was made from/);
      }
    }
    assert.ok(await call(cutMesh)); // the instance lives
  });
}

test('boundary() of meshes that it does not take', async () => {
  const resolved = mandoline.resolve(mesh);
  const cases = [
    [undefined, /^mesh must be an object, not undefined/],
    [{}, /^mesh\.positions must be an array of numbers/],
    [mesh, /^mesh\.frontWinding must be a Int32Array, not undefined/],
    [{ ...resolved, backWinding: [...resolved.backWinding] }, /^mesh\.backWinding must be a Int32Array, not an array/],
    [{ ...resolved, frontWinding: null }, /^mesh\.frontWinding must be a Int32Array, not null/],
    [{ ...resolved, backWinding: null }, /^mesh\.backWinding must be a Int32Array, not null/],
    [{ ...resolved, frontWinding: detached(resolved.frontWinding) }, /^mesh\.frontWinding is detached/],
    [{ ...resolved, frontWinding: resolved.frontWinding.slice(1) }, /don't fit together/],
    [{ ...resolved, backWinding: new Int32Array() }, /don't fit together/],
    [{ ...resolved, positions: resolved.positions.slice(3) }, /don't fit together/],
    [{ ...resolved, positions: resolved.positions.slice(1) }, /don't fit together/],
    [{ ...resolved, triangles: resolved.triangles.slice(1) }, /don't fit together/],
    [{ ...resolved, frontWinding: null, backWinding: null }, /^No part of the mesh is closed/],
    [mandoline.resolve(sheet([0, 0], [1, 1], 0)), /^No part of the mesh is closed/],
    [mandoline.cut(sheet([0, 0], [1, 1], 0.5), grid), /^No part of the mesh is closed/],
    [{ ...cutMesh, positions: null }, /^cutMesh\.positions must be a Float64Array/],
    [{ ...cutMesh, cellRegion: cutMesh.cellRegion.slice(1) }, /don't fit together/],
  ];
  for (const [wrong, pattern] of cases) await assertBad(() => mandoline.boundary(wrong), pattern);
  for (const rule of [null, 7, 'nonzero']) {
    await assertBad(() => mandoline.boundary(resolved, rule), /^inside must be "positive", "nonZero" or "odd", not/);
    await assertBad(() => mandoline.boundary(cutMesh, rule), /^inside must be "positive", "nonZero" or "odd", not/);
  }
  await assertBad(() => mandoline.boundary(cutMesh, {}), /^inside must be a Uint8Array or an array, not an object/);
  await assertBad(() => mandoline.boundary(cutMesh, detached(new Uint8Array(2))), /^inside is detached/);
});

test('damaged entries are judged, never followed', async () => {
  const large = torus(24, 12);
  const cut = mandoline.cut(large, { cells: 6 });
  let state = 1;
  const random = (n) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * n);
  };
  for (let round = 0; round < 400; ++round) {
    const key = arrays[random(arrays.length)];
    const value = cut[key].slice();
    if (value.length === 0) continue;
    for (let i = 0; i < 3; ++i) {
      const entries = [0, 1, -1, 7, 1000, 2 ** 31 - 1, 2 ** 32 - 1, value[random(value.length)]];
      value[random(value.length)] = entries[random(8)];
    }
    const damaged = { ...cut, [key]: value };
    const ofLarge = { measure: () => mandoline.measure(large, damaged), validate: () => mandoline.validate(large, damaged) };
    for (const [name, call] of Object.entries({ ...calls, ...ofLarge })) {
      try {
        await call(damaged);
      } catch (error) {
        assert.equal(error.code, 'badArgument', `${name}, ${key}: ${error.stack}`);
      }
    }
  }
  assert.equal((await mandoline.validate(large, cut)).pass, true);
});

test('questions about a cut-mesh', async () => {
  const cases = [
    [() => mandoline.triangulate(cutMesh, { cell: 16 }), /^There is no cut-cell 16: there are 16/],
    [() => mandoline.triangulate(cutMesh, { cell: -1 }), /^of\.cell is -1/],
    [() => mandoline.triangulate(cutMesh, { cell: 0.5 }), /^of\.cell/],
    [() => mandoline.triangulate(cutMesh, { region: 2 }), /^There is no region 2/],
    [() => mandoline.triangulate(cutMesh, { cell: 0, region: 0 }), /\{ cell \} or \{ region \}/],
    [() => mandoline.triangulate(cutMesh, {}), /\{ cell \} or \{ region \}/],
    [() => mandoline.triangulate(cutMesh, null), /^of must be an object, not null/],
    [() => mandoline.cellAt(cutMesh, [0, 0]), /^point must have three numbers/],
    [() => mandoline.cellAt(cutMesh, undefined), /^point must have three numbers/],
    [() => mandoline.cellsAt(cutMesh, [0, 0]), /^points must have three numbers per point/],
    [() => mandoline.cellsAt(cutMesh, null), /^points must be an array of numbers, not null/],
    [() => mandoline.slice(cutMesh, null), /^plane must be an object/],
    [() => mandoline.slice(cutMesh, { normal: [0, 0, 1] }), /^plane\.offset must be a number/],
    [() => mandoline.slice(cutMesh, { normal: 1, offset: 0 }), /^plane\.normal must have three numbers/],
    [() => mandoline.slice(cutMesh, { normal: [0, 0, 1], offset: 0 }, { untouched: 0 }), /^options\.untouched/],
    [() => mandoline.write(mesh, cutMesh, 'off'), /^format/],
    [() => mandoline.write(mesh, cutMesh), /^format/],
    [() => mandoline.write(mesh, cutMesh, 'vtu', { untouched: 1 }), /^options\.untouched/],
    [() => mandoline.write(mesh, cutMesh, 'vtu', { regions: 1 }), /^options\.regions must be a Uint8Array or an array, not 1/],
    [() => mandoline.write(mesh, cutMesh, 'vtu', { regions: [true] }), /^regions must have one .* 2 regions, but has 1\./],
    [() => mandoline.write(mesh, cutMesh, 'obj', { regions: new Uint8Array(3) }), /^regions must have one flag for each .*, but has 3\./],
    [() => mandoline.write(mesh, cutMesh, 'json', { regions: [true, true] }), /^Files of this format always have everything/],
    [() => mandoline.write(mesh, cutMesh, 'vtu', { simpleCells: 1 }), /^options\.simpleCells/],
    [() => mandoline.write(mesh, cutMesh, 'mcm', { untouched: false }), /^Files of this format always have everything/],
    [() => mandoline.write(mesh, cutMesh, 'json', { progress: 1 }), /^options\.progress/],
  ];
  for (const [call, pattern] of cases) await assertBad(call, pattern);
  for (const plane of [
    { normal: [0, 0, 0], offset: 1 },
    { normal: [0, NaN, 1], offset: 1 },
    { normal: [0, 0, 1], offset: Infinity },
  ]) {
    assert.throws(() => mandoline.slice(cutMesh, plane), { code: 'badArgument', stage: 'slice' });
  }
});

test('arrays with more entries than there is memory for', () => {
  const endless = new Array(2 ** 32 - 1);
  const refused = (call) =>
    assert.throws(call, (error) => {
      assert.ok(error instanceof MandolineError, error.stack);
      assert.match(error.code, /^(outOfMemory|badArgument)$/);
      return true;
    });
  refused(() => mandoline.cellsAt(cutMesh, endless));
  refused(() => mandoline.cut({ ...mesh, positions: endless }, grid));
  refused(() => mandoline.cut({ ...mesh, triangles: endless }, grid));
  refused(() => mandoline.slices(cutMesh, [0, 0, 1], { length: 2 ** 32 - 1 }));
});

test('a mesh that is not the one that was cut', async () => {
  for (const call of [mandoline.measure, mandoline.cutEdges, (other, cut) => mandoline.write(other, cut, 'vtu')]) {
    await assertBad(() => call(torus(8, 8), cutMesh), /is not the one that the cut-mesh was made from/);
  }
  assert.equal((await mandoline.validate(torus(8, 8), cutMesh)).pass, false);
});
