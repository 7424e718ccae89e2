// What can move by itself: the surface, or how it is sliced, pulled apart, and how finely it is cut.
import { motions, type Motion } from './motion';

export const plays = [...motions, 'slice', 'explode', 'cells'] as const;
export type Play = (typeof plays)[number];

export interface Playing {
  /** Cuts a second; null for what is not cut again. */
  rate: number | null;
}

export function isMotion(play: Play): play is Motion {
  return motions.some((motion) => motion === play);
}

export function isCut(play: Play): boolean {
  return play !== 'slice' && play !== 'explode';
}
