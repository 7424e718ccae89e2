// Decomposed cases of several processes against the polyMesh of one: their addressing, checkMesh, reconstructParMesh, and potentialFoam with
// the fluxes that reconstructPar puts together.
import { cpSync, readFileSync, rmSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fail, path, run } from '../tests/steps.mjs';
import { callFoam, makeCase, timed, writeField, writeInput } from './openfoam.mjs';
import { fields, listIn, schemes, solution } from './potential_foam.mjs';
import { scans } from './scans.mjs';

const processes = 3;
// Open MPI refuses to be root, and more processes than cores, unless it is told.
Object.assign(process.env, {
  OMPI_ALLOW_RUN_AS_ROOT: '1',
  OMPI_ALLOW_RUN_AS_ROOT_CONFIRM: '1',
  OMPI_MCA_rmaps_base_oversubscribe: '1',
  OMPI_MCA_hwloc_base_binding_policy: 'none',
});

const polyMesh = (folder) => join(folder, 'constant', 'polyMesh');
const parts = (folder) => Array.from({ length: processes }, (_, rank) => join(folder, `processor${rank}`));

/** What a program of OpenFOAM prints in all processes. */
function callParallel(folder, program, ...options) {
  const env = { ...process.env, HOME: folder, WM_PROJECT_DIR: '/usr/share/openfoam' };
  const { output, status } = timed(['mpirun', '-n', String(processes), program, '-parallel', ...options, '-case', folder], env);
  if (status !== 0) fail(`${program} failed in ${processes} processes:\n${output}`);
  return output;
}

/** The faces of a polyMesh, each as names of its points, whichever of these is the first and whichever side it is seen from. */
function facesIn(folder, nameOf) {
  const text = readFileSync(join(folder, 'faces'), 'utf8');
  return [...text.matchAll(/^\d+\s*\(([\d\s]+)\)/gm)].map(([, list]) => {
    const names = list.trim().split(/\s+/).map(nameOf);
    const fromLowest = (list) => {
      const lowest = list.reduce((least, name, i) => (name < list[least] ? i : least), 0);
      return [...list.slice(lowest), ...list.slice(0, lowest)].join(' ');
    };
    const [here, there] = [fromLowest(names), fromLowest(names.toReversed())];
    return here < there ? here : there;
  });
}

/** The patches of a polyMesh and their numbers of faces, without those between processes. */
const patchesIn = (folder) =>
  [...readFileSync(join(folder, 'boundary'), 'utf8').matchAll(/^\s*(\S+)\s*\{\s*type\s+(patch|wall);[^}]*nFaces\s+(\d+);/gm)]
    .map(([, ...words]) => words.join(' '))
    .join(', ');

/** Each point of the whole, put there from the pieces by their addressing. */
function pointsOf(whole, folder) {
  const points = listIn(polyMesh(whole), 'points');
  const put = new Float64Array(points.length).fill(NaN);
  for (const part of parts(folder)) {
    const of = listIn(polyMesh(part), 'pointProcAddressing');
    listIn(polyMesh(part), 'points').forEach((x, i) => (put[3 * of[Math.floor(i / 3)] + (i % 3)] = x));
  }
  return [points, put];
}

/** reconstructParMesh knows nothing of our addressing, and numbers cells in its own way, which turns faces: they are the same by their points. */
function checkReconstruction(whole, folder, mesh) {
  callFoam(whole, 'transformPoints', '-translate', '(0 0 0)'); // as OpenFOAM reads points: it rounds some of the last digits
  callFoam(folder, 'reconstructParMesh', '-constant', '-mergeTol', '1e-12');
  const faces = (at) => {
    const points = listIn(polyMesh(at), 'points');
    return facesIn(polyMesh(at), (p) => points.slice(3 * p, 3 * p + 3).join(',')).sort();
  };
  const [expected, made] = [faces(whole), faces(folder)];
  if (expected.length !== made.length) fail(`reconstructParMesh makes ${made.length} faces of ${mesh}, not ${expected.length}.`);
  const others = expected.filter((face, i) => face !== made[i]).length;
  if (others > 0) fail(`reconstructParMesh makes ${others} other faces of ${mesh}.`);
}

function writeFields(folder) {
  for (const [name, field] of Object.entries(fields)) {
    const value = field.type === 'volVectorField' ? '(0 0 0)' : '0';
    writeField(folder, name, { ...field, patches: { ...field.patches, '"procBoundary.*"': `processor; value uniform ${value}` } });
  }
}

/** The largest difference of the fluxes through faces, relative to the largest. */
function fluxDifference(whole, folder) {
  writeFields(whole);
  callFoam(whole, 'potentialFoam', '-writephi');
  for (const part of parts(folder)) writeFields(part);
  callParallel(folder, 'potentialFoam', '-writephi');
  cpSync(polyMesh(whole), polyMesh(folder), { recursive: true });
  callFoam(folder, 'reconstructPar', '-withZero', '-fields', '(phi)');
  const [expected, made] = [listIn(whole, '0', 'phi'), listIn(folder, '0', 'phi')];
  if (expected.length !== made.length) fail('The cases have other numbers of faces.');
  const largest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  return largest(expected.map((value, f) => value - made[f])) / largest(expected);
}

/** `cells`: options that say which. */
function check(mesh, ...cells) {
  const folder = makeCase({ schemes, solution, precision: 17 });
  writeInput(
    folder,
    'system',
    'decomposeParDict',
    'dictionary',
    `numberOfSubdomains ${processes}; method simple; coeffs { n (1 1 ${processes}); }`,
  );
  const whole = path('build', 'openfoam-whole');
  rmSync(whole, { recursive: true, force: true });
  cpSync(folder, whole, { recursive: true });
  const options = [mesh, '--cells', '12', ...cells, '--report', join(folder, 'report.json'), '-o'];
  run('build/mandoline', 'cut', ...options, polyMesh(whole));
  run('mpirun', '-n', String(processes), 'build/mandoline-mpi', 'cut', ...options, polyMesh(folder));
  const topology = (report) => report.split(/^Checking topology\.\.\.$|^Checking geometry\.\.\.$/m)[1] ?? '';
  const told = (text) =>
    text
      .split('\n')
      .filter((line) => /\*\*\*|OK\.$|Number of regions/.test(line))
      .join('\n');
  const [expected, made] = [callFoam(whole, 'checkMesh', '-allTopology'), callParallel(folder, 'checkMesh', '-allTopology')].map(topology);
  if (!made.includes('Upper triangular ordering OK') || told(made) !== told(expected))
    fail(`checkMesh says of ${mesh} in pieces:\n${made}`);
  const [points, put] = pointsOf(whole, folder);
  if (!points.every((x, i) => x === put[i])) fail(`The points of ${mesh} are not those of the pieces.`);
  const difference = fluxDifference(whole, folder);
  if (!(difference <= 1e-9)) fail(`${mesh}: in pieces potentialFoam's fluxes are others, by ${difference} of the largest.`);
  rmSync(polyMesh(folder), { recursive: true });
  checkReconstruction(whole, folder, mesh);
  if (patchesIn(polyMesh(whole)) !== patchesIn(polyMesh(folder))) fail(`reconstructParMesh makes other patches of ${mesh}.`);
  return {
    mesh: basename(mesh),
    cells: cells.join(' '),
    faces: facesIn(polyMesh(whole), Number).length,
    'fluxes off': difference.toExponential(1),
  };
}

const made = ['box', 'sphere', 'torus-knot'].map((shape) => {
  run('build/mandoline', 'make', shape, '-o', `build/${shape}.obj`);
  return `build/${shape}.obj`;
});
const kinds = [[], ['--coarsen', '2,0'], ['--merge', '0.2'], ['--merge', '0.2', '--coarsen', '2,0', '--unite-walls', '30']];
const rows = [...made, ...scans].flatMap((mesh) => kinds.map((cells) => check(mesh, ...cells)));
console.log(`Cases in ${processes} parts against whole ones:`);
console.table(rows);
