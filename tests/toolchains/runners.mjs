// Test runners, as Node and with a page that jsdom makes.
import { test } from 'node:test';
import { checkModule } from './example.mjs';
import { makeProject, run } from './projects.mjs';

const suite = (head) => `${head}
import { check } from './check.js';

test('cut', async () => expect(await check()).toEqual({ cells: 304, same: true, valid: 'true,true', again: '304,304' }));
`;
const patience = '--testTimeout=60000'; // of a busy machine; both allow 5 s
const esModules = JSON.stringify({ name: 'consumer', private: true, type: 'module' });

for (const environment of ['node', 'jsdom']) {
  test(`vitest, ${environment}`, async () => {
    const head = `// @vitest-environment ${environment}\nimport { expect, test } from 'vitest';`;
    await run(
      makeProject(`vitest ${environment}`, { 'check.js': checkModule(), 'check.test.js': suite(head) }),
      '.bin/vitest',
      'run',
      patience,
    );
  });

  test(`jest, ${environment}`, async () => {
    const head = `/** @jest-environment ${environment} */`;
    const files = { 'package.json': esModules, 'check.js': checkModule(), 'check.test.js': suite(head) };
    const command = ['node24/bin/node', '--experimental-vm-modules', '../../node_modules/jest/bin/jest.js', patience];
    await run(makeProject(`jest ${environment}`, files), ...command);
  });
}
