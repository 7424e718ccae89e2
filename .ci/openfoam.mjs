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

/** An empty case in the build folder, which is also the home folder where OpenFOAM looks for its own settings. */
export function makeCase({ schemes, solution, precision = 6 }) {
  const folder = path('build', 'openfoam');
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, '.OpenFOAM'), { recursive: true });
  for (const file of ['controlDict', 'cellModels']) cpSync(join(etc, 'etc', file), join(folder, '.OpenFOAM', file));
  writeControls(folder, { precision });
  for (const [name, entries] of Object.entries({ fvSchemes: schemes, fvSolution: solution }))
    writeInput(folder, 'system', name, 'dictionary', entries);
  return folder;
}

/** How long a program runs: none of the solvers' steps by default. */
export function writeControls(folder, { steps = 0, step = 1, precision = 6, functions = '' }) {
  const time = `startFrom startTime; startTime 0; stopAt endTime; endTime ${steps * step}; deltaT ${step};`;
  const output = `writeControl timeStep; writeInterval ${steps || 1}; writePrecision ${precision};`;
  writeInput(folder, 'system', 'controlDict', 'dictionary', `${time} ${output} functions { ${functions} }`);
}

/** Writes a field that is uniform at first. `patches`: by name or quoted pattern, the type of its condition and what else it takes. */
export function writeField(folder, name, { type, dimensions, inside, patches }) {
  const conditions = Object.entries(patches).map(([patch, what]) => `${patch} { type ${what}; }`);
  const entries = `dimensions ${dimensions};\ninternalField uniform ${inside};\nboundaryField { ${conditions.join(' ')} }`;
  writeInput(folder, '0', name, type, entries);
}

/** What the program prints, its exit status and its cpu time in seconds. */
export function tryFoam(folder, program, ...options) {
  return timed([program, ...options, '-case', folder], { ...process.env, HOME: folder, WM_PROJECT_DIR: etc });
}

/** Runs a command as `tryFoam` does. */
export function timed(command, env = process.env) {
  const script = 'TIMEFORMAT="%U %S"; time "$@" 2>&1';
  const { stdout, stderr, status } = spawnSync('bash', ['-c', script, 'bash', ...command], {
    cwd: path(),
    encoding: 'utf8',
    maxBuffer: 2 ** 28,
    env,
  });
  const seconds = stderr.trim().split(/\s+/).slice(-2).map(Number);
  return { output: stdout, status, seconds: seconds[0] + seconds[1] };
}

/** What the program prints. Ends this one if it fails. */
export function callFoam(folder, program, ...options) {
  const { output, status } = tryFoam(folder, program, ...options);
  if (status !== 0) fail(`${program} failed:\n${output}`);
  return output;
}
