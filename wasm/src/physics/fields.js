// Written by wasm/results.mjs from the headers in src/include/mandoline: change those.

export const CellComplex = {
  cutVertices: 'integer',
  cutFaces: 'integer',
  cutCells: 'integer',
  positions: 'Float64Array',
  loopOffsets: 'Uint32Array',
  loopVertices: 'Uint32Array',
  faceLoopOffsets: 'Uint32Array',
  faceCells: 'Int32Array',
  faceTag: 'Uint8Array',
  faceArea: 'Float64Array',
  faceNormal: 'Float64Array',
  faceCentroid: 'Float64Array',
  cellHalfFaceOffsets: 'Uint32Array',
  cellHalfFaces: 'Uint32Array',
  cellCorner: 'Int32Array',
  cellLevel: 'Uint8Array',
  cellCentre: 'Float64Array',
  cellRegion: 'Uint32Array',
  cellVolume: 'Float64Array',
  cellCentroid: 'Float64Array',
  cellMemberOffsets: 'Uint32Array',
  cellMembers: 'Uint32Array',
  faceMemberOffsets: 'Uint32Array',
  faceMembers: 'Uint32Array',
  madeFrom: 'Fingerprint',
  fingerprint: 'Fingerprint',
};

export const SubComplex = {
  cells: 'CellComplex',
  wholeVertex: 'Uint32Array',
  wholeFace: 'Uint32Array',
  wholeCell: 'Uint32Array',
};

export const OctreeCells = {
  gridCells: 'integer[3]',
  cellCorner: 'Int32Array',
  cellLevel: 'Uint8Array',
  cellRegion: 'Uint32Array',
  madeFrom: 'Fingerprint',
  fingerprint: 'Fingerprint',
};

export const Flow = {
  status: 'SolveStatus',
  residuals: 'Float64Array',
  wind: 'number[3]',
  phi: 'Float64Array',
  faceVelocity: 'Float64Array',
  cellVelocity: 'Float64Array',
  cellGradient: 'Float64Array',
  cellPressure: 'Float64Array',
  throttled: 'Uint32Array',
  madeFrom: 'Fingerprint',
};

export const Streamlines = {
  points: 'Float64Array',
  speeds: 'Float64Array',
  offsets: 'Uint32Array',
  ends: 'Uint8Array',
};

export const MergedCells = {
  cells: 'CellComplex',
  mergedCell: 'Uint32Array',
  pockets: 'Uint32Array',
};

export const ComplexEdges = {
  vertices: 'Uint32Array',
  madeFrom: 'Fingerprint',
};

export const Boundary = {
  halfFaces: 'Uint32Array',
  condition: 'Uint8Array',
  value: 'Float64Array',
  coefficient: 'Float64Array',
  madeFrom: 'Fingerprint',
};

export const CellComponents = {
  cellComponent: 'Uint32Array',
  count: 'integer',
};

export const PoissonSystem = {
  matrix: 'SparseMatrix',
  rhs: 'Float64Array',
  nullSpace: 'SparseMatrix',
};

export const Solution = {
  status: 'SolveStatus',
  phi: 'Float64Array',
  residuals: 'Float64Array',
  faceDerivative: 'Float64Array',
  boundaryDerivative: 'Float64Array',
  incompatible: 'Uint32Array',
  excess: 'Float64Array',
  unresolved: 'Uint32Array',
};

export const RefinedCells = {
  cells: 'CellComplex',
  cutMesh: 'CutMeshArrays',
  levels: 'integer',
};

export const UnsteadyFlow = {
  time: 'number',
  faceVelocity: 'Float64Array',
  cellVelocity: 'Float64Array',
  cellPressure: 'Float64Array',
  madeFrom: 'Fingerprint',
};

export const FlowStep = {
  status: 'SolveStatus',
  timeStep: 'number',
  courant: 'number',
  divergence: 'number',
  iterations: 'integer',
};

export const SurfaceForce = {
  pressure: 'number[3]',
  viscous: 'number[3]',
  moment: 'number[3]',
};

export const FaceTag = ['xMin', 'xMax', 'yMin', 'yMax', 'zMin', 'zMax', 'inner', 'surface'];

export const StreamlineEnd = ['side', 'surface', 'rest', 'maxLength', 'maxPoints', 'outside'];

export const DualPoints = ['centres', 'centroids'];

export const Condition = ['neumann', 'dirichlet', 'robin'];

export const FreeConstant = ['zeroMean', 'pinned'];

export const SolveStatus = ['converged', 'iterationLimit', 'incompatible', 'unresolved', 'breakdown'];
