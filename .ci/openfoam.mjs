// Cases of OpenFOAM, and its programs.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fail, path } from '../tests/steps.mjs';

const etc = '/usr/share/openfoam'; // Debian's

const head = (type, name) => `FoamFile { version 2.0; format ascii; class ${type}; object ${name}; }\n`;

/** Writes an input file of a case. */
export function writeInput(folder, part, name, type, entries) {
  mkdirSync(join(folder, part), { recursive: true });
  writeFileSync(join(folder, part, name), `${head(type, name)}${entries}\n`);
}

const controls = 'startFrom startTime; startTime 0; stopAt endTime; endTime 0; deltaT 1; writeControl timeStep; writeInterval 1;';

/** An empty case in the build folder, which is also the home folder where OpenFOAM looks for its own settings. */
export function makeCase({ schemes, solution, precision = 6 }) {
  const folder = path('build', 'openfoam');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, '.OpenFOAM'), { recursive: true });
  for (const file of ['controlDict', 'cellModels']) cpSync(join(etc, 'etc', file), join(folder, '.OpenFOAM', file));
  const dictionaries = { controlDict: `${controls} writePrecision ${precision};`, fvSchemes: schemes, fvSolution: solution };
  for (const [name, entries] of Object.entries(dictionaries)) writeInput(folder, 'system', name, 'dictionary', entries);
  return folder;
}

/** What the program prints. Ends this one if it fails. */
export function callFoam(folder, program, ...options) {
  const { stdout, stderr, status } = spawnSync(program, [...options, '-case', folder], {
    encoding: 'utf8',
    maxBuffer: 2 ** 28,
    env: { ...process.env, HOME: folder, WM_PROJECT_DIR: etc },
  });
  if (status !== 0) fail(`${program} failed:\n${stdout}\n${stderr}`);
  return stdout;
}
