/** The distinct ArrayBuffers in a value, most of them under typed arrays, to be transferred. */
export function buffersOf(value) {
  const buffers = new Set();
  const seen = new Set();
  const visit = (part) => {
    if (typeof part !== 'object' || part === null || seen.has(part)) return;
    seen.add(part);
    const buffer = ArrayBuffer.isView(part) ? part.buffer : part;
    if (buffer instanceof ArrayBuffer) buffers.add(buffer);
    else if (!ArrayBuffer.isView(part)) Object.values(part).forEach(visit);
  };
  visit(value);
  return [...buffers];
}
