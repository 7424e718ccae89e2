// Numbers and names as the page writes them.
const whole = new Intl.NumberFormat('en');

export function integer(n: number): string {
  return whole.format(n);
}

/** Four digits, without the noise of trailing zeros. */
export function real(x: number): string {
  return String(Number(x.toPrecision(4)));
}

/** What sums of doubles differ by. */
const rounding = 1e-9;

/** How far off something is, as a share of what is right: for example "+1.82%", or "same to 2e-16". */
export function deviation(share: number): string {
  const size = Math.abs(share);
  if (size === 0) return 'the same';
  if (size < rounding) return `same to ${size.toPrecision(1)}`;
  return `${share < 0 ? '−' : '+'}${Number((100 * size).toPrecision(3))}%`;
}

/** With a space that doesn't break. */
export function milliseconds(ms: number): string {
  return ms < 1000 ? `${ms < 10 ? ms.toFixed(1) : Math.round(ms)}\u00a0ms` : `${(ms / 1000).toFixed(ms < 10000 ? 2 : 1)}\u00a0s`;
}

export function plural(n: number, one: string, many = `${one}s`): string {
  return `${integer(n)} ${n === 1 ? one : many}`;
}

export function winding(value: number | null): string {
  return value === null ? 'none' : value < 0 ? `−${-value}` : String(value);
}

/** surfaceArea: Surface area; the field's terms with their hyphens: Grid-face area. */
export function words(camelCase: string): string {
  const spaced = camelCase.replace(/([A-Z])/g, (letter) => ` ${letter.toLowerCase()}`);
  const text = spaced.replace(/\b(tri|cut|half|grid) (edge|face)/, '$1-$2').replace(/\bcut cell/, 'cut-cell');
  return text.charAt(0).toUpperCase() + text.slice(1);
}
