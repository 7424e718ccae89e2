// Makes the README's picture of a flow with the command line and VTK: xvfb-run node tests/page/flow_picture.mjs
import { writeFileSync } from 'node:fs';
import bunny from 'bunny';
import { path, run, setUp } from '../steps.mjs';

setUp("Debian's VTK for Python");
const words = (letter, rows, first) => rows.map((row) => `${letter} ${row.map((value) => value + first).join(' ')}\n`).join('');
writeFileSync(path('build', 'bunny.obj'), words('v', bunny.positions, 0) + words('f', bunny.cells, 1));
run(
  'build/mandoline',
  'flow',
  'build/bunny.obj',
  '--wind',
  '1,0,0',
  '--cells',
  '160',
  '--coarsen',
  '6',
  '--margin',
  '0.6',
  '--streamlines',
  '500',
  '-o',
  'build/flow.vtu',
  'build/flow.obj',
);
run('/usr/bin/python3', 'tests/page/flow_picture.py', 'build/flow.vtu', 'build/flow.obj', 'build/bunny.obj', 'web/pictures/flow.png');
