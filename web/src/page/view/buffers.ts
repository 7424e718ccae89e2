// Buffers on the GPU that outlive the models: they are filled anew, and made anew only where they are too small or much too large.
import { BufferAttribute, DataTexture, DynamicDrawUsage, BufferGeometry, FloatType, type TypedArray } from 'three';

/** Room that is made where something has grown, since it may well grow again. */
const growth = 1.5;
/** Room that is given back is this much too large. */
const excess = 4;

/** An attribute's values: so many per vertex; `normalized` integers stand for 0 to 1, or -1 to 1. */
export interface Values {
  array: TypedArray;
  size: number;
  normalized?: boolean;
}

/** To be filled later. Shaders depend on which of these attributes there are. */
export function emptyGeometry(...names: 'normal'[]): BufferGeometry {
  const geometry = new BufferGeometry();
  for (const name of ['position', ...names]) geometry.setAttribute(name, new BufferAttribute(new Float32Array(0), 3));
  return geometry;
}

/** Gives a geometry these vertices, and draws all of them. Arrays that it may keep are written over by later ones: others are copied. */
export function refill(geometry: BufferGeometry, attributes: Record<string, Values>, index?: Uint32Array, mayKeep = false): void {
  const entries = Object.entries(attributes);
  const fits = entries.every(([name, { array }]) => hasRoom(geometry.attributes[name] as BufferAttribute | undefined, array));
  if (!fits || (index && !hasRoom(geometry.index, index))) {
    geometry.dispose();
    for (const [name, values] of entries) {
      geometry.setAttribute(name, withRoom(geometry.attributes[name] as BufferAttribute | undefined, values, mayKeep));
    }
    if (index) geometry.setIndex(withRoom(geometry.index, { array: index, size: 1 }, mayKeep));
  }
  for (const [name, { array }] of entries) overwrite(geometry.attributes[name] as BufferAttribute, array);
  if (index && geometry.index) overwrite(geometry.index, index);
  geometry.setDrawRange(0, index ? index.length : entries[0][1].array.length / entries[0][1].size);
}

function hasRoom(attribute: BufferAttribute | null | undefined, { length }: TypedArray): boolean {
  if (!attribute) return false;
  const room = attribute.array.length;
  return length <= room && room <= Math.max(excess * length, 1024);
}

function withRoom(former: BufferAttribute | null | undefined, values: Values, mayKeep: boolean): BufferAttribute {
  const { array, size, normalized = false } = values;
  const hasGrown = former && former.array.length > 0 && former.array.length < array.length;
  const length = hasGrown ? size * Math.ceil((growth * array.length) / size) : array.length;
  const room = mayKeep && !hasGrown ? array : new (array.constructor as Float32ArrayConstructor)(length);
  return new BufferAttribute(room, size, normalized).setUsage(DynamicDrawUsage);
}

function overwrite(attribute: BufferAttribute, array: TypedArray): void {
  if (attribute.array !== array) attribute.array.set(array);
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, array.length);
  attribute.needsUpdate = true;
}

/** Texels per row of the textures that are looked up by id. */
export const tableWidth = 1024;

/** RGBA per id, looked up in shaders by `texelFetch(table, place(id), 0)`. The data is padded to whole rows. */
export class Table<T extends Uint8Array | Float32Array> {
  texture: DataTexture;
  data: T;

  constructor(private readonly create: (length: number) => T) {
    this.data = create(4 * tableWidth);
    this.texture = this.makeTexture();
  }

  /** Makes room for so many ids. What is written to the data after this is drawn. */
  resize(count: number): void {
    const rows = Math.max(1, Math.ceil(count / tableWidth));
    const room = this.texture.image.height;
    if (rows > room || room > excess * rows) {
      this.texture.dispose();
      this.data = this.create(4 * tableWidth * (rows > room && room > 1 ? Math.ceil(growth * rows) : rows));
      this.texture = this.makeTexture();
    }
    this.texture.needsUpdate = true;
  }

  private makeTexture(): DataTexture {
    const texture = new DataTexture(this.data as Uint8Array<ArrayBuffer>, tableWidth, this.data.length / (4 * tableWidth));
    if (this.data instanceof Float32Array) texture.type = FloatType;
    return texture;
  }
}
