// How the camera glides after a drag.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { importBundled } from './bundled.mjs';

const { Camera } = await importBundled('page/view/camera.ts');
const { Visit } = await importBundled('page/view/visit.ts');

/** What OrbitControls needs of a canvas. */
function canvas() {
  const element = new EventTarget();
  const [ownerDocument, rootNode] = [new EventTarget(), new EventTarget()];
  return Object.assign(element, { style: {}, clientWidth: 800, clientHeight: 600, ownerDocument, getRootNode: () => rootNode });
}

function azimuth({ camera, controls }) {
  const { x, z } = camera.position.clone().sub(controls.target);
  return Math.atan2(x, z);
}

/** Turns by half a radian and gives the azimuth after each of some frames; the camera is drawn so many times a second. */
function glide(framesPerSecond, seconds) {
  let time = 5000;
  const view = new Camera(canvas(), Object.assign(new EventTarget(), { matches: false }), () => time);
  view.update();
  const still = azimuth(view);
  view.controls.rotateLeft(0.5);
  for (let frame = 0; frame < seconds * framesPerSecond; ++frame) {
    time += 1000 / framesPerSecond;
    view.update();
  }
  return still - azimuth(view);
}

test('inertia takes the same time at any frame rate', () => {
  for (const seconds of [0.1, 0.2, 0.5]) {
    const angle = glide(60, seconds);
    assert.ok(angle > 0.1 && angle < 0.5, `${angle} after ${seconds} s`);
    for (const rate of [10, 30, 120, 240]) assert.ok(Math.abs(glide(rate, seconds) - angle) < 1e-6, `at ${rate} frames per second`);
  }
});

test('a glide ends where it was going, at any frame rate', () => {
  for (const rate of [10, 60, 240]) assert.ok(Math.abs(glide(rate, 1) - 0.5) < 1e-3);
});

/** The corners of a cube of this size around (x, 0, 0). */
const cube = (x, size) =>
  new Float32Array(
    [0, 1, 2, 3, 4, 5, 6, 7].flatMap((bits) => [0, 1, 2].map((d) => (d === 0 ? x : 0) + (bits & (1 << d) ? 0.5 : -0.5) * size)),
  );

/** The camera's places at so many ms of a flight from a cube to another. */
function flight(times, reducedMotion, onTheWay = () => {}) {
  let time = 5000;
  const element = canvas();
  const view = new Camera(element, Object.assign(new EventTarget(), { matches: reducedMotion }), () => time);
  view.frame(cube(0, 1), false);
  const { at } = view;
  view.frame(cube(4, 0.5), true);
  const there = view.at;
  view.flyFrom(at);
  const places = times.map((ms) => {
    time = 5000 + ms;
    view.update();
    onTheWay(view, element, ms);
    return view.controls.target.x;
  });
  return { places, there, view };
}

test('a flight goes from one place to the other and ends there', () => {
  const { places, there, view } = flight([0, 200, 400, 600, 1000], false);
  assert.ok(Math.abs(places[0]) < 0.1 && Math.abs(places[4] - 4) < 0.1, String(places));
  for (const [k, x] of places.slice(1).entries()) assert.ok(x > places[k], String(places));
  assert.ok(view.at.position.distanceTo(there.position) < 1e-9 && view.at.target.equals(there.target));
  assert.ok(view.isFramed);
});

test('where motion is to be reduced there is no flight', () => {
  const { places, there } = flight([0], true);
  assert.deepEqual(places, [there.target.x]);
});

test('a flight to the other side goes around what is looked at, about the axis upwards', () => {
  for (const up of ['x', 'y', 'z']) {
    let time = 5000;
    const view = new Camera(canvas(), Object.assign(new EventTarget(), { matches: false }), () => time);
    view.setUp(up);
    view.frame(cube(0, 1), false);
    const distance = view.at.position.distanceTo(view.at.target);
    const { at } = view;
    view.place({ position: at.target.clone().multiplyScalar(2).sub(at.position), target: at.target });
    view.flyFrom(at);
    for (; time < 6000; time += 50) {
      view.update();
      const { position, target } = view.at;
      assert.ok(position.distanceTo(target) > 0.8 * distance, `${position.distanceTo(target)} of ${distance} after ${time - 5000} ms`);
    }
    assert.equal(view.camera.up[up], 1);
  }
});

test('it flies around what is in view to look from any direction, and tells how it sees the axes', () => {
  for (const up of ['x', 'y', 'z']) {
    for (const [d, sign] of [0, 1, 2].flatMap((axis) => [
      [axis, 1],
      [axis, -1],
    ])) {
      let time = 5000;
      const view = new Camera(canvas(), Object.assign(new EventTarget(), { matches: false }), () => time);
      view.setUp(up);
      view.frame(cube(2, 1), false);
      let seen = null;
      view.onTurned = (axes) => (seen = axes);
      view.lookFrom(view.at.target.clone().set(0, 0, 0).setComponent(d, sign));
      for (; time < 6000; time += 100) view.update();
      const toViewer = seen[d][2];
      assert.ok(Math.abs(toViewer - sign) < 1e-5, `${toViewer} from ${sign} ${d}, ${up} upwards`);
      const { position, target } = view.at;
      assert.ok(target.distanceTo(position.clone().set(2, 0, 0)) < 1e-3, 'the cube is in the middle');
      for (const [right, over] of seen)
        assert.ok(
          [right, over].every((x) => Math.abs(x - Math.round(x)) < 2e-3),
          String(seen),
        );
    }
  }
});

/** A camera without motion that sees all of a box, long along x; `look` flies to a direction and gives how far the box reaches in the picture. */
function aroundLongBox() {
  const element = canvas();
  const view = new Camera(element, Object.assign(new EventTarget(), { matches: true }));
  const box = cube(0, 1).map((x, at) => (at % 3 === 0 ? 6 * x : x));
  view.frame(box, false);
  /** 1 at the sides of the picture. */
  const reach = () => {
    view.camera.updateMatrixWorld();
    let most = 0;
    for (let at = 0; at < box.length; at += 3) {
      const seen = view.at.target.clone().fromArray(box, at).project(view.camera);
      most = Math.max(most, Math.abs(seen.x), Math.abs(seen.y));
    }
    return most;
  };
  const look = (x, y, z) => {
    view.lookFrom(view.at.target.clone().set(x, y, z));
    view.update();
    return reach();
  };
  return { view, element, look };
}

test('what is seen whole stays so from one direction after another, also in a scene that has been moved, until the person takes over', () => {
  const { view, element, look } = aroundLongBox();
  for (const direction of [
    [1, 0, 0],
    [0, 0, 1],
    [0, 1, 0],
    [-1, 0, 0],
    [0, 0, -1],
  ]) {
    const reach = look(...direction);
    assert.ok(reach > 0.7 && reach < 0.8, `${reach} from ${direction}`);
    assert.ok(!view.isFramed);
    view.transform((point) => point.clone());
  }
  look(1, 0, 0);
  const distance = () => view.at.position.distanceTo(view.at.target);
  element.dispatchEvent(Object.assign(new Event('keydown'), { key: '+' }));
  view.update();
  const near = distance();
  assert.ok(look(0, 0, 1) > 1);
  assert.ok(Math.abs(distance() / near - 1) < 1e-6);
});

test('where a visit goes back to follows a scene that is moved meanwhile', () => {
  const view = new Camera(canvas(), Object.assign(new EventTarget(), { matches: true }));
  view.frame(cube(0, 1), false);
  const { at } = view;
  view.place(at);
  const visit = new Visit(view);
  visit.begin(cube(1, 0.1));
  const move = (point) => point.clone().multiplyScalar(2).addScalar(10);
  view.transform(move);
  visit.transform(move);
  visit.end(() => assert.fail('it was not framed'));
  assert.ok(view.at.position.distanceTo(move(at.position)) < 1e-6);
  assert.ok(view.at.target.distanceTo(move(at.target)) < 1e-6);
});

test('it tells how it sees the axes from the very first, also where it has not turned', () => {
  const view = new Camera(canvas(), Object.assign(new EventTarget(), { matches: true }));
  let seen = null;
  view.onTurned = (axes) => (seen = axes);
  view.update();
  assert.equal(seen?.[2][2], 1);
});

test('a flight ends where the person takes over', () => {
  const press = (_view, element, ms) => {
    if (ms === 200) element.dispatchEvent(Object.assign(new Event('keydown'), { key: '+' }));
  };
  const { places, view } = flight([0, 200, 1000, 2000], false, press);
  assert.ok(places[3] < 3, String(places));
  assert.ok(!view.isFramed);
});

test('a flight goes on in a scene that has been moved', () => {
  const move = (view, _element, ms) => ms === 200 && view.transform((point) => point.clone().addScalar(10));
  const { places, there } = flight([0, 200, 1000], false, move);
  assert.ok(Math.abs(places[2] - 10 - there.target.x) < 1e-9);
});

test('where the person has moved it is told, also if the scene is moved before that', async () => {
  const view = new Camera(canvas(), Object.assign(new EventTarget(), { matches: false }));
  const told = [];
  view.onMoved = () => told.push(view.at.position.x);
  view.update();
  view.controls.rotateLeft(0.5);
  view.transform((point) => point.clone().addScalar(10));
  await new Promise((resolve) => setTimeout(resolve, 300));
  assert.deepEqual(told, []); // nobody has taken hold of it
  view.controls.dispatchEvent({ type: 'start' });
  view.controls.rotateLeft(0.5);
  view.transform((point) => point.clone().addScalar(10));
  await new Promise((resolve) => setTimeout(resolve, 300));
  assert.deepEqual(told, [view.at.position.x]);
});
