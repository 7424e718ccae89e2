// The page's worker thread: the package's own calls, and beside them the page's. Meshes and cut-meshes stay here; only what is drawn or
// told goes to the page, which owns it then.
import type { Mandoline } from 'mandoline-wasm';
import { serve } from 'mandoline-wasm/worker-thread';
import type { CallName, Calls } from '../model/calls';
import { otherGrid } from '../model/comparison';
import { loadAhead } from './ahead';
import { cutNow, cutOf, faceTrianglesOf, keep, makeCut, type Context } from './kept';
import { loadMesh } from './load';
import { makeModel, reuseLater } from './make_model';

type Answering = {
  [K in CallName]: (mandoline: Mandoline, ask: Calls[K]['ask'], context: Context) => Calls[K]['answer'] | Promise<Calls[K]['answer']>;
};

const calls: Answering = {
  async load(mandoline, ask) {
    const mesh = await loadMesh(mandoline, ask);
    keep(mesh);
    return { ...mesh, positions: mesh.positions.slice(), triangles: mesh.triangles.slice() };
  },
  loadAhead,
  keep: (_mandoline, mesh) => keep(mesh),
  reuse: (_mandoline, buffers) => reuseLater(buffers),
  async cut(mandoline, { recipe, slicing }, context) {
    const cut = await makeCut(mandoline, recipe, context);
    context.tell({ stage: 'drawing', fraction: 0.85 });
    return makeModel(mandoline, cut, slicing);
  },
  async slice(mandoline, { recipe, planes, untouched }, context) {
    const { cutMesh } = await cutOf(mandoline, recipe, context);
    return planes.map((plane) => mandoline.slice(cutMesh, plane, { untouched }));
  },
  async validate(mandoline, { recipe }, context) {
    const { checksOf } = await import('./checks');
    return checksOf(mandoline, await cutOf(mandoline, recipe, context));
  },
  async edges(mandoline, { recipe }, context) {
    const { mesh, cutMesh } = await cutOf(mandoline, recipe, context);
    return mandoline.cutEdges(mesh, cutMesh).edgeLength.length;
  },
  async card(mandoline, { recipe, cell }, context) {
    const { cellCard } = await import('./card');
    return cellCard(mandoline, await cutOf(mandoline, recipe, context), cell);
  },
  async crossings(mandoline, { recipe }, context) {
    const { crossingsOf } = await import('./crossings');
    return crossingsOf(mandoline, await cutOf(mandoline, recipe, context));
  },
  async step(mandoline, { recipe, request }, context) {
    const { stepPicture } = await import('./steps');
    const cut = await cutOf(mandoline, recipe, context);
    return stepPicture(cut.mesh, cut.cutMesh, faceTrianglesOf(mandoline, cut), request, cut.origin);
  },
  async compare(mandoline, { recipe, way }, context) {
    const { comparison } = await import('./compare');
    const cut = await cutOf(mandoline, recipe, context);
    const other = way && {
      way,
      cut: await cutNow(mandoline, { ...recipe, grid: otherGrid(recipe.grid, way) }, { ...context, tell: () => {} }),
    };
    return comparison(mandoline, cut, other);
  },
  async writeMesh(mandoline, { recipe }, context) {
    const { mesh } = await cutOf(mandoline, recipe, context);
    return mandoline.writeMesh(mesh, 'obj');
  },
  async write(mandoline, { recipe, format }, context) {
    const { mesh, cutMesh } = await cutOf(mandoline, recipe, context);
    return mandoline.write(mesh, cutMesh, format);
  },
  end() {},
};

/** In ms. */
const progressInterval = 50;

/** Passes on now and then what is told. */
function seldom(tell: Context['tell']): Context['tell'] {
  let last = 0;
  return (progress) => {
    const now = performance.now();
    if (now - last < progressInterval) return;
    last = now;
    tell(progress);
  };
}

for (const [name, call] of Object.entries(calls) as [CallName, (mandoline: Mandoline, ask: unknown, context: Context) => unknown][]) {
  serve({ [name]: (mandoline, [ask], { cut, progress }) => call(mandoline, ask, { cut, tell: seldom(progress) }) });
}
