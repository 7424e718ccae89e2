import { BufferAttribute, BufferGeometry } from 'three';
import { shiftedCellArrays } from './cell-arrays.js';
import { cellColorer, cellColors } from './colors.js';
import { MandolineError } from './errors.js';

export { cellArrays } from './cell-arrays.js';
export { cellColors, idColor, kindColors, outsideColor, regionColor, volumeColor, windingColor } from './colors.js';
export { meshFromGeometry } from './geometry-mesh.js';

const noShift = [0, 0, 0];

function geometryOf(attributes) {
  const geometry = new BufferGeometry();
  for (const [name, array] of Object.entries(attributes)) {
    geometry.setAttribute(name, new BufferAttribute(array, name === 'cell' || name === 'face' ? 1 : 3));
  }
  return geometry;
}

/** 3 per cut-cell: away from the centre of the grid, and to the origin. */
function cellShifts({ cellRegion, grid }, { origin = noShift, explode = 0, measures }) {
  if (explode !== 0 && !measures) throw new MandolineError('badArgument', 'Exploding needs the measures.', { stage: 'cellGeometry' });
  const center = grid.planes.map((planes) => 0.5 * (planes[0] + planes[planes.length - 1]));
  const shifts = new Float64Array(3 * cellRegion.length);
  for (let i = 0; i < shifts.length; ++i) {
    const way = explode === 0 ? 0 : explode * (measures.cellCentroid[i] - center[i % 3]);
    shifts[i] = way - origin[i % 3];
  }
  return shifts;
}

/** The colour of each vertex's cell. */
function spread(cellColor, cells) {
  const color = new Float32Array(3 * cells.length);
  for (let i = 0; i < cells.length; ++i) {
    for (let d = 0; d < 3; ++d) color[3 * i + d] = cellColor[3 * cells[i] + d];
  }
  return color;
}

export function cellGeometry(cutMesh, faceTriangles, options = {}) {
  const arrays = shiftedCellArrays(cutMesh, faceTriangles, options, cellShifts(cutMesh, options));
  const color = spread(cellColors(cutMesh, options.colorBy ?? 'region', options.measures), arrays.cell);
  return geometryOf({ ...arrays, color });
}

export function edgeGeometry(cutMesh, cutEdges, origin = noShift) {
  const geometry = geometryOf({ position: Float32Array.from(cutMesh.positions, (x, i) => x - origin[i % 3]) });
  return geometry.setIndex(new BufferAttribute(cutEdges.edgeVertices.slice(), 1));
}

function gridCellVolume({ planes }, cell) {
  return planes.reduce((volume, axis, d) => volume * (axis[cell[d] + 1] - axis[cell[d]]), 1);
}

/** 3 per polygon. Untouched grid cells have no ids of their own: they take those after the cut-cells, counted through the grid. */
function polygonColors(cutMesh, slice, colorBy, measures) {
  const { grid, cellRegion } = cutMesh;
  const colorOf = cellColorer(cutMesh, colorBy, measures);
  const colors = new Float32Array(3 * slice.polygonCell.length);
  for (let polygon = 0; polygon < slice.polygonCell.length; ++polygon) {
    const cell = slice.polygonCell[polygon];
    const [i, j, k] = slice.polygonGridCell.subarray(3 * polygon, 3 * polygon + 3);
    const untouched = cell < 0;
    colors.set(colorOf({
      id: untouched ? cellRegion.length + i + grid.cells[0] * (j + grid.cells[1] * k) : cell,
      region: slice.polygonRegion[polygon],
      volume: untouched ? gridCellVolume(grid, [i, j, k]) : measures?.cellVolume[cell],
    }), 3 * polygon);
  }
  return colors;
}

/** The unit normal of the plane, from the triangles, which all lie in it. */
function sliceNormal({ positions, triangles }) {
  const sum = [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => positions.subarray(3 * triangles[t + corner], 3 * triangles[t + corner] + 3));
    for (let d = 0; d < 3; ++d) {
      const e = (d + 1) % 3, f = (d + 2) % 3;
      sum[d] += (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
    }
  }
  const length = Math.hypot(...sum) || 1;
  return sum.map((x) => x / length);
}

export function sliceGeometry(cutMesh, slice, { colorBy = 'region', measures, origin = noShift } = {}) {
  const { triangles, positions, polygonTriangleOffsets: offsets } = slice;
  const count = triangles.length;
  const [position, normal, color] = [0, 1, 2].map(() => new Float32Array(3 * count));
  const cell = new Int32Array(count);
  const planeNormal = sliceNormal(slice);
  const colors = polygonColors(cutMesh, slice, colorBy, measures);
  for (let polygon = 0; polygon < slice.polygonCell.length; ++polygon) {
    for (let corner = 3 * offsets[polygon]; corner < 3 * offsets[polygon + 1]; ++corner) {
      for (let d = 0; d < 3; ++d) {
        position[3 * corner + d] = positions[3 * triangles[corner] + d] - origin[d];
        normal[3 * corner + d] = planeNormal[d];
        color[3 * corner + d] = colors[3 * polygon + d];
      }
    }
    cell.fill(slice.polygonCell[polygon], 3 * offsets[polygon], 3 * offsets[polygon + 1]);
  }
  return geometryOf({ position, normal, color, cell });
}
