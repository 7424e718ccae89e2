// How the camera glides after a drag.
import assert from 'node:assert/strict';
import { test } from 'node:test';
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
