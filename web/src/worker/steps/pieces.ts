// The last three steps: cut-faces of a triangle, faces of an axial plane, cut-cells of a grid cell.
import type { Vector3 } from '../../model/vector';
import type { StepPicture, StepRequest } from '../../model/instead';
import { axes } from '../../model/slices';
import { plural } from '../../model/format';
import { chosenGridCell, chosenPlane, chosenTriangle } from './choose';
import { coplanarColor, gridColor, outlineColor, pieceColor, shaded, type Color } from './colors';
import { facesWhere, loopPoints, middleOf, moved, trianglesOf } from './faces';
import { Drawing, pointOf, type Subject } from './picture';

/** A face drawn at some share of its size. */
function drawFace(drawing: Drawing, subject: Subject, face: number, size: number, color: Color): void {
  const loops = loopPoints(subject, face);
  const middle = middleOf(loops[0]);
  const place = (p: Vector3): Vector3 => [0, 1, 2].map((d) => middle[d] + size * (p[d] - middle[d])) as unknown as Vector3;
  for (const [a, b, c] of trianglesOf(subject, face)) drawing.triangle(place(a), place(b), place(c), color);
  for (const loop of loops) drawing.polygon(loop.map(place), outlineColor);
}

export function triangleFaces(subject: Subject, request: StepRequest): StepPicture {
  const { mesh, cutMesh } = subject;
  const triangle = chosenTriangle(cutMesh, request);
  const drawing = new Drawing(subject.origin);
  const corners = [0, 1, 2].map((k) => pointOf(mesh.positions, mesh.triangles[3 * triangle + k]));
  drawing.polygon(corners, gridColor);
  const faces = facesWhere(subject, (face) => cutMesh.faceTriangle[face] === triangle);
  faces.forEach((face, k) => drawFace(drawing, subject, face, 0.9, pieceColor(k)));
  const text =
    faces.length > 0
      ? `The axial planes cut triangle ${triangle} into ${plural(faces.length, 'cut-face')}, drawn slightly apart.` +
        ' Together they cover the triangle exactly, and each lies in one grid cell (Section 4.3).'
      : `Triangle ${triangle} has no cut-face: it is degenerate, another triangle covers it, or it lies outside the grid.`;
  return drawing.finish(text, { kind: 'triangleFaces', triangle }, subject, corners);
}

/** Two corners of the grid's box. */
function boxEnds({ cutMesh: { grid } }: Subject): Vector3[] {
  return [0, -1].map((at) => grid.planes.map((planes) => planes.at(at) ?? 0));
}

/** The outline of an axial plane within the grid's box. */
function planeOutline({ cutMesh }: Subject, axis: number, plane: number): Vector3[] {
  const { planes } = cutMesh.grid;
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
  return [
    [0, 0],
    [1, 0],
    [1, 1],
    [0, 1],
  ].map(([i, j]) => {
    const corner = [0, 0, 0];
    corner[axis] = planes[axis][plane];
    corner[u] = planes[u][i * (planes[u].length - 1)];
    corner[v] = planes[v][j * (planes[v].length - 1)];
    return [corner[0], corner[1], corner[2]];
  });
}

export function axialPlane(subject: Subject, request: StepRequest): StepPicture {
  const { faceAxis, facePlane, faceTriangle, faceLoopOffsets } = subject.cutMesh;
  const { axis, plane } = chosenPlane(subject.cutMesh, request);
  const drawing = new Drawing(subject.origin);
  drawing.polygon(planeOutline(subject, axis, plane), gridColor);
  const faces = facesWhere(subject, (face) => faceAxis[face] === axis && facePlane[face] === plane);
  faces.forEach((face, k) => drawFace(drawing, subject, face, 1, faceTriangle[face] >= 0 ? coplanarColor : pieceColor(k)));
  const punctured = faces.filter((face) => faceLoopOffsets[face + 1] - faceLoopOffsets[face] > 1).length;
  const coplanar = faces.filter((face) => faceTriangle[face] >= 0).length;
  const text =
    `In axial plane ${plane} normal to ${axes[axis]}, the outline of the surface divides the grid-faces` +
    ` into ${plural(faces.length, 'face')}` +
    `${punctured ? `, ${punctured.toLocaleString('en')} of them with holes` : ''} (Sections 4.3 and 4.5).` +
    (coplanar > 0 ? ` Pieces of triangles in the plane (${coplanar.toLocaleString('en')}, yellow) replace grid-faces.` : '');
  return drawing.finish(text, { kind: 'axialPlane', axis, plane }, subject, boxEnds(subject));
}

interface Piece {
  cell: number;
  min: Vector3;
  max: Vector3;
  middle: Vector3;
}

function pieceOf(subject: Subject, cell: number): Piece {
  const { cellHalfFaceOffsets, cellHalfFaces } = subject.cutMesh;
  const halfFaces = cellHalfFaces.subarray(cellHalfFaceOffsets[cell], cellHalfFaceOffsets[cell + 1]);
  const points = Array.from(halfFaces).flatMap((halfFace) => loopPoints(subject, halfFace >> 1).flat());
  const bound = (d: number, best: (a: number, b: number) => number) => points.reduce((x, p) => best(x, p[d]), points[0][d]);
  const min: Vector3 = [bound(0, Math.min), bound(1, Math.min), bound(2, Math.min)];
  const max: Vector3 = [bound(0, Math.max), bound(1, Math.max), bound(2, Math.max)];
  return { cell, min, max, middle: middleOf([min, max]) };
}

function volumeOf(min: Vector3, max: Vector3): number {
  return [0, 1, 2].reduce((volume, d) => volume * Math.max(0, max[d] - min[d]), 1);
}

/** The share of one piece's box that another's covers. */
function coveredShare(a: Piece, b: Piece): number {
  const min = a.min.map((x, d) => Math.max(x, b.min[d])) as unknown as Vector3;
  const max = a.max.map((x, d) => Math.min(x, b.max[d])) as unknown as Vector3;
  return volumeOf(min, max) / volumeOf(a.min, a.max);
}

/** Whether a piece lies in or around a larger one. */
function isHidden(piece: Piece, pieces: readonly Piece[]): boolean {
  const size = ({ min, max }: Piece) => volumeOf(min, max);
  const isBefore = (other: Piece) => size(other) > size(piece) || (size(other) === size(piece) && other.cell < piece.cell);
  return pieces.some((other) => other !== piece && isBefore(other) && coveredShare(piece, other) > 0.8);
}

/** Where pieces go: away from the middle of the grid cell; hidden ones are set in a row beside the others, along x. */
function movesApart(pieces: readonly Piece[], min: Vector3, max: Vector3): Vector3[] {
  const center = middleOf([min, max]);
  const hidden = pieces.map((piece) => isHidden(piece, pieces));
  const apart = pieces.map(({ middle }) => middle.map((x, d) => 0.9 * (x - center[d])) as unknown as Vector3);
  let end = pieces.reduce((x, piece, k) => (hidden[k] ? x : Math.max(x, piece.max[0] + apart[k][0])), max[0]);
  return pieces.map((piece, k): Vector3 => {
    if (!hidden[k]) return apart[k];
    const start = end + 0.2 * (max[0] - min[0]);
    end = start + piece.max[0] - piece.min[0];
    return [start - piece.min[0], 0, 0];
  });
}

const light: Vector3 = [0.37, 0.84, 0.4];

/** How bright a triangle is, seen from the side that its corners run around counter-clockwise. */
function shadeOf(a: Vector3, b: Vector3, c: Vector3): number {
  const [u, v] = [[0, 1, 2].map((d) => b[d] - a[d]), [0, 1, 2].map((d) => c[d] - a[d])];
  const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(normal[0], normal[1], normal[2]);
  return length > 0 ? 0.75 + (0.35 * (normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2])) / length : 1;
}

function drawCell(drawing: Drawing, subject: Subject, cell: number, by: Vector3, color: Color): void {
  const { cellHalfFaceOffsets, cellHalfFaces } = subject.cutMesh;
  for (const halfFace of cellHalfFaces.subarray(cellHalfFaceOffsets[cell], cellHalfFaceOffsets[cell + 1])) {
    for (const [a, b, c] of trianglesOf(subject, halfFace >> 1)) {
      const [p, q, r] = halfFace & 1 ? [a, c, b] : [a, b, c];
      drawing.triangle(moved(p, by), moved(q, by), moved(r, by), shaded(color, shadeOf(p, q, r)));
    }
    for (const loop of loopPoints(subject, halfFace >> 1))
      drawing.polygon(
        loop.map((p) => moved(p, by)),
        outlineColor,
      );
  }
}

export function gridCell(subject: Subject, request: StepRequest): StepPicture {
  const { grid, cellGridCell, cellRegion } = subject.cutMesh;
  const at = chosenGridCell(subject.cutMesh, request);
  const min: Vector3 = [grid.planes[0][at[0]], grid.planes[1][at[1]], grid.planes[2][at[2]]];
  const max: Vector3 = [grid.planes[0][at[0] + 1], grid.planes[1][at[1] + 1], grid.planes[2][at[2] + 1]];
  const drawing = new Drawing(subject.origin);
  drawing.box(min, max, gridColor);
  const pieces: Piece[] = [];
  for (let cell = 0; cell < cellRegion.length; ++cell) {
    if (at.every((index, d) => cellGridCell[3 * cell + d] === index)) pieces.push(pieceOf(subject, cell));
  }
  const moves = movesApart(pieces, min, max);
  pieces.forEach(({ cell }, k) => drawCell(drawing, subject, cell, moves[k], pieceColor(k)));
  const regions = new Set(pieces.map(({ cell }) => cellRegion[cell])).size;
  const name = `Grid cell (${at.join(', ')})`;
  const text =
    pieces.length > 0
      ? `${name} holds ${plural(pieces.length, 'cut-cell')} of ${plural(regions, 'region')}, pulled apart:` +
        ' each is a closed set of half-faces, joined at their edges (Section 4.4).'
      : `${name} is untouched: the surface does not reach it, so it stays whole.`;
  return drawing.finish(text, { kind: 'gridCell', gridCell: at }, subject, [min, max]);
}
