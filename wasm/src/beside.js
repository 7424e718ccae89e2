// Files that lie beside a script, which is at `url`: its import.meta.url.

/** In Node; written so that bundlers don't take it for an asset of a page. */
function fileBeside(name, url) {
  return new URL(url.replace(/[^/]*$/, name));
}

/** The file in Node; undefined if it is not there. */
function fileInNode(name, url) {
  try {
    const file = fileBeside(name, url);
    return globalThis.process.getBuiltinModule('node:fs').existsSync(file) ? file : undefined;
  } catch {
    return undefined; // code that is no longer a module does not know where it is
  }
}

/** Where a .wasm file of this name is, in pages at what `source` gives; undefined if it is not beside the code. */
export function addressOf(name, source, url) {
  if (globalThis.process?.versions?.node) return fileInNode(name, url);
  const address = source();
  return address.href.endsWith(`/deps/${name}`) ? undefined : address; // Vite keeps what it has bundled in "deps"
}

/** A worker thread of Node. */
export function nodeThreadBeside(name, url) {
  // No import, which bundlers for browsers would follow.
  const { Worker: NodeWorker } = globalThis.process.getBuiltinModule('node:worker_threads');
  return new NodeWorker(fileBeside(name, url), { execArgv: [] }); // those of the process may be for its own script only
}

/**
 * The address of a worker's script; only its name where a bundler has put the code of the file `own`, which is at `url`, elsewhere and may
 * have renamed the script.
 */
export function scriptBeside(name, own, url) {
  const isWherePacked = !url.startsWith('file:') && new RegExp(`/${own}\\.js\\b`).test(url); // webpack writes where it was when it built
  return isWherePacked ? fileBeside(name, url) : name;
}
