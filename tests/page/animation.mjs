// The README's animated picture: a bunny is cut open, and its cells come apart and together again.
import { writeFileSync } from 'node:fs';
import { animatedWebp, toWebp } from './animated_webp.mjs';
import { isReady } from './page_helpers.mjs';
import { setOthers, settledPixels } from './pictures.mjs';

const frameCount = 60;
/** In ms, of each frame. */
const duration = 80;
const [width, height] = [640, 480];

/** Rises smoothly from 0 to 1 between two times. */
function rise(time, from, to) {
  const share = Math.min(Math.max((time - from) / (to - from), 0), 1);
  return share * share * (3 - 2 * share);
}

/** The link to what is seen at a time from 0 to 1, which is the beginning again. */
function linkAt(time) {
  const open = rise(time, 0.05, 0.3) - rise(time, 0.8, 1);
  const apart = rise(time, 0.25, 0.5) - rise(time, 0.65, 0.85);
  const angle = 0.75 + 0.3 * Math.sin(2 * Math.PI * time);
  const camera = [29 * Math.sin(angle), 11, 29 * Math.cos(angle), -0.2, 4.4, 0].map((x) => x.toFixed(3));
  const slice = open > 0 ? `&x=${(1 - 0.5 * open).toFixed(4)},1&slice=flat` : '';
  return `n=16&explode=${(0.4 * apart).toFixed(4)},0&camera=${camera}${slice}`;
}

export async function makeAnimation(site, context, file) {
  const page = await site.open(context, linkAt(0), { viewport: { width, height: height + 200 }, panels: [], reducedMotion: 'reduce' });
  const encoder = await site.newPage(context);
  await setOthers(page, '#canvas', 'hidden');
  const canvas = await page.locator('#canvas').boundingBox();
  const clip = { x: canvas.x, y: canvas.y + (canvas.height - height) / 2, width, height };
  const frames = [];
  for (let frame = 0; frame < frameCount; ++frame) {
    await page.evaluate((link) => (location.hash = link), linkAt(frame / frameCount));
    await isReady(page);
    await settledPixels(page);
    await setOthers(page, '#canvas', 'hidden');
    frames.push(await toWebp(encoder, await page.screenshot({ clip }), 0.8));
  }
  writeFileSync(file, animatedWebp(frames, [width, height], duration));
}
