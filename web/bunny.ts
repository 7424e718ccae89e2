// The bunny of the package "bunny" as short text, since it is part of what the first picture needs: its triangles are found from neighbour to
// neighbour, and a new vertex is told by how far it is from where two neighbours make one expect it. Vertices and triangles are those of the
// package, in another order.
import bunny from 'bunny';
import type { Plugin } from 'vite';

const digits = '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;<=>?@^_{|}~,.';
/** Of coordinates, per unit. */
const steps = 1e6;

/** Whole numbers, each in as many digits as the largest needs: all first digits, then all second ones. The last digit is odd for those below 0. */
function textOf(numbers: readonly number[]): string {
  let rest = numbers.map((number) => (number < 0 ? -2 * number - 1 : 2 * number));
  const places: string[] = [];
  while (rest.some((number) => number > 0)) {
    places.unshift(rest.map((number) => digits[number % digits.length]).join(''));
    rest = rest.map((number) => Math.floor(number / digits.length));
  }
  return places.join('');
}

function numbersOf(text: string, length: number, digits: string): number[] {
  return Array.from({ length }, (_, i) => {
    let number = 0;
    for (let at = i; at < text.length; at += length) number = digits.length * number + digits.indexOf(text[at]);
    return number % 2 ? -(number + 1) / 2 : number / 2;
  });
}

/**
 * The triangles of a closed surface, each across an edge of one before. `cornerAt` tells the corner of the next one, which has an edge from x to y
 * with z at its other side: `count` for a new vertex.
 */
function spread(cornerAt: (x: number, y: number, z: number, count: number) => number): number[][] {
  const triangles: number[][] = [];
  const edges = new Set<string>();
  const add = (a: number, b: number, c: number) => {
    triangles.push([a, b, c]);
    for (const edge of [`${a},${b}`, `${b},${c}`, `${c},${a}`]) edges.add(edge);
  };
  add(0, 1, 2);
  let count = 3;
  for (const [a, b, c] of triangles) {
    for (const [y, x, z] of [
      [a, b, c],
      [b, c, a],
      [c, a, b],
    ]) {
      if (edges.has(`${x},${y}`)) continue;
      const corner = cornerAt(x, y, z, count);
      if (corner === count) ++count;
      add(x, y, corner);
    }
  }
  return triangles;
}

/** How many vertices ago each corner was new, and how far each vertex is from the fourth corner of a parallelogram, the first three from 0. */
function describe(positions: readonly number[][], cells: readonly number[][]): { ago: number[]; moves: number[] } {
  const across = new Map(cells.flatMap(([a, b, c]) => [[`${a},${b}`, c] as const, [`${b},${c}`, a] as const, [`${c},${a}`, b] as const]));
  const places = positions.map((position) => position.map((x) => Math.round(steps * x)));
  const order = [...cells[0]];
  const ago: number[] = [];
  const moves = order.flatMap((vertex) => places[vertex]);
  spread((x, y, z, count) => {
    const vertex = across.get(`${order[x]},${order[y]}`);
    if (vertex === undefined) throw new Error('the bunny is not closed');
    if (!order.includes(vertex)) {
      order.push(vertex);
      moves.push(...places[vertex].map((at, k) => at - places[order[x]][k] - places[order[y]][k] + places[order[z]][k]));
    }
    ago.push(count - order.indexOf(vertex));
    return order.indexOf(vertex);
  });
  return { ago, moves };
}

function meshOf(ago: number[], moves: number[], steps: number): { positions: number[][]; cells: number[][] } {
  const places = [0, 3, 6].map((at) => moves.slice(at, at + 3));
  let triangle = 0;
  const cells = spread((x, y, z, count) => {
    const corner = count - ago[triangle++];
    if (corner === count) places.push([0, 1, 2].map((k) => places[x][k] + places[y][k] - places[z][k] + moves[3 * count + k]));
    return corner;
  });
  return { positions: places.map((place) => place.map((x) => x / steps)), cells };
}

/** The triangles by their corners' coordinates, in an order that depends on nothing else. */
function trianglesOf({ positions, cells }: { positions: readonly number[][]; cells: readonly number[][] }): string {
  const turned = cells.map((cell) => {
    const corners = cell.map((vertex) => positions[vertex].join());
    const first = corners.indexOf([...corners].sort()[0]);
    return [0, 1, 2].map((k) => corners[(first + k) % 3]).join(' ');
  });
  return turned.sort().join('\n');
}

export function compactBunny(): Plugin {
  return {
    name: 'compact-bunny',
    enforce: 'pre',
    load(id) {
      if (!/\/bunny\/index\.js$/.test(id)) return;
      const { ago, moves } = describe(bunny.positions, bunny.cells);
      const texts = [ago, moves].map((numbers) => ({ text: textOf(numbers), length: numbers.length }));
      const [readAgo, readMoves] = texts.map(({ text, length }) => numbersOf(text, length, digits));
      if (trianglesOf(meshOf(readAgo, readMoves, steps)) !== trianglesOf(bunny)) throw new Error('the text of the bunny is not the bunny');
      const numbers = texts.map(({ text, length }) => `numbersOf(${JSON.stringify(text)}, ${length}, digits)`);
      return `const digits = ${JSON.stringify(digits)};
${[numbersOf, spread, meshOf].join('\n')}
export default meshOf(${numbers.join(', ')}, ${steps});`;
    },
  };
}
