// Written by wasm/results.mjs from the headers in src/include/mandoline: change those.

export const StageTime = {
  stage: 'string',
  ms: 'number',
};

export const PartCounts = {
  winding: 'integer',
  parity: 'integer',
  open: 'integer',
  openEdges: 'integer',
  holes: 'integer',
};

export const CutStats = {
  stages: 'array',
  totalMs: 'number',
  exactFallbacks: 'integer',
  weldedVertices: 'integer',
  zeroAreaTriangles: 'integer',
  outsideTriangles: 'integer',
  duplicateTriangles: 'integer',
  intersections: 'PairCounts',
  intersectionCurves: 'integer',
  madeVertices: 'integer',
  snappedVertices: 'integer',
  largestSnap: 'number',
  flushedCoordinates: 'integer',
  parts: 'PartCounts',
};

export const CutMesh = {
  grid: 'Grid',
  positions: 'Float64Array',
  vertexCell: 'Int32Array',
  vertexMask: 'Uint8Array',
  vertexTriVertex: 'Int32Array',
  vertexParents: 'Int32Array',
  madeVertices: 'Uint32Array',
  madeVertexKinds: 'Uint8Array',
  madeVertexParents: 'Int32Array',
  loopOffsets: 'Uint32Array',
  loopVertices: 'Uint32Array',
  faceLoopOffsets: 'Uint32Array',
  faceTriangle: 'Int32Array',
  faceParentOffsets: 'Uint32Array',
  faceParents: 'Uint32Array',
  faceParentSigns: 'Int8Array',
  faceAxis: 'Int8Array',
  facePlane: 'Int32Array',
  cellHalfFaceOffsets: 'Uint32Array',
  cellHalfFaces: 'Uint32Array',
  cellGridCell: 'Int32Array',
  cellRegion: 'Uint32Array',
  rowRunOffsets: 'Uint32Array',
  runBegin: 'Int32Array',
  runEnd: 'Int32Array',
  runRegion: 'Uint32Array',
  regionCount: 'integer',
  regionWinding: 'Int32Array | null',
  regionPartWinding: 'Int32Array | null',
  regionParity: 'Uint8Array | null',
  regionInsideness: 'Float64Array | null',
  parityTriangles: 'Uint32Array',
  openTriangles: 'Uint32Array',
  triangleCount: 'integer',
  droppedTriangles: 'Uint32Array',
  snapTolerance: 'number',
  madeFrom: 'Fingerprint',
  fingerprint: 'Fingerprint',
};

export const CellDrawing = {
  positions: 'Float32Array',
  normals: 'Int8Array',
  vertexCell: 'Uint32Array',
  triangles: 'Uint32Array',
  surfaceTriangles: 'integer',
  edges: 'Uint32Array',
  hybridEdges: 'integer',
  gridEdges: 'integer',
  cellVolume: 'Float64Array',
  cellCentroid: 'Float32Array',
  madeFrom: 'Fingerprint',
};

export const InsideRegions = {
  isInside: 'Uint8Array',
  by: 'InsideBy',
  isComplete: 'boolean',
};

export const MeshInfo = {
  vertices: 'integer',
  triangles: 'integer',
  min: 'number[3]',
  max: 'number[3]',
  closed: 'boolean',
  oriented: 'boolean',
  openEdges: 'integer',
  nonManifoldEdges: 'integer',
  inconsistentEdges: 'integer',
  components: 'integer',
  zeroAreaTriangles: 'integer',
  duplicateTriangles: 'integer',
  weldedVertices: 'integer',
  unreferencedVertices: 'integer',
  nonFiniteVertices: 'integer',
  triangleComponent: 'Int32Array',
  componentClosed: 'Uint8Array',
  componentOriented: 'Uint8Array',
  defectVertices: 'Uint32Array',
  defectKind: 'Uint8Array',
  defectTriangleOffsets: 'Uint32Array',
  defectTriangles: 'Uint32Array',
  defectPlace: 'Uint32Array',
  placeComponent: 'Uint32Array',
  placeBox: 'Float64Array',
};

export const PairCounts = {
  crossing: 'integer',
  touching: 'integer',
  overlapping: 'integer',
  folded: 'integer',
  identical: 'integer',
};

export const MeshIntersections = {
  counts: 'PairCounts',
  pairTriangles: 'Uint32Array',
  pairKinds: 'Uint8Array',
  pairPointOffsets: 'Uint32Array',
  positions: 'Float64Array',
};

export const Locations = {
  cell: 'Int32Array',
  gridCell: 'Int32Array',
  region: 'Int32Array',
};

export const Measures = {
  faceArea: 'Float64Array',
  faceNormal: 'Float64Array',
  faceCentroid: 'Float64Array',
  cellVolume: 'Float64Array',
  cellCentroid: 'Float64Array',
  madeFrom: 'Fingerprint',
};

export const CutEdges = {
  edgeVertices: 'Uint32Array',
  edgeLength: 'Float64Array',
};

export const Adjacency = {
  faceCells: 'Int32Array',
  faceGridCells: 'Float64Array',
  cellCellOffsets: 'Uint32Array',
  cellCells: 'Uint32Array',
};

export const Mesh = {
  positions: 'Float64Array',
  triangles: 'Uint32Array',
};

export const TriangleGroups = {
  names: 'array',
  triangleGroup: 'Uint32Array',
};

export const OrientedMesh = {
  mesh: 'MeshArrays',
  turnedTriangles: 'Uint32Array',
  trianglePatch: 'Int32Array',
  patchFacing: 'Uint8Array',
};

export const ResolvedMesh = {
  positions: 'Float64Array',
  triangles: 'Uint32Array',
  vertexTriVertex: 'Int32Array',
  parentOffsets: 'Uint32Array',
  parents: 'Uint32Array',
  parentSigns: 'Int8Array',
  frontWinding: 'Int32Array | null',
  backWinding: 'Int32Array | null',
  frontPartWinding: 'Int32Array | null',
  backPartWinding: 'Int32Array | null',
  frontParity: 'Uint8Array | null',
  backParity: 'Uint8Array | null',
};

export const Slice = {
  positions: 'Float64Array',
  loopOffsets: 'Uint32Array',
  loopPoints: 'Uint32Array',
  polygonLoopOffsets: 'Uint32Array',
  polygonCell: 'Int32Array',
  polygonGridCell: 'Int32Array',
  polygonRegion: 'Uint32Array',
  polygonTriangleOffsets: 'Uint32Array',
  triangles: 'Uint32Array',
};

export const Outlines = {
  positions: 'Float64Array',
  loopOffsets: 'Uint32Array',
  loopPoints: 'Uint32Array',
  polygonLoopOffsets: 'Uint32Array',
  polygonRegion: 'Uint32Array',
  slitOffsets: 'Uint32Array',
  slitPoints: 'Uint32Array',
  slitRegion: 'Uint32Array',
};

export const Progress = {
  stage: 'string',
  stageIndex: 'integer',
  stageCount: 'integer',
  done: 'integer',
  total: 'integer',
};

export const FaceTriangles = {
  faceTriangleOffsets: 'Uint32Array',
  triangles: 'Uint32Array',
  madeFrom: 'Fingerprint',
};

export const Check = {
  name: 'string',
  pass: 'boolean',
  skipped: 'boolean',
  worst: 'number',
  tolerance: 'number',
  elementKind: 'string',
  element: 'integer',
  message: 'string',
};

export const Validation = {
  pass: 'boolean',
  checks: 'array',
};

export const MadeVertex = ['edgeTriangle', 'edgeEdge', 'triangles', 'trianglesPlane'];

export const Element = [
  'vertex',
  'loop',
  'loopVertex',
  'face',
  'faceParent',
  'madeVertex',
  'cell',
  'cellHalfFace',
  'row',
  'run',
  'region',
  'parityTriangle',
  'openTriangle',
  'droppedTriangle',
];

export const WindingRule = ['positive', 'nonZero', 'odd'];

export const InsideBy = ['winding', 'parity', 'estimate'];

export const EdgeDefect = ['open', 'nonManifold', 'inconsistent'];

export const Intersections = ['resolve', 'refuse', 'assumeNone'];

export const IntersectionKind = ['crossing', 'touching', 'overlapping', 'folded', 'identical'];

export const FileFormat = ['json', 'mcm', 'vtu', 'obj', 'stl', 'ply', 'off', 'svg', 'dxf'];

export const Facing = ['outward', 'inward', 'unknown', 'nonOrientable'];

export const Status = [
  'ok',
  'cancelled',
  'emptyMesh',
  'badArrays',
  'badIndex',
  'nonFiniteCoordinate',
  'badGrid',
  'gridTooLarge',
  'badOption',
  'selfIntersection',
  'meshTooLarge',
  'outOfMemory',
  'internalError',
  'badArgument',
];
