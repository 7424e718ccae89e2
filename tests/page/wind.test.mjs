// The wind tunnel's flows beside the package's own, and beside those of the command line.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { initPhysics } from 'mandoline-wasm/physics';
import { box } from '../package/meshes.mjs';
import { importBundled } from './bundled.mjs';
import { galleryMesh, mandoline } from './reference.mjs';

const physics = await initPhysics();
const pack = { mandoline, physics };
const { makeTunnel } = await importBundled('worker/wind/tunnel.ts');
const { flowOf, solveAhead } = await importBundled('worker/wind/flows.ts');
const { tunnelLines } = await importBundled('worker/wind/lines.ts');
const { windPicture } = await importBundled('worker/wind/picture.ts');
const { writeWind } = await importBundled('worker/wind/write.ts');
const { boundsOf } = await importBundled('model/grid_around.ts');
const { WindTunnel } = await importBundled('page/wind.ts');
const program = process.env.MANDOLINE_CLI ?? fileURLToPath(new URL('../../build/mandoline', import.meta.url));

const loaded = (mesh, name = 'a mesh') => ({ ...mesh, id: 1, name, bounds: boundsOf(mesh) });
const request = (part = {}) => ({ mesh: 1, pose: null, cells: 48, direction: [1, 0, 0], surface: false, known: '', planes: [], ...part });
const bunny = loaded(await galleryMesh('bunny'), 'bunny');
const slanted = [0.48, -0.6, 0.64];

function largestDifference(a, b) {
  return a.reduce((most, x, at) => Math.max(most, Math.abs(x - b[at])), 0);
}

test('the flow of a slanted wind is that of winds along the axes combined', async () => {
  const tunnel = await makeTunnel(pack, bunny, { mesh: 1, pose: null, cells: 32 });
  while (await solveAhead(pack, tunnel));
  const combined = await flowOf(pack, tunnel, slanted);
  const solved = physics.solveFlow(tunnel.cells, slanted);
  assert.ok(!('phi' in combined), 'nothing was solved');
  // Each solution's corrections end when less than a 30,000th of the first ones is missing.
  assert.ok(largestDifference(combined.cellVelocity, solved.cellVelocity) < 1e-4);
  const size = tunnel.cutMesh.grid.spacing[0];
  assert.ok(size * largestDifference(combined.cellGradient, solved.cellGradient) < 1e-4);
});

test('a wind that a wall holds back is not combined', async () => {
  const wall = loaded({
    positions: Float64Array.of(0.1, -9, -9, 0.1, 9, -9, 0.1, 9, 9, 0.1, -9, 9),
    triangles: Uint32Array.of(0, 1, 2, 0, 2, 3),
  });
  // A grid that the wall divides.
  const tunnel = await makeTunnel(pack, wall, { mesh: 1, pose: null, cells: 8 });
  tunnel.cutMesh = mandoline.cut(wall, { min: [-1, -1, -1], max: [1, 1, 1], cells: [8, 8, 8] });
  tunnel.cells = physics.cellComplex(wall, tunnel.cutMesh);
  while (await solveAhead(pack, tunnel));
  const flow = await flowOf(pack, tunnel, slanted);
  assert.equal(flow.throttled.length, 2);
  assert.deepEqual(flow.cellVelocity, physics.solveFlow(tunnel.cells, slanted).cellVelocity);
});

test('pulses follow the streamlines at the speed of the flow, on a third of their points', async () => {
  const tunnel = await makeTunnel(pack, bunny, { mesh: 1, pose: null, cells: 24 });
  const { lines, size, origin } = await windPicture(pack, tunnel, request(), 0);
  const { arrival, offsets, position, speed } = lines;
  const all = await tunnelLines(pack, tunnel, await flowOf(pack, tunnel, [1, 0, 0]));
  assert.ok(Math.abs(offsets.length - 501) < 60, `${offsets.length - 1} lines`);
  assert.equal(offsets.length, all.offsets.length);
  assert.ok(speed.length < all.speeds.length / 2.5, `${speed.length} of ${all.speeds.length} points are drawn`);
  const place = (values, at) => [...values.subarray(3 * at, 3 * at + 3)];
  const minus = (a, b) => a.map((x, d) => x - b[d]);
  for (let line = 0; line + 1 < offsets.length; ++line) {
    let drawn = offsets[line];
    let time = 0;
    for (let at = all.offsets[line]; at < all.offsets[line + 1]; ++at) {
      const point = minus(place(all.points, at), origin);
      if (at > all.offsets[line]) {
        const length = Math.hypot(...minus(place(all.points, at), place(all.points, at - 1)));
        // Slower than this is made faster, so that it is seen.
        time += length / Math.max(0.03, (all.speeds[at] + all.speeds[at - 1]) / 2);
      }
      const isDrawn = (k) => k < offsets[line + 1] && Math.hypot(...minus(place(position, k), point)) < 1e-5 * size;
      if (isDrawn(drawn + 1)) ++drawn;
      if (isDrawn(drawn)) {
        // It may be the point beside the one that is drawn.
        assert.ok(
          Math.abs(arrival[drawn] - time) < 1e-4 * size && Math.abs(speed[drawn] - all.speeds[at]) < 1e-4,
          `line ${line}, point ${at}`,
        );
        continue;
      }
      const [from, to] = [place(position, drawn), place(position, drawn + 1)];
      const [way, gone] = [minus(to, from), minus(point, from)];
      const share = way.reduce((sum, x, d) => sum + x * gone[d], 0) / way.reduce((sum, x) => sum + x * x, 0);
      const differs = (values, value) => Math.abs(values[drawn] + share * (values[drawn + 1] - values[drawn]) - value);
      assert.ok(Math.hypot(...gone.map((x, d) => x - share * way[d])) < 0.0011 * size, `line ${line}, point ${at}`);
      assert.ok(differs(arrival, time) < 0.011 * size && differs(speed, all.speeds[at]) < 0.031, `line ${line}, point ${at}`);
    }
    assert.equal(drawn, offsets[line + 1] - 1, 'to the end');
  }
});

test('the surface of a box has the speed of the cells outside it, and none of its inside', async () => {
  const tunnel = await makeTunnel(pack, loaded(box([-1, -1, -1], [1, 1, 1])), { mesh: 1, pose: null, cells: 16 });
  const { surface } = await windPicture(pack, tunnel, request({ surface: true }), 0);
  const { position, index } = surface.shape;
  const corner = (at) => [...position.subarray(3 * index[at], 3 * index[at] + 3)];
  let volume = 0;
  for (let at = 0; at < index.length; at += 3) {
    const [a, b, c] = [corner(at), corner(at + 1), corner(at + 2)];
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  assert.ok(Math.abs(volume - 8) < 1e-5, `seen from outside, once: it encloses ${volume}`);
  // In front of the box the wind stands still, and beside it it is faster.
  const speedNear = (x, y, z) =>
    surface.speed[
      [...surface.speed.keys()].find((at) => Math.hypot(position[3 * at] - x, position[3 * at + 1] - y, position[3 * at + 2] - z) < 1e-6)
    ];
  assert.ok(speedNear(-1, 0, 0) < 0.2);
  assert.ok(speedNear(0, 1, 0) > 1);
  const again = await windPicture(pack, tunnel, request({ surface: true, known: tunnel.key }), 0);
  assert.equal(again.surface.shape, null);
  assert.deepEqual(again.surface.speed, surface.speed);
});

test('a section has the area of the tunnel, and no speed within a body', async () => {
  const tunnel = await makeTunnel(pack, bunny, { mesh: 1, pose: null, cells: 24 });
  const normal = [0.6, 0, 0.8];
  const offset = normal.reduce((sum, n, d) => sum + n * tunnel.origin[d], 0);
  const { sections, half } = await windPicture(pack, tunnel, request({ planes: [{ normal, offset }] }), 0);
  const [{ shape, speed, edges }] = sections;
  const corner = (at) => shape.position.subarray(3 * shape.index[at], 3 * shape.index[at] + 3);
  let [area, still] = [0, 0];
  for (let at = 0; at < shape.index.length; at += 3) {
    const [a, b, c] = [corner(at), corner(at + 1), corner(at + 2)];
    const [u, v] = [b, c].map((p) => p.map((x, d) => x - a[d]));
    const size = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    area += size;
    if (speed[shape.index[at]] < 0) still += size;
  }
  const whole = 2 * half[1] * 2 * Math.min(half[0] / 0.8, half[2] / 0.6);
  assert.ok(Math.abs(area / whole - 1) < 1e-4, `${area} of ${whole}`);
  assert.ok(still > 0.01 * whole && still < 0.2 * whole, `${still} of ${whole}`);
  assert.equal(edges.length % 6, 0);
});

/** An array of numbers in a VTU file. */
function arrayIn(vtu, name) {
  const head = vtu.toString('latin1', 0, 10_000);
  const begin = vtu.indexOf('_', vtu.indexOf('<AppendedData')) + 1 + Number(new RegExp(`Name="${name}".*offset="(\\d+)"`).exec(head)[1]);
  const bytes = Number(vtu.readBigUInt64LE(begin));
  return new Float64Array(Uint8Array.from(vtu.subarray(begin + 8, begin + 8 + bytes)).buffer);
}

const noProgram = !existsSync(program) && `there is no ${program}`;
for (const direction of [[1, 0, 0], slanted]) {
  test(`wind ${direction.join()}: the files are those of the command line, digit for digit`, { skip: noProgram }, async (t) => {
    const folder = mkdtempSync(join(tmpdir(), 'mandoline-wind-'));
    t.after(() => rmSync(folder, { recursive: true, force: true }));
    const [input, output] = [join(folder, 'bunny.obj'), join(folder, 'flow.vtu')];
    writeFileSync(input, await mandoline.writeMesh(bunny, 'obj'));
    const told = spawnSync(program, [
      'flow',
      input,
      '--wind',
      direction.join(),
      '--cells',
      '48',
      '--coarsen',
      '24',
      '--merge',
      '0',
      '-o',
      output,
    ]);
    assert.equal(told.status, 0, String(told.stderr));
    const tunnel = await makeTunnel(pack, bunny, { mesh: 1, pose: null, cells: 48 });
    const written = async (format) => Buffer.from(await writeWind(pack, tunnel, direction, format));
    const native = readFileSync(output);
    assert.ok((await written('vtu')).equals(native));
    const pressures = arrayIn(native, 'pressure_coefficient');
    const [head, ...rows] = String(await written('csv'))
      .trim()
      .split('\n')
      .map((row) => row.split(','));
    assert.equal(rows.length, pressures.length);
    assert.equal(head.at(-1), 'pressure_coefficient');
    rows.forEach((row, cell) => assert.equal(row.at(-1), String(pressures[cell]), `cell ${cell}`));
  });
}

/** How often a flow is solved ahead when the page, in this state, begins to do so twice. */
async function countAhead({ triangles = 1, isMoving = false, on = false, smoke = false, turnedOn = false }) {
  globalThis.window = {};
  const wind = { on, smoke, direction: [1, 0, 0], show: 'none', cells: 48 };
  const shown = { wind: null, isWindAwaited: false, smoke: null, playing: null };
  const values = { mesh: null, model: { isMoving, origin: [0, 0, 0] }, settings: { pose: null, wind }, ...shown };
  const state = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, { value, peek: () => state[name].value }]));
  const asked = [];
  const engine = { windAhead: async (request) => asked.push(request), cancelWind() {}, endSmoke() {}, wind: () => new Promise(() => {}) };
  const tunnel = new WindTunnel(state, engine, { setWind() {} });
  state.mesh.value = { triangles };
  tunnel.beginAhead();
  tunnel.beginAhead();
  state.settings.value.wind.on ||= turnedOn;
  await new Promise((resolve) => setTimeout(resolve, 400)); // nothing tells that nothing comes
  return asked.length;
}

test('the flow about a mesh that stands still is solved ahead, once', async () => {
  assert.equal(await countAhead({}), 1);
  assert.equal(await countAhead({ isMoving: true }), 0);
  assert.equal(await countAhead({ triangles: 200_000 }), 0);
  assert.equal(await countAhead({ on: true }), 0);
  assert.equal(await countAhead({ smoke: true }), 0);
  assert.equal(await countAhead({ turnedOn: true }), 0);
});
