// How the camera glides after a drag.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Vector3 } from 'three';
import { importBundled } from './bundled.mjs';

const { Camera } = await importBundled('page/view/camera.ts');

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

/** The camera's places at so many ms of a flight from a ball to another; null where the person takes over. */
function flight(times, reducedMotion, onTheWay = () => {}) {
  let time = 5000;
  const element = canvas();
  const view = new Camera(element, Object.assign(new EventTarget(), { matches: reducedMotion }), () => time);
  view.frame(new Vector3(0, 0, 0), 1, false);
  const { at } = view;
  view.frame(new Vector3(4, 0, 0), 0.5, true);
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
  assert.equal(places[0], 0);
  for (const [k, x] of places.slice(1).entries()) assert.ok(x > places[k], String(places));
  assert.ok(view.at.position.distanceTo(there.position) < 1e-9 && view.at.target.equals(there.target));
  assert.ok(view.isFramed);
});

test('where motion is to be reduced there is no flight', () => assert.deepEqual(flight([0], true).places, [4]));

test('a flight ends where the person takes over', () => {
  const press = (_view, element, ms) => {
    if (ms === 200) element.dispatchEvent(Object.assign(new Event('keydown'), { key: '+' }));
  };
  const { places, view } = flight([0, 200, 1000, 2000], false, press);
  assert.ok(places[3] < 3, String(places));
  assert.ok(!view.isFramed);
});

test('a flight goes on in a scene that has been moved', () => {
  const move = (view, _element, ms) => ms === 200 && view.transform((point) => point.clone().addScalar(10), 1);
  const { places, there } = flight([0, 200, 1000], false, move);
  assert.ok(Math.abs(places[2] - 10 - there.target.x) < 1e-9);
});
