// What one file of a 3MF archive describes. The few tags that matter are read by themselves.
import { damaged } from './damaged';
import { readTags, type Attributes } from './xml';

/** Twelve numbers: the rows that x, y, z and 1 are multiplied by. */
export type Transform = readonly number[];

export interface Placed {
  /** The file that has it, within the archive. */
  path: string;
  object: string;
  transform: Transform;
}

export interface MeshObject {
  positions: number[];
  triangles: number[];
  components: Placed[];
}

export interface Model {
  objects: Map<string, MeshObject>;
  items: Placed[];
}

export const identity: Transform = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];

type Readers = Record<string, (attribute: Attributes) => void>;

/** Lengths stay in the file's own unit, whichever that is. */
export function readModel(text: string, path: string): Model {
  const model: Model = { objects: new Map(), items: [] };
  let object: MeshObject = { positions: [], triangles: [], components: [] };
  let id = '';
  let isInMesh = false;
  const placed = (attribute: Attributes): Placed => ({
    path: pathIn(attribute('path'), path),
    object: attribute('objectid') ?? '',
    transform: transformOf(attribute('transform')),
  });
  const ofModel: Readers = {
    object: (attribute) => {
      id = attribute('id') ?? '';
      object = { positions: [], triangles: [], components: [] };
      model.objects.set(id, object);
    },
    component: (attribute) => object.components.push(placed(attribute)),
    item: (attribute) => model.items.push(placed(attribute)),
  };
  // Stacks of slices have vertices, too, which are flat.
  const ofMesh: Readers = {
    vertex: (attribute) => pushNumbers(object.positions, ['x', 'y', 'z'], attribute, 'vertex', id),
    triangle: (attribute) => pushNumbers(object.triangles, ['v1', 'v2', 'v3'], attribute, 'triangle', id),
  };
  readTags(text, {
    begin: (name, attribute) => {
      isInMesh ||= name === 'mesh';
      const readers = isInMesh ? ofMesh : ofModel;
      if (Object.hasOwn(readers, name)) readers[name](attribute);
    },
    end: (name) => {
      isInMesh &&= name !== 'mesh';
    },
  });
  for (const [name, { positions, triangles }] of model.objects) checkTriangles(name, positions.length / 3, triangles);
  return model;
}

/** Paths in an archive begin with a slash, the names of its files don't. */
export function pathIn(path: string | undefined, fallback: string): string {
  return path ? path.replace(/^\//, '') : fallback;
}

function pushNumbers(list: number[], names: readonly string[], attribute: Attributes, what: string, object: string): void {
  for (const name of names) {
    const text = attribute(name);
    const value = text?.trim() ? Number(text) : NaN;
    if (!Number.isFinite(value)) {
      const found = text === undefined ? 'missing' : `"${text}"`;
      throw damaged(`${name} of ${what} ${Math.floor(list.length / 3)} of object ${object} is ${found} instead of a number`);
    }
    list.push(value);
  }
}

function checkTriangles(object: string, count: number, triangles: readonly number[]): void {
  const wrong = triangles.findIndex((vertex) => !(Number.isInteger(vertex) && vertex >= 0 && vertex < count));
  if (wrong < 0) return;
  throw damaged(`triangle ${Math.floor(wrong / 3)} of object ${object} has vertex ${triangles[wrong]}, but there are ${count}, from 0 on`);
}

function transformOf(text: string | undefined): Transform {
  if (text === undefined) return identity;
  const numbers = text.trim().split(/\s+/).map(Number);
  if (numbers.length !== 12 || !numbers.every(Number.isFinite)) throw damaged(`"${text}" is not a transform`);
  return numbers;
}
