// PLY, text or binary. three's loader drops polygons of more than four corners without a word, so this one is our own.
import type { MeshArrays } from '../../model/gallery/mesh';
import { Flaw, quoted } from './flaw';
import { Polygons } from './polygons';
import { parseDecimal } from './text';

type Read = (view: DataView, at: number, littleEndian: boolean) => number;
interface NumberType {
  size: number;
  read: Read;
}

const numberTypes: Record<string, NumberType> = {};
function define(names: string, size: number, read: Read): void {
  for (const name of names.split(' ')) numberTypes[name] = { size, read };
}
define('char int8', 1, (view, at) => view.getInt8(at));
define('uchar uint8', 1, (view, at) => view.getUint8(at));
define('short int16', 2, (view, at, little) => view.getInt16(at, little));
define('ushort uint16', 2, (view, at, little) => view.getUint16(at, little));
define('int int32', 4, (view, at, little) => view.getInt32(at, little));
define('uint uint32', 4, (view, at, little) => view.getUint32(at, little));
define('float float32', 4, (view, at, little) => view.getFloat32(at, little));
define('double float64', 8, (view, at, little) => view.getFloat64(at, little));

interface Property {
  name: string;
  type: NumberType;
  /** Type of the list's length; null if the property is one number. */
  length: NumberType | null;
}

interface Element {
  name: string;
  count: number;
  properties: Property[];
}

interface Header {
  format: 'ascii' | 'binary_little_endian' | 'binary_big_endian';
  elements: Element[];
  /** Where the body starts. */
  bytes: number;
  lines: number;
}

function typeNamed(name: string | undefined, line: number): NumberType {
  const type = name && Object.hasOwn(numberTypes, name) ? numberTypes[name] : null;
  if (!type) throw new Flaw(`Line ${line}: ${quoted(name ?? '')} is not a type of numbers.`);
  return type;
}

function parseHeader(bytes: Uint8Array): Header {
  // Longer headers than this are no headers.
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, 1 << 16));
  const end = /(?:^|[\r\n])end_header[ \t]*(\r\n|\n|\r)/.exec(start);
  if (!end) throw new Flaw('Line 1: the header of this PLY file has no end ("end_header" on a line of its own).');
  const lines = start.slice(0, end.index).split(/\r\n|\n|\r/);
  if (lines[0].trim() !== 'ply') throw new Flaw('Line 1: a PLY file starts with "ply".');
  let format: string | undefined;
  const elements: Element[] = [];
  lines.forEach((text, index) => {
    const line = index + 1;
    const [key, ...words] = text.trim().split(/\s+/);
    if (key === 'format') format = words[0];
    if (key === 'element') {
      const count = Number(words[1]);
      if (!/^\d+$/.test(words[1] ?? '')) {
        throw new Flaw(`Line ${line}: the number of elements, ${quoted(words[1] ?? '')}, is not a whole number.`);
      }
      elements.push({ name: words[0], count, properties: [] });
    }
    if (key !== 'property') return;
    const element = elements.at(-1);
    if (!element) throw new Flaw(`Line ${line}: a property before any element.`);
    element.properties.push(words[0] === 'list'
      ? { name: words[3], type: typeNamed(words[2], line), length: typeNamed(words[1], line) }
      : { name: words[1], type: typeNamed(words[0], line), length: null });
  });
  if (format !== 'ascii' && format !== 'binary_little_endian' && format !== 'binary_big_endian') {
    throw new Flaw(`The header names the format ${quoted(format ?? '')}; ascii, binary_little_endian and binary_big_endian are known.`);
  }
  return { format, elements, bytes: end.index + end[0].length, lines: lines.length + (end.index > 0 ? 1 : 0) };
}

/** The numbers of the body, one after another. */
interface Numbers {
  next(type: NumberType): number;
  where(): string;
}

function binaryNumbers(bytes: Uint8Array, littleEndian: boolean, from: number): Numbers {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = from;
  let last = from;
  return {
    next(type) {
      if (at + type.size > bytes.length) throw new Flaw(`Byte ${at}: the file ends before all the elements that its header promises.`);
      last = at;
      at += type.size;
      return type.read(view, last, littleEndian);
    },
    where: () => `Byte ${last}`,
  };
}

function textNumbers(bytes: Uint8Array, from: number, firstLine: number): Numbers {
  const text = new TextDecoder('latin1').decode(bytes);
  const word = /[^\s]+/g;
  word.lastIndex = from;
  let line = firstLine;
  let counted = from;
  return {
    next() {
      const match = word.exec(text);
      if (!match) throw new Flaw(`Line ${line}: the file ends before all the elements that its header promises.`);
      for (; counted < match.index; ++counted) if (text[counted] === '\n') ++line;
      const value = parseDecimal(match[0]);
      if (Number.isNaN(value)) throw new Flaw(`Line ${line}: ${quoted(match[0])} is not a number.`);
      return value;
    },
    where: () => `Line ${line}`,
  };
}

/** Refuses counts that the file can't hold, before any time is spent on them. */
function checkCounts({ format, elements, bytes: headerBytes }: Header, total: number): void {
  for (const { name, count, properties } of elements) {
    const each = properties.reduce((sum, { type, length }) => sum + (format === 'ascii' ? 1 : (length ?? type).size), 0);
    if (count > 0 && (each === 0 || count * each > total - headerBytes)) {
      throw new Flaw(`The header promises ${count} elements "${name}", but only ${total - headerBytes} bytes follow it.`);
    }
  }
}

function readList(numbers: Numbers, property: Property, longest: number): number[] {
  const length = numbers.next(property.length!);
  if (!Number.isInteger(length) || length < 0 || length > longest) throw new Flaw(`${numbers.where()}: a list can't have ${length} items.`);
  return Array.from({ length }, () => numbers.next(property.type));
}

/** Calls visit with the values of each element's properties. */
function readElements(element: Element, numbers: Numbers, longestList: number, visit: (values: (number | number[])[]) => void): void {
  for (let k = 0; k < element.count; ++k) {
    visit(element.properties.map((property) => (property.length ? readList(numbers, property, longestList) : numbers.next(property.type))));
  }
}

function pointReader(element: Element, polygons: Polygons, numbers: Numbers): (values: (number | number[])[]) => void {
  const at = ['x', 'y', 'z'].map((name) => element.properties.findIndex((property) => property.name === name && !property.length));
  if (at.includes(-1)) throw new Flaw('The header gives points no properties x, y and z.');
  return (values) => {
    const [x, y, z] = at.map((index) => Number(values[index]));
    if (![x, y, z].every(Number.isFinite)) {
      throw new Flaw(`${numbers.where()}: point ${polygons.pointCount} has a coordinate that is not a finite number.`);
    }
    polygons.addPoint(x, y, z);
  };
}

function faceReader(element: Element, polygons: Polygons, numbers: Numbers): (values: (number | number[])[]) => void {
  const at = element.properties.findIndex(({ name, length }) => length && (name === 'vertex_indices' || name === 'vertex_index'));
  if (at < 0) throw new Flaw('The header gives faces no list "vertex_indices".');
  if (polygons.pointCount === 0) throw new Flaw('There are no points before the faces.');
  return (values) => polygons.addPolygon(values[at] as number[], numbers.where);
}

export function parsePly(bytes: Uint8Array): MeshArrays {
  const header = parseHeader(bytes);
  checkCounts(header, bytes.length);
  const numbers = header.format === 'ascii' ? textNumbers(bytes, header.bytes, header.lines + 1)
    : binaryNumbers(bytes, header.format === 'binary_little_endian', header.bytes);
  const polygons = new Polygons();
  const readers: Record<string, typeof pointReader> = { vertex: pointReader, face: faceReader };
  for (const element of header.elements) {
    readElements(element, numbers, bytes.length, readers[element.name]?.(element, polygons, numbers) ?? (() => {}));
  }
  return polygons.mesh();
}
