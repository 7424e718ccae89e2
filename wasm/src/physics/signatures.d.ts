// Written by wasm/signatures.mjs from physics/calls.js: change that.
import type { CutMeshArrays, Mesh, PlacedGrid, RunOptions, TriangleGroups, Vector3 } from '../index.js';
import type {
  Boundary,
  CellComplex,
  CellComponents,
  ChosenOperators,
  CoarsenOptions,
  ComplexEdges,
  Conditions,
  Flow,
  FlowField,
  FlowOptions,
  FlowStepper,
  FlowStepperOptions,
  HeatProblem,
  HeatStepper,
  MergeOptions,
  MergedCells,
  OctreeCells,
  OperatorNames,
  OperatorOptions,
  PoissonProblem,
  PoissonSolver,
  PoissonSystem,
  PolyMeshFiles,
  Solution,
  SolveOptions,
  StreamlineOptions,
  Streamlines,
  SubComplex,
  WallOptions,
  WriteCellsOptions,
  WriteFacesOptions,
  WritePolyMeshOptions,
} from './index.js';
import type { CallOptions, OnWorker } from '../worker.js';

export interface Calls {
  /**
   * Untouched grid cells merged into octree cells, away from the surface (5.3). The defaults are for solvers; with 0 for fineLayers and
   * layersPerLevel there are the fewest cells. Code "badOption" if an option is negative, but for a layersPerLevel of -1.
   */
  coarsen(cutMesh: CutMeshArrays, options?: CoarsenOptions): OctreeCells;
  /**
   * One conforming mesh of all cells. `mesh` is the input that `cutMesh` was made from, and `octree` comes from coarsen(cutMesh); without
   * it, the untouched grid cells are cells. Code "badArgument" if these don't belong together.
   */
  cellComplex(mesh: Mesh, cutMesh: CutMeshArrays, octree?: OctreeCells | null, options?: RunOptions): CellComplex;
  /**
   * Small cut-cells merged with neighbours, so that solvers can take long steps: each cell then has at least `options.fraction` (default
   * 0.2) of the volume of a grid cell, and at most 1.5 of it by default, but for the pockets that the result names. Never across a triangle.
   * `cells` are all of the cut-mesh's. Code "badOption" for a fraction below 0 or above 0.5, "badArgument" if the cells are those of
   * another cut-mesh, or merged already, or together smaller than 1e-70 or larger than 1e70.
   */
  mergeSmallCells(cutMesh: CutMeshArrays, cells: CellComplex, options?: MergeOptions): MergedCells;
  /**
   * The same cells with fewer faces: pieces of triangles between the same two cells that hang together, and whose normals are at most
   * `options.angle` (default 30) degrees from that of the first, become one face, which need not be flat and has the sum of their area
   * vectors. Groups stay apart. `cells` are all of the cut-mesh's, merged or not; merge them first. Code "badOption" for an angle below 0
   * or above 90, "badArgument" if the cells are those of another cut-mesh, or together smaller than 1e-70 or
   * larger than 1e70.
   */
  uniteWalls(cutMesh: CutMeshArrays, cells: CellComplex, options?: WallOptions): CellComplex;
  /** The cells that `cellIds` name, in any order. Code "badArgument" with the element if one does not exist or is named twice. */
  subComplex(cells: CellComplex, cellIds: Uint32Array | readonly number[]): SubComplex;
  /** The cells of a region of the cut-mesh. Code "badArgument" if there is none. */
  regionComplex(cells: CellComplex, region: number): SubComplex;
  /** The edges that faceEdgeIncidence and edgeVertexIncidence have the ids of. */
  complexEdges(cells: CellComplex): ComplexEdges;
  /** Discrete operators as sparse matrices: all, or those that `options.only` names. */
  operators<const Names extends OperatorNames | undefined = undefined>(
    cells: CellComplex,
    options?: OperatorOptions<Names>,
  ): ChosenOperators<Names>;
  /** The boundary with the same condition on all faces of a tag; where none is given, nothing passes ({ neumann: 0 }). */
  boundaryOf(cells: CellComplex, conditions?: Conditions): Boundary;
  /**
   * 3 per half-face of the boundary: the unit normal that points out of the cell. The Neumann values of phi = U . x, or of a wind U that
   * blows through, are its products with U.
   */
  outwardNormals(boundary: Boundary, cells: CellComplex): Float64Array<ArrayBuffer>;
  /** Which cells are connected through inner faces. */
  cellComponents(cells: CellComplex): CellComponents;
  /**
   * The system that solvePoisson() solves (appendix B). Dirichlet conditions hold phi, and so do Robin conditions with a coefficient above
   * 0, and mass. Conditions act over the distance along the normal between the face's centroid and the cell's dual point, or, on the
   * surface, the cell's centroid. Code "badArgument" for a boundary that is not that of `cells`, for arrays of other lengths, for values,
   * sources, coefficients and masses that are not finite or out of range, and if the cells together are smaller than 1e-70 or larger than
   * 1e70.
   */
  poissonSystem(cells: CellComplex, problem?: PoissonProblem): PoissonSystem;
  /**
   * Solves the problem's system by conjugate gradients, preconditioned by a multigrid, and corrects it by what the derivatives in its
   * matrix lack: so phi, and nearly everywhere its derivatives on faces, are of second order, also on merged cells. Errors as in
   * poissonSystem(); code "badOption" for a tolerance that is not positive, or for negative maxIterations or corrections. What can't be
   * solved is told by the solution's status.
   */
  solvePoisson(cells: CellComplex, problem?: PoissonProblem, options?: SolveOptions): Solution;
  /**
   * An object that solves one problem for many sources and boundary values: what does not depend on these is made once. The problem's own
   * are not used. Errors as in poissonSystem().
   */
  createPoissonSolver(cells: CellComplex, problem?: PoissonProblem): PoissonSolver;
  /**
   * An object that solves d phi / dt = div k grad phi - m phi - s in implicit steps of any length, of second order in time. Errors as in
   * poissonSystem(), "badOption" for a time step that is not positive.
   */
  createHeatStepper(cells: CellComplex, heat: HeatProblem): HeatStepper;
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
   */
  solveFlow(cells: CellComplex, wind: Vector3, options?: FlowOptions): Flow;
  /**
   * An object that solves the incompressible Navier-Stokes equations in time, or Euler's without viscosity, from the potential flow of the
   * wind on: conservative, of second order, without turbulence models. Merge small cells first, or steps are tiny, and unite walls, so that
   * they are quick. The wind enters through the sides of the box that it blows against, and leaves through those opposite, at pressure 0.
   * Code "badArgument" as in solveFlow(), "badOption" if an option is out of range.
   */
  createFlowStepper(cells: CellComplex, wind: Vector3, options?: FlowStepperOptions): FlowStepper;
  /**
   * Per face: the group of its triangle, 0 for others. `cells` are all of the cut-mesh's, merged or not. Code "badArgument" if these don't
   * belong together.
   */
  faceGroups(cutMesh: CutMeshArrays, cells: CellComplex, groups: TriangleGroups): Uint32Array<ArrayBuffer>;
  /**
   * 3 per point: the velocity there, linear in each cell; NaN outside the grid. Which cell holds a point, and so which side of a sheet it
   * is on, is decided as cellsAt() does. `points`: 3 per point, world units; many points in one call are far faster. Code "badArgument"
   * unless the field's parts belong together and the flow is finite.
   */
  velocityAt(field: FlowField, points: ArrayLike<number>): Float64Array<ArrayBuffer>;
  /**
   * Follows the flow from the seeds, 3 coordinates each: Runge-Kutta steps of third order (Bogacki, Shampine 1989) of adaptive length. Each
   * ends in its cell at the latest. No segment of a line meets a triangle of the mesh, by exact predicates (those without area are none),
   * and none leaves the grid. A seed on the surface has a line of one point. Errors as in velocityAt(); code "badOption" if an option is
   * out of range.
   */
  streamlines(field: FlowField, seeds: ArrayLike<number>, options?: StreamlineOptions): Streamlines;
  /**
   * 3 per seed: `count` points on the sides where the wind enters the box of a grid, spread in proportion to the inflow; none without wind.
   * Code "badArgument" if the wind is not finite, "badGrid" if the grid has no cells.
   */
  inflowSeeds(grid: PlacedGrid, wind: Vector3, count: number): Float64Array<ArrayBuffer>;
  /**
   * The cells as a file. "vtu": polyhedra and hexahedra for VTK and ParaView, which match face by face, with `options.fields` beside
   * arrays of their own; "json": every array, always of all cells, and no fields. Code "badArgument" if `cells` are not those of the cut-mesh.
   */
  writeCells(cutMesh: CutMeshArrays, cells: CellComplex, format: 'json' | 'vtu', options?: WriteCellsOptions): Uint8Array<ArrayBuffer>;
  /**
   * Their faces as polygons of a "vtu", with the tag, the triangle and the cells of each, its group if there are groups, and
   * `options.fields`. Errors as in writeCells().
   */
  writeFaces(cutMesh: CutMeshArrays, cells: CellComplex, options?: WriteFacesOptions): Uint8Array<ArrayBuffer>;
  /**
   * The cells as a polyMesh of OpenFOAM: the files of the folder constant/polyMesh by their names. Patches are xMin ... zMax, `surface` (a
   * wall), which has both sides of the input's triangles, or with groups a wall for each of them, and `inner` where only one of two
   * neighbours is written. Of merged cells, faces that are only as wide as rounding makes them are collapsed, walls in a plane with the
   * centroid of a cell beside them are moved off it by little more than that, cells that have walls alone around them are left out, and
   * faces of the grid that their own centre does not see as a whole, or no vertex does, are divided. Without `options.regions`, those that
   * no side of the grid bounds are left out, if there are others: solvers stop where nothing holds the pressure.
   * Errors as in writeCells().
   */
  writePolyMesh(cutMesh: CutMeshArrays, cells: CellComplex, options?: WritePolyMeshOptions): PolyMeshFiles;
}

/** The same in a worker. */
export interface WorkerCalls {
  coarsen(cutMesh: CutMeshArrays, options?: CoarsenOptions & CallOptions): Promise<OctreeCells>;
  cellComplex(mesh: Mesh, cutMesh: CutMeshArrays, octree?: OctreeCells | null, options?: RunOptions & CallOptions): Promise<CellComplex>;
  mergeSmallCells(cutMesh: CutMeshArrays, cells: CellComplex, options?: MergeOptions & CallOptions): Promise<MergedCells>;
  uniteWalls(cutMesh: CutMeshArrays, cells: CellComplex, options?: WallOptions & CallOptions): Promise<CellComplex>;
  subComplex(cells: CellComplex, cellIds: Uint32Array | readonly number[], options?: CallOptions): Promise<SubComplex>;
  regionComplex(cells: CellComplex, region: number, options?: CallOptions): Promise<SubComplex>;
  complexEdges(cells: CellComplex, options?: CallOptions): Promise<ComplexEdges>;
  operators<const Names extends OperatorNames | undefined = undefined>(
    cells: CellComplex,
    options?: OperatorOptions<Names> & CallOptions,
  ): Promise<ChosenOperators<Names>>;
  boundaryOf(cells: CellComplex, conditions?: Conditions, options?: CallOptions): Promise<Boundary>;
  outwardNormals(boundary: Boundary, cells: CellComplex, options?: CallOptions): Promise<Float64Array<ArrayBuffer>>;
  cellComponents(cells: CellComplex, options?: CallOptions): Promise<CellComponents>;
  poissonSystem(cells: CellComplex, problem?: PoissonProblem, options?: CallOptions): Promise<PoissonSystem>;
  solvePoisson(cells: CellComplex, problem?: PoissonProblem, options?: SolveOptions & CallOptions): Promise<Solution>;
  createPoissonSolver(cells: CellComplex, problem?: PoissonProblem, options?: CallOptions): Promise<OnWorker<PoissonSolver>>;
  createHeatStepper(cells: CellComplex, heat: HeatProblem, options?: CallOptions): Promise<OnWorker<HeatStepper>>;
  solveFlow(cells: CellComplex, wind: Vector3, options?: FlowOptions & CallOptions): Promise<Flow>;
  createFlowStepper(cells: CellComplex, wind: Vector3, options?: FlowStepperOptions & CallOptions): Promise<OnWorker<FlowStepper>>;
  faceGroups(cutMesh: CutMeshArrays, cells: CellComplex, groups: TriangleGroups, options?: CallOptions): Promise<Uint32Array<ArrayBuffer>>;
  velocityAt(field: FlowField, points: ArrayLike<number>, options?: CallOptions): Promise<Float64Array<ArrayBuffer>>;
  streamlines(field: FlowField, seeds: ArrayLike<number>, options?: StreamlineOptions & CallOptions): Promise<Streamlines>;
  inflowSeeds(grid: PlacedGrid, wind: Vector3, count: number, options?: CallOptions): Promise<Float64Array<ArrayBuffer>>;
  writeCells(
    cutMesh: CutMeshArrays,
    cells: CellComplex,
    format: 'json' | 'vtu',
    options?: WriteCellsOptions & CallOptions,
  ): Promise<Uint8Array<ArrayBuffer>>;
  writeFaces(cutMesh: CutMeshArrays, cells: CellComplex, options?: WriteFacesOptions & CallOptions): Promise<Uint8Array<ArrayBuffer>>;
  writePolyMesh(cutMesh: CutMeshArrays, cells: CellComplex, options?: WritePolyMeshOptions & CallOptions): Promise<PolyMeshFiles>;
}
