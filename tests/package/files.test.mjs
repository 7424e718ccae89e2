// Files of every kind: meshes from bytes and Blobs, packed and damaged; what is written is read back.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { MandolineError, init } from 'mandoline-wasm';
import { createWorker } from 'mandoline-wasm/worker';
import { box, gut, writeObj } from './meshes.mjs';

const { boundary, cut, inspect, outlines, readCutMesh, readGroups, readMesh, write, writeDefects, writeLines, writeMesh, writeOutlines } =
  await init();
const cube = box([0.1, -2, 1e-300], [1 / 3, 5, 7]);

function writeStl({ positions, triangles }) {
  const bytes = new DataView(new ArrayBuffer(84 + (50 * triangles.length) / 3));
  bytes.setUint32(80, triangles.length / 3, true);
  triangles.forEach((v, i) => {
    for (let d = 0; d < 3; ++d) bytes.setFloat32(84 + 50 * Math.floor(i / 3) + 12 + 12 * (i % 3) + 4 * d, positions[3 * v + d], true);
  });
  return new Uint8Array(bytes.buffer);
}

const triples = (array) => Array.from({ length: array.length / 3 }, (_, i) => [...array.subarray(3 * i, 3 * i + 3)].join(' ')).join('\n');
const counts = ({ positions, triangles }) => [positions.length / 3, triangles.length / 3];
const faces = ({ triangles }) => triples(triangles).replace(/^/gm, '3 ');
const encode = (text) => new TextEncoder().encode(text);
const ply = (mesh) =>
  `ply\nformat ascii 1.0\nelement vertex ${counts(mesh)[0]}\n` +
  'property double x\nproperty double y\nproperty double z\n' +
  `element face ${counts(mesh)[1]}\nproperty list uchar int vertex_indices\nend_header\n${triples(mesh.positions)}\n${faces(mesh)}\n`;

const files = {
  'cube.obj': encode(writeObj(cube)),
  'cube.off': encode(`OFF\n${counts(cube).join(' ')} 0\n${triples(cube.positions)}\n${faces(cube)}\n`),
  'cube.ply': encode(ply(cube)),
};

for (const [name, bytes] of Object.entries(files)) {
  test(`${name} keeps every double, as bytes of any kind, gzipped or not`, async () => {
    const inTheMiddle = new Uint8Array(bytes.length + 7);
    inTheMiddle.set(bytes, 5);
    const sources = [
      bytes,
      bytes.slice().buffer,
      Buffer.from(bytes),
      inTheMiddle.subarray(5, 5 + bytes.length),
      new DataView(bytes.slice().buffer),
      new Blob([bytes]),
      gzipSync(bytes),
      new Blob([gzipSync(bytes)]),
    ];
    for (const source of sources) assert.deepEqual(await readMesh(source, { name }), cube);
  });
}

test('a binary STL file has three vertices per triangle', async () => {
  const mesh = await readMesh(gzipSync(writeStl(cube)), { name: 'cube.stl.gz' });
  assert.deepEqual(counts(mesh), [36, 12]);
  assert.deepEqual(
    mesh.triangles,
    Uint32Array.from({ length: 36 }, (_, i) => i),
  );
  const corners = [...cube.triangles].flatMap((v) => [...cube.positions.subarray(3 * v, 3 * v + 3)]);
  assert.deepEqual([...mesh.positions], corners.map(Math.fround));
});

test('polygons are fanned, and what is told by its content needs no name', async () => {
  const text = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n';
  assert.deepEqual([...(await readMesh(encode(text))).triangles], [0, 1, 2, 0, 2, 3]);
});

const failures = [
  ['an OBJ file with a flaw', encode('v 0 0 0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n'), 'bad.obj', /^bad\.obj.*line 3.*\.$/],
  ['a packed file with a flaw', gzipSync(encode('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n')), 'bad.obj.gz', /^bad\.obj\.gz.*line 4/],
  ['an empty file', new Uint8Array(), 'empty.obj', /^empty\.obj.*empty/],
  ['an empty packed file', gzipSync(''), 'empty.obj.gz', /^empty\.obj\.gz.*empty/],
  ['a file of no known kind', encode('{"glTF": 1}'), 'scene.gltf', /^scene\.gltf/],
  ['a packed file that was cut off', gzipSync(files['cube.obj']).subarray(0, 100), 'cube.obj.gz', /^cube\.obj\.gz: damaged gzip data.*\.$/],
];

for (const [what, bytes, name, pattern] of failures) {
  test(`${what} is a badFile whose message names it`, async () => {
    await assert.rejects(readMesh(bytes, { name }), (error) => {
      assert.ok(error instanceof MandolineError, error.stack);
      assert.deepEqual([error.code, error.stage], ['badFile', 'readMesh']);
      assert.match(error.message, pattern);
      return true;
    });
  });
}

for (const [name, content] of Object.entries({ ...files, 'cube.stl': writeStl(cube) })) {
  test(`${name}, cut off anywhere or with a wrong byte anywhere, gives a mesh or a badFile`, async () => {
    const settle = (bytes) =>
      readMesh(bytes, { name }).then(
        ({ positions, triangles }) => assert.ok(triangles.every((v) => 3 * v < positions.length)),
        (error) => assert.equal(error.code, 'badFile', error.stack),
      );
    for (let i = 0; i < content.length; ++i) {
      await settle(content.subarray(0, i));
      for (const value of [0, 0x39, 0xff]) await settle(Uint8Array.from(content, (byte, at) => (at === i ? value : byte)));
    }
  });
}

test('a value that is not a file is a badArgument', async () => {
  const refusal = { code: 'badArgument', stage: 'readMesh' };
  for (const source of [undefined, null, 'cube.obj', {}, [1, 2]]) await assert.rejects(readMesh(source), refusal);
  await assert.rejects(readMesh('cube.obj'), { message: /fetch\(address\).*readFile\(path\), not string\.$/ });
  for (const options of [null, 7, { name: 7 }]) await assert.rejects(readMesh(files['cube.obj'], options), refusal);
});

test("bytes out of their buffer's bounds are called so", async () => {
  const buffer = new ArrayBuffer(24, { maxByteLength: 48 });
  const views = [new Uint8Array(buffer, 8, 8), new DataView(buffer, 8, 8)];
  buffer.resize(8);
  for (const view of views) await assert.rejects(readMesh(view), { code: 'badArgument', message: /^The bytes are .* out of bounds/ });
});

test('bytes that were transferred elsewhere are called so', async () => {
  for (const bytesOf of [(bytes) => bytes, (bytes) => bytes.buffer]) {
    const bytes = files['cube.ply'].slice(),
      source = bytesOf(bytes);
    structuredClone(null, { transfer: [bytes.buffer] });
    await assert.rejects(readMesh(source), { code: 'badArgument', message: /^The bytes are detached/ });
  }
});

test('in a worker', async () => {
  const worker = await createWorker();
  try {
    assert.deepEqual(await worker.readMesh(new Blob([gzipSync(files['cube.obj'])]), { name: 'cube.obj.gz' }), cube);
    const bytes = files['cube.ply'].slice();
    assert.deepEqual(await worker.readMesh(bytes, { name: 'cube.ply', transfer: [bytes.buffer] }), cube);
    assert.equal(bytes.length, 0);
    const empty = new File([''], 'empty.obj'); // whose clone has no name in Node 20
    for (const options of [undefined, {}, { name: undefined }]) {
      await assert.rejects(worker.readMesh(empty, options), { code: 'badFile', message: /^empty\.obj: the file is empty/ });
    }
    await assert.rejects(worker.readMesh(empty, { name: 'other.off' }), { code: 'badFile', message: /^other\.off/ });
    for (const options of [null, 7]) await assert.rejects(worker.readMesh(empty, options), { code: 'badArgument', stage: 'readMesh' });
    await assert.rejects(worker.readMesh(encode('v 0 0\n'), { name: 'bad.obj' }), { code: 'badFile', message: /^bad\.obj.*line 1/ });
  } finally {
    worker.terminate();
  }
});

test('groups of triangles', async () => {
  const square = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n';
  const file = encode(`${square}g wheel\nf 1 2 3 4\ng T\u00fcr\nf 1 2 3\n`);
  const expected = { names: ['wheel', 'T\u00fcr'], triangleGroup: new Uint32Array([0, 0, 1]) };
  for (const source of [file, new Blob([file]), gzipSync(file)]) {
    assert.deepEqual(await readGroups(source, { name: 'a.obj' }), expected);
  }
  assert.deepEqual(await readGroups(encode(`${square}f 1 2 3\n`)), { names: [], triangleGroup: new Uint32Array() });
  const cutOff = readGroups(encode('solid a\nfacet normal 0 0'), { name: 'bad.stl' });
  await assert.rejects(cutOff, { code: 'badFile', stage: 'readGroups', message: /^bad\.stl.*line 2/ });
  await assert.rejects(readGroups('bad.obj'), { code: 'badArgument', stage: 'readGroups' });
});

test('the groups of a File in a worker', async () => {
  const file = new File(['v 0 0 0\nv 1 0 0\nv 0 1 0\ng a\nf 1 2 3\n'], 'a.obj');
  const worker = await createWorker();
  assert.deepEqual(await worker.readGroups(file), await readGroups(file));
  worker.terminate();
});

test('a cut-mesh is read back as it was, and is a result like that of cut()', async () => {
  const { stats, gridCellRegion, ...cutMesh } = cut(cube, { cells: 5 });
  const bytes = await write(cube, cutMesh, 'mcm');
  const read = await readCutMesh(new Blob([gzipSync(bytes)]), { name: 'cube.mcm' });
  assert.deepEqual(read, cutMesh);
  const expected = boundary(cutMesh);
  assert.deepEqual(boundary(gut(read)), expected); // from the twin
  await assert.rejects(readCutMesh(bytes.subarray(1), { name: 'cube.mcm' }), {
    code: 'badFile',
    stage: 'readCutMesh',
    message: /^cube\.mcm/,
  });
});

test('meshes are read back as they were', async () => {
  for (const format of ['obj', 'off']) assert.deepEqual(await readMesh(await writeMesh(cube, format), { name: `cube.${format}` }), cube);
  const single = { ...cube, positions: Float64Array.from(cube.positions, Math.fround) };
  assert.deepEqual(await readMesh(await writeMesh(single, 'ply'), { name: 'cube.ply' }), single);
  const corners = ({ positions, triangles }) => Array.from(triangles, (v) => [...positions.subarray(3 * v, 3 * v + 3)]);
  assert.deepEqual(corners(await readMesh(await writeMesh(single, 'stl'), { name: 'cube.stl' })), corners(single));
});

test('groups are written as they are read', async () => {
  const groups = { names: ['below', 'others'], triangleGroup: Uint32Array.from({ length: 12 }, (_, i) => Number(i > 1)) };
  assert.deepEqual(await readGroups(await writeMesh(cube, 'obj', { groups }), { name: 'cube.obj' }), groups);
  const missing = { ...groups, triangleGroup: new Uint32Array(3) };
  await assert.rejects(writeMesh(cube, 'obj', { groups: missing }), { code: 'badArgument', stage: 'writeMesh' });
});

test('lines and defects that are not there are refused', async () => {
  const points = new Float64Array(9);
  const refusal = (stage, element = -1) => ({ code: 'badArgument', stage, element });
  for (const [offsets, element] of [
    [[0, 2, 4], 1],
    [[0, 2, 1], 1],
    [[1, 2], -1],
    [[], -1],
  ]) {
    await assert.rejects(writeLines({ points, offsets: new Uint32Array(offsets) }), refusal('writeLines', element));
  }
  await assert.rejects(writeLines({ points, offsets: [0, 3] }), refusal('writeLines'));
  await assert.rejects(writeLines({ points: [1, 2], offsets: new Uint32Array(1) }), refusal('writeLines'));
  const text = new TextDecoder().decode(await writeLines({ points, offsets: new Uint32Array([0, 2, 3]) }));
  assert.equal(text, 'v 0 0 0\nv 0 0 0\nv 0 0 0\nl 1 2\n');
  const open = { ...cube, triangles: cube.triangles.subarray(3) };
  const small = { positions: cube.positions.subarray(0, 9), triangles: [0, 1, 2] };
  await assert.rejects(writeDefects(small, inspect(open)), { code: 'badArgument', stage: 'writeDefects' });
  await assert.rejects(writeDefects(cube, inspect(open)), { code: 'badArgument', stage: 'writeDefects' });
  assert.match(new TextDecoder().decode(await writeDefects(open, inspect(open))), /^l \d+ \d+$/m);
});

test('the module of files is loaded for a PLY file, not for an OBJ file', async () => {
  const without = await createWorker({ filesWasm: new Uint8Array() });
  assert.deepEqual(await without.readMesh(files['cube.obj'], { name: 'cube.obj' }), cube);
  await assert.rejects(without.readMesh(files['cube.ply'], { name: 'cube.ply' }), { code: 'loadFailed' });
  without.terminate();
});

test('outlines', async () => {
  const cutMesh = cut(cube, { cells: 5 });
  const stack = { normal: [0, 0, 1], offsets: [1, 2], layers: outlines(cutMesh, [0, 0, 1], [1, 2]) };
  const text = async (format, options) => new TextDecoder().decode(await writeOutlines(stack, format, options));
  assert.match(await text('svg'), /<svg.*<path.*<\/svg>\s*$/s);
  assert.match(await text('dxf'), /POLYLINE.*EOF\s*$/s);
  assert.match(await text('obj'), /^l \d+ \d+/m);
  const none = new Uint8Array(cutMesh.regionCount);
  assert.doesNotMatch(await text('obj', { regions: none }), /^l /m);
  const short = { ...stack, offsets: [1] };
  await assert.rejects(writeOutlines(short, 'svg'), { code: 'badArgument', stage: 'writeOutlines' });
});
