// What is inside, in the words of the command line.
import type { InsideBy } from 'mandoline-wasm';
import { real, winding } from './format';
import type { Model } from './cut_model';

export const insideWords: Record<InsideBy, string> = { winding: 'by winding numbers', parity: 'by parity', estimate: 'by an estimate' };

/** Whether a region lies outside the surface. */
export function isOutside({ regions }: Model, region: number): boolean {
  return !regions[region].isInside;
}

/** For example "inside by an estimate: 0.97". */
function sideOf({ regions, insideBy }: Model, region: number): string {
  const { isInside, insideness } = regions[region];
  const number = insideness === null ? '' : `: ${real(Number(insideness.toFixed(2))).replace('-', '−')}`;
  return `${isInside ? 'inside' : 'outside'} ${insideWords[insideBy]}${number}`;
}

/** What tells that a region is inside or outside: its winding number, or else which it is and by what. */
export function insideOf(model: Model, region: number): string {
  const { winding: number } = model.regions[region];
  return number === null ? sideOf(model, region) : `winding ${winding(number)}`;
}

/** The winding number, or the one that an estimate counts as; null where there is but parity. */
export function nearestWinding({ regions }: Model, region: number): number | null {
  const { winding: number, insideness } = regions[region];
  if (number !== null || insideness === null) return number;
  return Math.sign(insideness) * Math.floor(Math.abs(insideness) + 0.5) || 0;
}
