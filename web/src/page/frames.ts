// Waiting for frames of the screen, for pictures, and for nothing to do.
import type { View } from '../model/view';
import type { State } from './state';

/** Resolves to when it comes, in ms. */
export function nextFrame(): Promise<number> {
  return new Promise((resolve) => requestAnimationFrame(() => resolve(performance.now())));
}

/** Of a model, if there is one. It may be late: shaders are compiled before it. */
export async function firstPicture({ model }: State, view: View): Promise<void> {
  while (model.value && view.pictures === 0) await nextFrame();
}

/** Not every browser tells when it is idle. */
export function idle(): Promise<unknown> {
  return new Promise((resolve) => {
    if ('requestIdleCallback' in window) requestIdleCallback(resolve);
    else setTimeout(resolve, 200);
  });
}
