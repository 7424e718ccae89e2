// Meshes for the tests, made by formula, with what is measured and asserted of them, and OBJ files; and results that have lost their arrays.
import assert from 'node:assert/strict';

/** An axis-aligned box with outward normals. */
export function box([x0, y0, z0], [x1, y1, z1]) {
  const positions = [];
  for (let i = 0; i < 8; ++i) positions.push(i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0);
  const quads = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
  ];
  return { positions: new Float64Array(positions), triangles: new Uint32Array(quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])) };
}

/** The rectangle from (x0, y0) to (x1, y1) at height z, with normal +z. */
export function sheet([x0, y0], [x1, y1], z) {
  return { positions: new Float64Array([x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z]), triangles: new Uint32Array([0, 1, 2, 0, 2, 3]) };
}

/** A surface over a grid of m x n parameters from 0 to 1; either end may be joined with the beginning. */
export function patch(m, n, joinU, joinV, pointAt) {
  const positions = [];
  const triangles = [];
  const columns = joinU ? m : m + 1;
  const rows = joinV ? n : n + 1;
  for (let j = 0; j < rows; ++j) for (let i = 0; i < columns; ++i) positions.push(...pointAt(i / m, j / n));
  const at = (i, j) => (i % columns) + columns * (j % rows);
  for (let j = 0; j < n; ++j) {
    for (let i = 0; i < m; ++i) triangles.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return { positions: new Float64Array(positions), triangles: new Uint32Array(triangles) };
}

export function torus(m, n, radius = 1, tube = 0.4) {
  return patch(m, n, true, true, (u, v) => {
    const a = 2 * Math.PI * u;
    const b = 2 * Math.PI * v;
    const r = radius + tube * Math.cos(b);
    return [r * Math.cos(a), r * Math.sin(a), tube * Math.sin(b)];
  });
}

/** An open, wavy sheet. */
export function waves(n, height = 0.2) {
  return patch(n, n, false, false, (u, v) => [u, v, height * Math.sin(7 * u) * Math.cos(5 * v)]);
}

/** Both meshes as one. */
export function join(a, b) {
  const shift = a.positions.length / 3;
  const moved = b.triangles.map((v) => v + shift);
  return { positions: Float64Array.of(...a.positions, ...b.positions), triangles: Uint32Array.of(...a.triangles, ...moved) };
}

export function writeObj({ positions, triangles }) {
  const lines = [];
  for (let i = 0; i < positions.length; i += 3) lines.push(`v ${positions[i]} ${positions[i + 1]} ${positions[i + 2]}`);
  for (let i = 0; i < triangles.length; i += 3) lines.push(`f ${triangles[i] + 1} ${triangles[i + 1] + 1} ${triangles[i + 2] + 1}`);
  return `${lines.join('\n')}\n`;
}

/** The volume that triangles enclose: positive if they are oriented outwards. */
export function volumeOf({ positions, triangles }) {
  let volume = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((j) => positions.subarray(3 * triangles[i + j], 3 * triangles[i + j] + 3));
    volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return volume / 6;
}

/** Asserts that there are triangles, and that each edge is run through as often one way as the other. */
export function assertClosed({ triangles }) {
  assert.ok(triangles.length > 0);
  const sums = new Map();
  for (let i = 0; i < triangles.length; ++i) {
    const [a, b] = [triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]];
    const edge = `${Math.min(a, b)} ${Math.max(a, b)}`;
    sums.set(edge, (sums.get(edge) ?? 0) + (a < b ? 1 : -1));
  }
  assert.ok([...sums.values()].every((sum) => sum === 0));
}

/** Vertices and faces of an OBJ file; polygons are fanned from their first vertex, as the native program does. */
export function readObj(text) {
  const positions = [];
  const triangles = [];
  for (const line of text.split('\n')) {
    const words = line.trim().split(/\s+/);
    if (words[0] === 'v') positions.push(...words.slice(1, 4).map(Number));
    if (words[0] !== 'f') continue;
    const ids = words
      .slice(1)
      .map((word) => parseInt(word, 10))
      .map((id) => (id > 0 ? id - 1 : positions.length / 3 + id));
    for (let i = 2; i < ids.length; ++i) triangles.push(ids[0], ids[i - 1], ids[i]);
  }
  return { positions: new Float64Array(positions), triangles: new Uint32Array(triangles) };
}

/** Leaves a result without its arrays, so that only its twin can answer for it. */
export function gut(value) {
  structuredClone(null, {
    transfer: Object.values(value)
      .filter((part) => ArrayBuffer.isView(part))
      .map((array) => array.buffer),
  });
  return value;
}

/** The doubles of the arrays in a .vtu file, by their names. */
export function readVtu(bytes) {
  const mark = '<AppendedData encoding="raw">\n_';
  const start = bytes.indexOf(mark) + mark.length;
  const heads = bytes
    .subarray(0, start)
    .toString()
    .matchAll(/<DataArray type="Float64" Name="(\w+)" .* offset="(\d+)"\/>/g);
  return Object.fromEntries(
    Array.from(heads, ([, name, offset]) => {
      const at = start + Number(offset);
      const size = Number(bytes.readBigUInt64LE(at));
      return [name, new Float64Array(new Uint8Array(bytes.subarray(at + 8, at + 8 + size)).buffer)];
    }),
  );
}
