/** As in ../arguments.js, of mandoline-wasm/physics. */
import {
  bad,
  collect,
  expectInteger,
  expectNumber,
  expectObject,
  expectTypedArray,
  kindOf,
  readFlag,
  readGrid,
  readId,
  readMesh,
  readNumbers,
  readVector,
  readWord,
} from '../arguments.js';

/** What a face is part of, by CellComplex.faceTag. */
export const faceTags = ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'];

/** Where a streamline ends, by Streamlines.ends. */
export const streamlineEnds = ['side', 'surface', 'rest', 'maxLength', 'maxPoints', 'outside'];

const conditions = ['neumann', 'dirichlet'];
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

export function readCoarsenOptions({ maxLevel = 24, fineLayers = 0 }) {
  return { maxLevel: readInt32(maxLevel, 'options.maxLevel'), fineLayers: readInt32(fineLayers, 'options.fineLayers') };
}

function readDualPoints({ dualPoints = 'centres' }, of) {
  return readWord(dualPoints, ['centres', 'centroids'], `${of}.dualPoints`);
}

export function readOperatorOptions(given) {
  const { only = operatorNames } = given;
  if (!Array.isArray(only)) throw bad(`options.only must be an array of names of operators, not ${kindOf(only)}.`);
  only.forEach((name, i) => readWord(name, operatorNames, `options.only[${i}]`));
  return [[...new Set(only)], readDualPoints(given, 'options')];
}

const definedEntries = (object) => Object.entries(object).filter(([, value]) => value !== undefined);

/** As arrays, Maps and the like are not. */
const isRecord = (value) => Object.prototype.toString.call(value) === '[object Object]';

/** { xMin: { dirichlet: 0 }, ... } as [tag, condition, value] each. */
export function readConditions(given) {
  if (given === undefined) return [];
  expectObject(given, 'conditions');
  if (!isRecord(given)) throw bad('conditions must be an object whose keys are tags.');
  return definedEntries(given).map(([tag, set]) => {
    const name = `conditions.${tag}`;
    const number = readWord(tag, faceTags, 'A key of conditions');
    expectObject(set, name);
    const [[word, value] = [], ...others] = definedEntries(set);
    if (word === undefined || others.length > 0) throw bad(`${name} must be { dirichlet } or { neumann }.`);
    return [number, readWord(word, conditions, `The key of ${name}`), expectNumber(value, `${name}.${word}`)];
  });
}

export function readBoundary(boundary, name = 'boundary') {
  expectObject(boundary, name);
  const halfFaces = expectTypedArray(boundary.halfFaces, 'Uint32Array', `${name}.halfFaces`);
  const condition = expectTypedArray(boundary.condition, 'Uint8Array', `${name}.condition`);
  const wrong = condition.findIndex((number) => number >= conditions.length);
  if (wrong >= 0) throw bad(`${name}.condition[${wrong}] must be 0 (neumann) or 1 (dirichlet), not ${condition[wrong]}.`);
  return { halfFaces, condition, value: readNumbers(boundary.value, `${name}.value`) };
}

export function readProblem(problem = {}) {
  expectObject(problem, 'problem');
  const { boundary, source } = problem;
  return {
    boundary: boundary === undefined ? undefined : readBoundary(boundary, 'problem.boundary'),
    source: source === undefined ? undefined : readNumbers(source, 'problem.source'),
    dualPoints: readDualPoints(problem, 'problem'),
  };
}

/** When a solver stops. */
export function readLimits({ tolerance = 1e-10, maxIterations = 500 }) {
  return { tolerance: expectNumber(tolerance, 'options.tolerance'), maxIterations: readInt32(maxIterations, 'options.maxIterations') };
}

export function readFreeConstant({ freeConstant = 'zeroMean' }) {
  return readWord(freeConstant, ['zeroMean', 'pinned'], 'options.freeConstant');
}

/** As much of a flow field as is no twin. */
export function readField(field) {
  expectObject(field, 'field');
  const { mesh, flow } = field;
  expectObject(flow, 'flow');
  return {
    mesh: readMesh(mesh),
    flow: {
      wind: readVector(flow.wind, 'flow.wind'),
      cellVelocity: expectTypedArray(flow.cellVelocity, 'Float64Array', 'flow.cellVelocity'),
      cellGradient: expectTypedArray(flow.cellGradient, 'Float64Array', 'flow.cellGradient'),
    },
  };
}

export function readStreamlineOptions({ upstream, tolerance = 1e-3, maxLength = Infinity, maxPoints = 10000 }) {
  if (expectInteger(maxPoints, 'options.maxPoints') < 0) throw bad(`options.maxPoints must be at least 0, not ${maxPoints}.`, 'badOption');
  return {
    upstream: readFlag(upstream, false, 'options.upstream'),
    tolerance: expectNumber(tolerance, 'options.tolerance'),
    maxLength: expectNumber(maxLength, 'options.maxLength'),
    maxPoints: Math.min(maxPoints, 2 ** 32 - 1),
  };
}

/** A grid that is none around a mesh. */
export function readPlacedGrid(grid) {
  const given = readGrid(grid);
  if (given.kind === 'around') throw bad('grid must be that of a cut-mesh, or have min and max, origin and spacing, or planes.');
  return given;
}
