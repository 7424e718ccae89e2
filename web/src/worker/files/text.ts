// Text files: decoded, line by line, with numbers that are checked.
import { Flaw, quoted } from './flaw';

/** Bytes beyond ASCII stand in names and comments only, so text in an older encoding than UTF-8 is read, too. */
export function decodeText(bytes: Uint8Array): string {
  const [a, b] = bytes;
  if ((a === 0xff && b === 0xfe) || (a === 0xfe && b === 0xff)) return new TextDecoder(a === 0xff ? 'utf-16le' : 'utf-16be').decode(bytes);
  const zero = bytes.indexOf(0);
  const last = bytes.findLastIndex((byte) => byte !== 0);
  if (zero >= 0 && zero < last) throw new Flaw(`Byte ${zero}: binary data where text is expected.`);
  return new TextDecoder().decode(bytes.subarray(0, last + 1));
}

export interface Line {
  text: string;
  /** From 1. */
  number: number;
}

/** All lines, trimmed; a line that ends with a backslash goes on in the next one if `continued`. */
export function* linesOf(text: string, continued = false): Generator<Line> {
  let number = 0;
  for (let from = 0; from < text.length; ) {
    const first = ++number;
    let line = '';
    for (;;) {
      let end = text.indexOf('\n', from);
      if (end < 0) end = text.length;
      line += text.slice(from, end).trim();
      from = end + 1;
      if (!continued || !line.endsWith('\\') || from >= text.length) break;
      line = `${line.slice(0, -1)} `;
      ++number;
    }
    yield { text: line, number: first };
  }
}

const decimal = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** The number that a word is, or NaN. */
export function parseDecimal(word: string): number {
  return decimal.test(word) ? Number(word) : NaN;
}

const ordinals = ['first', 'second', 'third'];

/** The three coordinates at the start of some words. */
export function coordinates(words: readonly string[], line: number): [number, number, number] {
  const values = ordinals.map((ordinal, d) => {
    if (words[d] === undefined) throw new Flaw(`Line ${line}: a point needs three coordinates, and the ${ordinal} is missing.`);
    const value = parseDecimal(words[d]);
    if (Number.isNaN(value)) throw new Flaw(`Line ${line}: the ${ordinal} coordinate, ${quoted(words[d])}, is not a number.`);
    if (!Number.isFinite(Math.fround(value))) throw new Flaw(`Line ${line}: the ${ordinal} coordinate, ${quoted(words[d])}, is too large.`);
    return value;
  });
  return [values[0], values[1], values[2]];
}
