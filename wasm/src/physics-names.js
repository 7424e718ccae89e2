// Written by wasm/signatures.mjs from physics/calls.js: change that.

export const physicsNames = [
  'coarsen',
  'cellComplex',
  'mergeSmallCells',
  'uniteWalls',
  'subComplex',
  'regionComplex',
  'complexEdges',
  'operators',
  'boundaryOf',
  'outwardNormals',
  'cellComponents',
  'poissonSystem',
  'solvePoisson',
  'solveFlow',
  'velocityAt',
  'streamlines',
  'inflowSeeds',
  'writeCells',
  'writeFaces',
  'writePolyMesh',
];
