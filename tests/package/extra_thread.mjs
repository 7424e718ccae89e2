// A thread with calls of its own, for worker.test.mjs and shares.test.mjs.
import { MandolineError } from 'mandoline-wasm';
import { serve } from 'mandoline-wasm/worker-thread';

let kept = 0;

serve({
  volume: (mandoline, [mesh, cells]) => mandoline.measure(mesh, mandoline.cut(mesh, { cells })).regionVolume,
  cutTogether: (_, [mesh, grids, options], { cut }) => Promise.all(grids.map((grid) => cut(mesh, grid, options))),
  count: () => ++kept,
  later: async (_, [value], { progress }) => {
    for (let i = 0; i < 3; ++i) {
      progress(i);
      await new Promise((resolve) => {
        setTimeout(resolve, 20);
      });
    }
    return { value, nested: [new Float32Array([1, 2])] };
  },
  tellAfterwards: (_, _args, { progress }) => {
    setTimeout(() => progress('too late'), 20);
  },
});
serve({
  fail: (_, [kind]) => {
    if (kind === 'core') throw new MandolineError('badGrid', 'No.', { element: 1 });
    if (kind === 'plain') throw { title: 'Mine', detail: 7 };
    if (kind === 'type') throw new TypeError('mine');
    throw () => {};
  },
  unsendable: () => () => {},
  cyclic: () => {
    const value = { array: new Uint8Array(4) };
    value.itself = value;
    return value;
  },
});
