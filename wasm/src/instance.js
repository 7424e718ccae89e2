/** A new instance of a compiled module, which its own code makes, with a memory of its own. Throws if there is not enough memory. */
export function instantiate(createModule, module) {
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
