// OBJ. three's loader passes over lines that it can't read and takes missing points for NaN, so every point and face is checked here first.
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import type { MeshArrays } from '../../model/gallery/mesh';
import { Flaw, quoted } from './flaw';
import { sceneTriangles } from './scene';
import { coordinates, decodeText, linesOf } from './text';

/** The faces of a file, checked once all points are known. */
interface Face {
  words: string[];
  line: number;
  /** Points before it, to which negative numbers refer. */
  pointsBefore: number;
}

function corner(word: string, face: Face, pointCount: number): number {
  const number = word.split('/', 1)[0];
  if (!/^[+-]?\d+$/.test(number)) throw new Flaw(`Line ${face.line}: a face's corner, ${quoted(word)}, is not the number of a point.`);
  const id = Number(number);
  const point = id < 0 ? face.pointsBefore + id + 1 : id;
  if (point >= 1 && point <= pointCount) return point;
  const points = pointCount > 0 ? `points are numbered from 1 to ${pointCount}` : 'there are no points';
  throw new Flaw(`Line ${face.line}: a face names point ${id}, but ${points}.`);
}

/** The points and faces alone: lines, loose points and materials would make the loader split or mix up its meshes. */
function checkedText(text: string): string {
  const points: string[] = [];
  const faces: Face[] = [];
  for (const { text: line, number } of linesOf(text, true)) {
    const words = line.split(/\s+/);
    const key = words.shift();
    if (key === 'v') points.push(`v ${coordinates(words, number).join(' ')}`);
    else if (key === 'f') faces.push({ words, line: number, pointsBefore: points.length });
  }
  const faceLines = faces.map((face) => {
    const comment = face.words.findIndex((word) => word.startsWith('#'));
    const words = comment < 0 ? face.words : face.words.slice(0, comment);
    if (words.length < 3) {
      throw new Flaw(`Line ${face.line}: a face needs three corners, and this one has ${words.filter(Boolean).length}.`);
    }
    return `f ${words.map((word) => corner(word, face, points.length)).join(' ')}`;
  });
  return [...points, ...faceLines].join('\n');
}

export function parseObj(bytes: Uint8Array): MeshArrays {
  return sceneTriangles(new OBJLoader().parse(checkedText(decodeText(bytes))));
}
