// physics.wasm, which lies beside this script. Apart from mandoline.wasm, so that those who only cut are built without it.

/**
 * Gives the address of the WebAssembly or what else initPhysics() takes, or a promise of it.
 *
 * @type {{ source: () => any }}
 */
export const ownPhysicsWasm = { source: () => new URL('./physics.wasm', import.meta.url) };
