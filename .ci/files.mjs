// What OpenFOAM and VTK say of the files that the build in build/ writes: of made meshes, and of real ones where there are any.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { meshFolder } from '../tests/mesh_folder.mjs';
import { path, run } from '../tests/steps.mjs';
import { checkCourantNumbers } from './courant.mjs';
import { checkPotentialFoam } from './potential_foam.mjs';
import { checkFilters, checkPolyMeshes, checkVtuFiles } from './readers.mjs';
import { scans } from './scans.mjs';

const made = ['box', 'sphere', 'torus', 'torus-knot'].map((shape) => {
  run('build/mandoline', 'make', shape, '-o', `build/${shape}.obj`);
  return `build/${shape}.obj`;
});
// A box and a ball, as groups under names that OpenFOAM does not take.
const [box, ball] = ['box', 'sphere'].map((shape) => readFileSync(path('build', `${shape}.obj`), 'utf8'));
const corners = box.match(/^v/gm).length;
const shifted = ball.replace(/^f .*/gm, (face) => face.replace(/\d+/g, (v) => Number(v) + corners));
writeFileSync(path('build', 'groups.obj'), `g xMin\n${box}g 2{ball}\n${shifted}`);
const beetle = 'common_beetle.obj.gz';
const all = meshFolder
  ? readdirSync(meshFolder)
      .filter((name) => name.endsWith('.obj.gz'))
      .sort()
  : [];
checkPolyMeshes([...made, 'build/groups.obj', ...all.filter((_, i) => i % 9 === 0).map((name) => join(meshFolder, name))]);
checkVtuFiles([...made, ...scans]);
// Two sheets that end in cells.
writeFileSync(path('build', 'sheets.obj'), 'v 0 0 0\nv 1 0.2 0\nv 0.1 1 0.3\nv 0.5 -0.3 -0.4\nv 0.4 0.3 0.6\nf 1 2 3\nf 1 4 5\n');
checkFilters(['build/sheets.obj', 'build/torus-knot.obj', ...scans]);
// One is closed. The others, where there is a folder of meshes, are a scan with hundreds of open or non-manifold edges, and a tube whose
// triangles pass planes of the grid by rounding alone.
const open = [beetle, 'thingi_741527.obj.gz'].filter((name) => all.includes(name)).map((name) => join(meshFolder, name));
checkCourantNumbers(['build/torus-knot.obj', ...(open.length > 0 ? open : ['build/groups.obj'])]);
await checkPotentialFoam(['build/sphere.obj', 'build/torus-knot.obj', ...scans]);
