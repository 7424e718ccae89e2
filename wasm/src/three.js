import { BufferAttribute, BufferGeometry } from 'three';
import { shiftedCellArrays } from './cell-arrays.js';
import { shiftedCellEdges } from './cell-edges.js';
import { cellColorer, colorsOfCells } from './colors.js';
import { drawing } from './drawing.js';
import { cellShifts } from './selection.js';
import { untouchedColorer, untouchedEdges, untouchedFaces } from './untouched.js';

export { cellArrays } from './cell-arrays.js';
export { cellEdgeArrays } from './cell-edges.js';
export { cellColors, idColor, kindColors, outsideColor, regionColor, volumeColor, windingColor } from './colors.js';
export { meshFromGeometry } from './geometry-mesh.js';
export { meshFromObject } from './object-mesh.js';
export { untouchedCells } from './untouched.js';

const singles = ['cell', 'face', 'vertex'];

/** @param {{ index?: Uint32Array, [name: string]: any }} arrays */
/** @param {{ index?: Uint32Array, [name: string]: any }} arrays */
function geometryOf({ index, ...attributes }) {
  const geometry = new BufferGeometry();
  for (const [name, array] of Object.entries(attributes)) {
    geometry.setAttribute(name, new BufferAttribute(array, singles.includes(name) ? 1 : 3));
  }
  return index ? geometry.setIndex(new BufferAttribute(index, 1)) : geometry;
}

/** The colour of each vertex's cell. */
function spread(cellColor, cells) {
  const color = new Float32Array(3 * cells.length);
  for (let i = 0; i < cells.length; ++i) {
    for (let d = 0; d < 3; ++d) color[3 * i + d] = cellColor[3 * cells[i] + d];
  }
  return color;
}

export const cellGeometry = drawing('cellGeometry', ['faceTriangles'], (cutMesh, faceTriangles, options) => {
  const arrays = shiftedCellArrays(cutMesh, faceTriangles, options, cellShifts(cutMesh, options));
  const color = spread(colorsOfCells(cutMesh, options.colorBy, options.measures), arrays.cell);
  return geometryOf({ ...arrays, color });
});

export const cellEdgeGeometry = drawing('cellEdgeGeometry', [], (cutMesh, options) => {
  return geometryOf(shiftedCellEdges(cutMesh, options, cellShifts(cutMesh, options)));
});

export const untouchedGeometry = drawing('untouchedGeometry', [], (cutMesh, options) => {
  return geometryOf(untouchedFaces(cutMesh, options));
});

export const untouchedEdgeGeometry = drawing('untouchedEdgeGeometry', [], (cutMesh, options) => {
  return geometryOf(untouchedEdges(cutMesh, options));
});

export const edgeGeometry = drawing('edgeGeometry', ['cutEdges', 'origin'], (cutMesh, cutEdges, origin) => {
  const position = Float32Array.from(cutMesh.positions, (x, i) => x - origin[i % 3]);
  return geometryOf({ position, index: cutEdges.edgeVertices.slice() });
});

/** 3 per polygon. */
function polygonColors(cutMesh, slice, colorBy, measures) {
  const colorOf = cellColorer(cutMesh, colorBy, measures);
  const untouchedColorOf = untouchedColorer(cutMesh, colorBy, measures);
  const colors = new Float32Array(3 * slice.polygonCell.length);
  for (let polygon = 0; polygon < slice.polygonCell.length; ++polygon) {
    const id = slice.polygonCell[polygon],
      region = slice.polygonRegion[polygon];
    const color =
      id >= 0
        ? colorOf({ id, region, volume: measures?.cellVolume[id] })
        : untouchedColorOf(slice.polygonGridCell.subarray(3 * polygon, 3 * polygon + 3), region);
    colors.set(color, 3 * polygon);
  }
  return colors;
}

/** The unit normal of the plane, from the triangles, which all lie in it. */
function sliceNormal({ positions, triangles }) {
  const sum = [0, 0, 0];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => positions.subarray(3 * triangles[t + corner], 3 * triangles[t + corner] + 3));
    for (let d = 0; d < 3; ++d) {
      const e = (d + 1) % 3,
        f = (d + 2) % 3;
      sum[d] += (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
    }
  }
  const length = Math.hypot(...sum) || 1;
  return sum.map((x) => x / length);
}

export const sliceGeometry = drawing('sliceGeometry', ['slice'], (cutMesh, slice, { colorBy, measures, origin }) => {
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
});
