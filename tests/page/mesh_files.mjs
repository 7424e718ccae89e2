// Mesh files for the page to read.
import { join, writeObj } from '../package/meshes.mjs';

const octahedron = {
  positions: new Float64Array([2, 0, 0, -1, 0, 0, 0, 1.5, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1.25]),
  triangles: new Uint32Array([0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5]),
};

/** Coordinates that 32 bits hold exactly, so every format says the same. */
export { octahedron };

function rows(array) {
  return Array.from({ length: array.length / 3 }, (_, i) => array.slice(3 * i, 3 * i + 3));
}

function off({ positions, triangles }) {
  const faces = rows(triangles).map((corners) => `3 ${corners.join(' ')}`);
  return `OFF\n${positions.length / 3} ${triangles.length / 3} 0\n${[...rows(positions).map((p) => p.join(' ')), ...faces].join('\n')}\n`;
}

function ply({ positions, triangles }) {
  const header = [
    'ply',
    'format ascii 1.0',
    `element vertex ${positions.length / 3}`,
    'property float x',
    'property float y',
    'property float z',
    `element face ${triangles.length / 3}`,
    'property list uchar int vertex_indices',
    'end_header',
  ];
  const faces = rows(triangles).map((corners) => `3 ${corners.join(' ')}`);
  return [...header, ...rows(positions).map((p) => p.join(' ')), ...faces, ''].join('\n');
}

function binaryStl({ positions, triangles }) {
  const bytes = Buffer.alloc(84 + 50 * (triangles.length / 3));
  bytes.writeUInt32LE(triangles.length / 3, 80);
  triangles.forEach((vertex, corner) => {
    const at = 84 + 50 * Math.floor(corner / 3) + 12 + 12 * (corner % 3);
    for (let d = 0; d < 3; ++d) bytes.writeFloatLE(positions[3 * vertex + d], at + 4 * d);
  });
  return bytes;
}

function glb({ positions, triangles }) {
  const places = Buffer.from(new Float32Array(positions).buffer);
  const indices = Buffer.from(new Uint32Array(triangles).buffer);
  const bounds = (best) => [0, 1, 2].map((d) => best(...rows(positions).map((p) => p[d])));
  const json = JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: positions.length / 3, type: 'VEC3', min: bounds(Math.min), max: bounds(Math.max) },
      { bufferView: 1, componentType: 5125, count: triangles.length, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: places.length },
      { buffer: 0, byteOffset: places.length, byteLength: indices.length },
    ],
    buffers: [{ byteLength: places.length + indices.length }],
  });
  const text = Buffer.from(json.padEnd(4 * Math.ceil(json.length / 4)));
  const head = (length, kind) => Buffer.concat([Buffer.from(Uint32Array.of(length).buffer), Buffer.from(kind)]);
  const chunks = Buffer.concat([head(text.length, 'JSON'), text, head(places.length + indices.length, 'BIN\0'), places, indices]);
  return Buffer.concat([Buffer.from('glTF'), Buffer.from(Uint32Array.of(2, 12 + chunks.length).buffer), chunks]);
}

/** One solid in every format. */
export const octahedronFiles = {
  'octahedron.obj': writeObj(octahedron),
  'octahedron.off': off(octahedron),
  'octahedron.ply': ply(octahedron),
  'octahedron.stl': binaryStl(octahedron),
  'octahedron.glb': glb(octahedron),
};

const moved = octahedron.positions.map((x, at) => (at % 3 === 0 ? x + 0.5 : 0.7 * x));
/** Triangles of the first eight meet those of the last eight. */
export const crossing = join(octahedron, { ...octahedron, positions: moved });

/** It can be read, but not cut. */
export const notFinite = { ...octahedron, positions: octahedron.positions.with(0, NaN) };

/** Files that can't be read, and what has to be said about them. */
export const badFiles = [
  { name: 'empty.obj', content: '', says: /empty/ },
  { name: 'no-faces.obj', content: 'v 0 0 0\nv 1 0 0\nv 0 1 0\n', says: /no triangles/i },
  { name: 'far-index.obj', content: 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n', says: /line 4.*9|9.*line 4/i },
  { name: 'not-a-number.off', content: 'OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n', says: /line 4/i },
  { name: 'cut-short.stl', content: binaryStl(octahedron).subarray(0, 300), says: /8|bytes/ },
  { name: 'cut-short.glb', content: glb(octahedron).subarray(0, 200), says: /cut off/ },
  { name: 'letter.txt', content: 'Dear reader', says: /OBJ, STL, PLY or OFF/ },
];
