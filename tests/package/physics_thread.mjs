// A thread with a call of its own that computes, for physics_worker.test.mjs.
import { initPhysics } from 'mandoline-wasm/physics';
import { serve } from 'mandoline-wasm/worker-thread';

serve({
  potential: async (mandoline, [mesh, grid]) => {
    const { cellComplex, solvePoisson } = await initPhysics();
    const cells = cellComplex(mesh, mandoline.cut(mesh, grid));
    return solvePoisson(cells, { source: cells.cellCentre.filter((_, i) => i % 3 === 0) }, { balance: true }).phi;
  },
});
