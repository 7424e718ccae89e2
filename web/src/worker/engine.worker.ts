// The worker's half of the engine: loads, cuts and makes ready to be drawn, so that the page stays responsive.
import { compiledModule, init, type Adjacency, type CutMesh, type GridInput, type Mandoline } from 'mandoline-wasm';
import { parseMesh } from './files';
import { galleryMesh } from '../model/gallery';
import { stepPicture } from './steps';
import type { GridSettings, PageError, Source } from '../model/types';
import { cellCard } from './card';
import { pageError, toPageError } from '../model/failure';
import { derive, makeModel, type Derived } from './model';
import { buffersOf, type Answered, type Call, type CallName, type Calls } from '../model/protocol';
import type { CutRecipe, EngineMesh, FromWorker, ToWorker } from '../model/protocol';

/** The newest cut, whose Model the page shows. */
interface Held {
  recipe: CutRecipe;
  cutMesh: CutMesh;
  derived: Derived;
  adjacency: Adjacency | null;
}

/** More untouched grid cells than this fill memory with what can't be told apart on a screen. */
const mostGridCells = 2 ** 24;
const progressInterval = 50;

let mandoline: Promise<Mandoline>;
let wasm: WebAssembly.Module | null = null;
let loaded: EngineMesh | null = null;
let shown: CutRecipe | null = null;
let held: Held | null = null;
let queue = Promise.resolve();
let lastProgress = 0;

self.onmessage = (event: MessageEvent<ToWorker>) => {
  const message = event.data;
  if (message.kind === 'call') {
    queue = queue.then(() => answer(message));
    return;
  }
  ({ wasm, mesh: loaded, shown } = message);
  void start().catch(() => {}); // The first call tries again and says what is wrong.
};

function post(message: FromWorker, transfer: ArrayBuffer[] = []): void {
  self.postMessage(message, { transfer });
}

function start(): Promise<Mandoline> {
  mandoline = init(wasm ? { wasm } : {});
  return mandoline.then(async (ready) => {
    if (!wasm) post({ kind: 'ready', wasm: await compiledModule() });
    return ready;
  });
}

async function answer(call: Call): Promise<void> {
  try {
    const { answer, transfer } = await answerTo(call);
    post({ kind: 'answer', id: call.id, answer }, transfer);
  } catch (error) {
    post({ kind: 'error', id: call.id, error: toPageError(error, call.name) });
  }
}

async function answerTo(call: Call): Promise<Answered<Calls[CallName]['answer']>> {
  if (call.name === 'load') return load(call.ask.source, call.ask.bytes);
  const api = await mandoline.catch(start);
  if (call.name === 'cut') return cut(api, call.ask);
  const current = heldCut(api);
  const { recipe, cutMesh } = current;
  switch (call.name) {
    case 'slice': {
      const slices = call.ask.planes.map((plane) => api.slice(cutMesh, plane, { untouched: call.ask.untouched }));
      return { answer: slices, transfer: slices.flatMap((slice) => buffersOf(...Object.values(slice))) };
    }
    case 'validate':
      return { answer: api.validate(recipe.mesh, cutMesh, { snapTolerance: recipe.snapTolerance }), transfer: [] };
    case 'card':
      return cellCard(cutMesh, current.derived, (current.adjacency ??= api.adjacency(cutMesh)), checkedCell(cutMesh, call.ask.cell));
    case 'step': {
      const picture = stepPicture(recipe.mesh, cutMesh, current.derived.faceTriangles, call.ask, current.derived.origin);
      const { lines, faces, points } = picture;
      return { answer: picture, transfer: [lines, faces, points].flatMap((part) => buffersOf(part.position, part.color)) };
    }
    case 'write': {
      const bytes = api.write(recipe.mesh, cutMesh, call.ask);
      return { answer: bytes, transfer: buffersOf(bytes) };
    }
  }
}

async function load(source: Source, bytes?: ArrayBuffer): Promise<Answered<EngineMesh>> {
  const { positions, triangles } = await meshOf(source, bytes);
  loaded = { name: nameOf(source), positions, triangles };
  const copy: EngineMesh = { ...loaded, positions: positions.slice(), triangles: triangles.slice() };
  return { answer: copy, transfer: buffersOf(copy.positions, copy.triangles) };
}

function nameOf(source: Source): string {
  return source.kind === 'url' ? fileName(source.url) : source.name;
}

function fileName(url: string): string {
  if (!URL.canParse(url, self.location.href)) throw pageError("The address can't be read", `"${url}" is not the address of a file.`);
  const name = new URL(url, self.location.href).pathname.split('/').pop() ?? '';
  try {
    return decodeURIComponent(name) || url;
  } catch {
    return name; // A stray % that encodes nothing.
  }
}

async function meshOf(source: Source, bytes?: ArrayBuffer): Promise<{ positions: Float64Array; triangles: Uint32Array }> {
  if (source.kind === 'gallery') return galleryMesh(source.name);
  if (source.kind === 'url') return parseMesh(fileName(source.url), await fetched(source.url));
  if (bytes) return parseMesh(source.name, bytes);
  throw pageError(`${source.name} isn't here any more`, 'A link keeps only the name of a file. Choose the file again.');
}

async function fetched(url: string): Promise<ArrayBuffer> {
  const title = "The address can't be read";
  const response = await fetch(url).catch((error: unknown) => {
    throw pageError(title, `Nothing came from ${url}: there is no such server, or it doesn't let other pages read it (${String(error)}).`);
  });
  if (!response.ok) throw pageError(title, `${url} answers with ${response.status} ${response.statusText}.`);
  return response.arrayBuffer();
}

function cut(api: Mandoline, { model, grid, snapTolerance }: Calls['cut']['ask']): Answered<Calls['cut']['answer']> {
  if (!loaded) throw noMesh();
  const made = cutBy(api, { model, mesh: loaded, grid, snapTolerance });
  report('drawing', 0.9);
  const answered = makeModel(model, loaded.name, api, loaded, made.cutMesh, made.derived);
  held = made;
  return answered;
}

function noMesh(): PageError {
  return pageError('There is no mesh', 'Choose a mesh first.');
}

function cutBy(api: Mandoline, recipe: CutRecipe): Held {
  checkSize(recipe.grid);
  const { mesh, snapTolerance } = recipe;
  const cutMesh = api.cut(mesh, recipe.grid as GridInput, {
    snapTolerance,
    progress: ({ stage, stageIndex, stageCount, done, total }) => {
      report(stage, (0.85 * (stageIndex + (total > 0 ? done / total : 1))) / stageCount);
    },
  });
  report('measures', 0.85);
  return { recipe, cutMesh, derived: derive(api, mesh, cutMesh), adjacency: null };
}

function checkSize(grid: GridSettings): void {
  const cells = 'min' in grid ? grid.cells[0] * grid.cells[1] * grid.cells[2] : 0;
  if (cells <= mostGridCells) return;
  const most = mostGridCells.toLocaleString('en');
  const detail = `It has ${cells.toLocaleString('en')} cells; this page draws up to ${most}. The library has no such limit.`;
  throw pageError('The grid is too fine', detail);
}

function report(stage: string, fraction: number): void {
  const now = performance.now();
  if (now - lastProgress < progressInterval) return;
  lastProgress = now;
  post({ kind: 'progress', stage, fraction });
}

/** The cut whose Model the page shows. A worker that took the place of another makes it again. */
function heldCut(api: Mandoline): Held {
  if (!held && shown) held = cutBy(api, shown);
  if (!held) throw noMesh();
  return held;
}

function checkedCell(cutMesh: CutMesh, cell: number): number {
  if (Number.isInteger(cell) && cell >= 0 && cell < cutMesh.cellRegion.length) return cell;
  throw pageError('There is no such cell', `The cut-mesh has ${cutMesh.cellRegion.length} cut-cells.`);
}
