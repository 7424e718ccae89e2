// Emscripten's code, which build.mjs puts beside the sources.
declare module '*/mandoline.js' {
  const createModule: (options: object) => any;
  export default createModule;
}
declare module '*/module.js' {
  const createModule: (options: object) => any;
  export default createModule;
}
