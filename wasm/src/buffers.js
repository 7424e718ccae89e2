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

/** Of what is made where no buffer fits: the next such arrays may be a little longer. */
const room = 1.25;
/** A buffer that is larger than this many times an array is left for others. */
const excess = 4;

/** A function that copies typed arrays, each into the smallest of these buffers that fits and that no other has got. */
export function copierInto(buffers) {
  const free = new Set(buffers);
  return (array) => {
    const size = array.byteLength;
    if (size === 0) return array.slice();
    const fits = ({ byteLength }) => byteLength >= size && byteLength <= Math.max(excess * size, 4096);
    const smallest = [...free].filter(fits).sort((a, b) => a.byteLength - b.byteLength)[0];
    free.delete(smallest);
    const copy = new array.constructor(smallest ?? new ArrayBuffer(8 * Math.ceil((room * size) / 8)), 0, array.length);
    copy.set(array);
    return copy;
  };
}

/** structuredClone(), also in Node's jsdom, which has none. */
export function clone(value, transfer) {
  if (typeof structuredClone === 'function') return structuredClone(value, { transfer });
  const { MessageChannel, receiveMessageOnPort } = globalThis.process.getBuiltinModule('node:worker_threads');
  const { port1, port2 } = new MessageChannel();
  try {
    port1.postMessage(value, transfer);
    return receiveMessageOnPort(port2).message;
  } finally {
    port1.close();
  }
}
