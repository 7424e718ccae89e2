// The table of the calls of the module that cuts again, brick by brick and where cells are refined, as in ../calls.js. It is loaded when the
// first of them is made.
import {
  bad,
  coarsening,
  expectFunction,
  expectNumber,
  flag,
  int32,
  kindOf,
  numbered,
  optional,
  readBuffers,
  readCount,
  readFunction,
  readGrid,
  readId,
  readInt32,
  readMembers,
  readMesh,
  readPlacedGrid,
  readSnapTolerance,
  readVector,
} from '../arguments.js';
import { Intersections } from '../fields.js';

const progress = readFunction;
const intersections = numbered(Intersections);
const keep = flag(true);

/** Untouched grid cells that are not refined are not merged by default. */
const readCoarsening = (given = {}, name) => readMembers(given, coarsening(0), name);

/** Whether they are boxes is up to C++. */
function readBoxes(boxes = [], name) {
  if (!Array.isArray(boxes)) throw bad(`${name} must be an array of boxes, not ${kindOf(boxes)}.`);
  return boxes.map((box, i) => readMembers(box, { min: readVector, max: readVector, levels: readInt32 }, `${name}[${i}]`));
}

const readRule = optional((rule, name) => readMembers(rule, { divides: expectFunction, levels: readInt32 }, name));

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
  /**
   * Cells of several sizes, as one conforming mesh: grid cells are divided where the surface bends, or where boxes or a rule say so, and cut
   * again there alone. `mesh` is the input that `cutMesh` was made from, without a snapTolerance and not by estimateInside(). The result has
   * a cut-mesh of its own, for calls of mandoline-wasm/physics that take both. Code "badOption" for options that are out of range,
   * "gridTooLarge" if there are more than 2^24 of the smallest cells along an axis, "badGrid" if planes between those of the grid are not
   * apart, "badArgument" if the mesh and the cut-mesh don't belong together.
   *
   * refineCells(mesh: Mesh, cutMesh: CutMeshArrays, options?: RefineOptions): Promise<RefinedCells>
   */
  refineCells: {
    takes: { mesh: readMesh, cutMesh: { kind: 'cutMesh' } },
    options: {
      levels: int32(0),
      angle: (value = 30, name) => expectNumber(value, name),
      boxes: readBoxes,
      rule: readRule,
      layers: int32(1),
      coarsening: readCoarsening,
      intersections,
      progress,
    },
    keeps: 'cells',
    member: 'cells',
  },
};
