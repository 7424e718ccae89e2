// 3MF: a zip archive with meshes as XML. three's loader reads that with the XML parser of a page, which workers lack; here the few tags
// that matter are read by themselves.
import { unzipSync } from 'three/examples/jsm/libs/fflate.module.js';
import type { MeshArrays } from '../model/gallery';

/** Twelve numbers: the rows that x, y, z and 1 are multiplied by. */
type Transform = readonly number[];

interface Placed {
  /** The file that has it, within the archive. */
  path: string;
  object: string;
  transform: Transform;
}

interface MeshObject {
  positions: number[];
  triangles: number[];
  components: Placed[];
}

/** What one file of the archive describes. */
interface Model {
  objects: Map<string, MeshObject>;
  items: Placed[];
}

type Attributes = (name: string) => string | undefined;

const identity: Transform = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
/** Components within components. */
const deepest = 32;
/** Of triangles: beyond it, files that repeat their parts would fill memory. */
const mostTriangles = 2e7;

export function read3mf(bytes: ArrayBuffer): MeshArrays {
  const files = unpacked(bytes);
  const main = mainPath(files);
  const models = new Map<string, Model>();
  const modelAt = (path: string): Model => {
    const model = models.get(path) ?? readModel(textOf(files, path), path);
    models.set(path, model);
    return model;
  };
  const positions: number[] = [];
  const triangles: number[] = [];
  const place = ({ path, object, transform }: Placed, depth: number) => {
    const found = modelAt(path).objects.get(object);
    if (!found) throw damaged(`object ${object} is placed, but ${path} doesn't have it`);
    if (depth > deepest) throw damaged(`object ${object} is made of itself, or of parts within parts without end`);
    if (triangles.length + found.triangles.length > 3 * mostTriangles) throw new Error('It has too many triangles for this page.');
    append(positions, triangles, found, transform);
    for (const part of found.components) place({ ...part, transform: product(part.transform, transform) }, depth + 1);
  };
  const { items } = modelAt(main);
  if (items.length === 0) throw new Error('It says nothing about what to build of it: no object is placed.');
  for (const item of items) place(item, 0);
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

function damaged(why: string): Error {
  return new Error(`It is damaged: ${why}.`);
}

function unpacked(bytes: ArrayBuffer): Record<string, Uint8Array> {
  try {
    return unzipSync(new Uint8Array(bytes), { filter: ({ name }) => /\.(model|rels)$/i.test(name) });
  } catch {
    throw damaged('a 3MF file is a zip archive, and this one ends too early or is none');
  }
}

function textOf(files: Record<string, Uint8Array>, path: string): string {
  const file = files[path];
  if (!file) throw damaged(`it has no file ${path}`);
  return new TextDecoder().decode(file);
}

/** Where the relations of the archive say that its model is. */
function mainPath(files: Record<string, Uint8Array>): string {
  const relations = '_rels/.rels';
  let path = '';
  if (files[relations]) {
    readTags(textOf(files, relations), (name, attribute) => {
      if (name === 'Relationship' && attribute('Type')?.endsWith('/3dmodel')) path ||= pathIn(attribute('Target'), '');
    });
  }
  path ||= Object.keys(files).find((name) => /\.model$/i.test(name)) ?? '';
  if (path === '') throw new Error('There is no 3D model in this archive.');
  return path;
}

/** Paths in an archive begin with a slash, the names of its files don't. */
function pathIn(path: string | undefined, fallback: string): string {
  return path ? path.replace(/^\//, '') : fallback;
}

function readModel(text: string, path: string): Model {
  const model: Model = { objects: new Map(), items: [] };
  let object: MeshObject = { positions: [], triangles: [], components: [] };
  let id = '';
  const placed = (attribute: Attributes): Placed => ({
    path: pathIn(attribute('path'), path),
    object: attribute('objectid') ?? '',
    transform: transformOf(attribute('transform')),
  });
  const readers: Record<string, (attribute: Attributes) => void> = {
    object: (attribute) => {
      id = attribute('id') ?? '';
      object = { positions: [], triangles: [], components: [] };
      model.objects.set(id, object);
    },
    vertex: (attribute) => {
      for (const axis of ['x', 'y', 'z'])
        object.positions.push(numberOf(attribute(axis), `${axis} of vertex ${object.positions.length / 3} of object ${id}`));
    },
    triangle: (attribute) => {
      for (const corner of ['v1', 'v2', 'v3']) object.triangles.push(Number(attribute(corner)));
    },
    component: (attribute) => object.components.push(placed(attribute)),
    item: (attribute) => model.items.push(placed(attribute)),
  };
  readTags(text, (name, attribute) => {
    if (Object.hasOwn(readers, name)) readers[name](attribute);
  });
  for (const [name, { positions, triangles }] of model.objects) checkTriangles(name, positions.length / 3, triangles);
  return model;
}

function numberOf(text: string | undefined, what: string): number {
  const value = text?.trim() ? Number(text) : NaN;
  if (!Number.isFinite(value)) throw damaged(`${what} is ${text === undefined ? 'missing' : `"${text}"`} instead of a number`);
  return value;
}

function checkTriangles(object: string, count: number, triangles: readonly number[]): void {
  const wrong = triangles.findIndex((vertex) => !(Number.isInteger(vertex) && vertex >= 0 && vertex < count));
  if (wrong < 0) return;
  throw damaged(`triangle ${Math.floor(wrong / 3)} of object ${object} has vertex ${triangles[wrong]}, but there are ${count}, from 0 on`);
}

function transformOf(text: string | undefined): Transform {
  if (text === undefined) return identity;
  const numbers = text.trim().split(/\s+/).map(Number);
  if (numbers.length !== 12 || !numbers.every(Number.isFinite)) throw damaged(`"${text}" is no transform`);
  return numbers;
}

/** One transform after another. */
function product(first: Transform, second: Transform): Transform {
  return first.map((_, at) => {
    const [row, column] = [at - (at % 3), at % 3];
    const sum = first[row] * second[column] + first[row + 1] * second[3 + column] + first[row + 2] * second[6 + column];
    return row === 9 ? sum + second[9 + column] : sum;
  });
}

/** Where a transform mirrors, triangles are turned around, so that they face outwards as before. */
function append(positions: number[], triangles: number[], { positions: points, triangles: corners }: MeshObject, m: Transform): void {
  const first = positions.length / 3;
  for (let at = 0; at < points.length; at += 3) {
    const [x, y, z] = [points[at], points[at + 1], points[at + 2]];
    for (let d = 0; d < 3; d++) positions.push(x * m[d] + y * m[3 + d] + z * m[6 + d] + m[9 + d]);
  }
  const isMirrored = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]) < 0;
  const [second, third] = isMirrored ? [2, 1] : [1, 2];
  for (let at = 0; at < corners.length; at += 3) {
    triangles.push(first + corners[at], first + corners[at + second], first + corners[at + third]);
  }
}

const tags = /<(?:[\w.-]+:)?([\w.-]+)((?:\s+[\w:.-]+\s*=\s*(?:"[^"]*"|'[^']*'))*)\s*\/?>/g;

/** Calls back for every tag that begins something, names and attributes without their prefixes. */
function readTags(text: string, read: (name: string, attribute: Attributes) => void): void {
  const searches = new Map<string, RegExp>();
  const searchFor = (name: string) => {
    const search = searches.get(name) ?? new RegExp(`[\\s:]${name}\\s*=\\s*(?:"([^"]*)"|'([^']*)')`);
    searches.set(name, search);
    return search;
  };
  for (const [, name, attributes] of text.replaceAll(/<!--.*?-->/gs, '').matchAll(tags)) {
    read(name, (wanted) => {
      const found = searchFor(wanted).exec(attributes);
      return found?.[1] ?? found?.[2];
    });
  }
}
