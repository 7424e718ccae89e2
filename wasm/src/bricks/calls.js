// The table of the calls of the module that cuts again and brick by brick, as in ../calls.js. It is loaded when the first of them is made.
import {
  flag,
  numbered,
  readBuffers,
  readCount,
  readFunction,
  readGrid,
  readId,
  readMesh,
  readPlacedGrid,
  readSnapTolerance,
} from '../arguments.js';
import { Intersections } from '../fields.js';

const progress = readFunction;
const intersections = numbered(Intersections);
const keep = flag(true);

const recutter = {
  type: 'recutter',
  methods: {
    cut: {
      takes: { mesh: readMesh },
      options: { gridCellRegion: flag(true), keep, reuse: readBuffers, progress },
      keeps: 'cutMesh',
      isCut: true,
    },
    counts: { takes: {} },
  },
};

const brickCutter = {
  type: 'brick cutter',
  methods: {
    count: { takes: {} },
    first: { takes: { brick: readId } },
    cut: { takes: { brick: readId }, options: { keep, progress }, keeps: 'cutMesh', member: 'cutMesh', isCut: true },
  },
};

export const brickCalls = {
  /**
   * Cuts meshes one after the other with the same grid. If a mesh differs from the one before in positions alone, only those parts of the
   * grid are cut again in which something has moved. Whether there is such a grid, the first cut tells.
   *
   * createRecutter(grid: PlacedGrid, options?: RecutterOptions): Promise<Recutter>
   */
  createRecutter: { takes: { grid: readPlacedGrid }, options: { snapTolerance: readSnapTolerance, intersections }, gives: recutter },
  /**
   * Cuts a grid brick by brick, a box of grid cells at a time, for cuts that are larger than memory: prepares the mesh and finds the
   * triangles near each brick. Errors are those of cut(); code "badOption" unless `cells` is a power of two up to 2^24.
   *
   * createBrickCutter(mesh: Mesh, grid: GridInput, options?: BrickCutterOptions): Promise<BrickCutter>
   */
  createBrickCutter: {
    takes: { mesh: readMesh, grid: readGrid },
    options: { cells: (value = 128, name) => readCount(value, name), untouched: flag(false), intersections, progress },
    gives: brickCutter,
    isCut: true,
  },
};
