// What is seen on a screenshot, in numbers that tell a wrong picture from a right one on any renderer.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { dataOf, eventually } from './page_helpers.mjs';

const expectedFile = new URL('./expected/pictures.json', import.meta.url);
const columns = 16;
const rows = 12;

/** The pixels of an element (nothing that lies over it) or of a PNG: { width, height, rgb }. */
export async function pixelsOf(page, selectorOrPng = '#canvas') {
  const png = typeof selectorOrPng === 'string' ? await screenshot(page, selectorOrPng) : selectorOrPng;
  const { width, height, rgba } = await page.evaluate(decode, png.toString('base64'));
  return { width, height, rgba: Buffer.from(rgba, 'base64') };
}

async function screenshot(page, selector) {
  await setOthers(page, selector, 'hidden');
  const png = await page.locator(selector).screenshot();
  await setOthers(page, selector, '');
  return png;
}

/** The visibility of all that may lie over an element. */
export function setOthers(page, selector, visibility) {
  return page.locator(selector).evaluate((element, value) => {
    for (let item = element; item !== document.body; item = item.parentElement) {
      for (const other of item.parentElement.children) if (other !== item) other.style.visibility = value;
    }
  }, visibility);
}

/** Runs in the page. */
async function decode(base64) {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
  let text = '';
  for (let at = 0; at < data.length; at += 30_000) text += String.fromCharCode(...data.subarray(at, at + 30_000));
  return { width: bitmap.width, height: bitmap.height, rgba: btoa(text) };
}

/** The share of the pixels for which a test of red, green, blue and alpha holds. */
export function share({ rgba }, holds) {
  let count = 0;
  for (let at = 0; at < rgba.length; at += 4) if (holds(rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3])) ++count;
  return (4 * count) / rgba.length;
}

/** Unlike the upper right corner, in which there is nothing. */
export function isDrawn({ rgba, width }) {
  const at = 4 * (3 * width - 4);
  const [r, g, b] = rgba.subarray(at, at + 3);
  return (red, green, blue) => Math.abs(red - r) + Math.abs(green - g) + Math.abs(blue - b) > 40;
}

export const covered = (picture) => share(picture, isDrawn(picture));
export const isOrange = (r, g, b) => r > g + 25 && g > b + 25;
export const isBlue = (r, _g, b) => b > r + 25;

/** The mean colours of 16 x 12 tiles, 3 numbers each. */
export function tiles({ width, height, rgba }) {
  const sums = new Float64Array(3 * columns * rows);
  const counts = new Float64Array(columns * rows);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const tile = Math.floor((x * columns) / width) + columns * Math.floor((y * rows) / height);
      ++counts[tile];
      for (let c = 0; c < 3; ++c) sums[3 * tile + c] += rgba[4 * (x + width * y) + c];
    }
  }
  return Array.from(sums, (sum, at) => Math.round(sum / counts[Math.floor(at / 3)]));
}

/** The root of the mean square difference of tiles. */
export function difference(a, b) {
  return Math.sqrt(a.reduce((sum, x, at) => sum + (x - b[at]) ** 2, 0) / a.length);
}

/** Renderers differ by less than this; a cell more or less shows. */
const likeness = 6;

/**
 * Waits until the canvas looks like the expected picture of that name. With UPDATE_PICTURES=folder what is seen becomes the expected
 * picture, and its PNG is put into the folder, to be looked at.
 */
export async function looksLike(page, name) {
  const folder = process.env.UPDATE_PICTURES;
  if (folder) {
    keep(name, tiles(await settledPixels(page)));
    writeFileSync(join(folder, `${name}.png`), await screenshot(page, '#canvas'));
    return;
  }
  const expected = readExpected()[name];
  assert.ok(expected, `there is an expected picture "${name}"`);
  await eventually(async () => {
    const by = difference(tiles(await pixelsOf(page)), expected);
    assert.ok(by < likeness, `${name} differs by ${by.toFixed(1)} of ${likeness}`);
  });
}

/** The canvas once it is drawn with all pixels of the screen, its shadow, too, and two screenshots running are the same. */
export async function settledPixels(page) {
  let last = await pixelsOf(page);
  return eventually(async () => {
    const { shadow } = await dataOf(page, '#canvas');
    const isFine = await page.evaluate(() => {
      const canvas = document.querySelector('#canvas');
      return canvas.width >= Math.floor(canvas.clientWidth * devicePixelRatio);
    });
    const next = await pixelsOf(page);
    const by = difference(tiles(last), tiles(next));
    last = next;
    assert.equal(shadow, 'drawn');
    assert.ok(isFine, 'drawn with all pixels of the screen');
    assert.equal(by, 0);
    return next;
  });
}

function readExpected() {
  return existsSync(expectedFile) ? JSON.parse(readFileSync(expectedFile, 'utf8')) : {};
}

function keep(name, values) {
  const all = Object.entries({ ...readExpected(), [name]: values }).sort(([a], [b]) => (a < b ? -1 : 1));
  writeFileSync(expectedFile, `{\n${all.map(([key, value]) => `${JSON.stringify(key)}: ${JSON.stringify(value)}`).join(',\n')}\n}\n`);
}
