import { bad, readCutMesh, readMesh } from './arguments.js';
import { Host } from './host.js';
import createModule from './mandoline.js';
import { cutMeshes } from './results.js';

/** The host of what the package's main entry calls. Its results are cut-meshes, and meshes that prepare() gave, with its options. */
export class CutHost extends Host {
  #arrays;

  constructor(module) {
    super(createModule, module);
    this.#arrays = this.start((bindings) => bindings.cutMeshArrays());
  }

  /** run() with a binding that takes a cut-mesh: the twin of this result, or else its arrays, which may have to pass a check. */
  runOn(cutMesh, f, checked = true) {
    if (this.preparationOf(cutMesh)) throw bad('cutMesh must be what cut() gives, not what prepare() does.');
    const input = {
      value: cutMesh,
      read: () => readCutMesh(cutMesh, this.#arrays),
      make: (bindings, arrays) => bindings.keep(arrays, checked),
      isKept: checked && this.isResult(cutMesh),
    };
    return this.runWith([input], (bindings, [twin]) => f(bindings, twin));
  }

  /** The same with a binding that takes a mesh that prepare() gave: its twin, or else what `again` makes, which does it once more. */
  runOnPrepared(mesh, again, f) {
    const input = { value: mesh, read: () => readMesh(mesh), make: again, isKept: true };
    return this.runWith([input], (bindings, [twin], twins) => f(bindings, twin, twins));
  }

  adopt(result, preparation) {
    super.adopt(result, preparation);
    if (!preparation) cutMeshes.add(result);
  }

  /** The options of the prepare() that gave this mesh, if one did. */
  preparationOf(mesh) {
    return this.originOf(mesh);
  }
}
