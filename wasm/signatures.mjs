// The types of the calls, as their tables have them: src/signatures.d.ts from src/calls.js, src/physics/signatures.d.ts from
// src/physics/calls.js. The last lines of a call's comment are its signatures. Those of a worker's calls are the same as promises, with the
// options of every call of a worker. And src/physics-names.js, the names of the calls of mandoline-wasm/physics, for the worker that has
// none of them. Writes the files into src/; with --check only looks whether these are as they would be written.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const path = (name) => fileURLToPath(new URL(`src/${name}`, import.meta.url));
const textOf = (name) => (existsSync(path(name)) ? readFileSync(path(name), 'utf8') : '');

/** What the comment of each call says, as lines, and its signatures. */
function callsIn(table) {
  return [...table.matchAll(/^ {2}\/\*\*\n((?: {3}\*.*\n)+?) {3}\*\/\n {2}\w+: \{/gm)].map(([, comment]) => {
    const lines = comment.trimEnd().split('\n');
    const empty = lines.lastIndexOf('   *');
    return { says: lines.slice(0, empty), signatures: lines.slice(empty + 1).map((line) => line.slice('   * '.length)) };
  });
}

/** Of objects whose state stays in the thread. */
const keptTypes = ['BrickCutter', 'FlowStepper', 'HeatStepper', 'PoissonSolver', 'Recutter'];

function ofWorker(signature) {
  const [, given, result] = signature.match(/^(.*)\): (.*)$/);
  const all = /options\?: \S+$/.test(given) ? `${given} & CallOptions` : `${given}, options?: CallOptions`;
  const value = result.match(/^Promise<(.*)>$/)?.[1] ?? result;
  return `${all}): Promise<${keptTypes.includes(value) ? `OnWorker<${value}>` : value}>`;
}

function formatted(text) {
  const biome = fileURLToPath(new URL('../node_modules/@biomejs/biome/bin/biome', import.meta.url));
  return execFileSync(process.execPath, [biome, 'format', '--stdin-file-path=any.ts'], { input: text, encoding: 'utf8' });
}

const builtIn = /^(\w+Array|Array\w+|Blob|Promise|Names)$/;

/** Imports of the types that these calls use: from `main` those that its files declare, and the others from `own`, the entry that has them. */
function imports(calls, main, own) {
  const used = new Set(calls.flatMap(({ signatures }) => signatures.join(' ').match(/\b[A-Z]\w*/g)).filter((name) => !builtIn.test(name)));
  const declared = `${textOf('index.d.ts')}${textOf('results.d.ts')}`;
  const isMain = (name) => main === own || new RegExp(`^export (interface|type) ${name}\\b`, 'm').test(declared);
  return [...new Set([main, own])].flatMap((from) => {
    const names = [...used].filter((name) => isMain(name) === (from === main)).sort();
    return names.length ? [`import type { ${names.join(', ')} } from '${from}';`] : [];
  });
}

const note = (table) => `// Written by wasm/signatures.mjs from ${table}: change that.`;

function typesOf(table, main, worker, own = './index.js') {
  const calls = callsIn(textOf(table));
  const comment = (says) => (says.length === 1 ? [`  /**${says[0].slice('   *'.length)} */`] : ['  /**', ...says, '   */']);
  const direct = ({ says, signatures }) => [...comment(says), ...signatures.map((signature) => `  ${signature};`)];
  const promised = ({ signatures }) => signatures.map((signature) => `  ${ofWorker(signature)};`);
  const lines = [
    note(table),
    ...imports(calls, main, own),
    `import type { CallOptions${keptTypes.some((type) => new RegExp(`\\): (Promise<)?${type}>?\n`).test(textOf(table))) ? ', OnWorker' : ''} } from '${worker}';`,
    '',
    'export interface Calls {',
    ...calls.flatMap(direct),
    '}',
    '',
    '/** The same in a worker. */',
    'export interface WorkerCalls {',
    ...calls.flatMap(promised),
    '}',
    '',
  ];
  return formatted(lines.join('\n'));
}

function namesOf(table) {
  const names = callsIn(textOf(table)).map(({ signatures }) => `'${signatures[0].match(/^\w+/)[0]}'`);
  return formatted(`${note(table)}\n\nexport const physicsNames = [${names.join(', ')}];\n`);
}

const files = {
  'signatures.d.ts': typesOf('calls.js', './index.js', './worker.js'),
  'bricks/signatures.d.ts': typesOf('bricks/calls.js', '../index.js', '../worker.js', '../physics/index.js'),
  'files/signatures.d.ts': typesOf('files/calls.js', '../index.js', '../worker.js'),
  'physics/signatures.d.ts': typesOf('physics/calls.js', '../index.js', '../worker.js'),
  'physics-names.js': namesOf('physics/calls.js'),
};
const changed = Object.keys(files).filter((name) => textOf(name) !== files[name]);
if (process.argv.includes('--check') && changed.length) {
  console.error(`Not as the tables of calls have it: ${changed.join(', ')}. Run node wasm/signatures.mjs.`);
  process.exit(1);
}
for (const name of changed) writeFileSync(path(name), files[name]);
