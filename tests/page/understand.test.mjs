import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { writeObj } from '../package/meshes.mjs';
import { dataOf, enter, eventually, isReady, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
import { covered, difference, looksLike, pixelsOf, settledPixels, tiles } from './pictures.mjs';
import { cutOf, galleryMesh, mandoline } from './reference.mjs';

const knot = await galleryMesh('torus-knot');
const sheet = await galleryMesh('wavy-plane');
/** Two triangles that cross within a grid cell. */
const crossed = {
  positions: Float64Array.of(4, 4, 2, 3, 1, 4, 0, 0, 0, 4, 0, 2, 3, 1, 2, 1, 4, 2),
  triangles: Uint32Array.of(0, 1, 2, 3, 4, 5),
};
const site = await startSite({ files: { 'crossed.obj': writeObj(crossed), 'knot.obj': writeObj(knot), 'sheet.obj': writeObj(sheet) } });
after(() => site.close());
const link = `url=${site.meshUrl('knot.obj')}&n=6&free=off&explode=0,0`;
const reference = await cutOf(knot, { cells: 6 });
const { cutMesh } = reference;

async function hasStepText(page, words) {
  await eventually(async () => assert.match(await textOf(page, '#step-text'), words));
}

describe('steps', () => {
  test('one after the other, each with its picture and text', async (t) => {
    const page = await site.open(t, link);
    const model = tiles(await settledPixels(page));
    await openPanel(page, 'steps');
    const pictures = [model];
    for (const step of ['triEdges', 'hybridEdges', 'triangleFaces', 'axialPlane', 'gridCell']) {
      await page.locator('#step-next').click();
      await shows(page, '#canvas', { instead: step });
      assert.equal(await page.locator(`#step-${step}`).getAttribute('aria-current'), 'step');
      assert.ok((await textOf(page, '#step-text')).length > 40);
      await looksLike(page, `step ${step}`);
      const picture = await pixelsOf(page);
      assert.ok(covered(picture) > 0.01);
      for (const former of pictures) assert.ok(difference(former, tiles(picture)) > 2, `${step} looks unlike the others`);
      pictures.push(tiles(picture));
    }
    assert.equal(await page.locator('#step-next').isDisabled(), true);
    await page.locator('#step-gridCell').press('ArrowLeft');
    await shows(page, '#canvas', { instead: 'axialPlane' });
    await page.locator('#step-leave').click();
    await shows(page, '#canvas', { instead: '' });
    await eventually(async () => assert.ok(difference(model, tiles(await pixelsOf(page))) < 1, 'the model again, seen as before'));
  });

  test('the cut-faces of any triangle', async (t) => {
    const page = await site.open(t, link);
    await openPanel(page, 'steps');
    await page.locator('#step-triangleFaces').click();
    await shows(page, '#canvas', { instead: 'triangleFaces' });
    assert.equal(await page.locator('#step-triangle').getAttribute('max'), String(cutMesh.triangleCount - 1));
    for (const triangle of [0, 17, cutMesh.triangleCount - 1]) {
      await enter(page, '#step-triangle-number', triangle);
      const faces = cutMesh.faceTriangle.filter((id) => id === triangle).length;
      await hasStepText(page, new RegExp(`triangle ${triangle} into ${faces} cut-face`));
      assert.equal(await page.locator('#step-triangle').inputValue(), String(triangle));
    }
  });

  test('a small picture shows where on the model a triangle is, and none where all of the grid is seen', async (t) => {
    const page = await site.open(t, link);
    await openPanel(page, 'steps');
    await page.locator('#step-axialPlane').click();
    await shows(page, '#canvas', { instead: 'axialPlane', inset: '' });
    await page.locator('#step-triangleFaces').click();
    await shows(page, '#canvas', { instead: 'triangleFaces', inset: 'shown' });
    const middleX = (triangle) => [0, 1, 2].reduce((sum, k) => sum + knot.positions[3 * knot.triangles[3 * triangle + k]] / 3, 0);
    const byX = Array.from({ length: knot.triangles.length / 3 }, (_, triangle) => triangle).sort((a, b) => middleX(a) - middleX(b));
    const markOf = async (triangle) => {
      await enter(page, '#step-triangle-number', triangle);
      await hasStepText(page, new RegExp(`triangle ${triangle} `));
      const { rgba, width } = await settledPixels(page);
      const [columns, rows] = [
        [18, 140],
        [66, 190],
      ];
      let [count, sum] = [0, 0];
      for (let y = rows[0]; y < rows[1]; ++y) {
        for (let x = columns[0]; x < columns[1]; ++x) {
          const [r, g, b] = rgba.subarray(4 * (x + width * y), 4 * (x + width * y) + 3);
          if (r > 190 && g < 90 && b > 100) [count, sum] = [count + 1, sum + x];
        }
      }
      assert.ok(count > 20, `${count} pixels of the mark`);
      return sum / count;
    };
    const [left, right] = [await markOf(byX[0]), await markOf(byX.at(-1))];
    assert.ok(right - left > 45, `from ${left} to ${right}`);
    await page.locator('#step-leave').click();
    await shows(page, '#canvas', { instead: '', inset: '' });
  });

  test('any axial plane', async (t) => {
    const page = await site.open(t, link);
    await openPanel(page, 'steps');
    await page.locator('#step-axialPlane').click();
    await shows(page, '#canvas', { instead: 'axialPlane' });
    for (const [axis, plane] of [
      [1, 2],
      [2, 1],
    ]) {
      await page.locator(`#step-axis-${axis}`).check();
      await slideTo(page, '#step-plane', plane);
      const faces = cutMesh.faceAxis.filter((at, face) => at === axis && cutMesh.facePlane[face] === plane).length;
      await hasStepText(page, new RegExp(`axial plane ${plane} normal to ${'xyz'[axis]}, .* into ${faces} faces?\\b`));
    }
  });

  test('any grid cell', async (t) => {
    const page = await site.open(t, link);
    await openPanel(page, 'steps');
    await page.locator('#step-gridCell').click();
    await shows(page, '#canvas', { instead: 'gridCell' });
    const wanted = [3, 1, 2];
    for (const [d, axis] of ['x', 'y', 'z'].entries()) await slideTo(page, `#step-cell-${axis}`, wanted[d]);
    const isWanted = (cell) => wanted.every((c, d) => cutMesh.cellGridCell[3 * cell + d] === c);
    const cells = Array.from(cutMesh.cellRegion.keys()).filter(isWanted).length;
    assert.ok(cells > 1);
    await hasStepText(page, new RegExp(`^Grid cell \\(${wanted.join(', ')}\\) holds ${cells} cut-cells `));
    await page.locator('#canvas').press('Escape');
    await shows(page, '#canvas', { instead: '' });
  });
});

/** Runs in the page before all else: counts how often the worker is asked for checks. */
function noteChecks() {
  const { postMessage } = Worker.prototype;
  window.checks = 0;
  Worker.prototype.postMessage = function (message, ...rest) {
    if (Object.values(message).includes('validate')) ++window.checks;
    return postMessage.call(this, message, ...rest);
  };
}

/** After a pause, by the page's own timer: those that were set before it have gone off then. */
async function areNotAsked(page, why) {
  const [before, after] = await page.evaluate(async () => {
    const { checks } = window;
    await new Promise((resolve) => setTimeout(resolve, 1200));
    return [checks, window.checks];
  });
  assert.equal(after, before, why);
  assert.equal(await page.locator('#check-line').count(), 0, why);
}

describe('checks', () => {
  test('all pass for the bunny; their deviations are there for those who ask', async (t) => {
    const page = await site.open(t, 'mesh=bunny&n=8&free=off');
    const { mesh, cutMesh: bunny } = await cutOf(await galleryMesh('bunny'), { cells: 8 });
    const { checks } = await mandoline.validate(mesh, bunny);
    await openPanel(page, 'checks');
    await page.locator('#validate').click();
    await shows(page, '#validation', { pass: true, failed: 0, skipped: 0, passed: checks.length });
    const listed = page.locator('#validation [data-check]');
    const states = await listed.evaluateAll((all) => all.map(({ dataset }) => [dataset.check, dataset.state]));
    assert.deepEqual(
      states,
      checks.map(({ name }) => [name, 'pass']),
    );
    for (const { name, tolerance } of checks) {
      const text = await textOf(page, `[data-check="${name}"]`);
      assert.ok(text.endsWith(tolerance === 0 ? 'no violations' : 'exact, up to rounding'), `${name}: ${text}`);
    }
    await page.locator('#deviations summary').click();
    const rows = checks.filter(({ tolerance }) => tolerance > 0).map(({ worst, tolerance }) => [Number(worst.toPrecision(4)), tolerance]);
    const shown = await page.locator('#deviations tbody tr').evaluateAll((all) => {
      return all.map((row) => [...row.cells].slice(1).map((cell) => Number(cell.innerText)));
    });
    assert.deepEqual(shown, rows);
  });

  test('of a small cut are made by themselves once it stands, and told in one line', async (t) => {
    const page = await site.open(t, link, { onNewPage: (made) => made.addInitScript(noteChecks) });
    const { grid, cellGridCell, cellRegion } = cutMesh;
    const filled = new Map();
    reference.measures.cellVolume.forEach((volume, cell) => {
      const at = cellGridCell.subarray(3 * cell, 3 * cell + 3);
      const size = at.reduce((product, i, d) => product * (grid.planes[d][i + 1] - grid.planes[d][i]), 1);
      filled.set(at.join(), (filled.get(at.join()) ?? 0) + volume / size);
    });
    const gap = Math.max(...Array.from(filled.values(), (share) => Math.abs(share - 1)));
    assert.ok(gap < 1e-14, `${gap} of a cell`);
    const isChecked = () =>
      eventually(async () => assert.equal((await dataOf(page, '#check-line')).model, (await dataOf(page, '#counts')).model));
    await isChecked();
    assert.equal(await page.evaluate(() => window.checks), 1);
    const [count, words] = [cellRegion.length.toLocaleString('en'), gap === 0 ? 'exactly' : `within ${gap.toPrecision(1)} of a cell`];
    assert.equal(await textOf(page, '#check-line'), `All ${count} cut-cells are closed; their volumes fill their grid cells ${words}.`);
    await page.mouse.move(300, 300);
    await page.mouse.down();
    await slideTo(page, '#cells', 7);
    assert.equal(await isReady(page), 'ready');
    await areNotAsked(page, 'of a cut that is held nothing is said');
    await page.mouse.up();
    await isChecked();
    await slideTo(page, '#cells', 24);
    assert.equal(await isReady(page), 'ready');
    assert.ok(Number((await dataOf(page, '#counts')).faces) > 14_000);
    await areNotAsked(page, 'a larger one is checked when that is asked for');
    await openPanel(page, 'checks');
    await page.locator('#validate').click();
    await isChecked();
    await shows(page, '#validation', { pass: true });
  });

  test('that fail are said loudly', async (t) => {
    const page = await site.open(t, link, {
      onNewPage: (made) =>
        made.addInitScript(() => {
          // The page's own cuts pass.
          window.Worker = class extends Worker {
            addEventListener(type, take) {
              super.addEventListener(type, (event) => {
                const check = event.data?.value?.checks?.[8];
                if (check) Object.assign(check, { pass: false, worst: 1, message: 'Cell 3 is not closed.' });
                if (check) event.data.value.pass = false;
                take(event);
              });
            }
          };
        }),
    });
    await page.getByRole('alert').filter({ hasText: 'The cut-mesh is wrong' }).waitFor();
    assert.match(await textOf(page, '#check-line'), /^1 of \d+ checks failed\. Cell 3 is not closed\.$/);
  });

  test('what fails is said in sentences, without raw numbers', async () => {
    const { mesh, cutMesh } = await cutOf(crossed, { cells: 2 }); // the page's own cuts pass
    const wrong = structuredClone(cutMesh);
    wrong.positions[0] += 0.05;
    const failing = (await mandoline.validate(mesh, wrong)).checks.filter((check) => !check.pass);
    assert.ok(failing.length > 0);
    for (const { message } of failing) {
      assert.match(message, /^[A-Z].+\.$/);
      assert.doesNotMatch(message, /\d{6}|allowed/);
    }
  });

  test('of an open mesh those that do not apply are skipped', async (t) => {
    const page = await site.open(t, `url=${site.meshUrl('sheet.obj')}&n=6&free=off`);
    const { mesh, cutMesh: open } = await cutOf(sheet, { cells: 6 });
    const { checks } = await mandoline.validate(mesh, open);
    const skipped = checks.filter((check) => check.skipped).map(({ name }) => name);
    assert.ok(skipped.length > 0);
    await openPanel(page, 'checks');
    await page.locator('#validate').click();
    await shows(page, '#validation', { pass: true, failed: 0, skipped: skipped.length });
    const listed = page.locator('#validation [data-state="skipped"]');
    assert.deepEqual(await listed.evaluateAll((all) => all.map(({ dataset }) => dataset.check)), skipped);
  });
});
