// 3MF: a zip archive with meshes as XML. What repeats its parts is small in a file: how large it becomes is known before it is made.
import { unzipSync } from 'three/examples/jsm/libs/fflate.module.js';
import type { MeshArrays } from '../model/gallery';
import { damaged } from './damaged';
import { identity, pathIn, readModel, type MeshObject, type Model, type Placed, type Transform } from './three_mf_model';
import { readTags, xmlText } from './xml';

type Files = Record<string, Uint8Array>;

/** Of an object with all that it is made of. */
interface Size {
  vertices: number;
  triangles: number;
  /** How many objects are placed for it, itself among them. */
  placed: number;
  /** Objects within objects. */
  depth: number;
}

/** Of what is unpacked, in bytes. */
const mostBytes = 4e8;
const most: Size = { vertices: 2e7, triangles: 2e7, placed: 1e6, depth: 32 };
/** In bytes: the least that the directory of a zip archive has for a file. */
const leastEntry = 46;

export function read3mf(bytes: ArrayBuffer): MeshArrays {
  const files = unpacked(bytes);
  const main = mainPath(files);
  const models = new Map<string, Model>();
  const modelAt = (path: string): Model => {
    const model = models.get(path) ?? readModel(textOf(files, path), path);
    models.set(path, model);
    return model;
  };
  const objectOf = ({ path, object }: Placed): MeshObject => {
    const found = modelAt(path).objects.get(object);
    if (!found) throw damaged(`object ${object} is placed, but ${path} doesn't have it`);
    return found;
  };
  const { items } = modelAt(main);
  if (items.length === 0) throw new Error('It says nothing about what to build of it: no object is placed.');
  const all: MeshObject = { positions: [], triangles: [], components: items };
  const { vertices, triangles } = sizeOf(all, objectOf);
  return new Assembly(vertices, triangles, objectOf).place(all, identity);
}

function unpacked(bytes: ArrayBuffer): Files {
  let [size, entries] = [0, 0];
  const filter = (entry: { name: string; size: number; originalSize: number }) => {
    if (++entries * leastEntry > bytes.byteLength) throw new Error('It says that it has more files than there is room for.');
    if (!/\.(model|rels)$/i.test(entry.name)) return false;
    size += Math.max(entry.size, entry.originalSize);
    return size <= mostBytes;
  };
  let files: Files;
  try {
    files = unzipSync(new Uint8Array(bytes), { filter });
  } catch (error) {
    // Too little memory is no fault of the file.
    if (error instanceof RangeError) throw new Error('There is not enough memory to unpack it.');
    throw damaged('a 3MF file is a zip archive, and this one ends too early or is not one');
  }
  if (size > mostBytes) throw new Error('It is too large for this page once it is unpacked.');
  return files;
}

function textOf(files: Files, path: string): string {
  if (!Object.hasOwn(files, path)) throw damaged(`it has no file ${path}`);
  return xmlText(files[path]);
}

/** Where the relations of the archive say that its model is. */
function mainPath(files: Files): string {
  const relations = '_rels/.rels';
  let path = '';
  if (Object.hasOwn(files, relations)) {
    readTags(textOf(files, relations), {
      begin: (name, attribute) => {
        if (name === 'Relationship' && attribute('Type')?.endsWith('/3dmodel')) path ||= pathIn(attribute('Target'), '');
      },
    });
  }
  path ||= Object.keys(files).find((name) => /\.model$/i.test(name)) ?? '';
  if (path === '') throw new Error('There is no 3D model in this archive.');
  return path;
}

/** Looks at every object once, however often it is placed. */
function sizeOf(all: MeshObject, objectOf: (part: Placed) => MeshObject): Size {
  const sizes = new Map<MeshObject, Size>();
  const above = new Set<MeshObject>();
  const measure = (object: MeshObject): Size => {
    const known = sizes.get(object);
    if (known) return known;
    const size = { vertices: object.positions.length / 3, triangles: object.triangles.length / 3, placed: 1, depth: 0 };
    above.add(object);
    for (const part of object.components) {
      const found = objectOf(part);
      if (above.has(found)) throw damaged(`object ${part.object} is made of itself`);
      if (above.size > most.depth) throw tooMuch('parts within parts');
      const { vertices, triangles, placed, depth } = measure(found);
      size.vertices += vertices;
      size.triangles += triangles;
      size.placed += placed;
      size.depth = Math.max(size.depth, depth + 1);
    }
    above.delete(object);
    checkSize(size);
    sizes.set(object, size);
    return size;
  };
  return measure(all);
}

function checkSize({ vertices, triangles, placed, depth }: Size): void {
  if (triangles > most.triangles) throw tooMuch('triangles');
  if (vertices > most.vertices) throw tooMuch('vertices');
  if (placed > most.placed) throw tooMuch('parts');
  if (depth > most.depth) throw tooMuch('parts within parts');
}

function tooMuch(what: string): Error {
  return new Error(`It has too many ${what} for this page.`);
}

/** The mesh, while objects are placed in it. */
class Assembly {
  private readonly positions: Float64Array;
  private readonly triangles: Uint32Array;
  private vertexEnd = 0;
  private cornerEnd = 0;

  constructor(
    vertices: number,
    triangles: number,
    private readonly objectOf: (part: Placed) => MeshObject,
  ) {
    this.positions = new Float64Array(3 * vertices);
    this.triangles = new Uint32Array(3 * triangles);
  }

  place(object: MeshObject, transform: Transform): MeshArrays {
    this.append(object, transform);
    for (const part of object.components) this.place(this.objectOf(part), product(part.transform, transform));
    return { positions: this.positions, triangles: this.triangles };
  }

  /** Where a transform mirrors, triangles are turned around, so that they face outwards as before. */
  private append({ positions, triangles }: MeshObject, m: Transform): void {
    const first = this.vertexEnd;
    for (let at = 0; at < positions.length; at += 3, this.vertexEnd++) {
      const [x, y, z] = [positions[at], positions[at + 1], positions[at + 2]];
      for (let d = 0; d < 3; d++) this.positions[3 * this.vertexEnd + d] = x * m[d] + y * m[3 + d] + z * m[6 + d] + m[9 + d];
    }
    const isMirrored = m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]) < 0;
    const order = isMirrored ? [0, 2, 1] : [0, 1, 2];
    for (let at = 0; at < triangles.length; at += 3) {
      for (const corner of order) this.triangles[this.cornerEnd++] = first + triangles[at + corner];
    }
  }
}

/** One transform after another. */
function product(first: Transform, second: Transform): Transform {
  return first.map((_, at) => {
    const [row, column] = [at - (at % 3), at % 3];
    const sum = first[row] * second[column] + first[row + 1] * second[3 + column] + first[row + 2] * second[6 + column];
    return row === 9 ? sum + second[9 + column] : sum;
  });
}
