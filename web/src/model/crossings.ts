// What is said of triangles that meet other than in shared vertices and edges: the pairs that `mandoline info` counts, as places.
import type { PairCounts } from 'mandoline-wasm';
import { integer } from './format';

const phrases: readonly [keyof PairCounts, string][] = [
  ['crossing', 'crosses itself'],
  ['touching', 'touches itself'],
  ['overlapping', 'overlaps itself'],
  ['folded', 'folds onto itself'],
  ['identical', 'has a triangle twice'],
];

/** For example "This mesh crosses itself in 151 places and touches itself in 10; they were resolved exactly."; null if nothing meets. */
export function crossingsSentence(counts: PairCounts): string | null {
  const present = phrases.filter(([kind]) => counts[kind] > 0);
  if (present.length === 0) return null;
  const facts = present.map(([kind, phrase], k) => {
    const places = k > 0 ? '' : counts[kind] === 1 ? ' place' : ' places';
    return `${phrase} in ${integer(counts[kind])}${places}`;
  });
  const isOne = present.length === 1 && counts[present[0][0]] === 1;
  return `This mesh ${list(facts)}; ${isOne ? 'it was' : 'they were'} resolved exactly.`;
}

function list(items: readonly string[]): string {
  return items.length === 1 ? items[0] : `${items.slice(0, -1).join(', ')} and ${items[items.length - 1]}`;
}
