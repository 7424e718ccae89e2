/** What went wrong in a call: `code` says what kind of failure, `stage` where, `element` and `element2` which elements. */
export class MandolineError extends Error {
  /**
   * @param {string} code
   * @param {string} message
   * @param {{ stage?: string, element?: number, element2?: number, cause?: unknown }} [details]
   */
  constructor(code, message, { stage = '', element = -1, element2 = -1, cause } = {}) {
    super(message, cause === undefined ? undefined : { cause });
    this.name = 'MandolineError';
    this.code = code;
    this.stage = stage;
    this.element = element;
    this.element2 = element2;
  }
}

/** Makes the errors of f, which may be asynchronous, name the call, unless they name the stage of a cut. */
export function named(stage, f) {
  const rethrow = (error) => {
    if (error instanceof MandolineError && !error.stage) error.stage = stage;
    throw error;
  };
  return (...parameters) => {
    try {
      const value = f(...parameters);
      return value instanceof Promise ? value.catch(rethrow) : value;
    } catch (error) {
      return rethrow(error);
    }
  };
}

const advice = {
  cancelled: 'Nothing is wrong: it was stopped on request.',
  emptyMesh: 'The mesh needs at least one triangle: check that the file was read as a surface, not as points or lines.',
  badArrays: 'Positions and triangles need three numbers per item. Check that polygons were split into triangles.',
  badIndex: 'Vertices count from 0; many file formats count from 1.',
  nonFiniteCoordinate: 'Repair or leave out that vertex and its triangles.',
  badGrid: 'The grid needs at least one cell along each axis, and finite planes in ascending order.',
  gridTooLarge: 'Use fewer cells: at most 2^24 along an axis and 2^28 rows of cells.',
  badOption: 'Choose a value in the range that the message names.',
  selfIntersection: 'Cut with intersections: "resolve", as by default, or repair the mesh.',
  meshTooLarge: 'The result would have too many elements. Use fewer cells, or cut the mesh in parts.',
  outOfMemory: 'Use fewer cells, or leave out gridCellRegion. WebAssembly has at most 4 GB; the native program has no such limit.',
  internalError: 'Please report this with the mesh and the grid; the next call works again.',
  badArgument: 'The call was given something that it does not take: compare with its documentation.',
  badFile:
    'Check that the file is an OBJ, STL, PLY or OFF file, and complete. Of other formats, meshFromObject of mandoline-wasm/three takes what ' +
    "three's loaders make.",
  loadFailed:
    "Check that the package's files are served beside the code, or take them from mandoline-wasm/inline, " +
    "and that the page's content security policy allows 'wasm-unsafe-eval'.",
};

/** What went wrong, where, and what to do about it, in a few sentences for people. Takes any value that was caught. */
export function describe(error) {
  // Errors that came from another thread are copies without the class.
  if (!Object.hasOwn(advice, error?.code)) return error instanceof Error ? `${error.name}: ${error.message}` : String(error);
  const { code, message, stage } = error; // the message names the elements
  const where = code === 'internalError' && stage ? `It happened in ${stage}.` : '';
  return [message, where, advice[code]].filter(Boolean).join(' ');
}
