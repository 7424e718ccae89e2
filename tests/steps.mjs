// Steps that npm start, npm test, npm run bench and the continuous integration have in common.
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { availableParallelism } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = dirname(dirname(fileURLToPath(import.meta.url)));
export const jobs = String(availableParallelism());

/** Runs a command in the project's folder, its output going to the terminal; ends the program if it fails. */
export function run(command, ...args) {
  console.log(`\n> ${[command, ...args].join(' ')}`);
  const { status, error } = spawnSync(command, args, { cwd: root, stdio: 'inherit' });
  if (error) fail(`can't run ${command}: ${error.message}`);
  if (status !== 0) process.exit(status ?? 1);
}

/** Runs commands side by side, each a list of words. Ends the program, once all have ended, if one has failed. */
export async function runTogether(...commands) {
  const runs = commands.map(async ([command, ...args]) => {
    const text = [command, ...args].join(' ');
    console.log(`\n> ${text} &`);
    const [status] = await once(spawn(command, args, { cwd: root, stdio: 'inherit' }), 'exit');
    if (status !== 0) console.error(`failed: ${text}`);
    return status ?? 1;
  });
  const failure = (await Promise.all(runs)).find((status) => status !== 0);
  if (failure !== undefined) process.exit(failure);
}

export function fail(message) {
  console.error(message);
  process.exit(1);
}

/** Configures the folder with CMake's options and builds a target there, or all. Folders of sources are compiled as one: in half the time. */
export function build(folder, options, target = 'all') {
  run('cmake', '-S', '.', '-B', folder, '-DCMAKE_UNITY_BUILD=ON', ...options);
  run('cmake', '--build', folder, '--parallel', jobs, '--target', target);
}

export const path = (...parts) => join(root, ...parts);
