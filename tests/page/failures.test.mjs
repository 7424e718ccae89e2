// What the page shows when a mesh can't be read or cut, or when nothing of it is left to see.
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { after, describe, test } from 'node:test';
import { writeObj } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { crossing, notFinite, octahedronFiles } from './mesh_files.mjs';
import { dataOf, enter, eventually, isReady, openPanel, shows, startSite, textOf } from './page_helpers.mjs';
import { covered, difference, pixelsOf, settledPixels, tiles } from './pictures.mjs';
import { galleryMesh, mandoline } from './reference.mjs';

const { Thread } = await importBundled('page/thread.ts');
const needle = 'v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 1 0\nv 3 1 0\nf 1 2 3\nf 1 4 5\nf 2 2 4\n';
const site = await startSite({ files: octahedronFiles });
after(() => site.close());
const start = 'mesh=wedge&n=4';

async function pick(page, name, content) {
  await page.locator('#file').setInputFiles({ name, mimeType: 'application/octet-stream', buffer: Buffer.from(content) });
}

async function openUrl(page, url) {
  await page.locator('#url').fill(url);
  await page.locator('#open-url').click();
}

/** The package's grid around the box of a mesh, by a triangle without area that has this box. */
function gridAround({ positions, triangles }, cells) {
  const end = (best) => [0, 1, 2].map((d) => triangles.reduce((x, v) => best(x, positions[3 * v + d]), positions[3 * triangles[0] + d]));
  const diagonal = { positions: [...end(Math.min), ...end(Math.max)], triangles: [0, 1, 1] };
  return mandoline.cut(diagonal, { cells }, { gridCellRegion: false }).grid;
}

async function hasGridFields(page, { cells, planes }) {
  await eventually(async () => {
    for (const [d, axis] of ['x', 'y', 'z'].entries()) {
      const read = async (key) => Number(await page.locator(`#grid-${key}-${axis}`).inputValue());
      assert.equal(await read('cells'), cells[d]);
      const size = planes[d].at(-1) - planes[d][0];
      for (const [key, x] of [
        ['min', planes[d][0]],
        ['max', planes[d].at(-1)],
      ]) {
        assert.ok(Math.abs((await read(key)) - x) < 1e-12 * size, `${key} along ${axis}: ${await read(key)} instead of ${x}`);
      }
    }
  });
}

/** A server that sends the file when it is told to. */
async function slowHost(t, content) {
  const waiting = [];
  const server = createServer((_request, response) => {
    response.writeHead(200, { 'Access-Control-Allow-Origin': '*' });
    response.flushHeaders();
    waiting.push(() => response.end(content));
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  t.after(() => {
    server.close();
    server.closeAllConnections();
  });
  return { url: `http://127.0.0.1:${server.address().port}/slow.obj`, send: () => waiting.splice(0).forEach((answer) => answer()) };
}

describe('a mesh that cannot be cut', () => {
  test('takes the place of the former one: nothing of that is shown or saved', async (t) => {
    const page = await site.open(t, start);
    await enter(page, '#pin-number', 0);
    await shows(page, '#cell-card', { cell: 0 });
    await pick(page, 'not-finite.obj', writeObj(notFinite));
    await page.locator('#stage-note').waitFor();
    assert.match(await textOf(page, '#stage-note'), /can't be cut.*vertex \d+/i);
    assert.equal(await isReady(page), 'error');
    await shows(page, '#mesh-line', { name: 'not-finite.obj' });
    await eventually(async () => assert.ok(covered(await pixelsOf(page)) < 0.001, 'the former picture is gone'));
    assert.equal((await textOf(page, '#counts')).trim(), '');
    assert.doesNotMatch(await textOf(page, '#hover-line'), /wedge/);
    assert.equal(await page.locator('#cell-card').isVisible(), false);
    for (const panel of ['save', 'checks', 'steps']) await openPanel(page, panel);
    for (const button of ['#save-json', '#save-vtu', '#save-obj', '#save-glb', '#save-png', '#validate', '#step-next']) {
      assert.equal(await page.locator(button).isDisabled(), true, `${button} has nothing to work on`);
    }
    await page.locator('#gallery [data-name="wedge"]').click();
    await shows(page, '#mesh-line', { name: 'wedge' });
    assert.equal(await isReady(page), 'ready');
    assert.equal(await page.locator('#stage-note').isVisible(), false);
    assert.equal(await page.locator('#save-json').isDisabled(), false);
    await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.05));
  });

  test('has its own grid in the fields of the custom grid, also where no cut succeeds', async (t) => {
    const page = await site.open(t, start);
    await page.locator('#custom-grid summary').click();
    await hasGridFields(page, gridAround(await galleryMesh('wedge'), 4));
    await pick(page, 'crossing.obj', writeObj(crossing));
    await shows(page, '#mesh-line', { name: 'crossing.obj' });
    await hasGridFields(page, gridAround(crossing, 4));
    await page.locator('#gallery [data-name="wedge"]').click();
    await shows(page, '#mesh-line', { name: 'wedge' });
    await enter(page, '#cells-number', 512);
    await eventually(async () => assert.match(await textOf(page, '#cut-error'), /too fine/));
    await hasGridFields(page, gridAround(await galleryMesh('wedge'), 512));
  });

  test('in a grid that is too fine keeps its picture, which is of the same mesh', async (t) => {
    const page = await site.open(t, start);
    const { model } = await dataOf(page, '#counts');
    await enter(page, '#cells-number', 512);
    await eventually(async () => assert.match(await textOf(page, '#cut-error'), /too fine/));
    assert.equal(await isReady(page), 'error');
    await shows(page, '#counts', { model });
    assert.equal(await page.locator('#stage-note').isVisible(), false);
    assert.ok(covered(await pixelsOf(page)) > 0.05);
  });
});

describe('while a mesh is loading', () => {
  test('the page says so, and it can be cancelled', async (t) => {
    const host = await slowHost(t, octahedronFiles['octahedron.obj']);
    const page = await site.open(t, start);
    await openUrl(page, host.url);
    await page.locator('#progress').waitFor();
    assert.match(await textOf(page, '#progress'), /Loading/);
    await page.locator('#cancel').click();
    assert.equal(await isReady(page), 'ready');
    assert.equal(await page.locator('#progress').isVisible(), false);
    await shows(page, '#mesh-line', { name: 'wedge' });
    await openUrl(page, host.url);
    await page.locator('#progress').waitFor();
    host.send();
    await shows(page, '#mesh-line', { name: 'slow.obj' });
    assert.equal(await isReady(page), 'ready');
    assert.equal(await page.locator('#progress').isVisible(), false);
  });
});

describe('what is too large or too small to be drawn', () => {
  const scaled = (scale) => writeObj({ ...crossing, positions: crossing.positions.map((x) => x * scale) });

  for (const [scale, says] of [
    [6e307, /more than 1e\+18 across/],
    [1e19, /more than 1e\+18 across/],
    [1e-20, /less than 1e-18 across/],
    [1e-308, /less than 1e-18 across/],
  ]) {
    test(`a mesh with coordinates near ${scale} is refused`, async (t) => {
      const page = await site.open(t, start);
      await pick(page, 'scaled.obj', scaled(scale));
      await eventually(async () => assert.match(await textOf(page, '[data-test=alert]'), says));
      assert.match(await textOf(page, '[data-test=alert]'), /^scaled\.obj can't be drawn/);
      await shows(page, '#mesh-line', { name: 'wedge' });
    });
  }

  for (const scale of [1e17, 1e-17]) {
    test(`a mesh with coordinates near ${scale} is drawn`, async (t) => {
      const page = await site.open(t, start);
      await pick(page, 'scaled.obj', scaled(scale));
      await shows(page, '#mesh-line', { name: 'scaled.obj' });
      assert.equal(await isReady(page), 'ready');
      await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.05));
    });
  }

  test('a grid of a link is refused, and its mesh shown in another', async (t) => {
    const page = await site.open(t, 'mesh=wedge&n=2,2,2&box=-1e300,-1e300,-1e300,1e300,1e300,1e300');
    assert.match(await textOf(page, '[data-test=alert]'), /The grid can't be drawn.*more than 1e\+18 across/);
    await eventually(async () => assert.ok(covered(await pixelsOf(page)) > 0.05));
  });
});

describe('alerts', () => {
  const alerts = '[data-test=alert]';

  test('of any length leave half of the page free, and can be dismissed', async (t) => {
    const page = await site.newPage(t);
    await page.goto(`${site.url}#mesh=${'a'.repeat(4000)}`);
    await page.locator(alerts).waitFor();
    const { height } = await page.locator(alerts).boundingBox();
    assert.ok(height <= page.viewportSize().height / 2, `${height} pixels`);
    await page.locator(alerts).getByRole('button', { name: 'Dismiss' }).click();
    await eventually(async () => assert.equal(await page.locator(alerts).count(), 0));
  });

  test('go when the next mesh is shown', async (t) => {
    const page = await site.open(t, start);
    await pick(page, 'empty.obj', '');
    await page.locator(alerts).waitFor();
    await page.locator('#gallery [data-name="claw"]').click();
    await shows(page, '#mesh-line', { name: 'claw' });
    await eventually(async () => assert.equal(await page.locator(alerts).count(), 0));
  });

  test('go when the next cut is shown', async (t) => {
    const page = await site.open(t, start);
    await pick(page, 'empty.obj', '');
    await page.locator(alerts).waitFor();
    await enter(page, '#cells-number', 5);
    await eventually(async () => assert.equal(await page.locator(alerts).count(), 0));
  });

  test('stay when the page falls back to another mesh than the one asked for', async (t) => {
    const page = await site.open(t, 'mesh=unicorn');
    await shows(page, '#mesh-line', { name: 'bunny' });
    assert.match(await textOf(page, alerts), /unicorn/);
  });
});

test('a mesh of degenerate triangles alone leaves a word instead of an empty picture', async (t) => {
  const page = await site.open(t, start);
  await pick(page, 'needle.obj', needle);
  await page.locator('#stage-note').waitFor();
  assert.match(await textOf(page, '#stage-note'), /All 3 triangles are degenerate/);
  assert.equal(await page.locator('#legend').isVisible(), false);
  assert.equal(await isReady(page), 'ready');
  await page.locator('#gallery [data-name="claw"]').click();
  await shows(page, '#mesh-line', { name: 'claw' });
  await page.locator('#stage-note').waitFor({ state: 'hidden' });
});

describe('when the graphics context is lost', () => {
  const alert = '[data-test=alert]';
  const lose = (page) =>
    page.evaluate(() => {
      window.lost = document.getElementById('canvas').getContext('webgl2').getExtension('WEBGL_lose_context');
      window.lost.loseContext();
    });
  const restore = (page) => page.evaluate(() => window.lost.restoreContext());

  test('the page says so, answers touches, and draws all of the picture again once it is back', async (t) => {
    const page = await site.open(t, `${start}&explode=0,0`);
    const before = await settledPixels(page);
    const { x, y, width, height } = await page.locator('#canvas').boundingBox();
    await lose(page);
    await eventually(async () => assert.match(await textOf(page, alert), /The picture is lost for now/));
    await page.mouse.click(x + width / 2, y + height / 2);
    await restore(page);
    await eventually(async () => assert.equal(await page.locator(alert).count(), 0));
    await page.mouse.move(x + 1, y + 1);
    await eventually(async () => {
      const by = difference(tiles(before), tiles(await settledPixels(page)));
      assert.ok(by < 0.1, `it differs by ${by}`);
    });
    await page.mouse.click(x + width / 2, y + height / 2);
    await page.locator('#cell-card').waitFor();
  });

  test('the page says so until it is back, whatever is answered meanwhile', async (t) => {
    const page = await site.open(t, `${start}&explode=0,0`);
    await lose(page);
    await eventually(async () => assert.match(await textOf(page, alert), /The picture is lost for now/));
    await page.evaluate(() => (location.hash += '&compare=voxels'));
    await page.locator('#divider').waitFor();
    assert.match(await textOf(page, alert), /The picture is lost for now/);
    await restore(page);
    await eventually(async () => assert.equal(await page.locator(alert).count(), 0));
  });
});

test('that a mesh is not there is still said when another one, which takes its place, has been compared', async (t) => {
  const page = await site.open(t, 'mesh=unicorn&n=4&explode=0,0&compare=voxels', { panels: [] });
  await page.locator('#divider').waitFor();
  assert.match(await textOf(page, '#alerts'), /no "unicorn"/);
  await page.locator('#cells').press('ArrowRight');
  await eventually(async () => assert.equal(await textOf(page, '#alerts'), ''));
});

test('a worker that turns out not to start does not take the place of the one after it, and is ended in silence', async () => {
  const workers = [];
  const open = () => new Promise((resolve, reject) => workers.push({ resolve, reject }));
  const thread = new Thread(open, () => undefined);
  thread.start();
  thread.end();
  const answer = thread.call('cut', null);
  workers[1].resolve({ call: async () => 'cells', terminate() {} });
  assert.equal(await answer, 'cells');
  workers[0].reject(new Error('no memory'));
  await new Promise(setImmediate);
  assert.equal(await thread.call('cut', null), 'cells');
  assert.equal(workers.length, 2);
});

test('of a mesh that a worker lacks again, or that is no longer there to be given, the page says so', async () => {
  const given = [];
  const lacking = async () => ({
    async call(name, [ask]) {
      if (name !== 'keep') throw { lacksMesh: 7 };
      given.push(ask);
    },
    terminate() {},
  });
  const said = { title: "The mesh can't be cut", detail: 'Another mesh has taken the place of its own.' };
  await assert.rejects(new Thread(lacking, (id) => ({ id })).call('cut', null), said);
  assert.deepEqual(given, [{ id: 7 }]);
  await assert.rejects(new Thread(lacking, () => undefined).call('cut', null), said);
  assert.equal(given.length, 1);
});

test('where the code can not be written for lack of its module the page says so, and loads it when the panel is opened again', async (t) => {
  const page = await site.newPage(t, { expectedProblem: /ERR_FAILED/ });
  await page.route(/\/code-.*\.js/, (route) => route.abort());
  await page.goto(`${site.url}#mesh=wedge&n=4`);
  await isReady(page);
  await openPanel(page, 'code');
  await eventually(async () => assert.match(await textOf(page, '#code'), /can't be loaded/));
  await page.unrouteAll({ behavior: 'wait' });
  await page.locator('#code-toggle').click();
  await openPanel(page, 'code');
  await eventually(async () => assert.match(await textOf(page, '#javascript-text'), /mandoline/));
});
