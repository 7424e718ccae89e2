/** As in ../arguments.js, of files. */
import { bad, expectTypedArray, kindOf, readFields, readMembers } from '../arguments.js';
import { Outlines } from '../fields.js';
import { readName } from '../files.js';

const asList = (read) => (value, name) => {
  if (!Array.isArray(value)) throw bad(`${name} must be an array, not ${kindOf(value)}.`);
  return value.map((item, i) => read(item, `${name}[${i}]`));
};

export const readLayers = asList((layer, name) => readFields(layer, Outlines, name));

const readTriangleGroup = (value, name) => expectTypedArray(value, 'Uint32Array', name);

/** What readGroups() gives. */
export const readGroups = (groups, name) => readMembers(groups, { names: asList(readName), triangleGroup: readTriangleGroup }, name);
