// The first two steps: tri-edges with their crossings, and hybrid edges.
import type { StepPicture, StepRequest } from '../../model/instead';
import type { Vector3 } from '../../model/vector';
import { plural } from '../../model/format';
import { axisColors, crossingColors, outlineColor, triEdgeColor } from './colors';
import { chosenTriangle } from './choose';
import { commonPlanes, facesWhere, forEachEdge } from './faces';
import { Drawing, pointOf, type Subject } from './picture';

/** Of meshes with more triangles, one triangle and its neighbours are shown: the points would cover each other. */
const mostTriangles = { triEdges: 800, hybridEdges: 20000 };

/** The triangles to show: all, or one and those that touch it. Vertices at one place are one vertex, welded or not. */
function chosenTriangles({ mesh, cutMesh }: Subject, request: StepRequest, most: number): { triangle?: number; shown: Set<number> } {
  const { positions, triangles } = mesh;
  const all = Array.from({ length: triangles.length / 3 }, (_, t) => t);
  if (request.triangle === undefined && all.length <= most) return { shown: new Set(all) };
  const triangle = chosenTriangle(cutMesh, request);
  const at = (corner: number) => pointOf(positions, triangles[corner]);
  const corners = [at(3 * triangle), at(3 * triangle + 1), at(3 * triangle + 2)];
  const touches = (t: number) =>
    [0, 1, 2].some((k) => corners.some((corner) => corner.every((x, d) => x === positions[3 * triangles[3 * t + k] + d])));
  return { triangle, shown: new Set(all.filter(touches)) };
}

function isOnTriEdge({ cutMesh }: Subject, vertex: number): boolean {
  const [a, b] = [cutMesh.vertexParents[2 * vertex], cutMesh.vertexParents[2 * vertex + 1]];
  return a >= 0 && b >= 0 && a !== b;
}

function isTriVertex({ cutMesh }: Subject, vertex: number): boolean {
  return cutMesh.vertexTriVertex[vertex] >= 0;
}

/** The tri-edge or tri-vertex that holds a vertex, as its tri-vertices; none for others. */
function triVerticesOf(subject: Subject, vertex: number): readonly number[] {
  if (!isOnTriEdge(subject, vertex) && !isTriVertex(subject, vertex)) return [];
  return [subject.cutMesh.vertexParents[2 * vertex], subject.cutMesh.vertexParents[2 * vertex + 1]];
}

/** Whether both ends lie on one tri-edge: then the edge is a piece of that. */
function isAlongTriEdge(subject: Subject, u: number, v: number): boolean {
  const ends = [...triVerticesOf(subject, u), ...triVerticesOf(subject, v)];
  return ends.length === 4 && new Set(ends).size <= 2;
}

function facesOfTriangles(subject: Subject, triangles: ReadonlySet<number>): number[] {
  return facesWhere(subject, (face) => triangles.has(subject.cutMesh.faceTriangle[face]));
}

/** Returns their number. Vertices at one place are one vertex, so an edge of an unwelded mesh counts once. */
function drawTriEdges(drawing: Drawing, { mesh }: Subject, triangles: Iterable<number>): number {
  const seen = new Set<string>();
  for (const t of triangles) {
    const corners = [0, 1, 2].map((k) => pointOf(mesh.positions, mesh.triangles[3 * t + k]));
    corners.forEach((a, k) => {
      const b = corners[(k + 1) % 3];
      const key = [a.join(), b.join()].sort().join(' ');
      if (seen.has(key)) return;
      seen.add(key);
      drawing.line(a, b, triEdgeColor);
    });
  }
  return seen.size;
}

function cornersOf({ mesh: { positions, triangles } }: Subject, triangle: number | undefined): Vector3[] | null {
  return triangle === undefined ? null : [0, 1, 2].map((k) => pointOf(positions, triangles[3 * triangle + k]));
}

function where(triangle: number | undefined): string {
  return triangle === undefined ? '' : ` of triangle ${triangle} and its neighbours`;
}

export function triEdges(subject: Subject, request: StepRequest): StepPicture {
  const { positions, vertexMask } = subject.cutMesh;
  const { triangle, shown } = chosenTriangles(subject, request, mostTriangles.triEdges);
  const drawing = new Drawing(subject.origin);
  const edges = drawTriEdges(drawing, subject, shown);
  const crossings = [0, 0, 0, 0];
  let triVerticesOnPlanes = 0;
  const vertices = new Set<number>();
  forEachEdge(subject, facesOfTriangles(subject, shown), (u, v) => vertices.add(u).add(v));
  for (const vertex of vertices) {
    const planes = (vertexMask[vertex] & 1) + ((vertexMask[vertex] >> 1) & 1) + (vertexMask[vertex] >> 2);
    if (planes === 0) continue;
    if (isOnTriEdge(subject, vertex)) ++crossings[planes];
    else if (isTriVertex(subject, vertex)) ++triVerticesOnPlanes;
    else continue;
    drawing.point(pointOf(positions, vertex), crossingColors[planes - 1]);
  }
  const several = crossings[2] + crossings[3];
  const text =
    `The axial planes cross ${plural(edges, 'tri-edge')}${where(triangle)} at ${plural(crossings[1] + several, 'point')}` +
    ` (orange${several ? `; ${several.toLocaleString('en')} of them where two planes meet, magenta, or three, red` : ''}).` +
    `${triVerticesOnPlanes ? ` ${plural(triVerticesOnPlanes, 'tri-vertex lies', 'tri-vertices lie')} exactly on a plane.` : ''}` +
    ' All of these become vertices of the cut-mesh (Section 4.1.1).';
  return drawing.finish(text, { kind: 'triEdges', triangle }, subject, cornersOf(subject, triangle));
}

export function hybridEdges(subject: Subject, request: StepRequest): StepPicture {
  const { triangle, shown } = chosenTriangles(subject, request, mostTriangles.hybridEdges);
  const drawing = new Drawing(subject.origin);
  if (triangle !== undefined) drawTriEdges(drawing, subject, shown);
  const perAxis = [0, 0, 0];
  forEachEdge(subject, facesOfTriangles(subject, shown), (u, v) => {
    const planes = commonPlanes(subject, u, v);
    if (planes === 0 || isAlongTriEdge(subject, u, v)) return;
    const axis = planes & 1 ? 0 : planes & 2 ? 1 : 2;
    ++perAxis[axis];
    const color = planes & (planes - 1) ? outlineColor : axisColors[axis];
    drawing.line(pointOf(subject.cutMesh.positions, u), pointOf(subject.cutMesh.positions, v), color);
  });
  const total = perAxis[0] + perAxis[1] + perAxis[2];
  if (total === 0 && triangle === undefined) drawTriEdges(drawing, subject, shown);
  const text =
    total > 0
      ? `Hybrid edges are where the triangles${where(triangle)} meet the axial planes normal to x (red), y (green) and z (blue).` +
        ` They are split where they cross each other, which makes ${plural(total, 'cut-edge')} (Section 4.1.2).`
      : `There are no hybrid edges${where(triangle)}: no axial plane passes through the inside of a triangle (Section 4.1.2).`;
  return drawing.finish(text, { kind: 'hybridEdges', triangle }, subject, cornersOf(subject, triangle));
}
