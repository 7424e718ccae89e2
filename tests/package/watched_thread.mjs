// A thread that tells of its memory, for worker_twins.test.mjs.
import { memories, memorySize } from './instances.mjs';

const { serve } = await import('mandoline-wasm/worker-thread'); // after the instances are watched

serve({
  memory: () => ({ size: memorySize(), instances: memories.length }),
  sliceOfOwn: (mandoline, [mesh, cells, plane]) => {
    const cutMesh = mandoline.cut(mesh, { cells });
    return { cutMesh, slice: mandoline.slice(cutMesh, plane) };
  },
});
