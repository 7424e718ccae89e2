// mandoline.wasm, which lies beside this script and is loaded at run time.

/** A file beside this one, in Node; said so that bundlers don't take it for an asset of a page. */
export function fileBeside(name) {
  return new URL(import.meta.url.replace(/[^/]*$/, name));
}

/** Gives the address of the WebAssembly or what else init() takes, or a promise of it. */
export const ownWasm = { source: () => new URL('./mandoline.wasm', import.meta.url) };
