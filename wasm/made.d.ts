// Emscripten's code, which build.mjs puts beside the sources.
declare module '*/mandoline.js' {
  const createModule: (options: object) => any;
  export default createModule;
}
declare module '*/files.js' {
  const createModule: (options: object) => any;
  export default createModule;
}
declare module '*/bricks.js' {
  const createModule: (options: object) => any;
  export default createModule;
}
declare module '*/physics.js' {
  const createModule: (options: object) => any;
  export default createModule;
}
