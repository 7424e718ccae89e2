// What is wrong with a glTF or GLB file, in words, before three's loader stumbles over it. Only what leads to triangles is looked at.
import { damaged } from './damaged';

interface Buffer {
  byteLength: number;
  uri?: string;
}
interface BufferView {
  buffer: number;
  byteOffset?: number;
  byteLength: number;
  byteStride?: number;
}
interface Accessor {
  bufferView?: number;
  byteOffset?: number;
  componentType: number;
  count: number;
  type: string;
  min?: number[];
  max?: number[];
}
interface Primitive {
  attributes: Record<string, number>;
  indices?: number;
}
export interface Gltf {
  asset: { version: string };
  scene?: number;
  scenes?: { nodes?: number[] }[];
  nodes?: { mesh?: number; children?: number[] }[];
  meshes?: { primitives: Primitive[] }[];
  accessors?: Accessor[];
  bufferViews?: BufferView[];
  buffers?: Buffer[];
  extensionsRequired?: string[];
  extensionsUsed?: string[];
}

/** What the file describes, and the bytes of its first buffer if they are in a binary chunk. */
export interface Checked {
  json: Gltf;
  binary: ArrayBuffer | null;
}

const lists = ['scenes', 'nodes', 'meshes', 'accessors', 'bufferViews', 'buffers'] as const;
const words = { scenes: 'scene', nodes: 'node', meshes: 'mesh', accessors: 'accessor', bufferViews: 'buffer view', buffers: 'buffer' };
const componentBytes: Record<number, number> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };
const components: Record<string, number> = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT2: 4, MAT3: 9, MAT4: 16 };
const compressions: Record<string, string> = {
  KHR_draco_mesh_compression: 'Draco',
  EXT_meshopt_compression: 'meshopt',
  KHR_meshopt_compression: 'meshopt',
};

/** Throws an error that says what is wrong, if anything is. */
export function checkedGltf(bytes: ArrayBuffer): Checked {
  const { text, binary } = textOf(bytes.slice(0, 4)) === 'glTF' ? chunksOf(bytes) : { text: textOf(bytes), binary: null };
  const json = parsed(text);
  checkVersion(json);
  checkCompression(json);
  checkLists(json);
  json.buffers?.forEach((buffer, id) => checkBuffer(buffer, id, binary));
  json.bufferViews?.forEach((_, id) => checkBufferView(json, id));
  json.meshes?.forEach((_, id) => checkMesh(json, id));
  checkScene(json);
  return { json, binary };
}

function textOf(bytes: ArrayBuffer): string {
  return new TextDecoder().decode(bytes);
}

/** The JSON of a GLB file, and the binary chunk behind it. */
function chunksOf(bytes: ArrayBuffer): { text: string; binary: ArrayBuffer } {
  const size = bytes.byteLength;
  const view = new DataView(bytes);
  const promised = size < 12 ? 12 : view.getUint32(8, true);
  if (size >= 8 && view.getUint32(4, true) !== 2)
    throw new Error(`It is GLB of version ${view.getUint32(4, true)}; only version 2 is read.`);
  if (promised > size) throw new Error(`It is cut off: of ${promised} bytes ${size} are there.`);
  const length = size < 20 ? 0 : view.getUint32(12, true);
  if (size < 20 || textOf(bytes.slice(16, 20)) !== 'JSON' || 20 + length > promised)
    throw new Error('It is damaged: byte 12 begins no JSON.');
  const next = 20 + length;
  const end = next + 8 <= promised ? next + 8 + view.getUint32(next, true) : next;
  return { text: textOf(bytes.slice(20, next)), binary: bytes.slice(next + 8, Math.min(end, promised)) };
}

function parsed(text: string): Gltf {
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch {
    throw new Error('It is damaged or cut off: its JSON makes no sense.');
  }
  if (!isObject(json) || !isObject(json.asset) || !json.asset.version)
    throw new Error('It is JSON, but no glTF, which would name its version in "asset".');
  return json as unknown as Gltf;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function checkVersion({ asset: { version } }: Gltf): void {
  if (!/^2(\.|$)/.test(String(version))) throw new Error(`It is glTF of version ${version}; only version 2 is read. Save it as glTF 2.0.`);
}

/** Draco replaces the data; meshopt may come beside data that are not compressed, unless it is required. */
function checkCompression({ extensionsRequired = [], extensionsUsed = [] }: Gltf): void {
  const named = [...extensionsRequired, ...extensionsUsed.filter((extension) => compressions[extension] === 'Draco')];
  for (const extension of named) {
    const compression = compressions[extension];
    if (compression) throw new Error(`It is compressed with ${compression}, which is not read. Save it without compression.`);
  }
}

function checkLists(gltf: Gltf): void {
  for (const key of lists) {
    const list: unknown = gltf[key] ?? [];
    if (!Array.isArray(list) || !list.every(isObject)) throw damaged(`"${key}" is no list of objects`);
  }
}

/** The item that something refers to by its number. */
function itemOf<K extends (typeof lists)[number]>(gltf: Gltf, key: K, id: unknown, from: string): NonNullable<Gltf[K]>[number] {
  const list = gltf[key] ?? [];
  const item = typeof id === 'number' ? list[id] : undefined;
  if (id === undefined) throw damaged(`${from} names no ${words[key]}`);
  if (item === undefined) throw damaged(`${from} refers to ${words[key]} ${id}, but there are ${list.length}, from 0 on`);
  return item as NonNullable<Gltf[K]>[number];
}

function checkBuffer({ byteLength, uri }: Buffer, id: number, binary: ArrayBuffer | null): void {
  if (!(byteLength >= 0)) throw damaged(`buffer ${id} has no length`);
  if (typeof uri === 'string') {
    if (uri.startsWith('data:')) return;
    throw new Error(`It needs another file, "${uri}". Save the model as one file (GLB, or glTF with embedded buffers).`);
  }
  if (id > 0 || !binary) throw damaged(`buffer ${id} has no data`);
  const found = binary.byteLength;
  if (!(byteLength <= found)) throw damaged(`buffer ${id} should have ${byteLength} bytes, but only ${found} are there`);
}

function checkBufferView(gltf: Gltf, id: number): void {
  const { buffer, byteOffset = 0, byteLength } = itemOf(gltf, 'bufferViews', id, '');
  if (!(byteLength >= 0)) throw damaged(`buffer view ${id} has no length`);
  const { byteLength: most } = itemOf(gltf, 'buffers', buffer, `buffer view ${id}`);
  if (!(byteOffset >= 0 && byteOffset + byteLength <= most)) throw damaged(`buffer view ${id} goes beyond the ${most} bytes of its buffer`);
}

function checkMesh(gltf: Gltf, id: number): void {
  const { primitives } = itemOf(gltf, 'meshes', id, '');
  if (!Array.isArray(primitives)) throw damaged(`mesh ${id} has no list of primitives`);
  for (const primitive of primitives) {
    if (!isObject(primitive) || !isObject(primitive.attributes)) throw damaged(`mesh ${id} has a primitive without attributes`);
    const { attributes, indices } = primitive;
    for (const accessor of Object.values(attributes)) checkAccessor(gltf, accessor, id);
    if (indices !== undefined) checkAccessor(gltf, indices, id);
    giveBounds(gltf, attributes.POSITION);
  }
}

function checkAccessor(gltf: Gltf, id: unknown, mesh: number): void {
  const { bufferView, byteOffset = 0, componentType, count, type } = itemOf(gltf, 'accessors', id, `mesh ${mesh}`);
  const item = componentBytes[componentType] * components[type];
  if (!(item > 0)) throw damaged(`accessor ${id} has no type that glTF knows`);
  if (!Number.isInteger(count) || count < 0) throw damaged(`accessor ${id} has no count`);
  if (bufferView === undefined || count === 0) return;
  const { byteLength, byteStride = item } = itemOf(gltf, 'bufferViews', bufferView, `accessor ${id}`);
  if (!(byteOffset >= 0 && byteOffset + byteStride * (count - 1) + item <= byteLength)) {
    throw damaged(`accessor ${id} needs ${count} items, but its buffer view ${bufferView} has only ${byteLength} bytes`);
  }
}

/** Those of positions are required, and three's loader warns where they are missing. Nothing uses them here. */
function giveBounds({ accessors = [] }: Gltf, id: number | undefined): void {
  if (id === undefined) return;
  accessors[id].min ??= [0, 0, 0];
  accessors[id].max ??= [0, 0, 0];
}

function checkScene(gltf: Gltf): void {
  gltf.nodes?.forEach(({ mesh, children = [] }, id) => {
    if (mesh !== undefined) itemOf(gltf, 'meshes', mesh, `node ${id}`);
    if (!Array.isArray(children)) throw damaged(`the children of node ${id} are no list`);
    for (const child of children) itemOf(gltf, 'nodes', child, `node ${id}`);
  });
  checkTree(gltf);
  if (!gltf.scenes?.length) throw new Error('It has no scene, which would say where its meshes are.');
  const scene = gltf.scene ?? 0;
  const { nodes = [] } = itemOf(gltf, 'scenes', scene, '"scene"');
  if (!Array.isArray(nodes)) throw damaged(`the nodes of scene ${scene} are no list`);
  for (const node of nodes) itemOf(gltf, 'nodes', node, `scene ${scene}`);
}

/** Throws if a node contains itself. */
function checkTree({ nodes = [] }: Gltf): void {
  const parents = new Int32Array(nodes.length).fill(-1);
  nodes.forEach(({ children = [] }, id) => children.forEach((child) => (parents[child] = id)));
  const seenFrom = new Int32Array(nodes.length).fill(-1);
  nodes.forEach((_, id) => {
    let up = id;
    for (; up >= 0 && seenFrom[up] < 0; up = parents[up]) seenFrom[up] = id;
    if (up >= 0 && seenFrom[up] === id) throw damaged(`node ${up} contains itself`);
  });
}
