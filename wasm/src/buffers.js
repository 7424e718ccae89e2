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
