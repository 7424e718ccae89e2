// The calls of the package, on a module that has been started.
import {
  bad, readFlag, readFunction, readGrid, readId, readMesh, readNumbers, readOptions, readPlane, readPoints, readSnapTolerance, readVector,
} from './arguments.js';
import { named } from './errors.js';
import { readFile } from './files.js';

/** Runs f with a callback that C++ can call: what the user's throws passes by C++, and through this call. */
function withProgress(progress, f) {
  if (readFunction(progress, 'options.progress') === undefined) return f(undefined);
  let thrown;
  try {
    return f((state) => {
      try {
        return progress(state) !== false;
      } catch (error) {
        thrown = { error };
        return false;
      }
    });
  } catch (error) {
    throw thrown ? thrown.error : error;
  }
}

function makeCut(host) {
  return (mesh, grid, options) => {
    const given = readOptions(options);
    return withProgress(given.progress, (progress) => {
      const input = [readMesh(mesh), readGrid(grid), {
        snapTolerance: readSnapTolerance(given),
        gridCellRegion: readFlag(given.gridCellRegion, true, 'options.gridCellRegion'),
        keep: readFlag(given.keep, true, 'options.keep'),
        progress,
      }];
      return host.run((bindings, twins) => {
        const { value, error } = bindings.cut(...input);
        if (error) return { error };
        if (value.twin) {
          host.adopt(value.cutMesh);
          twins.keep(value.cutMesh, value.twin);
        }
        return { value: value.cutMesh };
      });
    });
  };
}

function makeTriangulate(host) {
  return (cutMesh, of) => {
    if (of === undefined) return host.runOn(cutMesh, (bindings, twin) => bindings.triangulate(twin));
    if (typeof of !== 'object' || of === null || ('cell' in of) === ('region' in of)) throw bad('The second argument must be { cell } or { region }.');
    if ('region' in of) {
      const region = readId(of.region, 'region');
      return host.runOn(cutMesh, (bindings, twin) => bindings.triangulateRegion(twin, region));
    }
    const cell = readId(of.cell, 'cell');
    return host.runOn(cutMesh, (bindings, twin) => bindings.triangulateCell(twin, cell));
  };
}

function callsOf(host) {
  return {
    validate: (mesh, cutMesh, options) => {
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const input = [readMesh(mesh), { snapTolerance: readSnapTolerance(given), progress }];
        return host.runOn(cutMesh, (bindings, twin) => bindings.validate(input[0], twin, input[1]), false);
      });
    },
    measure: (mesh, cutMesh, options) => withProgress(readOptions(options).progress, (progress) => {
      const input = readMesh(mesh);
      return host.runOn(cutMesh, (bindings, twin) => bindings.measure(input, twin, { progress }));
    }),
    cutEdges: (mesh, cutMesh) => {
      const input = readMesh(mesh);
      return host.runOn(cutMesh, (bindings, twin) => bindings.cutEdges(input, twin));
    },
    adjacency: (cutMesh) => host.runOn(cutMesh, (bindings, twin) => bindings.adjacency(twin)),
    triangulate: makeTriangulate(host),
    cellAt: (cutMesh, point) => {
      const input = readVector(point, 'point');
      const { cell, gridCell, region } = host.runOn(cutMesh, (bindings, twin) => bindings.locate(twin, input));
      return region[0] < 0 ? null : { cell: cell[0], gridCell: [...gridCell], region: region[0] };
    },
    cellsAt: (cutMesh, points) => {
      const input = readPoints(points);
      return host.runOn(cutMesh, (bindings, twin) => bindings.locate(twin, input));
    },
    slice: (cutMesh, plane, options) => {
      const input = [readPlane(plane), readFlag(readOptions(options).untouched, true, 'options.untouched')];
      return host.runOn(cutMesh, (bindings, twin) => bindings.slice(twin, ...input));
    },
    slices: (cutMesh, normal, offsets, options) => {
      const input = [readVector(normal, 'normal'), readNumbers(offsets, 'offsets'), readFlag(readOptions(options).untouched, true, 'options.untouched')];
      return host.runOn(cutMesh, (bindings, twin) => bindings.slices(twin, ...input));
    },
    outlines: (cutMesh, normal, offsets) => {
      const input = [readVector(normal, 'normal'), readNumbers(offsets, 'offsets')];
      return host.runOn(cutMesh, (bindings, twin) => bindings.outlines(twin, ...input));
    },
    write: (mesh, cutMesh, format) => {
      if (!['json', 'vtu', 'obj'].includes(format)) throw bad('format must be "json", "vtu" or "obj".');
      const input = readMesh(mesh);
      return host.runOn(cutMesh, (bindings, twin) => bindings.write(input, twin, format));
    },
    readMesh: async (source, options) => {
      const { name, bytes } = await readFile(source, options);
      return host.run((bindings) => bindings.readMesh(bytes, name));
    },
  };
}

/** What init() resolves to. */
export function makeApi(host) {
  const calls = Object.entries(callsOf(host)).map(([name, call]) => [name, named(name, call)]);
  return { version: host.run((bindings) => ({ value: bindings.version() })), cut: named('input', makeCut(host)), ...Object.fromEntries(calls) };
}
