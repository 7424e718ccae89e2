/** The worker of `mandoline-wasm/worker` that also computes: the calls of `mandoline-wasm/physics` as promises. Browsers and Node. */
import type { CutMesh, Grid, GridBox, GridRectilinear, GridRegular, Mesh, ReadMeshOptions, RunOptions, Vector3 } from '../index.js';
import type { CallOptions, MandolineWorker, WorkerOptions } from '../worker.js';
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
  OctreeCells,
  OperatorNames,
  OperatorOptions,
  PhysicsOptions,
  PoissonProblem,
  PoissonSystem,
  Solution,
  SolveOptions,
  StreamlineOptions,
  Streamlines,
  SubComplex,
  TriangleGroups,
} from './index.js';

export { MandolineError, describe } from '../index.js';

/**
 * All calls run one after another, in the order they were made. The first one that computes loads the module for it. Results are
 * transferred, and the twins of cell complexes, and of cut-meshes that were computed with, stay in the thread (see CutMesh).
 */
export interface PhysicsWorker extends MandolineWorker {
  coarsen(cutMesh: CutMesh, options?: CoarsenOptions & CallOptions): Promise<OctreeCells>;
  cellComplex(mesh: Mesh, cutMesh: CutMesh, octree?: OctreeCells | null, options?: RunOptions & CallOptions): Promise<CellComplex>;
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
  solveFlow(cells: CellComplex, wind: Vector3, options?: FlowOptions & CallOptions): Promise<Flow>;
  velocityAt(
    field: FlowField,
    points: Float64Array | Float32Array | readonly number[],
    options?: CallOptions,
  ): Promise<Float64Array<ArrayBuffer>>;
  streamlines(
    field: FlowField,
    seeds: Float64Array | Float32Array | readonly number[],
    options?: StreamlineOptions & CallOptions,
  ): Promise<Streamlines>;
  inflowSeeds(
    grid: Grid | GridBox | GridRegular | GridRectilinear,
    wind: Vector3,
    count: number,
    options?: CallOptions,
  ): Promise<Float64Array<ArrayBuffer>>;
  readGroups(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions & CallOptions): Promise<TriangleGroups>;
}

/** Starts a worker that has loaded the cutter's module. Errors as those of createWorker() of `mandoline-wasm/worker`. */
export function createWorker(options?: WorkerOptions & PhysicsOptions): Promise<PhysicsWorker>;
