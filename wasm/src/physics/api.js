// The calls of mandoline-wasm/physics, on a module that has been started.
import { readFlag, readId, readMesh, readOptions, readPoints, readVector } from '../arguments.js';
import { named } from '../errors.js';
import { readFile } from '../files.js';
import { withProgress } from '../progress.js';
import {
  readBoundary,
  readCellIds,
  readCoarsenOptions,
  readConditions,
  readField,
  readFreeConstant,
  readLimits,
  readOctree,
  readOperatorOptions,
  readPlacedGrid,
  readProblem,
  readStreamlineOptions,
} from './arguments.js';

function callsOf(host) {
  /** The value of a binding that also gives a twin, which is that of what `keptOf` finds in the value. */
  const keeping = (keptOf, binding) => (bindings, twin, twins) => {
    const { value, error } = binding(bindings, twin);
    if (error) return { error };
    const kept = keptOf(value.value);
    host.adopt(kept, 'cells');
    twins.keep(kept, value.twin);
    return { value: value.value };
  };
  return {
    coarsen: (cutMesh, options) => {
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const balanceEdges = readFlag(given.balanceEdges, false, 'options.balanceEdges');
        const what = { ...readCoarsenOptions(given), balanceEdges, progress };
        return host.runOnCutMesh(cutMesh, (bindings, twin) => bindings.coarsen(twin, what));
      });
    },
    cellComplex: (mesh, cutMesh, octree, options) =>
      withProgress(readOptions(options).progress, (progress) => {
        const [input, cells] = [readMesh(mesh), readOctree(octree)];
        const call = (bindings, twin) => bindings.cellComplex(input, twin, cells, { progress });
        return host.runOnCutMesh(
          cutMesh,
          keeping((value) => value, call),
        );
      }),
    subComplex: (cells, cellIds) => {
      const ids = readCellIds(cellIds);
      return host.runOnComplex(
        cells,
        keeping(
          (value) => value.cells,
          (bindings, twin) => bindings.subComplex(twin, ids),
        ),
      );
    },
    regionComplex: (cells, region) => {
      const id = readId(region, 'region');
      return host.runOnComplex(
        cells,
        keeping(
          (value) => value.cells,
          (bindings, twin) => bindings.regionComplex(twin, id),
        ),
      );
    },
    complexEdges: (cells) => host.runOnComplex(cells, (bindings, twin) => bindings.complexEdges(twin)),
    operators: (cells, options) => {
      const input = readOperatorOptions(readOptions(options));
      return host.runOnComplex(cells, (bindings, twin) => bindings.operators(twin, ...input));
    },
    boundaryOf: (cells, conditions) => {
      const input = readConditions(conditions);
      return host.runOnComplex(cells, (bindings, twin) => bindings.boundaryOf(twin, input));
    },
    outwardNormals: (boundary, cells) => {
      const input = readBoundary(boundary);
      return host.runOnComplex(cells, (bindings, twin) => bindings.outwardNormals(twin, input));
    },
    cellComponents: (cells) => host.runOnComplex(cells, (bindings, twin) => bindings.cellComponents(twin)),
    poissonSystem: (cells, problem) => {
      const input = readProblem(problem);
      return host.runOnComplex(cells, (bindings, twin) => bindings.poissonSystem(twin, input));
    },
    solvePoisson: (cells, problem, options) => {
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const input = readProblem(problem);
        const balance = readFlag(given.balance, false, 'options.balance');
        const what = { ...readLimits(given), freeConstant: readFreeConstant(given), balance, progress };
        return host.runOnComplex(cells, (bindings, twin) => bindings.solvePoisson(twin, input, what));
      });
    },
    solveFlow: (cells, wind, options) => {
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const [input, what] = [readVector(wind, 'wind'), { ...readLimits(given), progress }];
        return host.runOnComplex(cells, (bindings, twin) => bindings.solveFlow(twin, input, what));
      });
    },
    velocityAt: (field, points) => {
      const input = { ...readField(field), points: readPoints(points) };
      return host.runOnBoth(field.cutMesh, field.cells, (bindings, cutMesh, cells) => bindings.velocityAt(cutMesh, cells, input));
    },
    streamlines: (field, seeds, options) => {
      const given = readOptions(options);
      return withProgress(given.progress, (progress) => {
        const input = { ...readField(field), points: readPoints(seeds, 'seeds') };
        const what = { ...readStreamlineOptions(given), progress };
        const call = (bindings, cutMesh, cells) => bindings.streamlines(cutMesh, cells, input, what);
        return host.runOnBoth(field.cutMesh, field.cells, call);
      });
    },
    inflowSeeds: (grid, wind, count) => {
      const input = [readPlacedGrid(grid), readVector(wind, 'wind'), readId(count, 'count')];
      return host.run((bindings) => bindings.inflowSeeds(...input));
    },
    readGroups: async (source, options) => {
      const { name, bytes } = await readFile(source, options);
      return host.run((bindings) => bindings.readGroups(bytes, name));
    },
  };
}

/** What initPhysics() resolves to. */
export function makePhysics(host) {
  const calls = Object.entries(callsOf(host)).map(([name, call]) => [name, named(name, call)]);
  return { version: host.run((bindings) => ({ value: bindings.version() })), ...Object.fromEntries(calls) };
}
