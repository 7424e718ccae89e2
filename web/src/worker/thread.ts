// The page's worker thread: the package's own calls, and beside them the page's. Meshes and cut-meshes stay here; only what is drawn or
// told goes to the page, which owns it then.
import type { Mandoline } from 'mandoline-wasm';
import { serve } from 'mandoline-wasm/worker-thread';
import type { CallName, CallProgress, Calls } from '../model/calls';
import { otherGrid } from '../model/comparison';
import { loadAhead } from './ahead';
import { cutNow, cutOf, faceTrianglesOf, keep, makeCut } from './kept';
import { loadMesh } from './load';
import { makeModel, reuseLater } from './make_model';

type Tell = (progress: CallProgress) => void;
type Answering = {
  [K in CallName]: (mandoline: Mandoline, ask: Calls[K]['ask'], tell: Tell) => Calls[K]['answer'] | Promise<Calls[K]['answer']>;
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
  cut(mandoline, { recipe, slicing }, tell) {
    const cut = makeCut(mandoline, recipe, tell);
    tell({ stage: 'drawing', fraction: 0.85 });
    return makeModel(mandoline, cut, slicing);
  },
  slice(mandoline, { recipe, planes, untouched }) {
    const { cutMesh } = cutOf(mandoline, recipe);
    return planes.map((plane) => mandoline.slice(cutMesh, plane, { untouched }));
  },
  async validate(mandoline, { recipe }) {
    const { checksOf } = await import('./checks');
    return checksOf(mandoline, cutOf(mandoline, recipe));
  },
  edges(mandoline, { recipe }) {
    const { mesh, cutMesh } = cutOf(mandoline, recipe);
    return mandoline.cutEdges(mesh, cutMesh).edgeLength.length;
  },
  async card(mandoline, { recipe, cell }) {
    const { cellCard } = await import('./card');
    return cellCard(mandoline, cutOf(mandoline, recipe), cell);
  },
  async crossings(mandoline, { recipe }) {
    const { crossingsOf } = await import('./crossings');
    return crossingsOf(mandoline, cutOf(mandoline, recipe));
  },
  async step(mandoline, { recipe, request }) {
    const { stepPicture } = await import('./steps');
    const cut = cutOf(mandoline, recipe);
    return stepPicture(cut.mesh, cut.cutMesh, faceTrianglesOf(mandoline, cut), request, cut.origin);
  },
  async compare(mandoline, { recipe, way }) {
    const { comparison } = await import('./compare');
    const cut = cutOf(mandoline, recipe);
    const other = way && { way, cut: cutNow(mandoline, { ...recipe, grid: otherGrid(recipe.grid, way) }, () => {}) };
    return comparison(mandoline, cut, other);
  },
  writeMesh: (mandoline, { recipe }) => mandoline.writeMesh(cutOf(mandoline, recipe).mesh, 'obj'),
  write(mandoline, { recipe, format }) {
    const { mesh, cutMesh } = cutOf(mandoline, recipe);
    return mandoline.write(mesh, cutMesh, format);
  },
  end() {},
};

/** In ms. */
const progressInterval = 50;

/** Passes on now and then what is told. */
function seldom(tell: (progress: CallProgress) => void): Tell {
  let last = 0;
  return (progress) => {
    const now = performance.now();
    if (now - last < progressInterval) return;
    last = now;
    tell(progress);
  };
}

for (const [name, call] of Object.entries(calls) as [CallName, (mandoline: Mandoline, ask: unknown, tell: Tell) => unknown][]) {
  serve({ [name]: (mandoline, [ask], { progress }) => call(mandoline, ask, seldom(progress)) });
}
