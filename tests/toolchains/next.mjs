// Next, whose pages use the package on the server and in the browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { assertChecked, checkModule } from './example.mjs';
import { makeProject, openServed, run } from './projects.mjs';

const files = {
  'app/layout.js': `
export default function Layout({ children }) {
  return <html lang="en"><head><link rel="icon" href="data:," /></head><body>{children}</body></html>;
}
`,
  'app/page.js': `
import { check } from './check.js';
import { Client } from './client.js';

export const dynamic = 'force-dynamic';

export default async function Page() {
  return <Client server={await check().catch(({ message }) => ({ error: message }))} />;
}
`,
  'app/client.js': `
'use client';
import { useEffect } from 'react';
import { check } from './check.js';

export function Client({ server }) {
  useEffect(() => {
    check().catch(({ message }) => ({ error: message })).then((client) => { globalThis.outcome = { client, server }; });
  }, []);
  return <p>{server.cells}</p>;
}
`,
  'app/check.js': checkModule(),
};
const at = (port) => ['--port', port, '--hostname', '127.0.0.1'];

function assertBoth({ client, server }) {
  assertChecked(server);
  assertChecked(client);
}

test('Next, development', async () => {
  assertBoth(await openServed(makeProject('next dev', files), '.bin/next', (port) => ['dev', ...at(port)]));
});

for (const bundler of ['turbopack', 'webpack']) {
  test(`Next, build, ${bundler}`, async () => {
    const folder = makeProject(`next ${bundler}`, files);
    assert.doesNotMatch(await run(folder, '.bin/next', 'build', `--${bundler}`), /mandoline/);
    assertBoth(await openServed(folder, '.bin/next', (port) => ['start', ...at(port)]));
  });
}
