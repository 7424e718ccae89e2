// What is loaded before it is asked for, so that it is at hand at once, also offline.
import type { Engine } from '../model/types';
import { loadGltfExporter } from './view/export';

/**
 * After the first picture, one after another, each when the page has nothing else to do. What can't be loaded is asked for again where it is
 * used, and missed there.
 */
export async function loadAhead(engine: Engine): Promise<void> {
  for (const load of [() => engine.loadAhead(), loadGltfExporter]) {
    await idle();
    await load().catch(() => {});
  }
}

/** Not every browser tells when it is idle. */
function idle(): Promise<unknown> {
  return new Promise((resolve) => {
    if ('requestIdleCallback' in window) requestIdleCallback(resolve);
    else setTimeout(resolve, 200);
  });
}
