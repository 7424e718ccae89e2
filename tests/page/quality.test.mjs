// How finely pictures are drawn while they follow one another.
import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { importBundled } from './bundled.mjs';

const { Quality } = await importBundled('page/view/quality.ts');

/** Draws a picture every so many ms, each of which takes as long as its share of pixels has it take; gives the shares. */
function draw(quality, clock, { count, every, fullTime }) {
  const shares = [];
  for (let i = 0; i < count; ++i) {
    const share = quality.next(fullTime * (shares.at(-1) ?? 1) ** 2);
    shares.push(share);
    clock.now += every;
  }
  return shares;
}

test('slow pictures get fewer pixels while they follow one another, and all of them once they rest', () => {
  mock.timers.enable({ apis: ['setTimeout'] });
  const clock = { now: 1000 };
  let refined = 0;
  const quality = new Quality(
    () => refined++,
    () => clock.now,
  );
  const shares = draw(quality, clock, { count: 6, every: 100, fullTime: 200 });
  assert.deepEqual(shares.slice(0, 2), [1, 1], 'the first picture stands, and what it took says nothing about the next one');
  assert.equal(Math.min(...shares), shares.at(-1));
  assert.ok(shares.at(-1) <= 0.5);
  assert.equal(refined, 0);
  mock.timers.tick(1000);
  assert.equal(refined, 1, 'one more picture is asked for');
  assert.equal(quality.next(50), 1);
  mock.timers.tick(1000);
  assert.equal(refined, 1);
  mock.timers.reset();
});

test('quick pictures keep all pixels, and get them back', () => {
  const clock = { now: 0 };
  const quality = new Quality(
    () => {},
    () => clock.now,
  );
  assert.deepEqual(new Set(draw(quality, clock, { count: 10, every: 16, fullTime: 10 })), new Set([1]));
  draw(quality, clock, { count: 5, every: 100, fullTime: 200 });
  assert.equal(draw(quality, clock, { count: 5, every: 16, fullTime: 5 }).at(-1), 1);
});

test('a single picture that takes long, or little, changes nothing', () => {
  const clock = { now: 0 };
  const quality = new Quality(
    () => {},
    () => clock.now,
  );
  const taking = (times) =>
    times.map((took) => {
      clock.now += 16;
      return quality.next(took);
    });
  assert.deepEqual(new Set(taking([5, 5, 5, 100, 5, 100, 30, 100, 5])), new Set([1]));
  assert.equal(taking([100, 100]).at(-1), 0.7);
  assert.deepEqual(new Set(taking([5, 30, 5, 100, 5])), new Set([0.7]));
  assert.equal(taking([5]).at(-1), 1);
});
