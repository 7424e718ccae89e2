// Mesh files: OBJ, STL, PLY, OFF, GLB and glTF with embedded buffers, each also gzipped. Runs in the page's worker: no DOM. Nothing is
// welded here: the cutter does that.
import type { MeshArrays } from '../../model/gallery/mesh';
import { FileError, Flaw } from './flaw';
import type { Format } from '../../model/formats';
import { isGlb, parseGltf } from './gltf';
import { gunzip, isGzipped } from './gunzip';
import { parseObj } from './obj';
import { offHeader, parseOff } from './off';
import { parsePly } from './ply';
import { isBinaryStl, parseStl } from './stl';

export { fileExtensions } from '../../model/formats';

const readers: Record<Format, (bytes: Uint8Array) => MeshArrays | Promise<MeshArrays>> = {
  obj: parseObj, stl: parseStl, ply: parsePly, off: parseOff, glb: parseGltf, gltf: parseGltf,
};

function extension(name: string): string {
  const path = name.replace(/[?#].*$/, '').replace(/\.gz$/i, '');
  return /\.(\w+)$/.exec(path)?.[1].toLowerCase() ?? '';
}

function start(bytes: Uint8Array): string {
  return new TextDecoder('latin1').decode(bytes.subarray(0, 1000)).trimStart();
}

/** Formats that say what they are, whatever their name. */
function markedFormat(bytes: Uint8Array): Format | null {
  if (isGlb(bytes)) return 'glb';
  return /^ply[ \t]*[\r\n]/.test(start(bytes)) ? 'ply' : null;
}

function likelyFormat(bytes: Uint8Array): Format | null {
  const text = start(bytes);
  if (text.startsWith('{')) return 'gltf';
  if (offHeader.test(text)) return 'off';
  if (/^solid\b/i.test(text) || isBinaryStl(bytes)) return 'stl';
  return /^v\s+[-+.\d]/m.test(text) ? 'obj' : null;
}

function formatOf(name: string, bytes: Uint8Array): Format {
  const named = extension(name);
  const format = markedFormat(bytes) ?? (named in readers ? (named as Format) : likelyFormat(bytes));
  if (format) return format;
  const text = start(bytes);
  if (text.startsWith('PK\x03\x04')) throw new Flaw('It is a ZIP archive. Unpack it first.');
  if (/^<(!doctype|html)/i.test(text)) throw new Flaw('It is a web page, not a mesh.');
  const kind = named ? `".${named}" is not a kind of file` : 'It is no kind of file';
  throw new Flaw(`${kind} that is read here: OBJ, STL, PLY, OFF, GLB and glTF are.`);
}

async function read(name: string, bytes: ArrayBuffer): Promise<MeshArrays> {
  if (bytes.byteLength === 0) throw new Flaw('The file is empty.');
  const packed = new Uint8Array(bytes);
  const content = isGzipped(packed) ? await gunzip(bytes) : packed;
  if (content.length === 0) throw new Flaw('The file is empty.');
  const mesh = await readers[formatOf(name, content)](content);
  if (mesh.triangles.length === 0) throw new Flaw('There are no triangles in it.');
  return mesh;
}

/** Rejects with a FileError, which is a PageError. */
export async function parseMesh(name: string, bytes: ArrayBuffer): Promise<MeshArrays> {
  try {
    return await read(name, bytes);
  } catch (error) {
    if (error instanceof Flaw) throw new FileError(name, error.message);
    throw new FileError(name, `The loader gave up on it: ${error instanceof Error ? error.message : String(error)}.`);
  }
}
