// glTF and GLB. Of the file only what makes triangles is handed to three's loader: no images, materials or skins are ever loaded.
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import type { MeshArrays } from '../../model/gallery/mesh';
import { Flaw } from './flaw';
import { sceneTriangles } from './scene';
import { decodeText } from './text';

const magic = 0x46546c67;
const jsonChunk = 0x4e4f534a;
const binChunk = 0x004e4942;
const instancing = 'EXT_mesh_gpu_instancing';
const known = new Set([instancing, 'KHR_mesh_quantization']);
const compressions: Record<string, string> = {
  KHR_draco_mesh_compression: 'Draco',
  EXT_meshopt_compression: 'meshopt',
  KHR_meshopt_compression: 'meshopt',
};

/** The parts of a file that matter here. A file may hold anything, so what is used is checked. */
interface Gltf {
  asset?: { version?: string };
  scene?: number;
  scenes?: { nodes?: number[] }[];
  nodes?: { children?: number[]; mesh?: number; extensions?: Record<string, unknown>; [key: string]: unknown }[];
  meshes?: { name?: string; primitives?: { attributes?: { POSITION?: number }; indices?: number; mode?: number }[] }[];
  accessors?: { count?: number; type?: string; componentType?: number }[];
  bufferViews?: { buffer?: number; byteOffset?: number; extensions?: unknown }[];
  buffers?: { uri?: string; byteLength?: number }[];
  extensionsUsed?: string[];
  extensionsRequired?: string[];
}

function unpackGlb(bytes: Uint8Array): { json: Uint8Array; bin: Uint8Array | null } {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20) throw new Flaw(`A GLB file starts with a header of 20 bytes; this file has ${bytes.length}.`);
  const version = view.getUint32(4, true);
  if (version !== 2) throw new Flaw(`Byte 4: this is version ${version} of GLB; version 2 is read.`);
  const length = view.getUint32(8, true);
  if (length > bytes.length) throw new Flaw(`Byte 8: the header promises ${length} bytes, but the file ends after ${bytes.length}.`);
  let json: Uint8Array | null = null;
  let bin: Uint8Array | null = null;
  for (let at = 12; at + 8 <= length; ) {
    const end = at + 8 + view.getUint32(at, true);
    const kind = view.getUint32(at + 4, true);
    if (end > length) throw new Flaw(`Byte ${at}: a chunk goes on to byte ${end}, but the file ends after ${length}.`);
    if (kind === jsonChunk) json ??= bytes.subarray(at + 8, end);
    if (kind === binChunk) bin ??= bytes.subarray(at + 8, end);
    at = end;
  }
  if (!json) throw new Flaw('Byte 12: the first chunk should be the JSON part, and there is none.');
  return { json, bin };
}

function parseJson(bytes: Uint8Array): Gltf {
  const text = decodeText(bytes);
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch (error) {
    throw new Flaw(`Its JSON is damaged: ${(error as Error).message}.`);
  }
  if (typeof json !== 'object' || json === null || !('asset' in json)) throw new Flaw('It is JSON, but not glTF: it has no "asset".');
  return json as Gltf;
}

function bufferBytes(uri: string | undefined, index: number, bin: Uint8Array | null): Uint8Array {
  if (uri === undefined) {
    if (index === 0 && bin) return bin;
    throw new Flaw(`Buffer ${index} has no data.`);
  }
  const data = /^data:[^,]*;base64,/.exec(uri);
  if (!data) {
    const advice = 'Save the model as one file (GLB, or glTF with embedded buffers).';
    throw new Flaw(`Buffer ${index} lies in another file, "${uri.slice(0, 60)}". ${advice}`);
  }
  try {
    return Uint8Array.from(atob(uri.slice(data[0].length)), (c) => c.charCodeAt(0));
  } catch {
    throw new Flaw(`Buffer ${index} is not valid base64.`);
  }
}

/** All buffers one after another, and where each starts. */
function joinBuffers(gltf: Gltf, bin: Uint8Array | null): { data: Uint8Array; starts: number[] } {
  const buffers = (gltf.buffers ?? []).map(({ uri, byteLength = 0 }, index) => {
    const bytes = bufferBytes(uri, index, bin);
    if (bytes.length < byteLength) throw new Flaw(`Buffer ${index} should have ${byteLength} bytes and has only ${bytes.length}.`);
    return bytes;
  });
  const starts: number[] = [];
  let length = 0;
  for (const bytes of buffers) {
    starts.push(length);
    length += Math.ceil(bytes.length / 8) * 8;
  }
  const data = new Uint8Array(length);
  buffers.forEach((bytes, index) => data.set(bytes, starts[index]));
  return { data, starts };
}

/** Roots of the scene to show. A node below itself would make the loader wait for ever. */
function sceneRoots(gltf: Gltf): number[] {
  const nodes = gltf.nodes ?? [];
  const parents = nodes.map(() => 0);
  nodes.forEach((node, k) => node.children?.forEach((child) => {
    if (!(child in nodes)) throw new Flaw(`Node ${k} has a child ${child}, which does not exist.`);
    if (++parents[child] > 1) throw new Flaw(`Node ${child} is below two nodes.`);
  }));
  const roots = gltf.scenes?.[gltf.scene ?? 0]?.nodes ?? nodes.flatMap((_, k) => (parents[k] === 0 ? [k] : []));
  for (const root of roots) {
    if (!(root in nodes)) throw new Flaw(`The scene has a node ${root}, which does not exist.`);
    if (parents[root]) throw new Flaw(`Node ${root} is a root of the scene and below another node, too.`);
  }
  return roots;
}

const componentTypes = [5120, 5121, 5122, 5123, 5125, 5126];

function checkAccessor(gltf: Gltf, index: number | undefined, type: string, mesh: number): void {
  const accessor = gltf.accessors?.[index ?? -1];
  if (!accessor) throw new Flaw(`Mesh ${mesh} is read from accessor ${index}, which does not exist.`);
  if (accessor.type !== type) throw new Flaw(`Mesh ${mesh} is read from accessor ${index}, which should be of type ${type}.`);
}

function check(gltf: Gltf, dataBytes: number): void {
  const version = String(gltf.asset?.version);
  if (!version.startsWith('2')) throw new Flaw(`It is glTF version "${version}"; version 2 is read.`);
  for (const extension of gltf.extensionsRequired ?? []) {
    if (compressions[extension]) {
      throw new Flaw(`It is compressed with ${compressions[extension]}, which is not read. Save it without compression.`);
    }
  }
  gltf.accessors?.forEach(({ count = 0, componentType = 0 }, index) => {
    if (!componentTypes.includes(componentType)) {
      throw new Flaw(`Accessor ${index} has the component type ${componentType}, which does not exist.`);
    }
    if (!(count <= dataBytes)) throw new Flaw(`Accessor ${index} promises ${count} items, but there are only ${dataBytes} bytes of data.`);
  });
  gltf.meshes?.forEach(({ primitives }, mesh) => primitives?.forEach(({ attributes, indices }) => {
    checkAccessor(gltf, attributes?.POSITION, 'VEC3', mesh);
    if (indices !== undefined) checkAccessor(gltf, indices, 'SCALAR', mesh);
  }));
  gltf.nodes?.forEach(({ mesh }, node) => {
    if (mesh !== undefined && !gltf.meshes?.[mesh]) throw new Flaw(`Node ${node} shows mesh ${mesh}, which does not exist.`);
  });
}

/** Nodes, triangles and what they are read from, and nothing else. */
function geometryOnly(gltf: Gltf, starts: readonly number[], dataBytes: number): object {
  const nodes = gltf.nodes?.map(({ children, mesh, matrix, translation, rotation, scale, extensions }) => {
    const instances = extensions?.[instancing];
    return { children, mesh, matrix, translation, rotation, scale, ...(instances ? { extensions: { [instancing]: instances } } : {}) };
  });
  const meshes = gltf.meshes?.map(({ name, primitives }) => ({
    name,
    primitives: primitives?.map(({ attributes, indices, mode }) => ({ attributes: { POSITION: attributes?.POSITION }, indices, mode })),
  }));
  const bufferViews = gltf.bufferViews?.map(({ buffer = 0, byteOffset = 0, extensions: _, ...view }) => ({
    ...view, buffer: 0, byteOffset: (starts[buffer] ?? 0) + byteOffset,
  }));
  return {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: sceneRoots(gltf) }],
    nodes, meshes, bufferViews,
    accessors: gltf.accessors,
    buffers: [{ byteLength: dataBytes }],
    extensionsUsed: gltf.extensionsUsed?.filter((name) => known.has(name)),
  };
}

function packGlb(json: object, data: Uint8Array): ArrayBuffer {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const textBytes = Math.ceil(text.length / 4) * 4;
  const glb = new Uint8Array(28 + textBytes + data.length);
  new Uint32Array(glb.buffer, 0, 5).set([magic, 2, glb.length, textBytes, jsonChunk]);
  glb.fill(0x20, 20, 20 + textBytes);
  glb.set(text, 20);
  new Uint32Array(glb.buffer, 20 + textBytes, 2).set([data.length, binChunk]);
  glb.set(data, 28 + textBytes);
  return glb.buffer;
}

export function isGlb(bytes: Uint8Array): boolean {
  return bytes.length >= 4 && new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true) === magic;
}

export async function parseGltf(bytes: Uint8Array): Promise<MeshArrays> {
  const { json, bin } = isGlb(bytes) ? unpackGlb(bytes) : { json: bytes, bin: null };
  const gltf = parseJson(json);
  const { data, starts } = joinBuffers(gltf, bin);
  check(gltf, data.length);
  const { scene } = await new GLTFLoader().parseAsync(packGlb(geometryOnly(gltf, starts, data.length), data), '');
  return sceneTriangles(scene);
}
