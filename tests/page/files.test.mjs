import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { BoxGeometry, BufferAttribute, BufferGeometry, Group, Mesh } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';
import { OBJExporter } from 'three/examples/jsm/exporters/OBJExporter.js';
import { PLYExporter } from 'three/examples/jsm/exporters/PLYExporter.js';
import { STLExporter } from 'three/examples/jsm/exporters/STLExporter.js';
import { importBundled } from './bundled.mjs';
import { corners, expectedCorners, faces, parse, points, refuses } from './parsed_files.mjs';

// What three's loaders and exporters need of a browser.
globalThis.ProgressEvent ??= class extends Event {};
globalThis.requestAnimationFrame ??= (callback) => setTimeout(callback);
globalThis.FileReader ??= class {
  readAsArrayBuffer(blob) {
    blob.arrayBuffer().then((buffer) => {
      this.result = buffer;
      this.onloadend();
    });
  }
};

const { fileExtensions } = await importBundled('model/formats.ts');

const pointLines = points.map((p) => `${p.join(' ')}\n`);
const faceLines = faces.map((f) => `f ${f.map((v) => v + 1).join(' ')}\n`);
const obj = `# made by hand\n${pointLines.map((p) => `v ${p}`).join('')}${faceLines.join('')}`;
const off = `OFF\n4 4 0\n${points.map((p) => p.join(' ')).join('\n')}\n${faces.map((f) => `3 ${f.join(' ')}`).join('\n')}\n`;
const facets = faces.map((f) => `facet normal 0 0 0\nouter loop\n${f.map((v) => `vertex ${pointLines[v]}`).join('')}endloop\nendfacet\n`);
const stl = `solid tetrahedron\n${facets.join('')}endsolid\n`;
const plyHeader = (format, number = 'float') =>
  [
    'ply',
    `format ${format} 1.0`,
    'comment made by hand',
    'element vertex 4',
    `property ${number} x`,
    `property ${number} y`,
    `property ${number} z`,
    'element face 4',
    'property list uchar int vertex_indices',
    'end_header',
    '',
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
  bufferViews: [
    { buffer: 0, byteOffset: 0, byteLength: 48 },
    { buffer: 0, byteOffset: 48, byteLength: 24 },
  ],
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
  const words = [
    [0, 0x46546c67],
    [4, 2],
    [8, bytes.length],
    [12, text.length],
    [16, 0x4e4f534a],
    [end, data.length],
    [end + 4, 0x004e4942],
  ];
  for (const [at, word] of words) bytes.writeUInt32LE(word, at);
  bytes.write(text, 20);
  data.copy(bytes, 28 + text.length);
  return bytes;
}

describe('formats', () => {
  const files = {
    'a.obj': obj,
    'A.OBJ': obj,
    noextension: obj,
    'query.obj?download=1': obj,
    'windows.obj': obj.replaceAll('\n', '\r\n'),
    'a.off': off,
    'off.txt': off,
    'windows.off': off.replaceAll('\n', '\r\n'),
    'a.stl': stl,
    'upper.stl': stl.toUpperCase(),
    'binary.stl': binaryStl(),
    'stl.dat': binaryStl(),
    'a.ply': ply,
    'windows.ply': ply.replaceAll('\n', '\r\n'),
    'little.ply': binaryPly(true),
    'big.ply': binaryPly(false),
    'double.ply': binaryPly(true, 'double'),
    'wrongly-named.obj': binaryPly(true),
    'a.gltf': embedded(),
    'a.glb': glb(gltf()),
    'also.stl': glb(gltf()),
    'a.obj.gz': gzipSync(obj),
    'packed.glb.gz': gzipSync(glb(gltf())),
  };
  for (const [name, content] of Object.entries(files)) {
    test(name, async () => {
      const mesh = await parse(name, content);
      assert.ok(mesh.positions instanceof Float64Array && mesh.triangles instanceof Uint32Array);
      assert.deepEqual(corners(mesh), expectedCorners);
      assert.equal(mesh.isReadHere, /gltf|glb|also/.test(name), 'whether the package does not read it');
    });
  }

  test('extensions for file pickers', () => {
    for (const name of ['.obj', '.stl', '.ply', '.off', '.glb', '.gltf', '.obj.gz', '.3mf']) assert.ok(fileExtensions.includes(name), name);
  });
});

describe('what glTF allows', () => {
  test('transforms, mirrored and nested, all meshes merged; images and materials are never loaded', async () => {
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
    assert.deepEqual(
      plain,
      expectedCorners.map(([x, y, z]) => [x + 10, y, z]),
    );
    const swapped = [0, 1, 2, 3].flatMap((t) => [0, 2, 1].map((k) => expectedCorners[3 * t + k]));
    assert.deepEqual(
      mirrored,
      swapped.map(([x, y, z]) => [10 - 2 * x, 2 * y, 2 * z]),
    );
  });
  test('instances', async () => {
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
  test('several buffers', async () => {
    const uri = (data) => `data:;base64,${data.toString('base64')}`;
    const buffers = [
      { byteLength: 48, uri: uri(gltfData.subarray(0, 48)) },
      { byteLength: 24, uri: uri(gltfData.subarray(48)) },
    ];
    const bufferViews = [
      { buffer: 0, byteLength: 48 },
      { buffer: 1, byteLength: 24 },
    ];
    assert.deepEqual(corners(await parse('a.gltf', JSON.stringify(gltf({ buffers, bufferViews })))), expectedCorners);
  });
});

describe('what three writes', () => {
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
  const bad = [
    ['empty.obj', '', /^The file is empty\.$/],
    ['no-faces.obj', 'v 0 0 0\nv 1 0 0\n', /no triangles/],
    ['cut.obj.gz', gzipSync(obj.repeat(50)).subarray(0, 60), /^Damaged gzip data/],
    ['picture.png', Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), /OBJ, STL, PLY or OFF/],
    ['archive.zip', Buffer.from('PK\x03\x04aaaa', 'latin1'), /ZIP archive/],
    ['page.html', '<!DOCTYPE html><html></html>', /web page/],
    ['word.obj', obj.replace('v 1.5 0 0', 'v 1.5 x 0'), /^Line 3: .*'x'/],
    ['cut.stl', binaryStl().subarray(0, 200), /^Byte \d+: /],
    ['index.ply', ply.replace('3 0 3 1', '3 0 4 1'), /^Line 16: .*vertex 4/],

    ['json.gltf', '{"asset": ', /cut off: its JSON/],
    ['other.gltf', '{"type": "geo"}', /no glTF/],
    ['old.gltf', embedded({ asset: { version: '1.0' } }), /glTF of version 1\.0; only version 2 is read/],
    ['outside.gltf', JSON.stringify(gltf({ buffers: [{ byteLength: 72, uri: 'data.bin' }] })), /another file, "data\.bin"/],
    ['base64.gltf', JSON.stringify(gltf({ buffers: [{ byteLength: 72, uri: 'data:;base64,@@' }] })), /^It is damaged, or/],
    ['lonely.gltf', JSON.stringify(gltf()), /buffer 0 has no data/],
    ['draco.glb', glb(gltf({ extensionsRequired: ['KHR_draco_mesh_compression'] })), /compressed with Draco/],
    ['used.glb', glb(gltf({ extensionsUsed: ['KHR_draco_mesh_compression'] })), /compressed with Draco/],
    ['cut.glb', glb(gltf()).subarray(0, -10), /^It is cut off: of \d+ bytes \d+ are there\.$/],
    ['header.glb', glb(gltf()).subarray(0, 10), /cut off: of 12 bytes 10 are there/],
    ['cut.glb.gz', gzipSync(glb(gltf())).subarray(0, 100), /^Damaged gzip data/],
    ['cycle.glb', glb(gltf({ nodes: [{ children: [0], mesh: 0 }] })), /node 0 contains itself/],
    ['child.glb', glb(gltf({ nodes: [{ children: [7] }] })), /node 0 refers to node 7, but there are 1, from 0 on/],
    ['mesh.glb', glb(gltf({ nodes: [{ mesh: 9 }] })), /node 0 refers to mesh 9/],
    ['scene.glb', glb(gltf({ scene: 3 })), /"scene" refers to scene 3/],
    ['no-scene.glb', glb(gltf({ scenes: undefined, scene: undefined })), /no scene/],
    ['nothing.glb', glb(gltf({ nodes: [{}] })), /no triangles/],
    ['strange.glb', glb(gltf({ nodes: 7, meshes: {}, accessors: 'x' })), /"nodes" is no list/],
    [
      'many.glb',
      glb(gltf({ accessors: [{ bufferView: 0, componentType: 5126, count: 4e9, type: 'VEC3' }, gltf().accessors[1]] })),
      /accessor 0 needs 4000000000 items, but its buffer view 0 has only 48 bytes/,
    ],
    [
      'component.glb',
      glb(gltf({ accessors: [{ ...gltf().accessors[0], componentType: 1 }, gltf().accessors[1]] })),
      /accessor 0 has no type/,
    ],
    ['accessor.glb', glb(gltf({ meshes: [{ primitives: [{ attributes: { POSITION: 5 } }] }] })), /mesh 0 refers to accessor 5/],
    [
      'beyond.glb',
      glb(gltf({ accessors: [{ bufferView: 0, componentType: 5126, count: 20, type: 'VEC3' }, gltf().accessors[1]] })),
      /accessor 0 needs 20 items/,
    ],
    [
      'index.glb',
      glb(gltf(), Buffer.concat([gltfData.subarray(0, 48), Buffer.from(new Uint16Array([0, 1, 9, ...faces.flat().slice(3)]).buffer)])),
      /refers to vertex 9, but there are 4/,
    ],
    [
      'nan.glb',
      glb(gltf(), Buffer.concat([Buffer.from(new Float32Array([NaN]).buffer), gltfData.subarray(4)])),
      /vertex 0 has a coordinate that is not a finite/,
    ],
  ];
  for (const [name, content, detail] of bad) test(name, { timeout: 5000 }, () => refuses(name, content, detail));
});

test('bounds of positions may be missing: nothing is said on the console', async (t) => {
  const warn = t.mock.method(console, 'warn', () => {});
  const [{ min, max, ...position }, indices] = gltf().accessors;
  assert.deepEqual(corners(await parse('a.glb', glb(gltf({ accessors: [position, indices] })))), expectedCorners);
  assert.equal(warn.mock.callCount(), 0);
});

describe('a glTF file cut off anywhere gives a mesh or an error, soon', () => {
  const settle = (name, bytes) =>
    parse(name, bytes).then(
      ({ positions, triangles }) => assert.ok(positions.every(Number.isFinite) && triangles.every((v) => 3 * v < positions.length), name),
      ({ title, detail }) => {
        assert.ok(title && detail, name);
        assert.doesNotMatch(detail, /THREE|undefined|Cannot read|typed array|DataView|token|position \d/, 'words for people');
      },
    );
  for (const [name, content] of Object.entries({ 'a.glb': glb(gltf()), 'a.gltf': embedded() })) {
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
