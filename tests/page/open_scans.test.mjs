// Open scans as they are first seen: a surface in one calm colour, not a web of dark lines.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { meshFolder, skipWithoutMeshes } from '../mesh_folder.mjs';
import { eventually, isReady, shows, startSite } from './page_helpers.mjs';
import { pixelsOf } from './pictures.mjs';

const names = ['common_beetle-alt', 'common_teapot', 'oded_mountain', 'igltut_face', 'codim_Sharkey12K'].map((name) => `${name}.obj.gz`);
const files = meshFolder ? Object.fromEntries(names.map((name) => [name, readFileSync(join(meshFolder, name))])) : {};
const site = await startSite({ smooth: true, files });
after(() => site.close());

/** The share of the model's pixels that are darker than a quarter. */
function darkShare({ rgba }) {
  let model = 0;
  let dark = 0;
  for (let at = 0; at < rgba.length; at += 4) {
    const [r, g, b] = rgba.subarray(at, at + 3);
    const isDark = 0.2126 * r + 0.7152 * g + 0.0722 * b < 64;
    // The ground and its shadow are gray, and never so dark.
    if (!isDark && Math.max(r, g, b) - Math.min(r, g, b) < 30) continue;
    model++;
    if (isDark) dark++;
  }
  assert.ok(model > 0.03 * (rgba.length / 4), 'the model is seen');
  return dark / model;
}

for (const name of names) {
  test(`${name} is seen in the light scheme, at most a tenth of it dark`, { skip: skipWithoutMeshes }, async (t) => {
    const page = await site.open(t, 'mesh=claw&n=2', { colorScheme: 'light' });
    await page.locator('#url').fill(site.meshUrl(name));
    await page.locator('#open-url').click();
    await shows(page, '#mesh-line', { name });
    assert.equal(await isReady(page), 'ready');
    const share = await eventually(async () => darkShare(await pixelsOf(page)));
    t.diagnostic(`${(100 * share).toFixed(1)} % are darker than luma 64`);
    assert.ok(share <= 0.1, `${(100 * share).toFixed(1)} % are darker than luma 64`);
  });
}
