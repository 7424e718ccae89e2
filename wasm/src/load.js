import { MandolineError } from './errors.js';

/** Throws unless it is WebAssembly: many servers answer unknown addresses with a page of theirs and status 200. */
function expectWasm(bytes, type) {
  const start = new Uint8Array(bytes, 0, Math.min(bytes.byteLength, 4));
  if ([0, 0x61, 0x73, 0x6d].every((byte, i) => start[i] === byte)) return bytes;
  const isPage = start[0] === 0x3c || /html/.test(type);
  throw new Error(`the server answered with ${isPage ? 'HTML' : 'something else'} instead of WebAssembly`);
}

async function readBytes(url) {
  if (url.protocol === 'file:' && globalThis.process?.versions?.node) {
    return globalThis.process.getBuiltinModule('node:fs/promises').readFile(url); // no import, which bundlers for browsers would follow
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`the server answered with ${response.status} ${response.statusText}`.trim());
  return expectWasm(await response.arrayBuffer(), response.headers.get('content-type'));
}

async function bytesOf(source) {
  if (typeof source !== 'string' && !(source instanceof URL)) return source;
  try {
    return await readBytes(new URL(source, globalThis.location?.href));
  } catch (cause) {
    throw failureOf(` ${source}`, cause);
  }
}

function failureOf(name, cause) {
  if (cause instanceof MandolineError) return cause;
  const message = `The WebAssembly module${name} could not be loaded: ${cause?.message ?? cause}.`;
  return new MandolineError('loadFailed', message, { stage: 'init', cause });
}

const mark = 'mandoline-wasm/';

/** The file's name in a module of the package, which has an export that the build named for it; undefined of others. */
function nameIn(module) {
  const marked = WebAssembly.Module.exports(module).find(({ name }) => name.startsWith(mark));
  return marked?.name.slice(mark.length);
}

/**
 * Compiles the module of the file `name`: `source` is where to load it from, its bytes, the compiled module itself, or a function that
 * gives one of these.
 */
export async function compile(source, name) {
  try {
    const given = await (typeof source === 'function' ? source() : source);
    const module = given instanceof WebAssembly.Module ? given : await WebAssembly.compile(await bytesOf(given));
    const found = nameIn(module);
    if (found !== name) throw new Error(`it is ${found ?? 'no module of mandoline-wasm'}, not ${name}`);
    return module;
  } catch (cause) {
    throw failureOf('', cause);
  }
}

/** A function that makes a promise of f() once, and again after a failure. */
export function once(f) {
  let made;
  return (...given) => {
    made ??= f(...given).catch((error) => {
      made = undefined;
      throw error;
    });
    return made;
  };
}
