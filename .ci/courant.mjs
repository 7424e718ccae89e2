// OpenFOAM's icoFoam runs on our polyMeshes: none stops it or forces shorter steps on it.
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fail, run } from '../tests/steps.mjs';
import { makeLaminarCase, runIcoFoam } from './laminar_foam.mjs';

const most = 1.5; // Courant number, where the wind alone has 0.2
const n = 24;
const options = [
  '--cells',
  String(n),
  '--margin',
  '1',
  '--coarsen',
  '3',
  '--merge',
  '0.2',
  '--unite-walls',
  '30',
  '--only',
  'outside,region=0',
];

/** Ends the program unless icoFoam does 60 steps about each mesh, with Courant numbers of at most 1.5. */
export function checkCourantNumbers(meshes) {
  const rows = meshes.map((mesh) => {
    const folder = makeLaminarCase();
    const report = join(folder, 'report.json');
    run('build/mandoline', 'cut', mesh, ...options, '--report', report, '-o', join(folder, 'constant', 'polyMesh'));
    const h = JSON.parse(readFileSync(report, 'utf8')).grid.spacing[0];
    const courant = runIcoFoam(folder, { size: (h * n) / 3, h });
    if (!(courant <= most)) fail(`icoFoam on the polyMesh of ${mesh}: Courant number ${courant}; at most ${most} is wanted.`);
    return { mesh: basename(mesh), 'Courant number': courant };
  });
  console.log('Largest Courant numbers of icoFoam:');
  console.table(rows);
}
