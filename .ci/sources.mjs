// What the C++ sources look like: formatted, short files and functions, and rooms that see only those before them.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { fail, jobs, path, run } from '../tests/steps.mjs';

// Of src. Each sees itself, those before it and the public headers, which base alone does without.
const rooms = ['base', 'mesh', 'grid', 'cut', 'operators', 'io', 'cli'];
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

/** Ends the program if something is wrong. `database` is a build folder with compile_commands.json. */
export function checkSources(database) {
  const files = execFileSync('git', ['ls-files', '*.h', '*.cpp'], { cwd: path(), encoding: 'utf8' }).trim().split('\n');
  run('clang-format-14', '--dry-run', '-Werror', ...files);

  const sources = files.filter((file) => file.startsWith('src/'));
  const lineCount = (file) => readFileSync(path(file), 'utf8').split('\n').length - 1;
  const long = sources.filter((file) => lineCount(file) > mostLines).map((file) => `${file} has more than ${mostLines} lines`);
  const problems = [...long, ...sources.flatMap(wrongIncludes)];
  if (problems.length) fail(problems.join('\n'));

  const options = { LineThreshold: mostFunctionLines, ParameterThreshold: mostParameters, StatementThreshold: 1000 };
  const check = 'readability-function-size';
  const config = {
    Checks: `-*,${check}`,
    WarningsAsErrors: '*',
    CheckOptions: Object.entries(options).map(([key, value]) => ({ key: `${check}.${key}`, value: String(value) })),
  };
  const list = path(database, 'sources.txt');
  writeFileSync(list, sources.filter((file) => file.endsWith('.cpp')).join('\n'));
  run('xargs', '-a', list, '-P', jobs, '-n', '4', 'clang-tidy', '--quiet', '-p', database, `--config=${JSON.stringify(config)}`);
}
