import assert from 'node:assert/strict';
import { after, describe, test } from 'node:test';
import { writeObj } from '../package/meshes.mjs';
import { dataOf, enter, eventually, openPanel, shows, slideTo, startSite, textOf } from './page_helpers.mjs';
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
    await slideTo(page, '#cells', 7);
    await eventually(async () => assert.equal((await dataOf(page, '#validation')).pass, undefined, 'of another cut nothing is said'));
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
