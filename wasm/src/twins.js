const mostTwins = 16;
/**
 * With one more of the latest's size, which the next call may make. Not much, since memory that was freed is faster than memory that is new
 * to the system.
 */
const mostBytes = 2 ** 26;

/**
 * The cut-meshes that stay in an instance of the module, each found by the result that it is the twin of. Collecting garbage frees the
 * twins of results that are gone, but not while a script runs without a break; so the ones used least recently are freed when there are
 * many, or large ones beside another.
 */
export class Twins {
  #ids = new WeakMap(); // of results
  #handles = new Map(); // by id, the one used last at the end
  #collected = new FinalizationRegistry((id) => this.#free(id));
  #count = 0;
  #bytes = 0;

  get bytes() {
    return this.#bytes;
  }

  /** From now on the handle is the result's twin. Twins in use, which are those found last, don't give way to it. */
  keep(result, handle, inUse = [handle]) {
    const id = ++this.#count;
    this.#ids.set(result, id);
    this.#collected.register(result, id);
    this.#handles.set(id, handle);
    this.#bytes += handle.bytes();
    for (const [oldest, other] of this.#handles) {
      if (inUse.includes(other) || (this.#handles.size <= mostTwins && this.#bytes + handle.bytes() <= mostBytes)) break;
      this.#free(oldest);
    }
  }

  /** The handle of the result's twin, if it is still there. */
  find(result) {
    const id = this.#ids.get(result);
    const handle = this.#handles.get(id);
    if (handle) this.#handles.delete(id) && this.#handles.set(id, handle);
    return handle;
  }

  has(result) {
    return this.#handles.has(this.#ids.get(result));
  }

  free(result) {
    this.#free(this.#ids.get(result));
  }

  #free(id) {
    const handle = this.#handles.get(id);
    if (!handle) return;
    this.#handles.delete(id);
    this.#bytes -= handle.bytes();
    handle.delete();
  }
}
