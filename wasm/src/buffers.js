/** The distinct ArrayBuffers under all typed arrays in a value, to be transferred. */
export function buffersOf(value) {
  const buffers = new Set();
  const visit = (part) => {
    if (!ArrayBuffer.isView(part)) return part !== null && typeof part === 'object' && Object.values(part).forEach(visit);
    if (part.buffer instanceof ArrayBuffer) buffers.add(part.buffer);
  };
  visit(value);
  return [...buffers];
}
