// The table of the calls of mandoline-wasm/physics, as in ../calls.js.
import {
  bad,
  coarsening,
  expectTypedArray,
  flag,
  int32,
  numbered,
  optional,
  readFlags,
  readFunction,
  readId,
  readMesh,
  readNumbers,
  readOrigin,
  readPlacedGrid,
  readPoints,
  readVector,
} from '../arguments.js';
import { FileFormat } from '../fields.js';
import { format, readGroups } from '../files/arguments.js';
import { FreeConstant } from './fields.js';
import {
  dualPoints,
  number,
  readBoundary,
  readCellIds,
  readConditions,
  readFieldsToWrite,
  readHeat,
  readPoissonData,
  readFlow,
  readMaxPoints,
  readOctree,
  readOperatorNames,
  readProblem,
} from './arguments.js';

const cutMesh = { kind: 'cutMesh' };
const cells = { kind: 'cells' };
const field = { mesh: readMesh, cutMesh, cells, flow: readFlow };

const progress = readFunction;

/** Of writers. */
const written = { untouched: flag(true), regions: optional(readFlags), groups: optional(readGroups), progress };
const writtenCells = { ...written, simpleCells: flag(false) };

/** When a solver stops, and how often it corrects. */
const limits = { tolerance: number(1e-10), maxIterations: int32(500), corrections: int32(8) };
const solving = { ...limits, freeConstant: numbered(FreeConstant), balance: flag(false), progress };

const poissonSolver = { type: 'Poisson solver', methods: { solve: { takes: { data: readPoissonData }, options: solving } } };
const heatStepper = {
  type: 'heat stepper',
  methods: {
    step: { takes: {}, options: solving },
    setSource: { takes: { source: readNumbers } },
    setBoundaryValue: { takes: { boundaryValue: readNumbers } },
    phi: { takes: {} },
    time: { takes: {} },
  },
};

const faceGroup = optional((value, name) => expectTypedArray(value, 'Uint32Array', name));
const flowStepper = {
  type: 'flow stepper',
  methods: {
    start: { takes: { cellVelocity: readNumbers } },
    step: { takes: {} },
    flow: { takes: {} },
    forces: { takes: {}, options: { faceGroup, centre: readOrigin } },
  },
};

export const physicsCalls = {
  /**
   * Untouched grid cells merged into octree cells, away from the surface (5.3). The defaults are for solvers; with 0 for fineLayers and
   * layersPerLevel there are the fewest cells. Code "badOption" if an option is negative, but for a layersPerLevel of -1.
   *
   * coarsen(cutMesh: CutMeshArrays, options?: CoarsenOptions): OctreeCells
   */
  coarsen: {
    takes: { cutMesh },
    options: { ...coarsening(24), progress },
  },
  /**
   * One conforming mesh of all cells. `mesh` is the input that `cutMesh` was made from, and `octree` comes from coarsen(cutMesh); without
   * it, the untouched grid cells are cells. Code "badArgument" if these don't belong together.
   *
   * cellComplex(mesh: Mesh, cutMesh: CutMeshArrays, octree?: OctreeCells | null, options?: RunOptions): CellComplex
   */
  cellComplex: {
    takes: { mesh: readMesh, cutMesh, octree: readOctree },
    options: { progress },
    keeps: 'cells',
  },
  /**
   * Small cut-cells merged with neighbours, so that solvers can take long steps: each cell then has at least `options.fraction` (default
   * 0.2) of the volume of a grid cell, and at most 1.5 of it by default, but for the pockets that the result names. Never across a triangle.
   * `cells` are all of the cut-mesh's. Code "badOption" for a fraction below 0 or above 0.5, "badArgument" if the cells are those of
   * another cut-mesh, or merged already, or together smaller than 1e-70 or larger than 1e70.
   *
   * mergeSmallCells(cutMesh: CutMeshArrays, cells: CellComplex, options?: MergeOptions): MergedCells
   */
  mergeSmallCells: { takes: { cutMesh, cells }, options: { fraction: number(0.2), progress }, keeps: 'cells', member: 'cells' },
  /**
   * The same cells with fewer faces: pieces of triangles between the same two cells that hang together, and whose normals are at most
   * `options.angle` (default 30) degrees from that of the first, become one face, which need not be flat and has the sum of their area
   * vectors. Groups stay apart. `cells` are all of the cut-mesh's, merged or not; merge them first. Code "badOption" for an angle below 0
   * or above 90, "badArgument" if the cells are those of another cut-mesh, or together smaller than 1e-70 or
   * larger than 1e70.
   *
   * uniteWalls(cutMesh: CutMeshArrays, cells: CellComplex, options?: WallOptions): CellComplex
   */
  uniteWalls: { takes: { cutMesh, cells }, options: { angle: number(30), groups: optional(readGroups), progress }, keeps: 'cells' },
  /**
   * The cells that `cellIds` name, in any order. Code "badArgument" with the element if one does not exist or is named twice.
   *
   * subComplex(cells: CellComplex, cellIds: Uint32Array | readonly number[]): SubComplex
   */
  subComplex: { takes: { cells, cellIds: readCellIds }, keeps: 'cells', member: 'cells' },
  /**
   * The cells of a region of the cut-mesh. Code "badArgument" if there is none.
   *
   * regionComplex(cells: CellComplex, region: number): SubComplex
   */
  regionComplex: { takes: { cells, region: readId }, keeps: 'cells', member: 'cells' },
  /**
   * The edges that faceEdgeIncidence and edgeVertexIncidence have the ids of.
   *
   * complexEdges(cells: CellComplex): ComplexEdges
   */
  complexEdges: { takes: { cells } },
  /**
   * Discrete operators as sparse matrices: all, or those that `options.only` names.
   *
   * operators<const Names extends OperatorNames | undefined = undefined>(cells: CellComplex, options?: OperatorOptions<Names>): ChosenOperators<Names>
   */
  operators: {
    takes: { cells },
    options: { only: readOperatorNames, dualPoints },
    run: (bindings, handle, options) => bindings.operators(handle, options.only, options.dualPoints),
  },
  /**
   * The boundary with the same condition on all faces of a tag; where none is given, nothing passes ({ neumann: 0 }).
   *
   * boundaryOf(cells: CellComplex, conditions?: Conditions): Boundary
   */
  boundaryOf: { takes: { cells, conditions: readConditions } },
  /**
   * 3 per half-face of the boundary: the unit normal that points out of the cell. The Neumann values of phi = U . x, or of a wind U that
   * blows through, are its products with U.
   *
   * outwardNormals(boundary: Boundary, cells: CellComplex): Float64Array<ArrayBuffer>
   */
  outwardNormals: {
    takes: { boundary: readBoundary, cells },
    run: (bindings, boundary, handle) => bindings.outwardNormals(handle, boundary),
  },
  /**
   * Which cells are connected through inner faces.
   *
   * cellComponents(cells: CellComplex): CellComponents
   */
  cellComponents: { takes: { cells } },
  /**
   * The system that solvePoisson() solves (appendix B). Dirichlet conditions hold phi, and so do Robin conditions with a coefficient above
   * 0, and mass. Conditions act over the distance along the normal between the face's centroid and the cell's dual point, or, on the
   * surface, the cell's centroid. Code "badArgument" for a boundary that is not that of `cells`, for arrays of other lengths, for values,
   * sources, coefficients and masses that are not finite or out of range, and if the cells together are smaller than 1e-70 or larger than
   * 1e70.
   *
   * poissonSystem(cells: CellComplex, problem?: PoissonProblem): PoissonSystem
   */
  poissonSystem: { takes: { cells, problem: readProblem } },
  /**
   * Solves the problem's system by conjugate gradients, preconditioned by a multigrid, and corrects it by what the derivatives in its
   * matrix lack: so phi, and nearly everywhere its derivatives on faces, are of second order, also on merged cells. Errors as in
   * poissonSystem(); code "badOption" for a tolerance that is not positive, or for negative maxIterations or corrections. What can't be
   * solved is told by the solution's status.
   *
   * solvePoisson(cells: CellComplex, problem?: PoissonProblem, options?: SolveOptions): Solution
   */
  solvePoisson: {
    takes: { cells, problem: readProblem },
    options: solving,
  },
  /**
   * An object that solves one problem for many sources and boundary values: what does not depend on these is made once. The problem's own
   * are not used. Errors as in poissonSystem().
   *
   * createPoissonSolver(cells: CellComplex, problem?: PoissonProblem): PoissonSolver
   */
  createPoissonSolver: { takes: { cells, problem: readProblem }, gives: poissonSolver },
  /**
   * An object that solves d phi / dt = div k grad phi - m phi - s in implicit steps of any length, of second order in time. Errors as in
   * poissonSystem(), "badOption" for a time step that is not positive.
   *
   * createHeatStepper(cells: CellComplex, heat: HeatProblem): HeatStepper
   */
  createHeatStepper: { takes: { cells, heat: readHeat }, gives: heatStepper },
  /**
   * Potential flow of a wind through the cells and about the surface (appendix B, figure 22): solves div grad phi = 0, where
   * grad phi . N = wind . N on the sides of the box. Nothing flows through the surface, or through faces where a sub-complex was cut off.
   * Within the tolerance, as much flows into a cell as out of it. Components that don't touch the box are at rest.
   *
   * Where the surface divides the box, the wind may bring more into a component than it takes out, or less. Then the larger of the two
   * flows is scaled down to the smaller one. A component with only an inflow or only an outflow, a dead end, is at rest. So is a dead end
   * within a component that only slits lead to: faces with less than a millionth of the area of other faces of their cells.
   *
   * With `options.farField` the flow is solved again until it agrees with the dipoles that the surface disturbs the wind by. About a ball
   * that keeps half its diameter from the sides, the fastest flow is within 1 % of that in unbounded space, where a wind tunnel makes it 9 %
   * too fast. Keep the sides at least a tenth of its longest extent away from the surface.
   *
   * Code "badArgument" if the wind is not finite, with farField for a face of the surface (element) that reaches a side, and as in
   * poissonSystem(); "badOption" as in solvePoisson().
   *
   * solveFlow(cells: CellComplex, wind: Vector3, options?: FlowOptions): Flow
   */
  solveFlow: { takes: { cells, wind: readVector }, options: { ...limits, farField: flag(false), progress } },
  /**
   * An object that solves the incompressible Navier-Stokes equations in time, or Euler's without viscosity, from the potential flow of the
   * wind on: conservative, of second order, without turbulence models. Merge small cells first, or steps are tiny, and unite walls, so that
   * they are quick. The wind enters through the sides of the box that it blows against, and leaves through those opposite, at pressure 0.
   * Code "badArgument" as in solveFlow(), "badOption" if an option is out of range.
   *
   * createFlowStepper(cells: CellComplex, wind: Vector3, options?: FlowStepperOptions): FlowStepper
   */
  createFlowStepper: {
    takes: { cells, wind: readVector },
    options: {
      viscosity: number(0),
      timeStep: number(0),
      courant: number(0.5),
      tolerance: number(1e-10),
      maxIterations: int32(500),
      corrections: int32(1),
    },
    gives: flowStepper,
  },
  /**
   * Per face: the group of its triangle, 0 for others. `cells` are all of the cut-mesh's, merged or not. Code "badArgument" if these don't
   * belong together.
   *
   * faceGroups(cutMesh: CutMeshArrays, cells: CellComplex, groups: TriangleGroups): Uint32Array<ArrayBuffer>
   */
  faceGroups: { takes: { cutMesh, cells, groups: readGroups } },
  /**
   * 3 per point: the velocity there, linear in each cell; NaN outside the grid. Which cell holds a point, and so which side of a sheet it
   * is on, is decided as cellsAt() does. `points`: 3 per point, world units; many points in one call are far faster. Code "badArgument"
   * unless the field's parts belong together and the flow is finite.
   *
   * velocityAt(field: FlowField, points: ArrayLike<number>): Float64Array<ArrayBuffer>
   */
  velocityAt: {
    takes: { field, points: readPoints },
    run: (bindings, { mesh, cutMesh, cells, flow }, points) => bindings.velocityAt(cutMesh, cells, { mesh, flow, points }),
  },
  /**
   * Follows the flow from the seeds, 3 coordinates each: Runge-Kutta steps of third order (Bogacki, Shampine 1989) of adaptive length. Each
   * ends in its cell at the latest. No segment of a line meets a triangle of the mesh, by exact predicates (those without area are none),
   * and none leaves the grid. A seed on the surface has a line of one point. Errors as in velocityAt(); code "badOption" if an option is
   * out of range.
   *
   * streamlines(field: FlowField, seeds: ArrayLike<number>, options?: StreamlineOptions): Streamlines
   */
  streamlines: {
    takes: { field, seeds: readPoints },
    options: { upstream: flag(false), tolerance: number(1e-3), maxLength: number(Infinity), maxPoints: readMaxPoints, progress },
    run: (bindings, { mesh, cutMesh, cells, flow }, points, options) => {
      return bindings.streamlines(cutMesh, cells, { mesh, flow, points }, options);
    },
  },
  /**
   * 3 per seed: `count` points on the sides where the wind enters the box of a grid, spread in proportion to the inflow; none without wind.
   * Code "badArgument" if the wind is not finite, "badGrid" if the grid has no cells.
   *
   * inflowSeeds(grid: PlacedGrid, wind: Vector3, count: number): Float64Array<ArrayBuffer>
   */
  inflowSeeds: { takes: { grid: readPlacedGrid, wind: readVector, count: readId } },
  /**
   * The cells as a file. "vtu": polyhedra and hexahedra for VTK and ParaView, which match face by face, with `options.fields` beside
   * arrays of their own; "json": every array, always of all cells, and no fields. Code "badArgument" if `cells` are not those of the cut-mesh.
   *
   * writeCells(cutMesh: CutMeshArrays, cells: CellComplex, format: 'json' | 'vtu', options?: WriteCellsOptions): Uint8Array<ArrayBuffer>
   */
  writeCells: {
    takes: { cutMesh, cells, format: format('json', 'vtu') },
    options: { ...writtenCells, fields: readFieldsToWrite },
    run: (bindings, cutMeshHandle, cellsHandle, number, options) => {
      if (FileFormat[number] === 'json' && options.fields.length)
        throw bad('options.fields is for "vtu": "json" has the arrays of cells alone.');
      return bindings.writeCells(cutMeshHandle, cellsHandle, number, options);
    },
  },
  /**
   * Their faces as polygons of a "vtu", with the tag, the triangle and the cells of each, its group if there are groups, and
   * `options.fields`. Errors as in writeCells().
   *
   * writeFaces(cutMesh: CutMeshArrays, cells: CellComplex, options?: WriteFacesOptions): Uint8Array<ArrayBuffer>
   */
  writeFaces: { takes: { cutMesh, cells }, options: { ...written, fields: readFieldsToWrite } },
  /**
   * The cells as a polyMesh of OpenFOAM: the files of the folder constant/polyMesh by their names. Patches are xMin ... zMax, `surface` (a
   * wall), which has both sides of the input's triangles, or with groups a wall for each of them, and `inner` where only one of two
   * neighbours is written. Of merged cells, faces that are only as wide as rounding makes them are collapsed, walls in a plane with the
   * centroid of a cell beside them are moved off it by little more than that, cells that have walls alone around them are left out, and
   * faces of the grid that their own centre does not see as a whole, or no vertex does, are divided. Without `options.regions`, those that
   * no side of the grid bounds are left out, if there are others: solvers stop where nothing holds the pressure.
   * Errors as in writeCells().
   *
   * writePolyMesh(cutMesh: CutMeshArrays, cells: CellComplex, options?: WritePolyMeshOptions): PolyMeshFiles
   */
  writePolyMesh: { takes: { cutMesh, cells }, options: writtenCells },
};
