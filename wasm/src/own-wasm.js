// mandoline.wasm, which lies beside this script and is loaded at run time.

/**
 * Gives the address of the WebAssembly or what else init() takes, or a promise of it.
 *
 * @type {{ source: () => any }}
 */
export const ownWasm = { source: () => new URL('./mandoline.wasm', import.meta.url) };
