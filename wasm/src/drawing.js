// What the functions of three.js are given, checked: arrays may have been transferred elsewhere, or be those of another cut-mesh.
// Readers are those of arguments.js with the cut-mesh as one more argument.
import { bad, expectNumber, expectObject, expectTypedArray, optional, readOptions, readOrigin, word } from './arguments.js';
import { named } from './errors.js';

function expectArrays(value, arrays, name) {
  expectObject(value, name);
  for (const [type, keys] of Object.entries(arrays)) for (const key of keys) expectTypedArray(value[key], type, `${name}.${key}`);
  return value;
}

const cutMeshArrays = {
  Float64Array: ['positions'],
  Uint32Array: [
    'loopOffsets',
    'loopVertices',
    'faceLoopOffsets',
    'cellHalfFaceOffsets',
    'cellHalfFaces',
    'cellRegion',
    'rowRunOffsets',
    'runRegion',
  ],
  Int32Array: ['faceTriangle', 'runBegin', 'runEnd'],
};

/** As much as colours are made of. */
export function readColored(cutMesh, name) {
  expectArrays(cutMesh, { Uint32Array: ['cellRegion'] }, name);
  const { regionWinding } = cutMesh;
  if (regionWinding !== null && regionWinding !== undefined) expectTypedArray(regionWinding, 'Int32Array', `${name}.regionWinding`);
  return cutMesh;
}

function readCutMesh(cutMesh, name) {
  expectArrays(cutMesh, cutMeshArrays, name);
  expectObject(cutMesh.grid, `${name}.grid`);
  expectArrays(cutMesh.grid.planes, { Float64Array: [0, 1, 2] }, `${name}.grid.planes`);
  return readColored(cutMesh, name);
}

function expectCount(found, expected, items, name) {
  if (found !== expected) throw bad(`${name} is of another cut-mesh: it has ${found} ${items}, not ${expected}.`);
}

function expectMadeFrom({ madeFrom }, { fingerprint }, name) {
  if (madeFrom && fingerprint && madeFrom !== fingerprint) throw bad(`${name} is of another cut-mesh.`);
}

function readFaceTriangles(value, name, cutMesh) {
  expectArrays(value, { Uint32Array: ['faceTriangleOffsets', 'triangles'] }, name);
  expectMadeFrom(value, cutMesh, name);
  expectCount(value.faceTriangleOffsets.length - 1, cutMesh.faceTriangle.length, 'faces', name);
  return value;
}

function readMeasures(value, name, cutMesh) {
  expectArrays(value, { Float64Array: ['cellVolume'] }, name);
  expectMadeFrom(value, cutMesh, name);
  expectCount(value.cellVolume.length, cutMesh.cellRegion.length, 'cut-cells', name);
  if (value.cellCentroid !== undefined) expectTypedArray(value.cellCentroid, 'Float64Array', `${name}.cellCentroid`);
  return value;
}

/** A reader of ids, of which the cut-mesh has as many as `count` says. */
const ids = (things, count) => (value, name, cutMesh) => {
  if (typeof value?.length !== 'number') throw bad(`${name} must be an array of ids.`);
  const most = count(cutMesh);
  for (let i = 0; i < value.length; ++i) {
    if (Number.isInteger(value[i]) && value[i] >= 0 && value[i] < most) continue;
    throw bad(`${name}[${i}] is ${value[i]}, but there are ${most} ${things}.`, 'badArgument', i);
  }
  return value;
};

const orElse =
  (fallback, read) =>
  (value = fallback, ...more) =>
    read(value, ...more);

const readColorBy = word(['region', 'winding', 'cell', 'volume']);

/** What the functions take between the cut-mesh and their options. */
const taken = {
  faceTriangles: readFaceTriangles,
  cutEdges: (value, name) => expectArrays(value, { Uint32Array: ['edgeVertices'] }, name),
  slice: (value, name) =>
    expectArrays(
      value,
      {
        Float64Array: ['positions'],
        Uint32Array: ['triangles', 'polygonTriangleOffsets', 'polygonRegion'],
        Int32Array: ['polygonCell', 'polygonGridCell'],
      },
      name,
    ),
  colorBy: readColorBy,
  measures: optional(readMeasures),
  origin: readOrigin,
};

/** Of all functions, so that they take the same object. */
const options = {
  cells: optional(ids('cut-cells', ({ cellRegion }) => cellRegion.length)),
  regions: optional(ids('regions', ({ regionCount }) => regionCount)),
  faces: orElse('all', word(['all', 'surface', 'grid'])),
  origin: readOrigin,
  explode: orElse(0, expectNumber),
  colorBy: orElse('region', readColorBy),
  measures: optional(readMeasures),
};

/** A function of three.js, which takes a cut-mesh, arguments of these names, and options. */
export function drawing(stage, names, f, readCut = readCutMesh) {
  return named(stage, (...given) => {
    const cutMesh = readCut(given[0], 'cutMesh');
    const args = names.map((name, i) => taken[name](given[i + 1], name, cutMesh));
    return f(cutMesh, ...args, readOptions(given[names.length + 1], options, cutMesh));
  });
}
