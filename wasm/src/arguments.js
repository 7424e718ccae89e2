/** Checks of arguments before they go to C++, which judges their values: here only kinds, and what C++ could not read. */
import { MandolineError } from './errors.js';

export function bad(message, code = 'badArgument', element = -1) {
  return new MandolineError(code, message, { element });
}

function kindOf(value) {
  if (value === null) return 'null';
  if (ArrayBuffer.isView(value)) return value[Symbol.toStringTag] ?? 'a DataView';
  if (Array.isArray(value)) return 'an array';
  if (typeof value === 'object') return 'an object';
  return typeof value === 'number' ? String(value) : typeof value;
}

function expectObject(value, name) {
  if (typeof value !== 'object' || value === null) throw bad(`${name} must be an object, not ${kindOf(value)}.`);
}

function expectNumber(value, name) {
  if (typeof value !== 'number') throw bad(`${name} must be a number, not ${kindOf(value)}.`);
  return value;
}

function expectInteger(value, name) {
  if (!Number.isInteger(value)) throw bad(`${name} must be a whole number, not ${kindOf(value)}.`);
  return value;
}

/** Numbers that C++ keeps as 64-bit integers; those beyond are too large for anything. */
function readCount(value, name) {
  const most = Number.MAX_SAFE_INTEGER;
  return Math.min(Math.max(expectInteger(value, name), -most), most);
}

function expectAttached(array, name) {
  if (array.length > 0) return;
  try {
    new Uint8Array(array.buffer);
  } catch {
    throw bad(`${name} is detached: its buffer was transferred elsewhere.`);
  }
}

function expectTypedArray(value, type, name) {
  if (!ArrayBuffer.isView(value) || value[Symbol.toStringTag] !== type) throw bad(`${name} must be a ${type}, not ${kindOf(value)}.`);
  expectAttached(value, name);
  return value;
}

function isTypedArray(value, types) {
  return ArrayBuffer.isView(value) && types.includes(value[Symbol.toStringTag]);
}

export function readNumbers(value, name) {
  if (isTypedArray(value, ['Float64Array', 'Float32Array'])) {
    expectAttached(value, name);
    return value;
  }
  const length = typeof value === 'object' ? value?.length : undefined;
  if (!Number.isInteger(length) || length < 0 || length >= 2 ** 32) throw bad(`${name} must be an array of numbers, not ${kindOf(value)}.`);
  const numbers = new Float64Array(length);
  for (let i = 0; i < length; ++i) {
    if (typeof value[i] !== 'number') throw bad(`${name}[${i}] must be a number, not ${kindOf(value[i])}.`);
    numbers[i] = value[i];
  }
  return numbers;
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
  const ids = new Uint32Array(value.length);
  for (let i = 0; i < ids.length; ++i) {
    const id = expectInteger(value[i], `${name}[${i}]`);
    const triangle = Math.floor(i / 3);
    if (id < 0 || id >= 2 ** 32) throw bad(`Triangle ${triangle} refers to vertex ${id}, which does not exist.`, 'badIndex', triangle);
    ids[i] = id;
  }
  return ids;
}

export function readMesh(mesh) {
  expectObject(mesh, 'mesh');
  return { positions: readNumbers(mesh.positions, 'mesh.positions'), triangles: readTriangles(mesh.triangles) };
}

export function readVector(value, name, read = expectNumber) {
  const count = Array.isArray(value) || ArrayBuffer.isView(value) ? value.length : undefined;
  if (count !== 3) throw bad(`${name} must have three numbers, not ${count ?? kindOf(value)}.`);
  return [0, 1, 2].map((d) => read(value[d], `${name}[${d}]`));
}

/** The grid of a cut-mesh, or another one given by its planes. */
function readPlanes(grid, name) {
  if (!Array.isArray(grid.planes) || grid.planes.length !== 3) throw bad(`${name}.planes must have the planes of three axes, not ${kindOf(grid.planes)}.`);
  const planes = [0, 1, 2].map((d) => readNumbers(grid.planes[d], `${name}.planes[${d}]`));
  const uniform = grid.spacing !== null && grid.spacing !== undefined;
  return {
    kind: 'planes',
    planes,
    origin: uniform ? readVector(grid.origin, `${name}.origin`) : null,
    spacing: uniform ? readVector(grid.spacing, `${name}.spacing`) : null,
  };
}

export function readGrid(grid) {
  expectObject(grid, 'grid');
  if ('planes' in grid) return readPlanes(grid, 'grid');
  const cells = () => readVector(grid.cells, 'grid.cells', readCount);
  if ('min' in grid || 'max' in grid) return { kind: 'box', min: readVector(grid.min, 'grid.min'), max: readVector(grid.max, 'grid.max'), cells: cells() };
  if ('spacing' in grid || 'origin' in grid) {
    return { kind: 'regular', origin: readVector(grid.origin, 'grid.origin'), spacing: readVector(grid.spacing, 'grid.spacing'), cells: cells() };
  }
  return { kind: 'around', cells: readCount(grid.cells, 'grid.cells') };
}

export function readOptions(options) {
  if (options === undefined) return {};
  expectObject(options, 'options');
  return options;
}

export function readSnapTolerance({ snapTolerance = 0 }) {
  expectNumber(snapTolerance, 'options.snapTolerance');
  if (!(snapTolerance >= 0 && snapTolerance < 0.5)) throw bad('options.snapTolerance must be at least 0 and below 0.5.', 'badOption');
  return snapTolerance;
}

export function readFlag(value, fallback, name) {
  if (value === undefined) return fallback;
  if (typeof value !== 'boolean') throw bad(`${name} must be true or false, not ${kindOf(value)}.`);
  return value;
}

export function readFunction(value, name) {
  if (value !== undefined && typeof value !== 'function') throw bad(`${name} must be a function, not ${kindOf(value)}.`);
  return value;
}

/** An id; whether there is such an element is up to C++. */
export function readId(value, name) {
  if (expectInteger(value, name) < 0 || value >= 2 ** 32) throw bad(`${name} is ${value}, which is out of range.`);
  return value;
}

/**
 * The arrays that the module says a cut-mesh has ({ name, type, optional } each), with the right types; whether their lengths and ids fit
 * together is up to C++.
 */
export function readCutMesh(cutMesh, arrays) {
  expectObject(cutMesh, 'cutMesh');
  expectObject(cutMesh.grid, 'cutMesh.grid');
  const result = {
    grid: readPlanes(cutMesh.grid, 'cutMesh.grid'),
    regionCount: readId(cutMesh.regionCount, 'cutMesh.regionCount'),
    triangleCount: readId(cutMesh.triangleCount, 'cutMesh.triangleCount'),
  };
  for (const { name, type, optional } of arrays) {
    const value = cutMesh[name];
    result[name] = optional && value === null ? null : expectTypedArray(value, type, `cutMesh.${name}`);
  }
  return result;
}

export function readPoints(points) {
  const numbers = readNumbers(points, 'points');
  if (numbers.length % 3 !== 0) throw bad('points must have three numbers per point.');
  return numbers;
}

export function readPlane(plane) {
  expectObject(plane, 'plane');
  return { normal: readVector(plane.normal, 'plane.normal'), offset: expectNumber(plane.offset, 'plane.offset') };
}
