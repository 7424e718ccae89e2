// The calls of the package, on a module that is compiled already.
import {
  bad, readCutMesh, readElement, readFlag, readFunction, readGrid, readMesh, readOptions, readPlane, readPoints, readSnapTolerance, readVector,
} from './arguments.js';
import { MandolineError, named } from './errors.js';
import { readFile } from './files.js';
import { instantiate } from './instance.js';

/** Keeps an instance of the module, and takes a new one after a failure that may have left it broken or with a memory that never shrinks. */
class Host {
  #module;
  #bindings;

  constructor(module) {
    this.#module = module;
    this.#bindings = instantiate(module);
  }

  /** The value of a binding's call; its error, and whatever the instance dies of, is thrown as a MandolineError. */
  run(f) {
    try {
      this.#bindings ??= instantiate(this.#module);
      const { value, error } = f(this.#bindings);
      if (error) throw new MandolineError(error.code, error.message, error);
      return value;
    } catch (error) {
      if (!(error instanceof MandolineError) || error.code === 'outOfMemory') this.#bindings = undefined;
      throw error instanceof MandolineError ? error : fatal(error);
    }
  }
}

/** What the engine throws, as opposed to C++: traps, exhausted stacks, arrays and memories that can't be allocated. */
function fatal(cause) {
  const memory = cause instanceof RangeError && !/stack/.test(cause.message);
  if (memory) return new MandolineError('outOfMemory', 'There is not enough memory for this call.', { cause });
  return new MandolineError('internalError', `The WebAssembly module failed: ${cause?.message ?? cause}.`, { cause });
}

function makeCut(host) {
  return (mesh, grid, options) => {
    const { progress, ...given } = readOptions(options);
    readFunction(progress, 'options.progress');
    let thrown;
    const report = (state) => {
      try {
        return progress(state) !== false;
      } catch (error) {
        thrown = { error };
        return false;
      }
    };
    const input = [readMesh(mesh), readGrid(grid), {
      snapTolerance: readSnapTolerance(given),
      gridCellRegion: readFlag(given.gridCellRegion, true, 'options.gridCellRegion'),
      progress: progress && report,
    }];
    try {
      return host.run((bindings) => bindings.cut(...input));
    } catch (error) {
      throw thrown ? thrown.error : error;
    }
  };
}

function makeTriangulate(host) {
  return (cutMesh, of) => {
    const input = readCutMesh(cutMesh);
    if (of === undefined) return host.run((bindings) => bindings.triangulate(input));
    if (typeof of !== 'object' || of === null || ('cell' in of) === ('region' in of)) throw bad('The second argument must be { cell } or { region }.');
    if ('region' in of) {
      const region = readElement(of.region, 'region', input.regionCount);
      return host.run((bindings) => bindings.triangulateRegion(input, region));
    }
    const cell = readElement(of.cell, 'cell', input.cellRegion.length);
    return host.run((bindings) => bindings.triangulateCell(input, cell));
  };
}

function callsOf(host) {
  const calls = {
    validate: (mesh, cutMesh, options) => {
      const input = [readMesh(mesh), readCutMesh(cutMesh), readSnapTolerance(readOptions(options))];
      return host.run((bindings) => bindings.validate(...input));
    },
    measure: (mesh, cutMesh) => {
      const input = [readMesh(mesh), readCutMesh(cutMesh)];
      return host.run((bindings) => bindings.measure(...input));
    },
    cutEdges: (mesh, cutMesh) => {
      const input = [readMesh(mesh), readCutMesh(cutMesh)];
      return host.run((bindings) => bindings.cutEdges(...input));
    },
    adjacency: (cutMesh) => {
      const input = readCutMesh(cutMesh);
      return host.run((bindings) => bindings.adjacency(input));
    },
    triangulate: makeTriangulate(host),
    cellAt: (cutMesh, point) => {
      const input = [readCutMesh(cutMesh), readVector(point, 'point')];
      const { cell, gridCell, region } = host.run((bindings) => bindings.locate(...input));
      return region[0] < 0 ? null : { cell: cell[0], gridCell: [...gridCell], region: region[0] };
    },
    cellsAt: (cutMesh, points) => {
      const input = [readCutMesh(cutMesh), readPoints(points)];
      return host.run((bindings) => bindings.locate(...input));
    },
    slice: (cutMesh, plane, options) => {
      const input = [readCutMesh(cutMesh), readPlane(plane), readFlag(readOptions(options).untouched, true, 'options.untouched')];
      return host.run((bindings) => bindings.slice(...input));
    },
    write: (mesh, cutMesh, format) => {
      if (!['json', 'vtu', 'obj'].includes(format)) throw bad('format must be "json", "vtu" or "obj".');
      const input = [readMesh(mesh), readCutMesh(cutMesh), format];
      return host.run((bindings) => bindings.write(...input));
    },
    readMesh: async (source, options) => {
      const { name, bytes } = await readFile(source, options);
      return host.run((bindings) => bindings.readMesh(bytes, name));
    },
  };
  const version = host.run((bindings) => ({ value: bindings.version() }));
  return {
    version,
    cut: named('input', makeCut(host)),
    ...Object.fromEntries(Object.entries(calls).map(([name, call]) => [name, named(name, call)])),
  };
}

/** What init() resolves to. Throws if the module can't be started. */
export function makeApi(module) {
  try {
    return callsOf(new Host(module));
  } catch (cause) {
    throw new MandolineError('loadFailed', `The WebAssembly module could not be started: ${cause?.message ?? cause}.`, { stage: 'init', cause });
  }
}
