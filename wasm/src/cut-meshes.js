/** The cut-meshes that cut() gave, of which mandoline-wasm/physics has twins, too. */
export const cutMeshes = new WeakSet();
