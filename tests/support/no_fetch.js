// Emscripten before 3.1.30 asks fetch() for files, which Node's own does not read.
globalThis.fetch = undefined;
