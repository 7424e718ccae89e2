// Makes the pictures of the gallery, each of an entry as it opens, from the built page: node tests/page/thumbnails.mjs
import { mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { path } from '../steps.mjs';
import { importBundled } from './bundled.mjs';
import { download, isReady, shows, startSite } from './page_helpers.mjs';

const { gallery } = await importBundled('model/gallery/list.ts');
const { toHash } = await importBundled('model/hash.ts');
const { readPreset } = await importBundled('model/gallery/preset.ts');
const folder = path('web', 'public', 'thumbnails');
const size = { width: 128, height: 96 };

const cleanUp = [];
const site = await startSite({ smooth: true });
try {
  const made = await pictures();
  for (const f of cleanUp) await f();
  keep(made);
} finally {
  await site.close();
}

/** The pictures, by the names of their files. */
async function pictures() {
  // Where motion is unwanted, whole streamlines are drawn, at rest.
  const page = await site.open({ after: (f) => cleanUp.push(f) }, 'mesh=wedge&n=2', {
    viewport: { width: 340 + 480, height: 360 },
    colorScheme: 'light',
    reducedMotion: 'reduce',
    panels: ['save'],
    expectedProblem: /404/, // of the pictures of new entries
  });
  await page.locator('#picture-transparent').check();
  const made = new Map();
  for (const entry of gallery) made.set(`${entry.name}.webp`, await pictureOf(page, entry));
  return made;
}

async function pictureOf(page, entry) {
  const { settings } = readPreset(entry);
  await page.evaluate((hash) => (location.hash = hash), toHash(settings));
  await shows(page, '#mesh-line', { name: entry.name });
  await isReady(page);
  await shows(page, '#canvas', { wind: settings.wind.on ? settings.wind.direction.join() : '', shadow: 'drawn' });
  const picture = await download(page, '#save-png');
  return Buffer.from(await page.evaluate(shrink, { png: picture.bytes.toString('base64'), ...size }), 'base64');
}

/** Only once all are there: these, and none of entries that are gone. */
function keep(made) {
  mkdirSync(folder, { recursive: true });
  for (const [name, bytes] of made) writeFileSync(join(folder, name), bytes);
  for (const name of readdirSync(folder)) if (!made.has(name)) rmSync(join(folder, name), { recursive: true });
  const total = Array.from(made.values()).reduce((sum, { length }) => sum + length, 0);
  console.log(`${made.size} pictures, ${(total / 1024).toFixed(0)} KB`);
}

/** Runs in the page: what is drawn on a transparent picture, as large as it fits, as WebP. */
async function shrink({ png, width, height }) {
  const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (letter) => letter.charCodeAt(0))]));
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
  let [left, top, right, bottom] = [Infinity, Infinity, 0, 0];
  for (let at = 3; at < data.length; at += 4) {
    if (data[at] < 24) continue; // The rim of a shadow may be cut off.
    const [x, y] = [((at - 3) / 4) % bitmap.width, Math.floor((at - 3) / 4 / bitmap.width)];
    [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, x + 1), Math.max(bottom, y + 1)];
  }
  const scale = Math.min(width / (right - left), height / (bottom - top));
  const small = new OffscreenCanvas(width, height);
  const target = small.getContext('2d');
  target.imageSmoothingQuality = 'high';
  const shift = [width / 2 - (scale * (left + right)) / 2, height / 2 - (scale * (top + bottom)) / 2];
  target.drawImage(bitmap, shift[0], shift[1], scale * bitmap.width, scale * bitmap.height);
  // Alpha is packed without loss, so fewer values of it take less room.
  const pixels = target.getImageData(0, 0, width, height);
  for (let at = 3; at < pixels.data.length; at += 4) pixels.data[at] = 17 * Math.round(pixels.data[at] / 17);
  target.putImageData(pixels, 0, 0);
  const blob = await small.convertToBlob({ type: 'image/webp', quality: 0.7 });
  return btoa(String.fromCharCode(...new Uint8Array(await blob.arrayBuffer())));
}
