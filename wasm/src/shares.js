// A cut that several threads share, none of which sees another's memory (mandoline/cut_share.h). The one that answers the page leads: it
// gives each of the others a share and joins what they send. All have the same module.
import { makeCall } from './api.js';
import { numbered, readFunction, readGrid, readMesh } from './arguments.js';
import { buffersOf } from './buffers.js';
import { Intersections } from './fields.js';
import { isResult } from './host.js';

const asIs = (value) => value;
const share = { share: asIs, summaries: asIs };

/** The steps, as a table of calls (see calls.js). */
const steps = {
  findPairs: {
    takes: { mesh: readMesh },
    options: { intersections: numbered(Intersections), index: asIs, count: asIs, progress: readFunction },
  },
  findEdges: { takes: { search: asIs } },
  beginShare: {
    takes: { mesh: { kind: 'prepared', otherwise: asIs }, grid: readGrid }, // or the search in one
    options: { pairs: asIs, index: asIs, count: asIs, progress: readFunction },
    run: (bindings, mesh, ...given) => {
      const isPrepared = mesh instanceof bindings.KeptMesh;
      return isPrepared ? bindings.beginShare(mesh, ...given) : bindings.beginSearched(mesh, ...given);
    },
  },
  keepPart: { takes: share, options: { gridCellRegion: asIs, progress: readFunction } },
  makePart: { takes: share, options: { reuse: asIs } },
  joinParts: {
    takes: { mesh: { kind: 'prepared', otherwise: asIs }, share: asIs, others: asIs },
    options: { gridCellRegion: asIs, keep: asIs, reuse: asIs },
    run: (bindings, _mesh, ...given) => bindings.joinParts(...given), // the twin of which does not give way to the result's
    keeps: 'cutMesh',
  },
  meshOf: { takes: { mesh: { kind: 'prepared' } } },
};

const stepsOn = (host) => Object.fromEntries(Object.entries(steps).map(([name, step]) => [name, makeCall(host, name, step)]));

/** Below this, sharing takes longer than it saves: about as many triangles, and grid cells in three cross-sections. */
const least = 20_000;

function workOf({ triangles = [] }, grid) {
  const [x, y, z] = sizesOf(grid);
  return triangles.length / 3 + x * y + y * z + z * x;
}

/** The numbers of cells along the axes, or bounds of them. */
function sizesOf(grid) {
  const { kind, cells, planes } = readGrid(grid);
  if (kind === 'planes') return planes.map(({ length }) => length - 1);
  return kind === 'around' ? [cells, cells, cells] : cells;
}

/** Another thread, as the leading one sees it. */
class Mate {
  #port;
  #waiting = []; // resolvers of answers, in order
  prepared; // the id of the prepared mesh that it has

  constructor(port) {
    this.#port = port;
    port.onmessage = ({ data }) => this.#waiting.shift()(data);
  }

  tell(message, transfer = []) {
    this.#port.postMessage(message, transfer);
  }

  /** Resolves with its answer; undefined if it has none. */
  ask(message) {
    return new Promise((resolve) => {
      this.#waiting.push(resolve);
      this.tell(message);
    });
  }

  /** What it was asked for will not come. */
  leave() {
    for (const resolve of this.#waiting.splice(0)) resolve(undefined);
    this.#port.close();
  }
}

const missing = Symbol('a share is missing');

/** @returns {any} */
function required(answer) {
  if (answer === undefined) throw missing;
  return answer;
}

/** The leading thread's side. */
export class Lead {
  #start;
  #mates = new Map(); // by the numbers that the page gives them
  #isSharing = false;
  #ids = new WeakMap(); // of prepared meshes
  #count = 0;

  /** `start` is called before the others are asked: it starts those that have not been started. */
  constructor(start) {
    this.#start = start;
  }

  add(number, port) {
    this.#mates.set(number, new Mate(port));
  }

  remove(number) {
    this.#mates.get(number)?.leave();
    this.#mates.delete(number);
  }

  /**
   * cut() of a module, { host, calls }. What others can't do is done here alone, and so is a cut meanwhile, and what fails, for the error
   * that cut() gives.
   *
   * @param {any} module
   * @param {any[]} given
   */
  async cut({ host, calls }, given) {
    if (this.#isSharing || !this.#isShared(given)) return calls.cut(...given);
    this.#isSharing = true;
    try {
      this.#start();
      return await this.#cutTogether(host, given);
    } catch {
      return calls.cut(...given);
    } finally {
      this.#isSharing = false;
    }
  }

  #isShared(given) {
    const [mesh, grid, options] = given;
    try {
      return this.#mates.size > 0 && !options?.snapTolerance && workOf(mesh, grid) >= least;
    } catch {
      return false; // bad arguments
    }
  }

  /** @param {any[]} given */
  async #cutTogether(host, given) {
    const [mesh, grid, options = {}] = given;
    const { intersections, gridCellRegion = true, keep = true, reuse, progress } = options;
    const { findPairs, findEdges, beginShare, keepPart, joinParts, meshOf } = stepsOn(host);
    const mates = [...this.#mates.values()];
    const count = mates.length + 1;
    const askAll = (given) => mates.map((mate, i) => mate.ask({ ...given(mate), options: { intersections, index: i + 1, count } }));
    const all = async (own, others) => [own, ...(await Promise.all(others)).map(required)];
    const leading = { index: 0, count, progress };
    let searched;
    let own;
    try {
      let pairs;
      if (!isResult(mesh)) {
        const searching = askAll(() => ({ mesh }));
        searched = findPairs(mesh, { intersections, ...leading });
        findEdges(searched.search);
        pairs = await all(searched.pairs, searching);
      }
      const begun = askAll((mate) => ({ grid, pairs, ...(pairs ? {} : this.#prepared(host, mesh, mate, meshOf)) }));
      own = beginShare(searched?.search ?? mesh, grid, { pairs, ...leading });
      const summaries = await all(own.summary, begun);
      const made = mates.map((mate) => mate.ask({ summaries }));
      keepPart(own.share, summaries, { gridCellRegion, progress });
      const parts = (await Promise.all(made)).map(required);
      const result = joinParts(mesh, own.share, parts, { gridCellRegion, keep, reuse });
      for (const [i, mate] of mates.entries()) {
        const spare = buffersOf(parts[i]);
        mate.tell({ spare }, spare);
      }
      return result;
    } catch (error) {
      for (const mate of mates) mate.tell({ drop: true });
      throw error;
    } finally {
      searched?.search.delete();
      own?.share.delete();
    }
  }

  /** What tells a mate of a prepared mesh. */
  #prepared(host, mesh, mate, meshOf) {
    if (!this.#ids.has(mesh)) this.#ids.set(mesh, ++this.#count);
    const id = this.#ids.get(mesh);
    const hasIt = mate.prepared === id;
    mate.prepared = id;
    return { prepared: { id, mesh: hasIt ? undefined : meshOf(mesh), origin: host.originOf(mesh) } };
  }
}

/** The side of another thread. */
class Follower {
  #host;
  #steps;
  #search;
  #share;
  #prepared; // { id, mesh }: the last prepared mesh
  spare = []; // buffers of its last part, which came back

  constructor(host) {
    this.#host = host;
    this.#steps = stepsOn(host);
  }

  /** Its answer: the pairs of triangles that it found in a mesh, or the summary of its share of a cut, or its part. */
  answer({ mesh, prepared, pairs, grid, options, summaries }) {
    if (mesh) return this.#findPairs(mesh, options);
    if (grid) return this.#begin(prepared ? this.#find(prepared) : this.#search, grid, pairs, options);
    const part = this.#steps.makePart(this.#share, summaries, { reuse: this.spare.splice(0) });
    this.drop();
    return part;
  }

  /** Forgets its share. */
  drop() {
    this.#search?.delete();
    this.#share?.delete();
    this.#search = this.#share = undefined;
  }

  #findPairs(mesh, options) {
    this.drop();
    const { search, pairs } = this.#steps.findPairs(mesh, options);
    this.#search = search;
    return pairs;
  }

  /** What is left to do before it hears what the others found. */
  goOn() {
    try {
      this.#steps.findEdges(this.#search);
    } catch {
      this.drop(); // so it has no share when it is asked for that
    }
  }

  #begin(mesh, grid, pairs, { index, count }) {
    const { share, summary } = this.#steps.beginShare(mesh, grid, { pairs, index, count });
    this.drop();
    this.#share = share;
    return summary;
  }

  #find({ id, mesh, origin }) {
    if (mesh) this.#host.adopt(mesh, origin);
    if (mesh) this.#prepared = { id, mesh };
    return this.#prepared.id === id ? this.#prepared.mesh : undefined;
  }
}

/** Answers the thread that leads, on a port. */
export function follow(port, host) {
  const follower = new Follower(host);
  port.onmessage = ({ data }) => {
    if (data.drop) return follower.drop();
    if (data.spare) {
      follower.spare = data.spare;
      return undefined;
    }
    let answer;
    try {
      answer = follower.answer(data);
    } catch {} // the thread that leads cuts alone, and finds out why
    port.postMessage(answer, buffersOf(answer));
    if (data.mesh && answer) follower.goOn();
  };
}
