// What the page can draw: in the shaders numbers have 32 bits, and their squares have to be there, too.
import { pageError } from '../model/failure';
import type { Bounds } from '../model/grid_around';

const most = 1e18;
const least = 1e-18;

/** Throws if a box with finite corners is too large or too small to be drawn. */
export function checkExtent({ min, max }: Bounds, title: string): void {
  const longest = Math.max(...max.map((x, d) => x - min[d]));
  if (longest > most)
    throw pageError(title, `It is more than ${most.toExponential()} across, and this page draws nothing larger. Scale it down.`);
  if (longest > 0 && longest < least) {
    throw pageError(title, `It is less than ${least.toExponential()} across, and this page draws nothing smaller. Scale it up.`);
  }
}
