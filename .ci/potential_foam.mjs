// Potential flow on our polyMeshes by OpenFOAM's potentialFoam, against ours: what flows from cell to cell.
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fail, run } from '../tests/steps.mjs';
import { callFoam, makeCase, writeField } from './openfoam.mjs';

// Two cells are as far apart as their centroids are along the normal of their face, as ours with dualPoints "centroids".
export const schemes = `gradSchemes { default Gauss linear; } divSchemes { default Gauss linear; } interpolationSchemes { default linear; }
laplacianSchemes { default Gauss linear uncorrected; } snGradSchemes { default uncorrected; }`;
export const solution = `solvers { Phi { solver PCG; preconditioner none; tolerance 1e-12; relTol 0; maxIter 5000; } }
potentialFlow { nNonOrthogonalCorrectors 0; }`;

// A wind of speed 1 enters at xMin and leaves at xMax.
export const fields = {
  U: {
    type: 'volVectorField',
    dimensions: '[0 1 -1 0 0 0 0]',
    inside: '(0 0 0)',
    patches: { xMin: 'fixedValue; value uniform (1 0 0)', xMax: 'zeroGradient', '".*"': 'slip' },
  },
  Phi: {
    type: 'volScalarField',
    dimensions: '[0 2 -1 0 0 0 0]',
    inside: '0',
    patches: { xMax: 'fixedValue; value uniform 0', '".*"': 'zeroGradient' },
  },
  p: {
    type: 'volScalarField',
    dimensions: '[0 2 -2 0 0 0 0]',
    inside: '0',
    patches: { xMax: 'fixedValue; value uniform 0', '".*"': 'zeroGradient' },
  },
};
const conditions = { xMin: { neumann: -1 }, xMax: { dirichlet: 0 } };

/** The first list of a file of OpenFOAM, all its numbers. */
export function listIn(...parts) {
  const text = readFileSync(join(...parts), 'utf8');
  const [list] = /^\d+\s*\n\(\n[\s\S]*?\n\)/m.exec(text);
  return Float64Array.from(list.replace(/^\d+/, '').replace(/[()]/g, ' ').trim().split(/\s+/), Number);
}

/** What flows between each two cells, from the one of lower number. `sides`: two cells of each face. */
function fluxes(sides) {
  const sums = new Map();
  for (const [from, to, flux] of sides) {
    const key = from < to ? `${from} ${to}` : `${to} ${from}`;
    sums.set(key, (sums.get(key) ?? 0) + (from < to ? flux : -flux));
  }
  return sums;
}

/** Fluxes as OpenFOAM finds them, and its centroids of the cells. */
function theirs(mesh, n) {
  const folder = makeCase({ schemes, solution, precision: 17 });
  const polyMesh = join(folder, 'constant', 'polyMesh');
  run('build/mandoline', 'cut', mesh, '--cells', String(n), '--coarsen', '0', '--report', join(folder, 'report.json'), '-o', polyMesh);
  for (const [name, field] of Object.entries(fields)) writeField(folder, name, field);
  callFoam(folder, 'potentialFoam', '-writephi');
  callFoam(folder, 'postProcess', '-func', 'writeCellCentres');
  const [owner, neighbour] = [listIn(polyMesh, 'owner'), listIn(polyMesh, 'neighbour')];
  const flux = listIn(folder, '0', 'phi');
  return { fluxes: fluxes(Array.from(flux, (value, f) => [owner[f], neighbour[f], value])), centroids: listIn(folder, '0', 'C') };
}

/** Without corrections, as potentialFoam with the schemes above. */
function ours({ boundaryOf, operators, solvePoisson }, cells, dualPoints) {
  const problem = { boundary: boundaryOf(cells, conditions), dualPoints };
  const { phi, status } = solvePoisson(cells, problem, { tolerance: 1e-12, corrections: 0 });
  if (status !== 'converged') fail(`Our solution: ${status}`);
  const {
    gradient: { rowOffsets, entryColumns, entryValues },
  } = operators(cells, { only: ['gradient'], dualPoints });
  return fluxes(
    Array.from(cells.faceArea, (area, f) => {
      let derivative = 0;
      for (let i = rowOffsets[f]; i < rowOffsets[f + 1]; ++i) derivative += entryValues[i] * phi[entryColumns[i]];
      return [cells.faceCells[2 * f], cells.faceCells[2 * f + 1], derivative * area];
    }).filter((_, f) => cells.faceTag[f] === 6),
  );
}

/** The largest difference, relative to the largest flux. */
function difference(mine, expected) {
  if (mine.size !== expected.size || ![...mine.keys()].every((key) => expected.has(key)))
    fail('Other cells are neighbours in the polyMesh.');
  const largest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  return largest([...mine].map(([key, flux]) => flux - expected.get(key))) / largest([...mine.values()]);
}

/**
 * Ends the program unless ours are potentialFoam's fluxes, to its solver's tolerance, once cells have the centroids that it computes: those
 * are off beside faces that are not convex. Prints also how far ours are with our centroids, and with the centres that solveFlow() takes.
 */
export async function checkPotentialFoam(meshes) {
  const { init } = await import('mandoline-wasm');
  const { initPhysics } = await import('mandoline-wasm/physics');
  const [{ cut, readMesh }, physics] = await Promise.all([init(), initPhysics()]);
  const n = 16;
  const rows = [];
  for (const path of meshes) {
    const mesh = await readMesh(readFileSync(path), { name: basename(path) });
    const cells = physics.cellComplex(mesh, cut(mesh, { cells: n }));
    const { fluxes: expected, centroids } = theirs(path, n);
    const off = (complex, dualPoints) => difference(ours(physics, complex, dualPoints), expected);
    const [itsCentroids, ...others] = [
      off({ ...cells, cellCentroid: centroids }, 'centroids'),
      off(cells, 'centroids'),
      off(cells, 'centres'),
    ].map((value) => value.toExponential(1));
    if (!(itsCentroids <= 1e-10)) fail(`${path}: potentialFoam's fluxes are others, by ${itsCentroids} of the largest.`);
    rows.push({
      mesh: basename(path),
      cells: cells.cellRegion.length,
      'its centroids': itsCentroids,
      centroids: others[0],
      centres: others[1],
    });
  }
  console.log('Fluxes of potentialFoam and ours, largest difference of the largest flux:');
  console.table(rows);
}
