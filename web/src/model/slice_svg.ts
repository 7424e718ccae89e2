// A slice as a drawing: a path for each polygon of a cell, in the units of the mesh, with the plane's normal towards the viewer.
import type { Slice } from 'mandoline-wasm';
import { escaped } from './markup';
import { fromUpright, type Up } from './up';
import { cross, dot, unit, type Vector3 } from './vector';

export interface Drawing {
  title: string;
  slice: Slice;
  normal: Vector3;
  /** The axis of the mesh that points upwards in the drawing, as far as the plane lets it. */
  up: Up;
  /** Which polygons are drawn, and their colours: 4 bytes each, for every polygon of the slice. */
  polygons: readonly number[];
  tint: Uint8Array;
}

/** So many strokes side by side would fill the diagonal of a drawing. */
const strokes = 1200;
/** Planes that are as flat as this are seen from above, with the front of the mesh at the foot of the drawing. */
const flat = 0.999;

export function sliceSvg({ title, slice, normal, up, polygons, tint }: Drawing): string {
  const { right, above } = axesOf(normal, up);
  const { positions } = slice;
  const place = (point: number): [number, number] => {
    const along = (axis: Vector3) => axis.reduce((sum, n, d) => sum + n * positions[3 * point + d], 0);
    return [along(right), -along(above)]; // SVG's y points down.
  };
  const min: [number, number] = [Infinity, Infinity];
  const max: [number, number] = [-Infinity, -Infinity];
  const pathOf = (polygon: number) => {
    const loops = loopsOf(slice, polygon).map((points) => {
      const places = Array.from(points, place);
      for (const at of places) for (const d of [0, 1]) [min[d], max[d]] = [Math.min(min[d], at[d]), Math.max(max[d], at[d])];
      return `M${places.map((at) => at.join(' ')).join('L')}Z`;
    });
    const cell = slice.polygonCell[polygon];
    const owner =
      cell >= 0 ? `data-cell="${cell}"` : `data-grid-cell="${slice.polygonGridCell.subarray(3 * polygon, 3 * polygon + 3).join(' ')}"`;
    const color = Array.from(tint.subarray(4 * polygon, 4 * polygon + 3), (byte) => byte.toString(16).padStart(2, '0')).join('');
    return `<path ${owner} data-region="${slice.polygonRegion[polygon]}" fill="#${color}" d="${loops.join('')}"/>\n`;
  };
  const paths = polygons.map(pathOf).join('');
  const size = [max[0] - min[0], max[1] - min[1]];
  const width = Math.hypot(...size) / strokes;
  const stroke = `stroke="#2a3440" stroke-width="${width}" stroke-linejoin="round"`;
  // The outer strokes reach half their width beyond the points.
  const box = [...min.map((x) => x - width / 2), ...size.map((x) => x + width)];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${box.join(' ')}">
<title>${escaped(title)}</title>
<g fill-rule="evenodd" ${stroke}>
${paths}</g>
</svg>
`;
}

/** The points of the outer loop of a polygon, and of its holes. */
function loopsOf({ polygonLoopOffsets, loopOffsets, loopPoints }: Slice, polygon: number): Uint32Array[] {
  const first = polygonLoopOffsets[polygon];
  return Array.from({ length: polygonLoopOffsets[polygon + 1] - first }, (_, at) => {
    return loopPoints.subarray(loopOffsets[first + at], loopOffsets[first + at + 1]);
  });
}

/** To the right and upwards in the drawing: units. */
function axesOf(normal: Vector3, up: Up): { right: Vector3; above: Vector3 } {
  const upright = fromUpright([0, 1, 0], up);
  const isFlat = Math.abs(dot(normal, upright)) > flat;
  const right = unit(cross(isFlat ? fromUpright([0, 0, -1], up) : upright, normal));
  return { right, above: cross(normal, right) };
}
