import { readCutMesh, readMesh } from './arguments.js';
import { Host } from './host.js';
import createModule from './mandoline.js';
import { cutMeshes } from './cut-meshes.js';

/** The host of what the package's main entry calls. Its results are cut-meshes, and meshes that prepare() gave, with its options. */
export class CutHost extends Host {
  constructor(module) {
    super(createModule, module);
  }

  input({ kind, isChecked = true }, value, progress) {
    this.expectKind(kind, value);
    const isKept = this.isResult(value);
    if (kind === 'prepared') {
      const { intersections } = this.originOf(value);
      const again = (bindings, mesh) => bindings.prepare(mesh, { intersections, progress });
      return { value, read: () => readMesh(value), make: again, isKept };
    }
    const make = (bindings, arrays) => bindings.keep(arrays, isChecked); // those that are to be validated may be damaged
    return { value, read: () => readCutMesh(value), make, isKept: isChecked && isKept };
  }

  adopt(result, origin) {
    super.adopt(result, origin);
    if (origin.kind === 'cutMesh') cutMeshes.add(result);
  }
}
