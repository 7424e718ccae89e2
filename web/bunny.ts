// The bunny of the package "bunny" as text of a fixed width, which is three quarters of its size compressed: it is part of what the first
// picture needs.
import bunny from 'bunny';
import type { Plugin } from 'vite';

const digits = '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;<=>?@^_{|}~,.';
/** Of coordinates, per unit. */
const steps = 1e6;
const [widthOfCoordinate, widthOfVertex] = [4, 2];

/** Whole numbers from 0, each in as many digits. */
function textOf(numbers: readonly number[], width: number): string {
  return numbers
    .map((number) => {
      let text = '';
      for (let rest = number, digit = 0; digit < width; digit++, rest = Math.floor(rest / digits.length)) {
        text = digits[rest % digits.length] + text;
      }
      return text;
    })
    .join('');
}

/** The module's own text: triples of numbers, as the package has them. */
function triplesOf(text: string, width: number, least: number, steps: number, digits: string): number[][] {
  const triples: number[][] = [];
  for (let at = 0; at < text.length; at += width) {
    let number = 0;
    for (const digit of text.slice(at, at + width)) number = digits.length * number + digits.indexOf(digit);
    if (at % (3 * width) === 0) triples.push([]);
    triples[triples.length - 1].push((number + least) / steps);
  }
  return triples;
}

export function compactBunny(): Plugin {
  return {
    name: 'compact-bunny',
    enforce: 'pre',
    load(id) {
      if (!/\/bunny\/index\.js$/.test(id)) return;
      const { positions, cells } = bunny;
      const places = positions.flat().map((x) => Math.round(steps * x));
      const least = Math.min(...places);
      const coordinates = textOf(
        places.map((place) => place - least),
        widthOfCoordinate,
      );
      const vertices = textOf(cells.flat(), widthOfVertex);
      const same = JSON.stringify([
        triplesOf(coordinates, widthOfCoordinate, least, steps, digits),
        triplesOf(vertices, widthOfVertex, 0, 1, digits),
      ]);
      if (same !== JSON.stringify([positions, cells])) throw new Error('the text of the bunny is not the bunny');
      return `const digits = ${JSON.stringify(digits)};
${triplesOf.toString()}
export default {
  positions: triplesOf(${JSON.stringify(coordinates)}, ${widthOfCoordinate}, ${least}, ${steps}, digits),
  cells: triplesOf(${JSON.stringify(vertices)}, ${widthOfVertex}, 0, 1, digits),
};`;
    },
  };
}
