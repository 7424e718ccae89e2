// What a visit without a link begins with: the surface alone, the grid that sweeps through it, cells that come apart, and wind.
import type { Settings } from './settings';

/** A moment of the opening. */
export interface Moment {
  /** 0 to 1 of the picture's width: left of it are cut-cells, right of it is the surface alone. */
  divider: number;
  /** How far cells are apart, in the settings' terms. */
  explode: number;
  wind: boolean;
}

/** In seconds. The first and the last are the default look. */
const script: readonly (Moment & { at: number })[] = [
  { at: 0, divider: 1, explode: 0.06, wind: false },
  { at: 0.35, divider: 0, explode: 0, wind: false },
  { at: 0.7, divider: 0, explode: 0, wind: false },
  { at: 1.6, divider: 1, explode: 0, wind: false },
  { at: 2.1, divider: 1, explode: 0.4, wind: false },
  { at: 2.25, divider: 1, explode: 0.4, wind: true },
  { at: 2.6, divider: 1, explode: 0, wind: true },
  { at: 3.8, divider: 1, explode: 0, wind: true },
  { at: 4, divider: 1, explode: 0.06, wind: false },
];
export const openingSeconds = script[script.length - 1].at;

/** What changes slowly begins and ends so between two moments of the script. */
export function momentAt(seconds: number): Moment {
  const next = script.findIndex(({ at }) => at > seconds);
  if (next < 0) return script[script.length - 1];
  if (next === 0) return script[0];
  const [from, to] = [script[next - 1], script[next]];
  const time = (seconds - from.at) / (to.at - from.at);
  const share = time * time * (3 - 2 * time);
  const between = (a: number, b: number) => a + share * (b - a);
  return { divider: between(from.divider, to.divider), explode: between(from.explode, to.explode), wind: from.wind };
}

/** The default look at a moment. */
export function lookAt(settings: Settings, { divider, explode }: Moment): Settings {
  const compare = { way: divider < 1 ? ('voxels' as const) : ('none' as const), divider };
  return { ...settings, compare, explode: { ...settings.explode, cells: explode } };
}
