// Which axis of a model points upwards: guessed, or chosen.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { meshFolder, skipWithoutMeshes } from '../mesh_folder.mjs';
import { importBundled } from './bundled.mjs';
import { eventually, isReady, openPanel, shows, startSite } from './page_helpers.mjs';
import { isBlue, isOrange, pixelsOf } from './pictures.mjs';
import { mandoline } from './reference.mjs';

const { guessUp } = await importBundled('worker/up.ts');
const { boundsOf } = await importBundled('model/grid_around.ts');
const { fromUpright, toUpright } = await importBundled('model/up.ts');

const boxTriangles = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
const boxCorners = ([x, y, z]) => [0, 1, 2, 3, 4, 5, 6, 7].map((bits) => [bits & 1 ? x : -x, bits & 2 ? y : -y, bits & 4 ? z : -z]);

/** A box around 0 by its extents, or, moved by `by`, another one. */
const box = (extent, by = [0, 0, 0]) => meshOf(boxCorners(extent.map((x) => x / 2)).map((corner) => corner.map((x, d) => x + by[d])));
/** A pyramid with its base at the lower end of an axis, or with axes in another order. */
const pyramid = (axis, height) => {
  const others = [0, 1, 2].filter((d) => d !== axis);
  return meshOf(
    boxCorners([0.5, 0.5, 0.5]).map((corner) => {
      const isTop = corner[axis] > 0;
      return corner.map((x, d) => (others.includes(d) ? (isTop ? 0.05 * x : x) : x * height));
    }),
  );
};
const meshOf = (corners) => ({ positions: Float64Array.from(corners.flat()), triangles: Uint32Array.from(boxTriangles) });
const guess = (file, mesh) => guessUp(file, mesh, boundsOf(mesh));

describe('the axis that is guessed', () => {
  const cases = [
    ['STL has z upwards', 'part.stl', box([1, 3, 2]), 'z'],
    ['also zipped and in capitals', 'PART.STL.GZ', box([1, 3, 2]), 'z'],
    ['glTF has y upwards, whatever lies on its side', 'plate.glb', box([4, 4, 0.1]), 'y'],
    ['a plate across z lies', 'plate.obj', box([4, 4, 0.1]), 'z'],
    ['a plate across y lies', 'plate.obj', box([4, 0.1, 4], [0, 0.3, 0]), 'y'],
    ['a drawing without any thickness is seen from its front', 'drawing.obj', box([4, 4, 0]), 'y'],
    ['what begins at 0 along z stands there', 'statue.obj', box([1, 1, 2], [0, 0, 1]), 'z'],
    ['what begins at 0 along y stands there', 'statue.ply', box([1, 2, 1], [0, 1, 0]), 'y'],
    ['what tapers along z alone has z upwards', 'tower.obj', pyramid(2, 1), 'z'],
    ['what tapers along y alone has y upwards', 'tower.obj', pyramid(1, 1), 'y'],
    ['what has a foot at the lower end of x has x upwards', 'tower.obj', pyramid(0, 1), 'x'],
    ['what begins at 0 along y and z says nothing', 'cube.obj', box([1, 1, 1], [0.5, 0.5, 0.5]), 'y'],
    ['nor does a cube about 0', 'cube.off', box([1, 1, 1]), 'y'],
    ['nor does a point', 'point.obj', box([0, 0, 0]), 'y'],
  ];
  for (const [name, file, mesh, expected] of cases) test(name, () => assert.equal(guess(file, mesh), expected));
});

describe('real meshes stand', { skip: skipWithoutMeshes }, () => {
  const standing = {
    x: ['ripc_3DBenchy'],
    y: ['cgal_bull', 'cgal_cactus', 'cgal_camel', 'codim_feline', 'common_beetle-alt', 'common_homer', 'common_teapot', 'oded_koala'],
    z: ['bullet_hokuyo', 'gcherchi_cactus', 'geocentral_fox', 'of_terrain', 'prusa_M3x10_screw', 'thingi_293137', 'vmesher_mannequin'],
  };
  for (const [up, names] of Object.entries(standing)) {
    for (const name of names) {
      test(`${name} along ${up}`, async () => {
        const file = `${name}.obj.gz`;
        assert.equal(guess(file, await mandoline.readMesh(readFileSync(join(meshFolder, file)), { name: file })), up);
      });
    }
  }
});

test('directions are told by what is to the right, above and in front, and back', () => {
  for (const [at, up] of ['x', 'y', 'z'].entries()) {
    assert.equal(fromUpright([0, 1, 0], up)[at], 1);
    assert.deepEqual(toUpright(fromUpright([1, 2, 3], up), up), [1, 2, 3]);
    const [[a, b, c], [d, e, f], front] = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ].map((axis) => fromUpright(axis, up));
    assert.equal((b * f - c * e) * front[0] + (c * d - a * f) * front[1] + (a * e - b * d) * front[2], 1, 'no mirror image');
  }
});

const objOf = ({ positions, triangles }) => {
  const rows = (letter, values) =>
    Array.from({ length: values.length / 3 }, (_, at) => `${letter} ${values.slice(3 * at, 3 * at + 3).join(' ')}`);
  return [
    ...rows('v', [...positions]),
    ...rows(
      'f',
      [...triangles].map((vertex) => vertex + 1),
    ),
  ].join('\n');
};

describe('on the page', () => {
  const files = { 'tower.obj': objOf(pyramid(2, 3)), 'needle.obj': objOf(box([0.02, 0.03, 2])) };
  let site;
  before(async () => (site = await startSite({ files })));
  after(() => site.close());

  /** How much of the picture's width and height a mesh spans; its shadow is gray. */
  const spans = ({ width, height, rgba }) => {
    const [xs, ys] = [new Set(), new Set()];
    for (let at = 0; at < rgba.length; at += 4) {
      const color = rgba.subarray(at, at + 3);
      if (!isOrange(...color) && !isBlue(...color)) continue;
      xs.add((at / 4) % width);
      ys.add(Math.floor(at / 4 / width));
    }
    const span = (values, size) => (Math.max(...values) - Math.min(...values) + 1) / size;
    return { across: span(xs, width), upright: span(ys, height) };
  };
  const drop = async (page, name) => {
    await page.locator('#url').fill(site.meshUrl(name));
    await page.locator('#open-url').click();
    await shows(page, '#mesh-line', { name });
    assert.equal(await isReady(page), 'ready');
  };

  test('what stands along z is seen upright and whole, and is laid down by hand', async (t) => {
    const page = await site.open(t, 'mesh=claw&n=2&x=0.5,1', { colorScheme: 'light' });
    await drop(page, 'tower.obj');
    assert.equal(await page.locator('#slice-x').isChecked(), false, 'a plane of the last mesh hides nothing');
    await eventually(async () => {
      const { across, upright } = spans(await pixelsOf(page));
      assert.ok(upright > 0.7 && upright < 0.9 && across < 0.5, `${upright} upright, ${across} across`);
    });
    await openPanel(page, 'view');
    await page.locator('#up-y').check({ force: true });
    await eventually(async () => {
      const { across, upright } = spans(await pixelsOf(page));
      assert.ok(across > 0.2 && (across > 0.7 || upright > 0.7), `${upright} upright, ${across} across`);
    });
    await eventually(async () => assert.match(page.url(), /up=y/));
    await drop(page, 'needle.obj');
    assert.equal(await page.locator('#up-auto').isChecked(), true, 'another mesh stands as it seems to');
    await eventually(async () => {
      const { across, upright } = spans(await pixelsOf(page));
      assert.ok(Math.max(across, upright) > 0.7, `${upright} upright, ${across} across`);
    });
  });
});
