/** As in ../arguments.js, of mandoline-wasm/physics. */
import {
  bad,
  collect,
  expectInteger,
  expectNumber,
  expectObject,
  expectTypedArray,
  kindOf,
  numbered,
  optional,
  readGrid,
  readId,
  readMembers,
  readNumbers,
  readVector,
  word,
} from '../arguments.js';

/** What a face is part of, by CellComplex.faceTag. */
export const faceTags = ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'];

/** Where a streamline ends, by Streamlines.ends. */
export const streamlineEnds = ['side', 'surface', 'rest', 'maxLength', 'maxPoints', 'outside'];

const conditions = ['neumann', 'dirichlet']; // in the order in which C++ numbers them
const operatorNames = [
  'cellFaceIncidence',
  'faceEdgeIncidence',
  'edgeVertexIncidence',
  'gradient',
  'divergence',
  'laplacian',
  'cellMass',
  'faceStar',
  'faceMass',
];

/** A number that C++ keeps as a 32-bit integer; those beyond are as good as the limit. */
function readInt32(value, name) {
  return Math.min(Math.max(expectInteger(value, name), -(2 ** 31)), 2 ** 31 - 1);
}

/** Readers of numbers that may be left out. */
export const number =
  (fallback) =>
  (value = fallback, name) =>
    expectNumber(value, name);
export const int32 =
  (fallback) =>
  (value = fallback, name) =>
    readInt32(value, name);

export const dualPoints = numbered(['centres', 'centroids']);

/** The arrays that the module says a cell complex has ({ name, type } each), with the right types; the rest is up to C++. */
export function readComplex(cells, arrays) {
  expectObject(cells, 'cells');
  const result = {};
  for (const name of ['cutVertices', 'cutFaces', 'cutCells']) result[name] = readId(cells[name], `cells.${name}`);
  for (const { name, type } of arrays) result[name] = expectTypedArray(cells[name], type, `cells.${name}`);
  return result;
}

export function readOctree(octree) {
  if (octree === undefined || octree === null) return null;
  expectObject(octree, 'octree');
  return {
    gridCells: readVector(octree.gridCells, 'octree.gridCells', readInt32),
    cellCorner: expectTypedArray(octree.cellCorner, 'Int32Array', 'octree.cellCorner'),
    cellLevel: expectTypedArray(octree.cellLevel, 'Uint8Array', 'octree.cellLevel'),
    cellRegion: expectTypedArray(octree.cellRegion, 'Uint32Array', 'octree.cellRegion'),
  };
}

/** Ids of cells; whether there are such is up to C++. */
export function readCellIds(ids) {
  if (ArrayBuffer.isView(ids)) return expectTypedArray(ids, 'Uint32Array', 'cellIds');
  if (!Array.isArray(ids)) throw bad(`cellIds must be a Uint32Array or an array, not ${kindOf(ids)}.`);
  return collect(Uint32Array, ids, 'cellIds', (id, i) => readId(id, `cellIds[${i}]`));
}

export function readOperatorNames(names = operatorNames, name) {
  if (!Array.isArray(names)) throw bad(`${name} must be an array of names of operators, not ${kindOf(names)}.`);
  return [...new Set(names.map((operator, i) => word(operatorNames)(operator, `${name}[${i}]`)))];
}

const definedEntries = (object) => Object.entries(object).filter(([, value]) => value !== undefined);

/** { dirichlet } or { neumann } as [condition, value]. */
function readCondition(given, name) {
  const members = readMembers(given, Object.fromEntries(conditions.map((condition) => [condition, optional(expectNumber)])), name);
  const [[condition, value] = [], ...others] = definedEntries(members);
  if (condition === undefined || others.length > 0) throw bad(`${name} must be { dirichlet } or { neumann }.`);
  return [conditions.indexOf(condition), value];
}

/** { xMin: { dirichlet: 0 }, ... } as [tag, condition, value] each. */
export function readConditions(given = {}, name) {
  const members = readMembers(given, Object.fromEntries(faceTags.map((tag) => [tag, optional(readCondition)])), name);
  return definedEntries(members).map(([tag, condition]) => [faceTags.indexOf(tag), ...condition]);
}

export function readBoundary(boundary, name) {
  expectObject(boundary, name);
  const halfFaces = expectTypedArray(boundary.halfFaces, 'Uint32Array', `${name}.halfFaces`);
  const condition = expectTypedArray(boundary.condition, 'Uint8Array', `${name}.condition`);
  const wrong = condition.findIndex((number) => number >= conditions.length);
  if (wrong >= 0) throw bad(`${name}.condition[${wrong}] must be 0 (neumann) or 1 (dirichlet), not ${condition[wrong]}.`);
  return { halfFaces, condition, value: readNumbers(boundary.value, `${name}.value`) };
}

export function readProblem(problem = {}, name) {
  return readMembers(problem, { boundary: optional(readBoundary), source: optional(readNumbers), dualPoints }, name);
}

/** As much of a flow as is read again. */
export function readFlow(flow) {
  expectObject(flow, 'flow');
  return {
    wind: readVector(flow.wind, 'flow.wind'),
    cellVelocity: expectTypedArray(flow.cellVelocity, 'Float64Array', 'flow.cellVelocity'),
    cellGradient: expectTypedArray(flow.cellGradient, 'Float64Array', 'flow.cellGradient'),
  };
}

export function readMaxPoints(maxPoints = 10000, name) {
  if (expectInteger(maxPoints, name) < 0) throw bad(`${name} must be at least 0, not ${maxPoints}.`, 'badOption');
  return Math.min(maxPoints, 2 ** 32 - 1);
}

/** A grid that is none around a mesh. */
export function readPlacedGrid(grid) {
  const given = readGrid(grid);
  if (given.kind === 'around') throw bad('grid must be that of a cut-mesh, or have min and max, origin and spacing, or planes.');
  return given;
}
