import type { Mandoline } from 'mandoline-wasm';
import type { Physics } from 'mandoline-wasm/physics';

type Later<F> = F extends (...given: infer Given) => infer Value ? (...given: Given) => Promise<Awaited<Value>> : never;

/** The calls of the package's two modules. The one that computes is loaded with the first of its calls, which are promises. */
export interface Package {
  mandoline: Mandoline;
  physics: { [K in Exclude<keyof Physics, 'version'>]: Later<Physics[K]> };
}
