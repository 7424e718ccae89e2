// OFF, in text.
import type { MeshArrays } from '../../model/gallery/mesh';
import { Flaw, quoted } from './flaw';
import { Polygons } from './polygons';
import { coordinates, decodeText, linesOf, type Line } from './text';

export const offHeader = /^(ST)?C?N?OFF\b/;

function* contentOf(text: string): Generator<Line> {
  for (const line of linesOf(text)) {
    const content = line.text.replace(/#.*/, '').trim();
    if (content) yield { text: content, number: line.number };
  }
}

/** The next line, of which there has to be one. */
function next(lines: Iterator<Line>, after: Line | null, what: string): Line {
  const { value, done } = lines.next();
  if (done) throw new Flaw(`Line ${after?.number ?? 1}: the file ends before ${what}.`);
  return value;
}

function wholeNumber(word: string | undefined, line: number, what: string): number {
  if (word && /^\d+$/.test(word)) return Number(word);
  throw new Flaw(`Line ${line}: ${what} should be a whole number, not ${quoted(word ?? '')}.`);
}

export function parseOff(bytes: Uint8Array): MeshArrays {
  const lines = contentOf(decodeText(bytes));
  let line = next(lines, null, 'its header');
  if (/^(ST)?C?N?(4n?|n)OFF\b|^\w*OFF\s+BINARY/.test(line.text)) {
    throw new Flaw(`Line ${line.number}: ${quoted(line.text)} is a kind of OFF file that is not read; text with three coordinates is.`);
  }
  if (offHeader.test(line.text)) {
    const counts = line.text.replace(offHeader, '').trim();
    line = counts ? { text: counts, number: line.number } : next(lines, line, 'its counts');
  }
  const words = line.text.split(/\s+/);
  const pointCount = wholeNumber(words[0], line.number, 'the number of points');
  const faceCount = wholeNumber(words[1], line.number, 'the number of faces');
  const polygons = new Polygons();
  for (let k = 0; k < pointCount; ++k) {
    line = next(lines, line, `point ${k} of ${pointCount}`);
    polygons.addPoint(...coordinates(line.text.split(/\s+/), line.number));
  }
  for (let k = 0; k < faceCount; ++k) {
    line = next(lines, line, `face ${k} of ${faceCount}`);
    const { text, number } = line;
    const face = text.split(/\s+/);
    const size = wholeNumber(face[0], number, 'the number of corners');
    if (face.length <= size) throw new Flaw(`Line ${number}: a face of ${size} corners names only ${face.length - 1}.`);
    const corners = face.slice(1, size + 1).map((word) => wholeNumber(word, number, 'a corner'));
    polygons.addPolygon(corners, () => `Line ${number}`);
  }
  return polygons.mesh();
}
