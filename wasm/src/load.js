import { MandolineError } from './errors.js';

async function readBytes(url) {
  if (url.protocol === 'file:' && globalThis.process?.versions?.node) {
    const fileSystem = 'node:fs/promises'; // not a literal, since bundlers for browsers would look for it
    const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ fileSystem);
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`.trim());
  return response.arrayBuffer();
}

/** Compiles the module: `source` is where to load it from, its bytes, or the compiled module itself. */
export async function compile(source = new URL('./mandoline.wasm', import.meta.url)) {
  if (source instanceof WebAssembly.Module) return source;
  let what = 'The WebAssembly module';
  try {
    if (typeof source !== 'string' && !(source instanceof URL)) return await WebAssembly.compile(source);
    what += ` ${source}`;
    return await WebAssembly.compile(await readBytes(new URL(source, globalThis.location?.href)));
  } catch (cause) {
    throw new MandolineError('loadFailed', `${what} could not be loaded: ${cause?.message ?? cause}.`, { stage: 'init', cause });
  }
}
