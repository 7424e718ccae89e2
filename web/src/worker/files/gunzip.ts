import { Flaw } from './flaw';

const mostBytes = 2 ** 30;

export function isGzipped(bytes: Uint8Array): boolean {
  return bytes[0] === 0x1f && bytes[1] === 0x8b;
}

/** Small files may unpack to endless ones, so there is an end. */
export async function gunzip(bytes: ArrayBuffer): Promise<Uint8Array> {
  const chunks: Uint8Array[] = [];
  let size = 0;
  try {
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip')).getReader();
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      chunks.push(part.value);
      size += part.value.length;
      if (size > mostBytes) {
        await reader.cancel();
        break;
      }
    }
  } catch {
    throw new Flaw(`Byte ${bytes.byteLength}: the gzipped data are damaged or cut off (${size} bytes could be unpacked).`);
  }
  if (size > mostBytes) throw new Flaw('It unpacks to more than a gigabyte.');
  const whole = new Uint8Array(size);
  let at = 0;
  for (const chunk of chunks) {
    whole.set(chunk, at);
    at += chunk.length;
  }
  return whole;
}
