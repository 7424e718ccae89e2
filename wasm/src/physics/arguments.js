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
  readFields,
  readId,
  readMembers,
  readNumbers,
  word,
} from '../arguments.js';
import { Boundary, CellComplex, Condition, DualPoints, FaceTag, Flow, OctreeCells, StreamlineEnd } from './fields.js';

/** What a face is part of, by CellComplex.faceTag. */
export const faceTags = FaceTag;

/** Where a streamline ends, by Streamlines.ends. */
export const streamlineEnds = StreamlineEnd;

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

/** Readers of numbers that may be left out. */
export const number =
  (fallback) =>
  (value = fallback, name) =>
    expectNumber(value, name);

export const dualPoints = numbered(DualPoints);

export const readComplex = (cells) => readFields(cells, CellComplex, 'cells');

export const readOctree = (octree) => (octree === undefined || octree === null ? null : readFields(octree, OctreeCells, 'octree'));

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

/** { dirichlet }, { neumann } or { robin, coefficient } as [condition, value, coefficient]. */
function readCondition(given, name) {
  const numbers = Object.fromEntries([...Condition, 'coefficient'].map((member) => [member, optional(expectNumber)]));
  const { coefficient, ...members } = readMembers(given, numbers, name);
  const [[condition, value] = [], ...others] = definedEntries(members);
  const isComplete = condition !== undefined && (coefficient !== undefined) === (condition === 'robin');
  if (!isComplete || others.length > 0) throw bad(`${name} must be { dirichlet }, { neumann } or { robin, coefficient }.`);
  return [Condition.indexOf(condition), value, coefficient ?? 0];
}

/** { xMin: { dirichlet: 0 }, ... } as [tag, condition, value, coefficient] each. */
export function readConditions(given = {}, name) {
  const members = readMembers(given, Object.fromEntries(faceTags.map((tag) => [tag, optional(readCondition)])), name);
  return definedEntries(members).map(([tag, condition]) => [faceTags.indexOf(tag), ...condition]);
}

export function readBoundary(boundary, name) {
  const { value: _, coefficient: __, ...fields } = Boundary;
  const { condition, ...others } = readFields(boundary, fields, name);
  const wrong = condition.findIndex((number) => number >= Condition.length);
  if (wrong >= 0) throw bad(`${name}.condition[${wrong}] must be 0 (neumann), 1 (dirichlet) or 2 (robin), not ${condition[wrong]}.`);
  const [value, coefficient] = ['value', 'coefficient'].map((member) => readNumbers(boundary[member], `${name}.${member}`));
  return { ...others, condition, value, coefficient };
}

export function readProblem(problem = {}, name) {
  const numbers = optional(readNumbers);
  const members = { boundary: optional(readBoundary), source: numbers, dualPoints, faceCoefficient: numbers, mass: numbers };
  return readMembers(problem, members, name);
}

/** What a solver is given each time. */
export function readPoissonData(data = {}, name) {
  const numbers = optional(readNumbers);
  return readMembers(data, { source: numbers, boundaryValue: numbers, start: numbers }, name);
}

export const readHeat = (heat, name) => readMembers(heat, { problem: readProblem, phi: readNumbers, timeStep: expectNumber }, name);

/** As much of a flow as is read again. */
export function readFlow(flow) {
  const { wind, cellVelocity, cellGradient, madeFrom } = Flow;
  return readFields(flow, { wind, cellVelocity, cellGradient, madeFrom }, 'flow');
}

export function readMaxPoints(maxPoints = 10000, name) {
  if (expectInteger(maxPoints, name) < 0) throw bad(`${name} must be at least 0, not ${maxPoints}.`, 'badOption');
  return Math.min(maxPoints, 2 ** 32 - 1);
}

/** { name: numbers, ... } as [name, numbers] each. */
export function readFieldsToWrite(fields = {}, name) {
  expectObject(fields, name);
  return Object.entries(fields).map(([field, numbers]) => [field, readNumbers(numbers, `${name}.${field}`)]);
}
