// bricks.wasm, which lies beside this script and is loaded when it is first needed.

/**
 * As ownWasm.
 *
 * @type {{ source: () => any }}
 */
export const ownBrickWasm = { source: () => new URL('./bricks.wasm', import.meta.url) };
