// What other programs say of the files: OpenFOAM's checkMesh of polyMeshes, and VTK of .vtu files.
import { basename, join } from 'node:path';
import { fail, path, run } from '../tests/steps.mjs';
import { callFoam, makeCase } from './openfoam.mjs';

const schemes = 'divSchemes {} gradSchemes {} laplacianSchemes {}'; // which no mesh is read without

/** The complaints of a part of checkMesh's report: lines that begin with ***. */
const complaints = (text) => text.split('\n').filter((line) => /^\s*\*\*\*/.test(line));

const kinds = { pyramids: /face pyramids: (\d+)/, skewness: /(\d+) highly skew/, 'non-orthogonality': /severely non-orthogonal.*: (\d+)/ };

/**
 * Writes and checks the polyMesh of every mesh, at N = 8 and each with another --coarsen. Ends the program if checkMesh finds a failure of
 * topology. What it says of geometry is printed: surfaces leave slivers and cells that are not convex.
 */
export function checkPolyMeshes(meshes) {
  const folder = makeCase({ schemes, solution: '' });
  const rows = [];
  meshes.forEach((mesh, i) => {
    const levels = String(i % 4);
    run(
      'build/mandoline',
      'cut',
      mesh,
      '--cells',
      '8',
      '--coarsen',
      levels,
      '--report',
      join(folder, 'report.json'),
      '-o',
      join(folder, 'constant', 'polyMesh'),
    );
    const report = callFoam(folder, 'checkMesh', '-allTopology');
    const [, topology, geometry] = report.split(/^Checking topology\.\.\.$|^Checking geometry\.\.\.$/m);
    if (!geometry || !topology.includes('Upper triangular ordering OK')) fail(`checkMesh failed on ${mesh}:\n${report}`);
    const failures = complaints(topology);
    if (failures.length > 0) fail(`checkMesh finds failures of topology in ${mesh}:\n${failures.join('\n')}`);
    const count = (what) => Number(report.match(new RegExp(`^ +${what}: +(\\d+)`, 'm'))[1]);
    const row = { mesh: basename(mesh), coarsen: levels, cells: count('cells'), faces: count('faces') };
    for (const [kind, pattern] of Object.entries(kinds)) row[kind] = Number(geometry.match(pattern)?.[1] ?? 0);
    row.others = complaints(geometry).filter((line) => !Object.values(kinds).some((pattern) => pattern.test(line))).length;
    rows.push(row);
  });
  console.log(`checkMesh -allTopology: no failure of topology in ${rows.length} polyMeshes. Faces of which it criticizes the geometry:`);
  console.table(rows);
}

/** Requires that VTK reads the cells of each mesh, as they are, coarsened and in pieces, as polyhedra with the volumes that the file says. */
export function checkVtuFiles(meshes) {
  const plain = path('build', 'cells.vtu');
  const coarse = path('build', 'coarse-cells.vtu');
  const pieces = path('build', 'pieces');
  for (const mesh of meshes) {
    const cut = (...options) => run('build/mandoline', 'cut', mesh, '--report', path('build', 'report.json'), ...options);
    cut('--cells', '8', '-o', plain);
    cut('--cells', '8', '--coarsen', '2', '-o', coarse);
    cut('--cells', '130,4,4', '--stream', '-o', pieces); // two of them
    run('/usr/bin/python3', '.ci/check_vtu.py', plain, coarse, `${pieces}/cut.pvtu`);
  }
}

/** Requires that VTK's own filters take the cells of a flow about each mesh, written without faces inside cells. Some merged cells they don't. */
export function checkFilters(meshes) {
  const flow = path('build', 'flow.vtu');
  for (const mesh of meshes) {
    run('build/mandoline', 'flow', mesh, '--cells', '16', '--wind', '1,0,0', '--merge', '0', '--simple-cells', '-o', flow);
    run('/usr/bin/python3', '.ci/check_filters.py', flow);
  }
}
