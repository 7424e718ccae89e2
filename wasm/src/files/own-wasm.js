// files.wasm, which lies beside this script and is loaded when it is first needed.

/**
 * As ownWasm.
 *
 * @type {{ source: () => any }}
 */
export const ownFileWasm = { source: () => new URL('./files.wasm', import.meta.url) };
