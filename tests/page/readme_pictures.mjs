// Makes the README's pictures, and the one that links to the page are shown with, from the built page: node tests/page/readme_pictures.mjs
import { mkdirSync } from 'node:fs';
import { makeAnimation } from './animation.mjs';
import { isReady, shows, startSite } from './page_helpers.mjs';
import { path } from '../steps.mjs';
import { setOthers } from './pictures.mjs';

const pictures = {
  slice: 'n=24&x=0.56,1&slice=flat&explode=0.12,0&camera=19,11,7,-0.6,4.4,0',
  tunnels: 'mesh=hilbert&n=6&z=0.6,1',
  sheet: 'mesh=wavy-plane&n=10&show=surface,edges,cutCells,outside&explode=0.2,0&color=cell',
  explode: 'mesh=torus-knot&n=14&explode=0.5,0&color=cell',
};

const cleanUp = [];
const site = await startSite({ smooth: true });
mkdirSync(path('web', 'pictures'), { recursive: true });
for (const [name, hash] of Object.entries(pictures)) {
  const page = await site.open({ after: (f) => cleanUp.push(f) }, hash, { viewport: { width: 910, height: 700 }, panels: [] });
  await isReady(page);
  await page.waitForTimeout(2000);
  await setOthers(page, '#canvas', 'hidden');
  await page.screenshot({ path: path('web', 'pictures', `${name}.png`) });
}

// Where motion is unwanted, whole streamlines are drawn, at rest.
const page = await site.open({ after: (f) => cleanUp.push(f) }, 'n=24&explode=0,0&wind=1,0,0&camera=6.6,9.5,18.8,0.9,4.6,0', {
  viewport: { width: 1200, height: 630 },
  colorScheme: 'dark',
  reducedMotion: 'reduce',
});
await page.locator('#panels-toggle').click();
await shows(page, '#canvas', { wind: '1,0,0' });
await page.waitForTimeout(3000);
await setOthers(page, '#canvas', 'hidden');
for (const selector of ['h1', '.what']) await page.locator(selector).evaluate((element) => (element.style.visibility = 'visible'));
await page.screenshot({ path: path('web', 'pictures', 'share.jpg'), type: 'jpeg', quality: 88 });

await makeAnimation(site, { after: (f) => cleanUp.push(f) }, path('web', 'pictures', 'bunny.webp'));

for (const f of cleanUp) await f();
await site.close();
