import createModule from './mandoline.js';

/** A new instance of the compiled module, with a memory of its own. Throws if there is not enough memory. */
export function instantiate(module) {
  let failure;
  const bindings = createModule({
    instantiateWasm(imports, receive) {
      try {
        const instance = new WebAssembly.Instance(module, imports);
        receive(instance, module);
        return instance.exports;
      } catch (error) {
        failure = error;
        throw error;
      }
    },
    locateFile: (name) => name, // not used
    print() {},
    printErr() {}, // what it says is also thrown
  });
  if (failure) throw failure;
  return bindings;
}
