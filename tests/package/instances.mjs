// Instances of WebAssembly are private to the package, so they are caught where they are made; and what they import can be made to fail.
// To be imported before the package.
export const memories = [];

let failure;

/** The next import that an instance calls throws this. */
export function failNext(error) {
  failure = error;
}

export const memorySize = () => memories.at(-1).buffer.byteLength;

const { Instance } = WebAssembly;

const sabotaged =
  (imported) =>
  (...values) => {
    if (!failure) return imported(...values);
    const error = failure;
    failure = undefined;
    throw error;
  };

// biome-ignore lint/complexity/useArrowFunction: called with new
WebAssembly.Instance = function (module, imports) {
  const mapped = (object, f) => Object.fromEntries(Object.entries(object).map(([key, value]) => [key, f(value)]));
  const instance = new Instance(
    module,
    mapped(imports, (all) => mapped(all, sabotaged)),
  );
  memories.push(Object.values(instance.exports).find((value) => value instanceof WebAssembly.Memory));
  return instance;
};
