// The tables of calls against the types and the README.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { brickCalls } from '../../wasm/src/bricks/calls.js';
import { cutCalls } from '../../wasm/src/calls.js';
import { fileCalls } from '../../wasm/src/files/calls.js';
import { physicsCalls } from '../../wasm/src/physics/calls.js';
import { root } from './environments.mjs';
import { compiler } from './types.mjs';

const tables = { Mandoline: { ...cutCalls, ...fileCalls, ...brickCalls }, Physics: physicsCalls };
const all = { ...tables.Mandoline, ...physicsCalls };
const calls = Object.entries(all);
const source = (name) => readFileSync(join(root, 'wasm', name), 'utf8');

const { assertCompiles, remove } = compiler();
after(remove);

test('the types of calls are those of the tables', () => {
  execFileSync(process.execPath, [join(root, 'wasm', 'signatures.mjs'), '--check'], { stdio: 'pipe', encoding: 'utf8' });
});

test('signatures have the names of the arguments', () => {
  const text = ['', 'bricks/', 'files/', 'physics/'].map((folder) => source(`src/${folder}signatures.d.ts`)).join('');
  for (const [name, { takes, options }] of calls) {
    const signatures = [...text.matchAll(new RegExp(`^  ${name}(?:<.*>)?\\(([^;]*)\\): `, 'gm'))].map(([, given]) => given);
    assert.ok(signatures.length >= 2, name);
    const names = [...Object.keys(takes), 'options'];
    const named = signatures.map((given) => [...given.matchAll(/(?:^|,)\s*(\w+)\??: /g)].map(([, word]) => word));
    for (const words of named) assert.deepEqual(words, names.slice(0, words.length), name);
    assert.ok(
      named.some((words) => words.length === (options ? names.length : names.length - 1)),
      name,
    );
  }
});

test('types have the options of the tables, no more and no fewer', () => {
  const checks = Object.entries(tables).flatMap(([type, table]) =>
    Object.entries(table)
      .filter(([, { options }]) => options)
      .map(([name, { takes, options }]) => {
        const names = `keyof NonNullable<Parameters<${type}['${name}']>[${Object.keys(takes).length}]>`;
        return `export const ${name}: Record<${names}, 0> = { ${Object.keys(options).map((option) => `${option}: 0`)} };`;
      }),
  );
  assert.ok(checks.length > 10);
  const imports = "import type { Mandoline } from 'mandoline-wasm';\nimport type { Physics } from 'mandoline-wasm/physics';\n";
  assertCompiles(imports + checks.join('\n'));
});

test('the README lists every call with its arguments and its options', () => {
  const rows = source('README.md').match(/^\| `\w+\(.*$/gm);
  const listed = rows.flatMap((row) =>
    [...row.split('|')[1].matchAll(/`(\w+)\(([^`]*)\)`/g)].map(([, name, given]) => ({ name, given, row })),
  );
  assert.deepEqual(listed.map(({ name }) => name).sort(), calls.map(([name]) => name).sort());
  for (const { name, given, row } of listed) {
    const { takes, options } = all[name];
    assert.equal(given, [...Object.keys(takes), ...(options ? ['options'] : [])].join(', '), name);
    const [, said = ''] = row.match(/`options`:([^|]*)/) ?? [];
    const names = [...said.matchAll(/`(\w+)`/g)].map(([, word]) => word);
    assert.deepEqual(names.sort(), Object.keys(options ?? {}).sort(), name);
  }
});
