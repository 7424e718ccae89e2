// STL, text or binary. three's loader takes what it finds, so sizes and lines are checked here first.
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';
import { Mesh } from 'three';
import type { MeshArrays } from '../../model/gallery/mesh';
import { Flaw, quoted } from './flaw';
import { sceneTriangles } from './scene';
import { coordinates, decodeText, linesOf } from './text';

const headerBytes = 84;
const triangleBytes = 50;

/** What the triangle count of a binary file promises. */
function promisedBytes(bytes: Uint8Array): number {
  return headerBytes + triangleBytes * new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
}

/** Whether the size fits a binary file to the byte. */
export function isBinaryStl(bytes: Uint8Array): boolean {
  return bytes.length >= headerBytes && bytes.length === promisedBytes(bytes);
}

function isText(bytes: Uint8Array): boolean {
  return !isBinaryStl(bytes) && /^\s*solid/i.test(new TextDecoder().decode(bytes.subarray(0, 100))) && !bytes.subarray(0, 1000).includes(0);
}

function checkBinary(bytes: Uint8Array): void {
  if (bytes.length < headerBytes) {
    throw new Flaw(`A binary STL file starts with a header of ${headerBytes} bytes; this file has ${bytes.length}.`);
  }
  const promised = promisedBytes(bytes);
  const triangles = (promised - headerBytes) / triangleBytes;
  if (bytes.length < promised) {
    const promise = `${triangles} triangles, which take ${promised} bytes`;
    throw new Flaw(`Byte 80: the header promises ${promise}, but the file ends after ${bytes.length}.`);
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  for (let t = 0; t < triangles; ++t) {
    const corners = headerBytes + triangleBytes * t + 12;
    for (let at = corners; at < corners + 36; at += 4) {
      if (!Number.isFinite(view.getFloat32(at, true))) {
        throw new Flaw(`Byte ${at}: triangle ${t} has a coordinate that is not a finite number.`);
      }
    }
  }
}

function checkText(text: string): void {
  let facet = 0;
  let corners = 0;
  let open = false;
  let last = 0;
  for (const { text: line, number } of linesOf(text)) {
    if (line) last = number;
    const words = line.split(/\s+/);
    if (words[0] === 'facet') [facet, corners] = [number, 0];
    else if (words[0] === 'vertex') {
      if (!facet) throw new Flaw(`Line ${number}: a vertex outside of a facet.`);
      coordinates(words.slice(1), number);
      ++corners;
    } else if (words[0] === 'endfacet') {
      if (corners !== 3) throw new Flaw(`Line ${facet}: a facet needs three vertices, and this one has ${corners}.`);
      facet = 0;
    } else if (words[0] === 'solid') open = true;
    else if (words[0] === 'endsolid') open = false;
    else if (line && words[0] !== 'outer' && words[0] !== 'endloop') {
      throw new Flaw(`Line ${number}: ${quoted(line)} does not belong into an STL file.`);
    }
  }
  if (facet || open) throw new Flaw(`Line ${last}: the file ends before its "${facet ? 'endfacet' : 'endsolid'}".`);
}

function read(source: ArrayBuffer | string): MeshArrays {
  return sceneTriangles(new Mesh(new STLLoader().parse(source)));
}

export function parseStl(bytes: Uint8Array): MeshArrays {
  if (isText(bytes)) {
    const text = decodeText(bytes).toLowerCase();
    checkText(text);
    return read(text);
  }
  checkBinary(bytes);
  return read(bytes.slice().buffer);
}
