// Mesh files: their bytes, unpacked. C++ reads them.
import { MandolineError } from './errors.js';
import { bad, kindOf, optional } from './arguments.js';

const mostBytes = 2 ** 31; // the mesh has to fit into the 4 GB of WebAssembly, too

export const readName = optional((value, name) => {
  if (typeof value !== 'string') throw bad(`${name} must be a string.`);
  return value;
});

/** @param {Blob | ArrayBuffer | Uint8Array} source */
async function bytesOf(source) {
  if (typeof Blob === 'function' && source instanceof Blob) return new Uint8Array(await source.arrayBuffer());
  try {
    if (source instanceof ArrayBuffer) return new Uint8Array(source);
    if (ArrayBuffer.isView(source)) {
      source.at?.(0); // throws where the next line would see an empty array
      return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
    }
  } catch {
    throw bad('The bytes are detached or out of bounds: their buffer was transferred elsewhere or shrunk.');
  }
  const how = 'a file as a Blob, or its bytes: await (await fetch(address)).arrayBuffer() or, in Node, await readFile(path)';
  throw bad(`The first argument must be ${how}, not ${kindOf(source)}.`);
}

const isGzipped = (bytes) => bytes[0] === 0x1f && bytes[1] === 0x8b;

/** Small files may unpack to endless ones, so there is an end. */
async function gunzip(packed, name) {
  const chunks = [];
  let size = 0;
  try {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
    for (const reader = stream.getReader(); ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      chunks.push(value);
      size += value.length;
      if (size > mostBytes) throw new Error('more than 2 GB are packed in it');
    }
  } catch (cause) {
    const message = `${name}: damaged gzip data, of which ${size} bytes could be unpacked (${cause?.message || cause}).`;
    throw new MandolineError('badFile', message, { cause });
  }
  return joined(chunks, size);
}

function joined(chunks, size) {
  const whole = new Uint8Array(size);
  let end = 0;
  for (const chunk of chunks) {
    whole.set(chunk, end);
    end += chunk.length;
  }
  return whole;
}

/** The unpacked bytes of a file and the name that messages call it by. */
export async function readFile(source, { name = readName(source?.name, 'options.name') ?? 'the file' }) {
  const bytes = await bytesOf(source);
  return { name, bytes: isGzipped(bytes) ? await gunzip(bytes, name) : bytes };
}
