import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { dataOf, enter, eventually, isReady, openPanel, shows, startSite, textOf } from './page_helpers.mjs';
import { covered, pixelsOf, settledPixels } from './pictures.mjs';

const site = await startSite();
after(() => site.close());
const link = 'mesh=wedge&n=2&free=off';
const panels = ['mesh', 'cut', 'view', 'volumes', 'measure', 'wind', 'compare', 'steps', 'checks', 'save', 'code'];
const controls = 'a[href], button, input, select, textarea, summary, [tabindex]';

/** Opens all that can be opened, and pins a cell. */
async function openAll(page) {
  for (const id of panels) await openPanel(page, id);
  await page.locator('#custom-grid summary').click();
  await page.getByText('Stages and details').click();
  await page.locator('#step-next').click();
  await shows(page, '#canvas', { instead: 'triEdges' });
  await enter(page, '#pin-number', 0);
  await shows(page, '#cell-card', { cell: 0 });
}

test('every control has a name', async (t) => {
  const page = await site.open(t, link);
  await openAll(page);
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send('Accessibility.getFullAXTree');
  const roles = [
    'button',
    'checkbox',
    'radio',
    'slider',
    'spinbutton',
    'textbox',
    'combobox',
    'link',
    'img',
    'progressbar',
    'DisclosureTriangle',
    'Canvas',
  ];
  const found = nodes.filter(({ ignored, role }) => !ignored && roles.includes(role?.value));
  assert.ok(found.length > 60, `${found.length} controls`);
  const nameless = found.filter(({ name }) => !name?.value?.trim());
  assert.deepEqual(
    nameless.map(({ role, properties }) => [role.value, JSON.stringify(properties)]),
    [],
  );
  const inputs = found.filter(({ role }) => ['slider', 'spinbutton', 'checkbox', 'combobox', 'textbox'].includes(role.value));
  const names = inputs.map(({ role, name }) => `${role.value} ${name.value}`);
  assert.deepEqual(
    names.filter((name, at) => names.indexOf(name) !== at),
    [],
    'no two controls have the same name',
  );
});

test('Tab reaches every control, in turn, and says where it is', async (t) => {
  const page = await site.open(t, link);
  await openAll(page);
  await page.locator('#deviations').waitFor(); // What the checks that begin by themselves have found is a control, too.
  const expected = await page.evaluate((selector) => {
    const seen = new Set();
    return [...document.querySelectorAll(selector)].filter((element) => {
      if (element.tabIndex < 0 || element.disabled || !element.checkVisibility({ visibilityProperty: true })) return false;
      if (element.type !== 'radio') return true;
      return !seen.has(element.name) && seen.add(element.name); // A group is one stop.
    }).length;
  }, controls);
  assert.ok(expected > 60, `${expected} controls`);
  await page.evaluate(() => {
    document.body.tabIndex = -1;
    document.body.focus();
  });
  const unmarked = [];
  const reached = new Set();
  for (let press = 0; press < expected + 5; ++press) {
    await page.keyboard.press('Tab');
    const { key, isMarked } = await page.evaluate(() => {
      const element = document.activeElement;
      const marked = [element, element.nextElementSibling, element.parentElement].some((item) => {
        const { outlineStyle, outlineWidth, boxShadow } = item ? getComputedStyle(item) : {};
        return (outlineStyle && outlineStyle !== 'none' && outlineWidth !== '0px') || (boxShadow && boxShadow !== 'none');
      });
      window.stops ??= new Map();
      if (!window.stops.has(element)) window.stops.set(element, window.stops.size);
      const key = element === document.body ? null : `${window.stops.get(element)} ${element.id || element.textContent.slice(0, 30)}`;
      return { key, isMarked: marked };
    });
    if (key === null || reached.has(key)) continue;
    reached.add(key);
    if (!isMarked) unmarked.push(key);
  }
  assert.equal(reached.size, expected);
  assert.deepEqual(unmarked, [], 'what has the focus shows it');
});

test('the keys of the picture', async (t) => {
  const page = await site.open(t, link);
  await page.locator('#canvas').focus();
  const before = await settledPixels(page);
  for (let press = 0; press < 3; ++press) await page.keyboard.press('ArrowLeft');
  await eventually(async () => assert.notDeepEqual((await pixelsOf(page)).rgba, before.rgba));
  await eventually(async () => assert.match(page.url(), /camera=/));
  await page.keyboard.press('f');
  await eventually(async () => assert.doesNotMatch(page.url(), /camera=/));
  const looksFrom = (d, sign) =>
    eventually(async () => {
      const [camera] = decodeURIComponent(page.url()).match(/(?<=camera=)[^&]+/) ?? [''];
      const place = camera.split(',').map(Number);
      const away = [0, 1, 2].map((e) => place[e] - place[e + 3]);
      assert.ok(sign * away[d] > 0.999 * Math.hypot(...away), camera);
    });
  await page.keyboard.press('1');
  await looksFrom(0, 1);
  await page.keyboard.press('1');
  await looksFrom(0, -1);
  await page.locator('#axes [tabindex="0"]').focus();
  for (const key of ['ArrowRight', 'ArrowDown', 'Enter']) await page.keyboard.press(key);
  await looksFrom(1, 1);
  await page.locator('#axes [data-end="minus z"]').click();
  await looksFrom(2, -1);
  await page.keyboard.press('?');
  await page.locator('#shortcuts').waitFor();
  assert.match(await textOf(page, '#shortcuts'), /Esc/);
  await page.keyboard.press('Escape');
  await eventually(async () => assert.equal(await page.locator('#shortcuts').isVisible(), false));
});

test('what happens is announced', async (t) => {
  const page = await site.open(t, link);
  for (const selector of ['#hover-line', '#mesh-line', '#step-text', '#validation', '#link-status']) {
    assert.equal(await page.locator(selector).getAttribute('aria-live'), 'polite', selector);
  }
  await page.locator('#file').setInputFiles({ name: 'empty.obj', mimeType: 'text/plain', buffer: Buffer.alloc(0) });
  await page.getByRole('alert').filter({ hasText: 'empty.obj' }).waitFor();
});

describe('on a screen 360 pixels wide', () => {
  const phone = { viewport: { width: 360, height: 640 }, hasTouch: true, isMobile: true };
  // innerWidth grows with what runs over the side.
  const overflow = (page) =>
    page.evaluate(() => Math.max(document.documentElement.scrollWidth, innerWidth) - document.documentElement.clientWidth);

  const phonePage = (t, hash) => site.open(t, hash, { ...phone, panels: [], reducedMotion: 'reduce' });
  /** Whether they share no pixel. */
  const areApart = async (page, ...selectors) => {
    const boxes = await Promise.all(selectors.map((selector) => page.locator(selector).boundingBox()));
    const [a, b] = boxes;
    return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
  };

  test('the picture is seen, nothing lies over it, and nothing runs over the side', async (t) => {
    const page = await phonePage(t, '');
    assert.ok((await overflow(page)) <= 0);
    const { width, height } = await page.locator('#canvas').boundingBox();
    assert.ok(width >= 320 && height >= 400, `the picture has ${width} x ${height}`);
    for (const selector of ['#bar', '.title', '#tools']) assert.ok(await areApart(page, '#canvas', selector), selector);
    await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.08));
  });

  for (const divider of [0, 0.5, 1]) {
    test(`a picture that is divided at ${100 * divider}% does not run over the side`, async (t) => {
      const page = await phonePage(t, `mesh=wedge&n=6&explode=0,0&compare=voxels&divider=${divider}`);
      await page.locator('#divider').waitFor();
      assert.ok((await overflow(page)) <= 0);
    });
  }

  test('every control can be reached with a finger', async (t) => {
    const page = await phonePage(t, link);
    await page.locator('#panels-toggle').tap();
    await page.locator('#mesh-toggle').tap();
    for (const id of ['bar', ...panels]) {
      if (id !== 'bar') await page.locator(`#${id}-toggle`).tap();
      if (id === 'cut') await page.locator('#custom-grid summary').tap();
      assert.ok((await overflow(page)) <= 0, `${id} fits`);
      assert.ok(await areApart(page, '#canvas', `#panels`), 'the picture stays in view');
      const hidden = await page
        .locator(`#${id}`)
        .locator(controls)
        .evaluateAll((all) =>
          all
            .filter((element) => {
              if (element.tabIndex < 0 || !element.checkVisibility()) return false;
              element.scrollIntoView({ block: 'center' });
              const target = element.closest('label') ?? element;
              const { left, right, top, bottom } = target.getBoundingClientRect();
              const hit = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
              return left < 0 || right > innerWidth + 0.5 || !target.contains(hit);
            })
            .map((element) => element.id || element.textContent),
        );
      assert.deepEqual(hidden, [], `all of ${id} can be touched`);
    }
  });

  test('the card of a cell takes the place of the panels, and leaves the picture free', async (t) => {
    const page = await phonePage(t, link);
    await openPanel(page, 'view');
    await enter(page, '#pin-number', 0);
    await shows(page, '#cell-card', { cell: 0 });
    await eventually(async () => assert.equal(await page.locator('#panels').isVisible(), false));
    const { x, width } = await page.locator('#cell-card').boundingBox();
    assert.ok(x >= 0 && x + width <= 360);
    for (const selector of ['#canvas', '#bar']) assert.ok(await areApart(page, '#cell-card', selector), selector);
    await page.locator('#unpin').tap();
    await eventually(async () => assert.equal(await page.locator('#cell-card').isVisible(), false));
  });
});

test('the gallery is one stop of the Tab key; arrow keys, Home and End go through its rows and columns', async (t) => {
  const page = await site.open(t, link, { panels: [] });
  const focused = () => page.evaluate(() => document.activeElement.dataset.name ?? document.activeElement.id);
  const names = await page.locator('#gallery button').evaluateAll((all) => all.map(({ dataset }) => dataset.name));
  const tops = await page.locator('#gallery button').evaluateAll((all) => all.map((button) => button.getBoundingClientRect().top));
  const columns = tops.filter((top) => top === tops[0]).length;
  assert.ok(columns > 1);
  await page.locator('#mesh-toggle').focus();
  await page.keyboard.press('Tab');
  assert.equal(await focused(), 'wedge', 'the mesh that is shown');
  for (const [key, name] of [
    ['End', names.at(-1)],
    ['ArrowDown', names.at(-1)],
    ['ArrowUp', names.at(-1 - columns)],
    ['Home', names[0]],
    ['ArrowRight', names[1]],
    ['ArrowDown', names[1 + columns]],
    ['ArrowLeft', names[columns]],
    ['ArrowUp', names[0]],
  ]) {
    await page.keyboard.press(key);
    assert.equal(await focused(), name, key);
  }
  await page.keyboard.press('Tab');
  assert.equal(await focused(), 'open-file');
  await page.keyboard.press('Shift+Tab');
  assert.equal(await focused(), names[0]);
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Enter');
  await shows(page, '#mesh-line', { name: names[1] });
});

test('the skip link leads to the controls and leaves the settings alone', async (t) => {
  const page = await site.open(t, 'mesh=claw&n=3&free=off&explode=0,0');
  const former = await dataOf(page, '#counts');
  await page.locator('.skip').focus();
  await page.keyboard.press('Enter');
  await eventually(async () => assert.equal(await page.evaluate(() => document.activeElement.id), 'panels'));
  assert.equal(await isReady(page), 'ready');
  assert.deepEqual(await dataOf(page, '#counts'), former);
  assert.equal(await page.locator('[data-test=notice]').count(), 0);
  assert.match(page.url(), /#mesh=claw&n=3/);
});

for (const viewport of [
  { width: 1000, height: 521 },
  { width: 360, height: 640 },
]) {
  test(`the document is no higher than a window of ${viewport.width} x ${viewport.height}`, async (t) => {
    const page = await site.open(t, link, { viewport });
    for (const id of panels) {
      await openPanel(page, id);
      for (const details of await page.locator(`#${id} summary`).all()) await details.click();
      const beyond = await page.evaluate(() => Math.max(document.documentElement.scrollHeight, document.body.scrollHeight) - innerHeight);
      assert.equal(beyond, 0, `with ${id} open`);
    }
  });
}

test('the panels are folded where they would leave the picture no room; what was open in them stays open', async (t) => {
  const wide = { width: 1000, height: 521 };
  const narrow = { width: 360, height: 640 };
  const page = await site.open(t, link, { viewport: narrow, panels: [] });
  const isExpanded = async (id) => (await page.locator(`#${id}-toggle`).getAttribute('aria-expanded')) === 'true';
  const are = (expected) =>
    eventually(async () => {
      const open = [];
      for (const id of ['panels', ...panels]) if (await isExpanded(id)) open.push(id);
      assert.deepEqual(open, expected);
      assert.equal(await page.locator('#panels').isVisible(), expected.includes('panels'));
    });
  await are(['mesh']);
  await page.setViewportSize(wide);
  await are(['panels', 'mesh']);
  await page.locator('#mesh-toggle').click();
  await page.locator('#save-toggle').click();
  const { width } = await page.locator('#canvas').boundingBox();
  await page.locator('#panels-toggle').click();
  await are(['save']);
  assert.ok((await page.locator('#canvas').boundingBox()).width > width, 'the picture takes their room');
  await page.locator('#panels-toggle').click();
  await page.setViewportSize(narrow);
  await are(['save']);
});

test('where motion is unwanted nothing moves by itself', async (t) => {
  const page = await site.open(t, link, { reducedMotion: 'reduce' });
  const moving = await page.evaluate(() =>
    [...document.querySelectorAll('*')]
      .filter((element) => {
        const { transitionDuration, animationName, animationDuration } = getComputedStyle(element);
        const seconds = (text) => Math.max(...text.split(',').map(parseFloat));
        return seconds(transitionDuration) > 0.01 || (animationName !== 'none' && seconds(animationDuration) > 0.01);
      })
      .map((element) => element.outerHTML.slice(0, 80)),
  );
  assert.deepEqual(moving, []);
  const { x, y, width, height } = await page.locator('#canvas').boundingBox();
  await page.mouse.move(x + width / 4, y + height / 4);
  await page.mouse.down();
  await page.mouse.move(x + width / 2, y + height / 3, { steps: 4 });
  await page.mouse.up();
  await eventually(async () => assert.match(page.url(), /camera=/));
  const seen = async () => [(await dataOf(page, '#canvas')).frames, page.url()];
  // A busy machine still draws what the drag asked for. The pause is longer than any timer of the page that a movement sets, by a timer
  // of the page.
  await eventually(async () => {
    const before = await seen();
    await page.evaluate(() => new Promise((done) => setTimeout(done, 1500)));
    assert.deepEqual(await seen(), before, 'the picture is at rest');
  });
  assert.equal(await isReady(page), 'ready');
});
