// Compiles TypeScript that imports the package by its name.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './environments.mjs';

const compilerOptions = {
  strict: true,
  noEmit: true,
  exactOptionalPropertyTypes: true,
  skipLibCheck: false,
  types: [],
  target: 'es2022',
  lib: ['es2022', 'dom'],
  module: 'nodenext',
};

/** compile(source) throws what the compiler prints; assertCompiles(source) fails with that; remove() is to be called in the end. */
export function compiler() {
  const folder = mkdtempSync(join(root, 'node_modules', '.mandoline-types-')); // where imports by name are found
  writeFileSync(join(folder, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: ['check.ts'] }));
  const compile = (source) => {
    writeFileSync(join(folder, 'check.ts'), source);
    execFileSync(process.execPath, [join(root, 'node_modules', 'typescript', 'bin', 'tsc'), '-p', folder], { encoding: 'utf8' });
  };
  const assertCompiles = (source) => {
    try {
      compile(source);
    } catch (error) {
      assert.fail(error.stdout || error.message);
    }
  };
  return { compile, assertCompiles, remove: () => rmSync(folder, { recursive: true }) };
}
