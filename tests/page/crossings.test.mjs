import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { importBundled } from './bundled.mjs';
import { eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { pixelsOf, share } from './pictures.mjs';
import { galleryMesh, mandoline } from './reference.mjs';

const site = await startSite();
after(() => site.close());

const { crossingsOf } = await importBundled('worker/crossings.ts');
const { boundsOf } = await importBundled('model/grid_around.ts');
const { crossingsSentence } = await importBundled('model/crossings.ts');

/** The curves of triangles given by their corners. */
function curvesOf(...corners) {
  const positions = Float64Array.from(corners.flat());
  const mesh = { positions, triangles: Uint32Array.from(positions.keys()).slice(0, positions.length / 3) };
  return crossingsOf(mandoline, { mesh: { ...mesh, bounds: boundsOf(mesh) }, origin: [1, 1, 1] });
}

const flat = [0, 0, 0, 4, 0, 0, 0, 4, 0];

describe('curves', () => {
  test('of two triangles that cross: the segment that they share, less the origin', () => {
    const { pairs, segments, center, radius } = curvesOf(flat, [1, 1, -1, 1, 1, 1, 1, -9, 1]);
    assert.equal(pairs, 1);
    const [from, to] = [segments.subarray(0, 3), segments.subarray(3)].map((end) => [...end]).sort((a, b) => a[1] - b[1]);
    assert.deepEqual(
      [from, to],
      [
        [0, -1, -1],
        [0, 0, -1],
      ],
    );
    assert.deepEqual(center, [0, -0.5, -1]);
    assert.ok(radius >= 0.5 && radius < 1, 'some surroundings at least');
  });

  test('of a corner that touches a triangle: a point', () => {
    const { segments, center, radius } = curvesOf(flat, [1, 1, 0, 1, 2, 3, 2, 1, 3]);
    assert.deepEqual([...segments], [0, 0, -1, 0, 0, -1]);
    assert.deepEqual(center, [0, 0, -1]);
    assert.ok(radius > 0.1 && radius < 1, 'with some of its surroundings');
  });

  test('of triangles that overlap: the outline of what they have in common, once', () => {
    const inner = [1, 1, 0, 2, 1, 0, 1, 2, 0];
    assert.equal(curvesOf(flat, inner).segments.length, 6 * 3);
    assert.equal(curvesOf(flat, flat, inner).segments.length, 6 * 6);
  });

  test('the largest is the longest connected one, not the one with the most segments', () => {
    const small = [3, 0.5, 0, 3, 0.6, 0.1, 3, 0.4, 0.1];
    const tiny = [0.5, 3, -1, 0.5, 3, 1, 0.5, 3.1, 1];
    const { segments, center } = curvesOf(flat, small, tiny, [1, 0.5, -1, 1, 0.5, 1, 1, 2, 1]);
    assert.equal(segments.length, 6 * 3);
    assert.equal(center[0], 0);
  });

  test('of two tori: two closed curves on both of them', async () => {
    const mesh = await galleryMesh('crossing-tori');
    const { segments, pairs } = crossingsOf(mandoline, { mesh: { ...mesh, bounds: boundsOf(mesh) }, origin: [0, 0, 0] });
    assert.equal(pairs, 272);
    assert.equal(segments.length, 6 * 272);
    const ends = new Map();
    for (let at = 0; at < segments.length; at += 3) {
      const key = segments.subarray(at, at + 3).join();
      ends.set(key, (ends.get(key) ?? 0) + 1);
    }
    assert.deepEqual(new Set(ends.values()), new Set([2]), 'every point ends two segments');
  });
});

describe('the sentence', () => {
  const none = { crossing: 0, touching: 0, overlapping: 0, folded: 0, identical: 0 };

  test('nothing is said of a mesh that does not meet itself', () => assert.equal(crossingsSentence(none), null));

  test('crossings alone', () => {
    const said = crossingsSentence({ ...none, crossing: 8727 });
    assert.equal(said, 'This mesh crosses itself in 8,727 places; they were resolved exactly.');
    assert.equal(crossingsSentence({ ...none, crossing: 1 }), 'This mesh crosses itself in 1 place; it was resolved exactly.');
  });

  test('all kinds', () => {
    assert.equal(
      crossingsSentence({ crossing: 0, touching: 1, overlapping: 23, folded: 0, identical: 4 }),
      'This mesh touches itself in 1 place, overlaps itself in 23 and has a triangle twice in 4; they were resolved exactly.',
    );
  });
});

describe('the banner', () => {
  const isAccent = (r, g, b) => r > 190 && g < 110 && b > 100;
  const hasGlow = async (page) => share(await pixelsOf(page), isAccent) > 0.001;
  const sentenceOf = async (name) => crossingsSentence(mandoline.findIntersections(await galleryMesh(name), { maxPairs: 0 }).counts);

  test('says how often the mesh meets itself, and shows where', async (t) => {
    const page = await site.open(t, 'mesh=teapot&n=8&free=off&explode=0,0', { colorScheme: 'light', reducedMotion: 'reduce' });
    assert.equal(await textOf(page, '#crossings p'), await sentenceOf('teapot'));
    assert.equal(await hasGlow(page), false);
    await page.locator('#show-crossings').press('Enter');
    await shows(page, '#canvas', { instead: 'crossings' });
    await eventually(async () => assert.ok(await hasGlow(page), 'the curves are seen'));
    assert.equal(await page.locator('#show-crossings').getAttribute('aria-pressed'), 'true');
    await slideTo(page, '#cells', 9);
    await shows(page, '#counts', { grid: '9x5x6' });
    assert.equal(await isReady(page), 'ready');
    await shows(page, '#canvas', { instead: 'crossings' });
    await page.locator('#show-crossings').press('Enter');
    await shows(page, '#canvas', { instead: '' });
    await page.locator('#show-crossings').click();
    await shows(page, '#canvas', { instead: 'crossings' });
    await page.keyboard.press('Escape');
    await shows(page, '#canvas', { instead: '' });
    assert.equal(await hasGlow(page), false);
  });

  test('counts the mesh as it was given, also where vertices are snapped', async (t) => {
    const page = await site.open(t, 'mesh=teapot&n=8&snap=0.3&free=off');
    assert.equal(await textOf(page, '#crossings p'), await sentenceOf('teapot'));
  });

  test('once dismissed stays away until there is another mesh', async (t) => {
    const page = await site.open(t, 'mesh=teapot&n=8&free=off');
    await page.locator('#show-crossings').click();
    await shows(page, '#canvas', { instead: 'crossings' });
    await page.locator('#dismiss-crossings').click();
    await shows(page, '#canvas', { instead: '' });
    await slideTo(page, '#cells', 9);
    await shows(page, '#counts', { grid: '9x5x6' });
    assert.equal(await page.locator('#crossings').isVisible(), false);
    await openPanel(page, 'mesh');
    await page.locator('#gallery [data-name="crossing-tori"]').click();
    await shows(page, '#mesh-line', { name: 'crossing-tori' });
    await isReady(page);
    assert.equal(await textOf(page, '#crossings p'), await sentenceOf('crossing-tori'));
  });

  test('is silent about a mesh that does not meet itself, and goes with the mesh that does', async (t) => {
    const page = await site.open(t, 'mesh=crossing-tori&n=8&free=off');
    await page.locator('#show-crossings').click();
    await shows(page, '#canvas', { instead: 'crossings' });
    await openPanel(page, 'mesh');
    await page.locator('#gallery [data-name="wedge"]').click();
    await shows(page, '#mesh-line', { name: 'wedge' });
    await isReady(page);
    await shows(page, '#canvas', { instead: '' });
    assert.equal(await page.locator('#crossings').isVisible(), false);
  });
});
