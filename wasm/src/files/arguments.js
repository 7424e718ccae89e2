/** As in ../arguments.js, of files. */
import { bad, expectObject, expectTypedArray, kindOf, readFields, readMembers, readPoints, word } from '../arguments.js';
import { FileFormat, MeshInfo, Outlines } from '../fields.js';
import { readName } from '../files.js';

/** A reader of one of these formats, as its number. */
export const format =
  (...words) =>
  (value, name) =>
    FileFormat.indexOf(word(words)(value, name));

const asList = (read) => (value, name) => {
  if (!Array.isArray(value)) throw bad(`${name} must be an array, not ${kindOf(value)}.`);
  return value.map((item, i) => read(item, `${name}[${i}]`));
};

export const readLayers = asList((layer, name) => readFields(layer, Outlines, name));

const readTriangleGroup = (value, name) => expectTypedArray(value, 'Uint32Array', name);

/** What readGroups() gives. */
export const readGroups = (groups, name) => readMembers(groups, { names: asList(readName), triangleGroup: readTriangleGroup }, name);

/** As much of what inspect() gives as is written. */
export function readDefects(info, name) {
  const { vertices, triangles, defectVertices, defectKind } = MeshInfo;
  return readFields(info, { vertices, triangles, defectVertices, defectKind }, name);
}

/** Of streamlines, their points and offsets. */
export function readLines(lines, name) {
  expectObject(lines, name);
  return { points: readPoints(lines.points, `${name}.points`), offsets: expectTypedArray(lines.offsets, 'Uint32Array', `${name}.offsets`) };
}
