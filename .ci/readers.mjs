// What other programs say of the files: OpenFOAM's checkMesh of polyMeshes, and VTK of .vtu files.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fail, path, run } from '../tests/steps.mjs';

const foam = '/usr/share/openfoam'; // Debian's
const dictionary = (name, entries) => `FoamFile { version 2.0; format ascii; class dictionary; object ${name}; }\n${entries}\n`;
const controls = 'startFrom startTime; startTime 0; stopAt endTime; endTime 0; deltaT 1; writeControl timeStep; writeInterval 1;';

const schemes = 'divSchemes {} gradSchemes {} laplacianSchemes {}'; // which no mesh is read without

/** An empty case, which is also the home folder where OpenFOAM looks for its own settings. */
function makeCase() {
  const folder = path('build', 'openfoam');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, 'system'), { recursive: true });
  mkdirSync(join(folder, '.OpenFOAM'));
  for (const file of ['controlDict', 'cellModels']) cpSync(join(foam, 'etc', file), join(folder, '.OpenFOAM', file));
  writeFileSync(join(folder, 'system', 'controlDict'), dictionary('controlDict', controls));
  for (const name of ['fvSchemes', 'fvSolution']) writeFileSync(join(folder, 'system', name), dictionary(name, schemes));
  return folder;
}

/** The complaints of a part of checkMesh's report: lines that begin with ***. */
const complaints = (text) => text.split('\n').filter((line) => /^\s*\*\*\*/.test(line));

const kinds = { pyramids: /face pyramids: (\d+)/, skewness: /(\d+) highly skew/, 'non-orthogonality': /severely non-orthogonal.*: (\d+)/ };

/**
 * Writes and checks the polyMesh of every mesh, at N = 8 and each with another --coarsen. Ends the program if checkMesh finds a failure of
 * topology. What it says of geometry is printed: surfaces leave slivers and cells that are not convex.
 */
export function checkPolyMeshes(meshes) {
  const folder = makeCase();
  const rows = [];
  meshes.forEach((mesh, i) => {
    const levels = String(i % 4);
    run('build/mandoline', 'cut', mesh, '--cells', '8', '--coarsen', levels, '--report', join(folder, 'report.json'),
      '-o', join(folder, 'constant', 'polyMesh'));
    const { stdout, status } = spawnSync('checkMesh', ['-allTopology', '-case', folder], {
      encoding: 'utf8', maxBuffer: 2 ** 28, env: { ...process.env, HOME: folder, WM_PROJECT_DIR: foam },
    });
    const [, topology, geometry] = stdout.split(/^Checking topology\.\.\.$|^Checking geometry\.\.\.$/m);
    if (status !== 0 || !geometry || !topology.includes('Upper triangular ordering OK')) fail(`checkMesh failed on ${mesh}:\n${stdout}`);
    const failures = complaints(topology);
    if (failures.length > 0) fail(`checkMesh finds failures of topology in ${mesh}:\n${failures.join('\n')}`);
    const count = (what) => Number(stdout.match(new RegExp(`^ +${what}: +(\\d+)`, 'm'))[1]);
    const row = { mesh: basename(mesh), coarsen: levels, cells: count('cells'), faces: count('faces') };
    for (const [kind, pattern] of Object.entries(kinds)) row[kind] = Number(geometry.match(pattern)?.[1] ?? 0);
    row.others = complaints(geometry).filter((line) => !Object.values(kinds).some((pattern) => pattern.test(line))).length;
    rows.push(row);
  });
  console.log(`checkMesh -allTopology: no failure of topology in ${rows.length} polyMeshes. Faces of which it criticizes the geometry:`);
  console.table(rows);
}

/** Requires that VTK reads the cells of each mesh, as they are and coarsened, as polyhedra with the volumes that the file says. */
export function checkVtuFiles(meshes) {
  for (const mesh of meshes) {
    const files = ['plain', '2'].map((levels) => {
      const file = path('build', `cells-${levels}.vtu`);
      run('build/mandoline', 'cut', mesh, '--cells', '8', '--report', path('build', 'report.json'),
        ...(levels === 'plain' ? [] : ['--coarsen', levels]), '-o', file);
      return file;
    });
    run('/usr/bin/python3', '.ci/check_vtu.py', ...files);
  }
}
