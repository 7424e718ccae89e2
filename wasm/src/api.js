// The calls of the package, on a module that has been started.
import {
  bad,
  readFlag,
  readFlags,
  readGrid,
  readId,
  readIntersections,
  readMesh,
  readMaxPairs,
  readNumbers,
  readOptions,
  readPlane,
  readPoints,
  readResolved,
  readRule,
  readSnapTolerance,
  readVector,
} from './arguments.js';
import { named } from './errors.js';
import { readFile } from './files.js';
import { withProgress } from './progress.js';

function makePrepare(host) {
  return (mesh, options) => {
    const given = readOptions(options);
    return withProgress(given.progress, (progress) => {
      const input = readMesh(mesh);
      const preparation = { intersections: readIntersections(given) };
      return host.run((bindings, twins) => {
        const { value: twin, error } = bindings.prepare(input, { ...preparation, progress });
        if (error) return { error };
        const value = { positions: new Float64Array(input.positions), triangles: new Uint32Array(input.triangles) };
        host.adopt(value, preparation);
        twins.keep(value, twin);
        return { value };
      });
    });
  };
}

function makeCut(host) {
  return (mesh, grid, options) => {
    const given = readOptions(options);
    return withProgress(given.progress, (progress) => {
      const preparation = host.preparationOf(mesh);
      const arrays = preparation ? null : readMesh(mesh);
      const place = readGrid(grid);
      const what = {
        snapTolerance: readSnapTolerance(given),
        intersections: readIntersections(given),
        gridCellRegion: readFlag(given.gridCellRegion, true, 'options.gridCellRegion'),
        keep: readFlag(given.keep, true, 'options.keep'),
        progress,
      };
      const cut = (bindings, prepared, twins) => {
        const { value, error } = bindings.cut(arrays, place, { ...what, prepared });
        if (error) return { error };
        if (value.twin) {
          host.adopt(value.cutMesh);
          twins.keep(value.cutMesh, value.twin);
        }
        return { value: value.cutMesh };
      };
      if (!preparation) return host.run((bindings, twins) => cut(bindings, undefined, twins));
      return host.runOnPrepared(mesh, (bindings, input) => bindings.prepare(input, { ...preparation, progress }), cut);
    });
  };
}

function makeTriangulate(host) {
  return (cutMesh, of) => {
    if (of === undefined) return host.runOn(cutMesh, (bindings, twin) => bindings.triangulate(twin));
    const isObject = typeof of === 'object' && of !== null;
    if (!isObject || 'cell' in of === 'region' in of) throw bad('The second argument must be { cell } or { region }.');
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
    findIntersections: (mesh, options) => {
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const input = [readMesh(mesh), { maxPairs: readMaxPairs(given), progress }];
        return host.run((bindings) => bindings.findIntersections(...input));
      });
    },
    resolve: (mesh, options) =>
      withProgress(readOptions(options).progress, (progress) => {
        const input = readMesh(mesh);
        return host.run((bindings) => bindings.resolve(input, { progress }));
      }),
    boundary: (mesh, rule) => {
      const number = readRule(rule);
      const isCutMesh = host.isResult(mesh) || mesh?.grid !== undefined;
      if (isCutMesh) return host.runOn(mesh, (bindings, twin) => bindings.boundary(twin, number));
      const resolved = readResolved(mesh);
      return host.run((bindings) => bindings.boundaryOfResolved(resolved, number));
    },
    measure: (mesh, cutMesh, options) =>
      withProgress(readOptions(options).progress, (progress) => {
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
      const { cell, gridCell, region } = host.runOn(cutMesh, (bindings, twin) => bindings.cellsAt(twin, input));
      return region[0] < 0 ? null : { cell: cell[0], gridCell: [...gridCell], region: region[0] };
    },
    cellsAt: (cutMesh, points) => {
      const input = readPoints(points);
      return host.runOn(cutMesh, (bindings, twin) => bindings.cellsAt(twin, input));
    },
    slice: (cutMesh, plane, options) => {
      const input = [readPlane(plane), readFlag(readOptions(options).untouched, true, 'options.untouched')];
      return host.runOn(cutMesh, (bindings, twin) => bindings.slice(twin, ...input));
    },
    slices: (cutMesh, normal, offsets, options) => {
      const untouched = readFlag(readOptions(options).untouched, true, 'options.untouched');
      const input = [readVector(normal, 'normal'), readNumbers(offsets, 'offsets'), untouched];
      return host.runOn(cutMesh, (bindings, twin) => bindings.slices(twin, ...input));
    },
    outlines: (cutMesh, normal, offsets) => {
      const input = [readVector(normal, 'normal'), readNumbers(offsets, 'offsets')];
      return host.runOn(cutMesh, (bindings, twin) => bindings.outlines(twin, ...input));
    },
    write: (mesh, cutMesh, format, options) => {
      if (!['json', 'vtu', 'obj'].includes(format)) throw bad('format must be "json", "vtu" or "obj".');
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const input = readMesh(mesh);
        const what = {
          untouched: readFlag(given.untouched, true, 'options.untouched'),
          regions: readFlags(given.regions, 'options.regions'),
          progress,
        };
        return host.runOn(cutMesh, (bindings, twin) => bindings.write(input, twin, format, what));
      });
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
  return {
    version: host.run((bindings) => ({ value: bindings.version() })),
    prepare: named('input', makePrepare(host)),
    cut: named('input', makeCut(host)),
    ...Object.fromEntries(calls),
  };
}
