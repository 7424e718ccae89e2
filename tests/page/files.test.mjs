import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gunzipSync, gzipSync } from 'node:zlib';
import { BoxGeometry, BufferAttribute, BufferGeometry, Group, Mesh } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';
import { OBJExporter } from 'three/examples/jsm/exporters/OBJExporter.js';
import { PLYExporter } from 'three/examples/jsm/exporters/PLYExporter.js';
import { STLExporter } from 'three/examples/jsm/exporters/STLExporter.js';
import { importBundled } from './bundled.mjs';

const { parseMesh, fileExtensions } = await importBundled('worker/files/index.ts');

function toBytes(content) {
  const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : new Uint8Array(content);
  return bytes.slice().buffer;
}

const parse = (name, content) => parseMesh(name, toBytes(content));

/** Corners of all triangles as numbers. */
function corners({ positions, triangles }) {
  return Array.from(triangles, (v) => Array.from(positions.subarray(3 * v, 3 * v + 3)));
}

/** Rejects with an error that the page can show: the file in its title, what and where in its detail. */
async function refuses(name, content, detail) {
  await assert.rejects(parse(name, content), (error) => {
    assert.ok(error instanceof Error);
    assert.equal(error.title, `${name} can't be read`);
    assert.match(error.detail, detail);
    return true;
  });
}

// A tetrahedron whose coordinates single precision holds.
const points = [[0, 0, 0], [1.5, 0, 0], [0, 2.25, 0], [0, 0, -3.125]];
const faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
const expectedCorners = faces.flat().map((v) => points[v]);

const pointLines = points.map((p) => `${p.join(' ')}\n`);
const obj = `# made by hand\n${pointLines.map((p) => `v ${p}`).join('')}${faces.map((f) => `f ${f.map((v) => v + 1).join(' ')}\n`).join('')}`;
const off = `OFF\n4 4 0\n${points.map((p) => p.join(' ')).join('\n')}\n${faces.map((f) => `3 ${f.join(' ')}`).join('\n')}\n`;
const facets = faces.map((f) => `facet normal 0 0 0\nouter loop\n${f.map((v) => `vertex ${pointLines[v]}`).join('')}endloop\nendfacet\n`);
const stl = `solid tetrahedron\n${facets.join('')}endsolid\n`;
const plyHeader = (format, number = 'float') =>
  [
    'ply', `format ${format} 1.0`, 'comment made by hand',
    'element vertex 4', `property ${number} x`, `property ${number} y`, `property ${number} z`,
    'element face 4', 'property list uchar int vertex_indices', 'end_header', '',
  ].join('\n');
const ply = `${plyHeader('ascii')}${points.map((p) => `${p.join(' ')}\n`).join('')}${faces.map((f) => `3 ${f.join(' ')}\n`).join('')}`;

function binaryPly(littleEndian, number = 'float') {
  const size = number === 'double' ? 8 : 4;
  const body = new DataView(new ArrayBuffer(12 * size + 4 * 13));
  let at = 0;
  for (const x of points.flat()) {
    if (number === 'double') body.setFloat64(at, x, littleEndian);
    else body.setFloat32(at, x, littleEndian);
    at += size;
  }
  for (const face of faces) {
    body.setUint8(at++, 3);
    for (const v of face) {
      body.setInt32(at, v, littleEndian);
      at += 4;
    }
  }
  const header = new TextEncoder().encode(plyHeader(`binary_${littleEndian ? 'little' : 'big'}_endian`, number));
  return Buffer.concat([header, new Uint8Array(body.buffer)]);
}

function binaryStl() {
  const view = new DataView(new ArrayBuffer(84 + 50 * faces.length));
  view.setUint32(80, faces.length, true);
  const put = (t, k, point) => point.forEach((x, d) => view.setFloat32(84 + 50 * t + 12 * (k + 1) + 4 * d, x, true));
  faces.forEach((face, t) => face.forEach((v, k) => put(t, k, points[v])));
  return Buffer.from(view.buffer);
}

const gltf = (extra = {}) => ({
  asset: { version: '2.0' },
  scene: 0,
  scenes: [{ nodes: [0] }],
  nodes: [{ mesh: 0 }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
  accessors: [
    { bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [0, 0, -3.125], max: [1.5, 2.25, 0] },
    { bufferView: 1, componentType: 5123, count: 12, type: 'SCALAR' },
  ],
  bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 24 }],
  buffers: [{ byteLength: 72 }],
  ...extra,
});
const gltfData = Buffer.concat([Buffer.from(new Float32Array(points.flat()).buffer), Buffer.from(new Uint16Array(faces.flat()).buffer)]);
const dataUri = `data:application/octet-stream;base64,${gltfData.toString('base64')}`;
const embedded = (extra = {}) => JSON.stringify(gltf({ buffers: [{ byteLength: 72, uri: dataUri }], ...extra }));

function glb(json, data = gltfData) {
  let text = JSON.stringify(json);
  text += ' '.repeat((4 - (text.length % 4)) % 4);
  const bytes = Buffer.alloc(28 + text.length + data.length);
  const end = 20 + text.length;
  const words = [[0, 0x46546c67], [4, 2], [8, bytes.length], [12, text.length], [16, 0x4e4f534a], [end, data.length], [end + 4, 0x004e4942]];
  for (const [at, word] of words) bytes.writeUInt32LE(word, at);
  bytes.write(text, 20);
  data.copy(bytes, 28 + text.length);
  return bytes;
}

describe('formats', () => {
  const files = {
    'a.obj': obj, 'A.OBJ': obj, noextension: obj, 'query.obj?download=1': obj, 'windows.obj': obj.replaceAll('\n', '\r\n'),
    'a.off': off, 'off.txt': off, 'windows.off': off.replaceAll('\n', '\r\n'),
    'a.stl': stl, 'upper.stl': stl.toUpperCase(), 'binary.stl': binaryStl(), 'stl.dat': binaryStl(),
    'a.ply': ply, 'windows.ply': ply.replaceAll('\n', '\r\n'), 'little.ply': binaryPly(true), 'big.ply': binaryPly(false),
    'double.ply': binaryPly(true, 'double'), 'wrongly-named.obj': binaryPly(true),
    'a.gltf': embedded(), 'a.glb': glb(gltf()), 'also.stl': glb(gltf()),
    'a.obj.gz': gzipSync(obj), 'packed.glb.gz': gzipSync(glb(gltf())),
  };
  for (const [name, content] of Object.entries(files)) {
    test(name, async () => {
      const mesh = await parse(name, content);
      assert.ok(mesh.positions instanceof Float64Array && mesh.triangles instanceof Uint32Array);
      assert.deepEqual(corners(mesh), expectedCorners);
    });
  }

  test('extensions for file pickers', () => {
    for (const name of ['.obj', '.stl', '.ply', '.off', '.glb', '.gltf', '.obj.gz']) assert.ok(fileExtensions.includes(name), name);
  });
});

describe('what the formats allow', () => {
  const square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0]];
  const pentagon = [[0, 0, 0], [2, 0, 0], [3, 1, 0], [1, 2, 0], [0, 1, 0]];
  const pentagonFan = [0, 1, 2, 0, 2, 3, 0, 3, 4].map((v) => pentagon[v]);

  test('OBJ: polygons, negative numbers, texture and normal numbers, materials, groups, lines, colours, continued lines', async () => {
    const text = `mtllib a.mtl\no one\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nvt 0 0\nvn 0 0 1
g lines\nl 1 2 3\np 1\nusemtl red\ns off\nf -4/1/1 -3//1 \\\n 3/1 4 # a square\no two\nf 1 2 3 4\n`;
    assert.deepEqual(corners(await parse('a.obj', text)), [...square, ...square]);
  });
  test('OBJ: faces before their points', async () => {
    assert.deepEqual(corners(await parse('a.obj', 'f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n')), [[0, 0, 0], [1, 0, 0], [0, 1, 0]]);
  });
  test('OBJ: names in an old encoding', async () => {
    assert.equal((await parse('a.obj', Buffer.from(`o M\xf6bius\n${obj}`, 'latin1'))).triangles.length, 12);
  });
  test('OFF: counts beside the keyword, comments, colours, polygons', async () => {
    const colored = pentagon.map((p) => `${p.join(' ')} 255 0 0 255\n`).join('');
    const text = `COFF 5 1 0 # counts\n\n# points\n${colored}5 0 1 2 3 4 0.5 0.5 0.5\n`;
    assert.deepEqual(corners(await parse('a.off', text)), pentagonFan);
  });
  test('PLY: polygons, further properties and elements, doubles', async () => {
    const text = [
      'ply', 'format ascii 1.0', 'element camera 1', 'property float fov',
      'element vertex 5', 'property double x', 'property double y', 'property double z', 'property uchar red',
      'element face 1', 'property uchar flags', 'property list uchar uint vertex_index', 'element edge 1', 'property int a', 'end_header',
      '60', ...pentagon.map((p) => `${p.join(' ')} 7`), '1 5 0 1 2 3 4', '0',
    ].join('\n');
    assert.deepEqual(corners(await parse('a.ply', text)), pentagonFan);
  });
  test('OFF and PLY keep double precision', async () => {
    const text = off.replace('1.5 0 0', '1.0000000000000002 0 0');
    assert.equal((await parse('a.off', text)).positions[3], 1.0000000000000002);
    const precise = binaryPly(true, 'double');
    precise.writeDoubleLE(0.1, precise.indexOf('end_header\n') + 11);
    assert.equal((await parse('a.ply', precise)).positions[0], 0.1);
  });
  test('STL: several solids', async () => assert.equal((await parse('a.stl', stl + stl)).triangles.length, 24));
  test('glTF: transforms, mirrored and nested, all meshes merged; images and materials are never loaded', async () => {
    const nodes = [{ children: [1, 2], translation: [10, 0, 0] }, { mesh: 0, scale: [-2, 2, 2] }, { mesh: 0 }];
    const json = gltf({
      nodes,
      images: [{ uri: 'http://localhost:1/missing.png' }],
      textures: [{ source: 0 }],
      materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    });
    json.meshes[0].primitives[0].material = 0;
    const found = corners(await parse('a.glb', glb(json)));
    const [mirrored, plain] = [found.slice(0, 12), found.slice(12)];
    assert.deepEqual(plain, expectedCorners.map(([x, y, z]) => [x + 10, y, z]));
    const swapped = [0, 1, 2, 3].flatMap((t) => [0, 2, 1].map((k) => expectedCorners[3 * t + k]));
    assert.deepEqual(mirrored, swapped.map(([x, y, z]) => [10 - 2 * x, 2 * y, 2 * z]));
  });
  test('glTF: instances', async () => {
    const data = Buffer.concat([gltfData, Buffer.from(new Float32Array([0, 0, 0, 5, 0, 0]).buffer)]);
    const json = gltf({
      nodes: [{ mesh: 0, extensions: { EXT_mesh_gpu_instancing: { attributes: { TRANSLATION: 2 } } } }],
      extensionsUsed: ['EXT_mesh_gpu_instancing'],
      buffers: [{ byteLength: 96 }],
    });
    json.bufferViews.push({ buffer: 0, byteOffset: 72, byteLength: 24 });
    json.accessors.push({ bufferView: 2, componentType: 5126, count: 2, type: 'VEC3' });
    const second = expectedCorners.map(([x, y, z]) => [x + 5, y, z]);
    assert.deepEqual(corners(await parse('a.glb', glb(json, data))), [...expectedCorners, ...second]);
  });
  test('glTF: several buffers', async () => {
    const uri = (data) => `data:;base64,${data.toString('base64')}`;
    const buffers = [{ byteLength: 48, uri: uri(gltfData.subarray(0, 48)) }, { byteLength: 24, uri: uri(gltfData.subarray(48)) }];
    const bufferViews = [{ buffer: 0, byteLength: 48 }, { buffer: 1, byteLength: 24 }];
    assert.deepEqual(corners(await parse('a.gltf', JSON.stringify(gltf({ buffers, bufferViews })))), expectedCorners);
  });
});

describe('what three writes', () => {
  // What the exporters need of a browser.
  globalThis.requestAnimationFrame ??= (callback) => setTimeout(callback);
  globalThis.FileReader ??= class {
    readAsArrayBuffer(blob) {
      blob.arrayBuffer().then((buffer) => {
        this.result = buffer;
        this.onloadend();
      });
    }
  };
  const scene = new Group();
  const box = new Mesh(new BoxGeometry(1, 2, 3));
  box.position.set(4, 0, 0);
  const tetrahedron = new Mesh(new BufferGeometry());
  tetrahedron.geometry.setAttribute('position', new BufferAttribute(new Float32Array(points.flat()), 3));
  tetrahedron.geometry.setIndex(faces.flat());
  tetrahedron.geometry.computeVertexNormals();
  scene.add(box, tetrahedron);
  scene.updateMatrixWorld(true);

  const exported = {
    'three.obj': () => new OBJExporter().parse(scene),
    'three.stl': () => new STLExporter().parse(scene),
    'three-binary.stl': () => new STLExporter().parse(scene, { binary: true }).buffer,
    'three.ply': () => new PLYExporter().parse(scene, () => {}, {}),
    'three-binary.ply': () => new PLYExporter().parse(scene, () => {}, { binary: true, littleEndian: true }),
    'three.glb': () => new GLTFExporter().parseAsync(scene, { binary: true }),
  };
  for (const [name, write] of Object.entries(exported)) {
    test(name, async () => {
      const found = corners(await parse(name, await write()));
      assert.equal(found.length, 3 * 16);
      const xs = found.map(([x]) => x);
      assert.deepEqual([Math.min(...xs), Math.max(...xs)], [0, 4.5]);
      assert.ok(expectedCorners.every((corner) => found.some((p) => p.every((x, d) => x === corner[d]))));
    });
  }
});

describe('bad files', () => {
  const withLine = (text, line, replacement) => text.split('\n').map((old, k) => (k === line - 1 ? replacement : old)).join('\n');
  const damagedStl = binaryStl();
  damagedStl.writeUInt32LE(4000000000, 80);
  const nanStl = binaryStl();
  nanStl.writeFloatLE(NaN, 84 + 50 * 2 + 12);
  const nanPly = binaryPly(true);
  nanPly.writeFloatLE(Infinity, nanPly.indexOf('end_header\n') + 11 + 12);
  const deepGlb = glb(gltf({ nodes: [{ children: [0], mesh: 0 }] }));
  const bad = [
    ['empty.obj', '', /empty/],
    ['blank.obj', '\n\n', /no triangles/],
    ['empty.obj.gz', gzipSync(''), /empty/],
    ['cut.obj.gz', gzipSync(obj.repeat(50)).subarray(0, 60), /gzipped data are damaged/],
    ['picture.png', Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), /"\.png" is not a kind of file/],
    ['what', 'hello', /no kind of file.*OBJ, STL, PLY, OFF, GLB/],
    ['archive.zip', Buffer.from('PK\x03\x04aaaa', 'latin1'), /ZIP archive/],
    ['page.html', '<!DOCTYPE html><html></html>', /web page/],

    ['word.obj', withLine(obj, 3, 'v 1.5 x 0'), /^Line 3: the second coordinate, "x", is not a number/],
    ['comma.obj', withLine(obj, 3, 'v 1,5 0 0'), /^Line 3: the first coordinate, "1,5"/],
    ['nan.obj', withLine(obj, 4, 'v 0 0 nan'), /^Line 4: the third coordinate, "nan"/],
    ['short.obj', withLine(obj, 5, 'v 0 0'), /^Line 5: .*the third is missing/],
    ['huge.obj', withLine(obj, 5, 'v 0 0 1e400'), /^Line 5: .*"1e400", is too large/],
    ['index.obj', withLine(obj, 7, 'f 1 2 5'), /^Line 7: a face names point 5, but points are numbered from 1 to 4/],
    ['zero.obj', withLine(obj, 7, 'f 1 2 0'), /^Line 7: a face names point 0/],
    ['negative.obj', withLine(obj, 7, 'f 1 2 -5'), /^Line 7: a face names point -5/],
    ['corner.obj', withLine(obj, 7, 'f 1 2 a/1'), /^Line 7: a face's corner, "a\/1"/],
    ['two.obj', withLine(obj, 7, 'f 1 2'), /^Line 7: a face needs three corners, and this one has 2/],
    ['points.obj', 'v 0 0 0\nv 1 0 0\n', /no triangles/],
    ['binary.obj', binaryStl(), /^Byte 0: binary data/],
    ['prose.obj', 'Dear reader,\nthere is no mesh here.\n', /no triangles/],

    ['count.stl', damagedStl, /^Byte 80: the header promises 4000000000 triangles.*ends after 284/],
    ['cut.stl', binaryStl().subarray(0, 200), /promises 4 triangles, which take 284 bytes, but the file ends after 200/],
    ['header.stl', Buffer.alloc(40), /header of 84 bytes; this file has 40/],
    ['nan.stl', nanStl, /^Byte 196: triangle 2 has a coordinate that is not a finite number/],
    ['none.stl', Buffer.alloc(84), /no triangles/],
    ['word.stl', stl.replace('vertex 1.5 0 0', 'vertex 1.5 y 0'), /^Line 5: the second coordinate, "y"/],
    ['four.stl', stl.replace('endloop', 'vertex 0 0 0\nendloop'), /^Line 2: a facet needs three vertices, and this one has 4/],
    ['end.stl', stl.slice(0, stl.lastIndexOf('endfacet')), /ends before its "endfacet"/],
    ['end2.stl', stl.replace('endsolid\n', ''), /ends before its "endsolid"/],
    ['strange.stl', stl.replace('endloop', 'polygon'), /^Line 7: "polygon" does not belong/],

    ['header.off', 'OFF\nfour 4 0\n', /^Line 2: the number of points should be a whole number, not "four"/],
    ['cut.off', off.split('\n').slice(0, 8).join('\n'), /^Line 8: the file ends before face 2 of 4/],
    ['many.off', 'OFF\n4000000000 1 0\n0 0 0\n', /^Line 3: the file ends before point 1 of 4000000000/],
    ['index.off', withLine(off, 8, '3 0 3 4'), /^Line 8: a face names point 4, but there are 4 points/],
    ['size.off', withLine(off, 8, '4 0 3 1'), /^Line 8: a face of 4 corners names only 3/],
    ['binary.off', 'OFF BINARY\n\0\0\0\x04', /binary data|is not read/],
    ['4d.off', '4OFF\n1 0 0\n0 0 0 1\n', /kind of OFF file that is not read/],

    ['header.ply', 'ply\nformat ascii 1.0\nelement vertex 3\n', /no end/],
    ['format.ply', ply.replace('ascii', 'utf7'), /format "utf7"/],
    ['type.ply', ply.replace('property float y', 'property half y'), /^Line 6: "half" is not a type/],
    ['noy.ply', ply.replace('property float y', 'property float q'), /no properties x, y and z/],
    ['word.ply', ply.replace('1.5 0 0', '1.5 up 0'), /^Line 12: "up" is not a number/],
    ['cut.ply', ply.slice(0, -8), /^Line 17: the file ends before/],
    ['cut2.ply', binaryPly(true).subarray(0, -3), /^Byte \d+: the file ends before/],
    ['many.ply', ply.replace('element vertex 4', 'element vertex 4000000000'), /promises 4000000000 elements "vertex"/],
    ['hollow.ply', ply.replace('element face', 'element nothing 4000000000\nelement face'), /promises 4000000000 elements "nothing"/],
    ['index.ply', ply.replace('3 0 3 1', '3 0 4 1'), /^Line 16: a face names point 4/],
    ['two.ply', ply.replace('3 0 3 1', '2 0 3 '), /^Line 16: a face needs three corners, and this one has 2/],
    ['inf.ply', nanPly, /^Byte \d+: point 1 has a coordinate that is not a finite number/],

    ['json.gltf', '{"asset": ', /JSON is damaged/],
    ['other.gltf', '{"type": "geo"}', /not glTF/],
    ['old.gltf', embedded({ asset: { version: '1.0' } }), /version "1\.0"; version 2 is read/],
    ['outside.gltf', JSON.stringify(gltf({ buffers: [{ byteLength: 72, uri: 'data.bin' }] })), /another file, "data\.bin"/],
    ['base64.gltf', JSON.stringify(gltf({ buffers: [{ byteLength: 72, uri: 'data:;base64,@@' }] })), /base64/],
    [
      'short.gltf', embedded().replace(';base64,', ';base64,AAAA').replace(gltfData.toString('base64'), ''),
      /should have 72 bytes and has only 3/,
    ],
    [
      'draco.glb', glb(gltf({ extensionsUsed: ['KHR_draco_mesh_compression'], extensionsRequired: ['KHR_draco_mesh_compression'] })),
      /compressed with Draco/,
    ],
    ['cut.glb', glb(gltf()).subarray(0, -10), /^Byte 8: the header promises/],
    ['header.glb', glb(gltf()).subarray(0, 10), /header of 20 bytes; this file has 10/],
    ['cycle.glb', deepGlb, /Node 0 is a root of the scene and below another node/],
    ['shared.glb', glb(gltf({ nodes: [{ children: [1, 1] }, { mesh: 0 }] })), /Node 1 is below two nodes/],
    ['child.glb', glb(gltf({ nodes: [{ children: [7] }] })), /child 7, which does not exist/],
    ['mesh.glb', glb(gltf({ nodes: [{ mesh: 9 }] })), /Node 0 shows mesh 9/],
    ['nothing.glb', glb(gltf({ nodes: [{}] })), /no triangles/],
    ['strange.glb', glb(gltf({ nodes: 7, meshes: {}, accessors: 'x' })), /./],
    [
      'many.glb', glb(gltf({ accessors: [{ bufferView: 0, componentType: 5126, count: 4e9, type: 'VEC3' }, gltf().accessors[1]] })),
      /Accessor 0 promises 4000000000 items/,
    ],
    [
      'type.glb', glb(gltf({ accessors: [{ ...gltf().accessors[0], type: 'VEC2' }, gltf().accessors[1]] })),
      /accessor 0, which should be of type VEC3/,
    ],
    ['component.glb', glb(gltf({ accessors: [{ ...gltf().accessors[0], componentType: 1 }, gltf().accessors[1]] })), /component type 1/],
    ['accessor.glb', glb(gltf({ meshes: [{ primitives: [{ attributes: { POSITION: 5 } }] }] })), /accessor 5, which does not exist/],
    [
      'beyond.glb', glb(gltf({ accessors: [{ bufferView: 0, componentType: 5126, count: 20, type: 'VEC3' }, gltf().accessors[1]] })),
      /The loader gave up on it: .*typed array/,
    ],
    [
      'index.glb',
      glb(gltf(), Buffer.concat([gltfData.subarray(0, 48), Buffer.from(new Uint16Array([0, 1, 9, ...faces.flat().slice(3)]).buffer)])),
      /names point 9, but there are 4 points/,
    ],
    [
      'nan.glb', glb(gltf(), Buffer.concat([Buffer.from(new Float32Array([NaN]).buffer), gltfData.subarray(4)])),
      /point 0 has a coordinate that is not a finite/,
    ],
  ];
  for (const [name, content, detail] of bad) test(name, { timeout: 5000 }, () => refuses(name, content, detail));

  test('a file that unpacks without end', { timeout: 60000 }, () =>
    refuses('bomb.obj.gz', gzipSync(Buffer.alloc(1100000000), { level: 1 }), /more than a gigabyte/));
});

describe('any file cut off anywhere gives a mesh or an error, soon', () => {
  const files = {
    'a.obj': obj, 'a.off': off, 'a.stl': stl, 'b.stl': binaryStl(), 'a.ply': ply, 'b.ply': binaryPly(true),
    'a.glb': glb(gltf()), 'a.gltf': embedded(), 'a.obj.gz': gzipSync(obj),
  };
  const settle = (name, bytes) =>
    parse(name, bytes).then(
      ({ positions, triangles }) => assert.ok(positions.every(Number.isFinite) && triangles.every((v) => 3 * v < positions.length), name),
      ({ title, detail }) => assert.ok(title && detail, name),
    );
  for (const [name, content] of Object.entries(files)) {
    const bytes = Buffer.from(content);
    test(`${name}, cut off`, { timeout: 60000 }, async () => {
      for (let length = 0; length < bytes.length; ++length) await settle(name, bytes.subarray(0, length));
    });
    test(`${name}, with a wrong byte`, { timeout: 60000 }, async () => {
      for (let at = 0; at < bytes.length; ++at) {
        for (const value of [0, 0xff, 0x39]) {
          const damaged = Buffer.from(bytes);
          damaged[at] = value;
          await settle(name, damaged);
        }
      }
    });
  }
});

const data = fileURLToPath(new URL('../../../shared/data/', import.meta.url));
describe('meshes from elsewhere', { skip: !existsSync(data) }, () => {
  const names = existsSync(data) ? readdirSync(data).filter((name) => name.endsWith('.obj.gz')).filter((_, k) => k % 5 === 0) : [];
  for (const name of names) {
    test(name, async () => {
      const packed = readFileSync(data + name);
      const lines = gunzipSync(packed).toString('latin1').match(/^f[ \t].*$/gm);
      const expected = lines.reduce((sum, line) => sum + line.trim().split(/\s+/).length - 3, 0);
      assert.equal((await parse(name, packed)).triangles.length, 3 * expected);
    });
  }
});
