// What the sources look like: formatted and linted, JavaScript's types, short files and functions of C++, and rooms that see only those
// before them. Run by itself, it checks what needs no build.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { setUp } from '../tests/set_up.mjs';
import { fail, jobs, path, run } from '../tests/steps.mjs';

// Of src. Each sees itself, those before it and the public headers, which base alone does without.
const rooms = ['base', 'mesh', 'grid', 'cut', 'operators', 'physics', 'io', 'mpi', 'cli'];
// Public headers of other libraries than that of the cut.
const ofOthers = [
  'io.h',
  'mesh_files.h',
  'operators.h',
  'csr_matrix.h',
  'poisson.h',
  'flow.h',
  'heat.h',
  'unsteady.h',
  'distributed.h',
  'rank_complex.h',
];
const mostLines = 350; // of a source file
const mostFunctionLines = 60;
const mostParameters = 5;

/** What a source file may not include, as messages. */
function wrongIncludes(file) {
  const room = rooms.indexOf(file.split('/')[1]);
  if (room < 0) return [];
  const included = [...readFileSync(path(file), 'utf8').matchAll(/^#include "([^"]+)"/gm)].map((match) => match[1]);
  const isSeen = (header) => {
    const [folder] = header.split('/');
    return folder === 'mandoline' ? room > 0 : rooms.indexOf(folder) <= room;
  };
  return included.filter((header) => !isSeen(header)).map((header) => `${file} includes ${header}`);
}

const files = execFileSync('git', ['ls-files', '*.h', '*.cpp'], { cwd: path(), encoding: 'utf8' }).trim().split('\n');
const sources = files.filter((file) => file.startsWith('src/'));

/** Public headers of the library of the cut that mandoline.h does not include, as messages. */
function headersLeftOut() {
  const folder = 'src/include/mandoline/';
  const among = (file) => [...readFileSync(path(folder, file), 'utf8').matchAll(/^#include "mandoline\/(.+)"/gm)].map((match) => match[1]);
  const seen = new Set(['mandoline.h']);
  for (const file of seen) for (const header of among(file)) seen.add(header);
  const headers = files.filter((file) => file.startsWith(folder)).map((file) => file.slice(folder.length));
  return headers.filter((file) => !seen.has(file) && !ofOthers.includes(file)).map((file) => `mandoline.h does not include ${file}`);
}

/** Public headers whose functions shared libraries would not export, as messages. */
function hiddenHeaders() {
  const headers = sources.filter((file) => file.startsWith('src/include/'));
  const isHidden = (file) => /^namespace mandoline\b/m.test(readFileSync(path(file), 'utf8'));
  return headers.filter(isHidden).map((file) => `${file}: "namespace MANDOLINE_API mandoline", or shared libraries export nothing of it`);
}

/** Ends the program if a file is not formatted, too long, or includes what it should not see. */
function checkFiles() {
  setUp('sources');
  run('npx', 'biome', 'check', '--error-on-warnings');
  run('npx', 'tsc', '-p', 'wasm');
  run('clang-format-14', '--dry-run', '-Werror', ...files);
  const lineCount = (file) => readFileSync(path(file), 'utf8').split('\n').length - 1;
  const long = sources.filter((file) => lineCount(file) > mostLines).map((file) => `${file} has more than ${mostLines} lines`);
  const problems = [...long, ...sources.flatMap(wrongIncludes), ...headersLeftOut(), ...hiddenHeaders()];
  if (problems.length) fail(problems.join('\n'));
}

/** Ends the program if a function is too long or takes too much. `database` is a build folder with compile_commands.json. */
export function checkFunctions(database) {
  const limits = { LineThreshold: mostFunctionLines, ParameterThreshold: mostParameters, StatementThreshold: 1000 };
  const check = 'readability-function-size';
  const config = {
    Checks: `-*,${check}`,
    WarningsAsErrors: '*',
    CheckOptions: Object.entries(limits).map(([key, value]) => ({ key: `${check}.${key}`, value: String(value) })),
  };
  const compiled = JSON.parse(readFileSync(path(database, 'compile_commands.json'), 'utf8')).map(({ file }) => file);
  const isOfSources = (file) => file.includes('/Unity/') || file.startsWith(path('src/')); // folders are compiled as one, or files
  const list = path(database, 'sources.txt');
  writeFileSync(list, compiled.filter(isOfSources).join('\n'));
  const options = ['--quiet', '-p', database, `--header-filter=${path('src')}/`, `--config=${JSON.stringify(config)}`];
  run('xargs', '-a', list, '-P', jobs, '-n', '1', 'clang-tidy', ...options);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) checkFiles();
