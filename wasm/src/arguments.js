/**
 * Checks of arguments before they go to C++. C++ judges their values; here only their kinds are checked, and what C++ could not read. A
 * reader, called with (value, name), returns what C++ takes; messages call the value by the name.
 */
import { MandolineError } from './errors.js';
import { CutMesh, ResolvedMesh } from './fields.js';
import { suggestion } from './names.js';

export function bad(message, code = 'badArgument', element = -1) {
  return new MandolineError(code, message, { element });
}

/** For example "Map"; "Object" for plain ones. */
const tagOf = (value) => Object.prototype.toString.call(value).slice(8, -1);

export function kindOf(value) {
  if (value === null) return 'null';
  if (ArrayBuffer.isView(value)) return value[Symbol.toStringTag] ?? 'a DataView';
  if (Array.isArray(value)) return 'an array';
  if (typeof value === 'object') return `a ${tagOf(value)}`.replace(/^a (?=[AEIO])/, 'an ').replace('Object', 'object');
  return typeof value === 'number' ? String(value) : typeof value;
}

export function expectObject(value, name) {
  if (typeof value !== 'object' || value === null) throw bad(`${name} must be an object, not ${kindOf(value)}.`);
}

/** Throws if the object has a key that is none of these names. */
function expectNames(object, names, name) {
  const unknown = Object.keys(object).find((key) => !names.includes(key));
  if (unknown !== undefined) throw bad(`${name} has no ${unknown}${suggestion(unknown, names, 'the call takes none')}`);
}

/** What these readers make, in a context, of the members of an object that has no others. It may be an imported module. */
export function readMembers(value, readers, name, ...context) {
  expectObject(value, name);
  if (!['Object', 'Module'].includes(tagOf(value))) throw bad(`${name} must be a plain object, not ${kindOf(value)}.`);
  expectNames(value, Object.keys(readers), name);
  return Object.fromEntries(Object.entries(readers).map(([key, read]) => [key, read(value[key], `${name}.${key}`, ...context)]));
}

export function readOptions(options = {}, readers = {}, ...context) {
  return readMembers(options, readers, 'options', ...context);
}

/**
 * The options that start a module or a worker: `own` has to be there if any of the others is. The inline entries have all of them, and
 * some bundlers add "default" to a module.
 */
export function readStart(options, own, more = {}) {
  const asIs = (value) => value;
  const read = readOptions(options, {
    wasm: asIs,
    filesWasm: asIs,
    bricksWasm: asIs,
    physicsWasm: asIs,
    thread: readFunction,
    default: asIs,
    ...more,
  });
  const other = ['wasm', 'physicsWasm'].find((name) => name !== own && read[name] !== undefined);
  if (own && other && read[own] === undefined) throw bad(`options.${other} is not for this: did you mean ${own}?`);
  return read;
}

const mostThreads = 64;

/** The same of a worker, which may have several threads. */
export function readWorkerStart(options, own) {
  const threads = (value = 1, name) => {
    if (!Number.isInteger(value) || value < 1 || value > mostThreads)
      throw bad(`${name} must be an integer from 1 to ${mostThreads}, not ${typeof value === 'number' ? value : kindOf(value)}.`);
    return value;
  };
  return readStart(options, own, { threads });
}

/** A reader that leaves undefined values as they are. */
export const optional =
  (read) =>
  (value, name, ...context) =>
    value === undefined ? value : read(value, name, ...context);

/** Undefined, or an array of ArrayBuffers. */
export function readBuffers(value, name) {
  if (value === undefined) return value;
  if (!Array.isArray(value)) throw bad(`${name} must be an array of ArrayBuffers, not ${kindOf(value)}.`);
  const wrong = value.findIndex((buffer) => tagOf(buffer) !== 'ArrayBuffer');
  if (wrong >= 0) throw bad(`${name}[${wrong}] must be an ArrayBuffer, not ${kindOf(value[wrong])}.`, 'badArgument', wrong);
  return value;
}

export function expectNumber(value, name) {
  if (typeof value !== 'number') throw bad(`${name} must be a number, not ${kindOf(value)}.`);
  return value;
}

export function expectInteger(value, name) {
  if (!Number.isInteger(value)) throw bad(`${name} must be a whole number, not ${kindOf(value)}.`);
  return value;
}

/** Numbers that C++ keeps as 64-bit integers; those beyond are too large for anything. */
export function readCount(value, name) {
  const most = Number.MAX_SAFE_INTEGER;
  return Math.min(Math.max(expectInteger(value, name), -most), most);
}

function expectAttached(array, name) {
  try {
    if (array.byteLength === 0) array.at?.(0); // throws unless it is just empty
  } catch {
    throw bad(`${name} is detached or out of bounds: its buffer was transferred elsewhere or shrunk.`);
  }
}

/** The same for everything that a value holds. */
export function expectAllAttached(value, name = '', seen = new Set()) {
  if (ArrayBuffer.isView(value)) return expectAttached(value, name);
  if (typeof value !== 'object' || value === null || seen.has(value)) return;
  seen.add(value);
  const nameOf = (key) => (Array.isArray(value) ? `${name}[${key}]` : name ? `${name}.${key}` : key);
  for (const [key, part] of Object.entries(value)) expectAllAttached(part, nameOf(key), seen);
}

/** @returns {any} */
export function expectTypedArray(value, type, name) {
  if (!ArrayBuffer.isView(value) || value[Symbol.toStringTag] !== type) throw bad(`${name} must be a ${type}, not ${kindOf(value)}.`);
  expectAttached(value, name);
  return value;
}

function isTypedArray(value, types) {
  return ArrayBuffer.isView(value) && types.includes(value[Symbol.toStringTag]);
}

/** A typed array of read(value, place) for each value. A sparse array may have a length that there is no memory for. */
export function collect(Type, values, name, read) {
  let collected;
  try {
    collected = new Type(values.length);
  } catch (cause) {
    throw new MandolineError('outOfMemory', `There is not enough memory for ${name}.`, { cause });
  }
  for (let i = 0; i < collected.length; ++i) collected[i] = read(values[i], i);
  return collected;
}

/** The length of an array, a typed array or an array-like object; undefined for others. */
function lengthOf(value) {
  const length = typeof value === 'object' ? value?.length : undefined;
  return Number.isInteger(length) && length >= 0 && length < 2 ** 32 ? length : undefined;
}

export function readNumbers(value, name) {
  if (isTypedArray(value, ['Float64Array', 'Float32Array'])) {
    expectAttached(value, name);
    return value;
  }
  if (lengthOf(value) === undefined) throw bad(`${name} must be an array of numbers, not ${kindOf(value)}.`);
  return collect(Float64Array, value, name, (number, i) => {
    if (typeof number !== 'number') throw bad(`${name}[${i}] must be a number, not ${kindOf(number)}.`);
    return number;
  });
}

function readTriangles(value) {
  const name = 'mesh.triangles';
  if (isTypedArray(value, ['Uint32Array', 'Uint16Array', 'Uint8Array'])) {
    expectAttached(value, name);
    return value;
  }
  if (!Array.isArray(value) && !isTypedArray(value, ['Int32Array', 'Int16Array', 'Int8Array'])) {
    throw bad(`${name} must be an array of tri-vertex ids, not ${kindOf(value)}.`);
  }
  if (!Array.isArray(value)) expectAttached(value, name);
  return collect(Uint32Array, value, name, (id, i) => {
    const triangle = Math.floor(i / 3);
    if (expectInteger(id, `${name}[${i}]`) >= 0 && id < 2 ** 32) return id;
    throw bad(`Triangle ${triangle} refers to vertex ${id}, which does not exist.`, 'badIndex', triangle);
  });
}

export function readMesh(mesh) {
  expectObject(mesh, 'mesh');
  return { positions: readNumbers(mesh.positions, 'mesh.positions'), triangles: readTriangles(mesh.triangles) };
}

export function readVector(value, name, read = expectNumber) {
  const count = lengthOf(value);
  if (count !== 3) throw bad(`${name} must have three numbers, not ${count ?? kindOf(value)}.`);
  return [0, 1, 2].map((d) => read(value[d], `${name}[${d}]`));
}

export const readOrigin = (value = [0, 0, 0], name) => readVector(value, name);

/** The grid of a cut-mesh, or another one given by its planes. */
function readPlanes(grid, name) {
  const isTriple = Array.isArray(grid.planes) && grid.planes.length === 3;
  if (!isTriple) throw bad(`${name}.planes must have the planes of three axes, not ${kindOf(grid.planes)}.`);
  const planes = [0, 1, 2].map((d) => readNumbers(grid.planes[d], `${name}.planes[${d}]`));
  const uniform = grid.spacing !== null && grid.spacing !== undefined;
  return {
    kind: 'planes',
    planes,
    origin: uniform ? readVector(grid.origin, `${name}.origin`) : null,
    spacing: uniform ? readVector(grid.spacing, `${name}.spacing`) : null,
  };
}

const gridKinds = {
  planes: ['planes', 'origin', 'spacing', 'cells'],
  box: ['min', 'max', 'cells'],
  regular: ['origin', 'spacing', 'cells'],
  around: ['cells', 'margin'],
};

/** The kind follows from the first of its names that the grid has. */
function kindOfGrid(grid) {
  const has = (name) => grid[name] !== undefined;
  if (has('planes')) return 'planes';
  if (has('min') || has('max')) return 'box';
  return has('origin') || has('spacing') ? 'regular' : 'around';
}

export function readGrid(grid) {
  expectObject(grid, 'grid');
  expectNames(grid, [...new Set(Object.values(gridKinds).flat())], 'grid');
  const kind = kindOfGrid(grid);
  const names = gridKinds[kind];
  const unused = Object.keys(grid).find((key) => grid[key] !== undefined && !names.includes(key));
  if (unused !== undefined) throw bad(`grid.${unused} is not used by a grid that has ${names[0]}.`);
  if (kind === 'planes') return readPlanes(grid, 'grid');
  if (kind === 'around') {
    const { cells, margin = 0.05 } = grid;
    expectNumber(margin, 'grid.margin');
    if (!(margin >= 0 && margin <= 1e6)) throw bad(`grid.margin must be from 0 to 1e6, not ${margin}.`, 'badGrid');
    return { kind, cells: readCount(cells, 'grid.cells'), margin };
  }
  const [first, second] = names;
  return {
    kind,
    [first]: readVector(grid[first], `grid.${first}`),
    [second]: readVector(grid[second], `grid.${second}`),
    cells: readVector(grid.cells, 'grid.cells', readCount),
  };
}

/** A grid that is none around a mesh. */
export function readPlacedGrid(grid) {
  const given = readGrid(grid);
  if (given.kind === 'around') throw bad('grid must be that of a cut-mesh, or have min and max, origin and spacing, or planes.');
  return given;
}

export function readSnapTolerance(snapTolerance = 0, name) {
  expectNumber(snapTolerance, name);
  if (!(snapTolerance >= 0 && snapTolerance < 0.5)) throw bad(`${name} must be at least 0 and below 0.5.`, 'badOption');
  return snapTolerance;
}

function expectWord(word, words, name) {
  if (words.includes(word)) return word;
  const [last, ...others] = words.map((other) => `"${other}"`).reverse();
  throw bad(`${name} must be ${others.reverse().join(', ')} or ${last}, not ${typeof word === 'string' ? `"${word}"` : kindOf(word)}.`);
}

export const word = (words) => (value, name) => expectWord(value, words, name);

/** A reader of a word as its number among these, which are in the order in which C++ numbers them. The first is the default. */
export const numbered =
  (words) =>
  (value = words[0], name) =>
    words.indexOf(expectWord(value, words, name));

/** How many pairs are to be listed. */
export function readMaxPairs(maxPairs = 100_000, name) {
  if (expectInteger(maxPairs, name) < 0) throw bad(`${name} must be at least 0, not ${maxPairs}.`);
  return Math.min(maxPairs, 2 ** 32 - 1);
}

/** A reader of true or false, where one of these is the default. */
export const flag =
  (fallback) =>
  (value = fallback, name) => {
    if (typeof value !== 'boolean') throw bad(`${name} must be true or false, not ${kindOf(value)}.`);
    return value;
  };

/** One flag each as bytes. */
export function readFlags(value, name) {
  if (isTypedArray(value, ['Uint8Array'])) {
    expectAttached(value, name);
    return value;
  }
  if (!Array.isArray(value)) throw bad(`${name} must be a Uint8Array or an array, not ${kindOf(value)}.`);
  return collect(Uint8Array, value, name, Boolean);
}

export function expectFunction(value, name) {
  if (typeof value !== 'function') throw bad(`${name} must be a function, not ${kindOf(value)}.`);
  return value;
}

export const readFunction = optional(expectFunction);

/** Readers of the options of coarsen(). */
export const coarsening = (maxLevel) => ({
  maxLevel: int32(maxLevel),
  fineLayers: int32(1),
  layersPerLevel: int32(-1),
  balanceEdges: flag(false),
});

/** An id; whether there is such an element is up to C++. */
export function readId(value, name) {
  if (expectInteger(value, name) < 0 || value >= 2 ** 32) throw bad(`${name} is ${value}, which is out of range.`);
  return value;
}

const parentArrays = ['faceParentOffsets', 'faceParents', 'faceParentSigns'];
const madeArrays = ['madeVertices', 'madeVertexKinds', 'madeVertexParents'];
const partArrays = ['regionPartWinding', 'regionParity', 'regionInsideness', 'parityTriangles', 'openTriangles'];

/** Cut-meshes from before parts of the mesh had winding numbers of their own know nothing of these. */
function withParts(cutMesh) {
  if (partArrays.some((name) => cutMesh[name] !== undefined)) return cutMesh;
  const nothing = { regionPartWinding: null, regionParity: null, regionInsideness: null };
  return { ...cutMesh, ...nothing, parityTriangles: new Uint32Array(), openTriangles: new Uint32Array() };
}

/** Cut-meshes from before self-intersections were resolved have neither parents nor made vertices: a face's triangle is its only parent. */
function withParents(cutMesh) {
  const { faceTriangle } = cutMesh;
  const isComplete = [...parentArrays, ...madeArrays].some((name) => cutMesh[name] !== undefined);
  if (isComplete || !isTypedArray(faceTriangle, ['Int32Array'])) return cutMesh;
  const faceParents = Uint32Array.from(faceTriangle.filter((triangle) => triangle >= 0));
  const faceParentOffsets = new Uint32Array(faceTriangle.length + 1);
  for (let f = 0; f < faceTriangle.length; ++f) faceParentOffsets[f + 1] = faceParentOffsets[f] + (faceTriangle[f] >= 0 ? 1 : 0);
  return {
    ...cutMesh,
    faceParentOffsets,
    faceParents,
    faceParentSigns: new Int8Array(faceParents.length).fill(1),
    madeVertices: new Uint32Array(),
    madeVertexKinds: new Uint8Array(),
    madeVertexParents: new Int32Array(),
  };
}

/** A number that C++ keeps as a 32-bit integer; those beyond are as good as the limit. */
export function readInt32(value, name) {
  return Math.min(Math.max(expectInteger(value, name), -(2 ** 31)), 2 ** 31 - 1);
}

/** A reader of such numbers that may be left out. */
export const int32 =
  (fallback) =>
  (value = fallback, name) =>
    readInt32(value, name);

function readGridOf(grid, name) {
  expectObject(grid, name);
  return readPlanes(grid, name);
}

/** What a result was made of; arrays from elsewhere have none. */
const readFingerprint = optional((value, name) => {
  if (typeof value === 'string' && /^[0-9a-f]{16}$/.test(value)) return value;
  throw bad(`${name} must be 16 hexadecimal digits, not ${typeof value === 'string' ? `"${value}"` : kindOf(value)}.`);
});

/** Readers of members by their kinds in fields.js, except typed arrays. */
const kinds = {
  Grid: readGridOf,
  Fingerprint: readFingerprint,
  integer: readId,
  number: expectNumber,
  'integer[3]': (...given) => readVector(...given, readInt32),
  'number[3]': readVector,
};

/** The members that a struct of C++ has, by its kinds in fields.js. Whether lengths and ids fit together is up to C++. */
export function readFields(value, fields, name) {
  expectObject(value, name);
  const read = ([key, kind]) => {
    const [type, orNull] = kind.split(' | ');
    if (orNull && value[key] === null) return [key, null];
    return [key, (kinds[type] ?? ((array, of) => expectTypedArray(array, type, of)))(value[key], `${name}.${key}`)];
  };
  return Object.fromEntries(Object.entries(fields).map(read));
}

export function readCutMesh(cutMesh) {
  expectObject(cutMesh, 'cutMesh');
  return readFields({ snapTolerance: 0, ...withParts(withParents(cutMesh)) }, CutMesh, 'cutMesh');
}

/** The part of the result of resolve() that boundary() takes. */
export function readResolved(mesh) {
  const arrays = readMesh(mesh);
  const fields = {};
  for (const what of ['Winding', 'PartWinding', 'Parity']) {
    const sides = [`front${what}`, `back${what}`];
    const isNull = sides.every((side) => mesh[side] === null);
    for (const side of sides) fields[side] = isNull ? ResolvedMesh[side] : ResolvedMesh[side].split(' | ')[0]; // one without the other is none
  }
  return { ...arrays, ...readFields(mesh, fields, 'mesh') };
}

export function readPoints(points, name = 'points') {
  const numbers = readNumbers(points, name);
  if (numbers.length % 3 !== 0) throw bad(`${name} must have three numbers per point.`);
  return numbers;
}

export function readPlane(plane) {
  return readMembers(plane, { normal: readVector, offset: expectNumber }, 'plane');
}

/** Undefined, { cell } or { region }. */
export function readPart(of, name) {
  if (of === undefined) return of;
  const { cell, region } = readMembers(of, { cell: optional(readId), region: optional(readId) }, name);
  if ((cell === undefined) === (region === undefined)) throw bad(`${name} must be { cell } or { region }.`);
  return { cell, region };
}
