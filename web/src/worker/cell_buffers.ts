import type { CutMesh, FaceTriangles } from 'mandoline-wasm';
import type { Model } from '../model/types';
import { areAlike } from './face_normals';

type Buffers = Pick<Model, 'triangles' | 'edges'>;

/**
 * Triangles and edges of all cut-cells. The faces of a cell share their vertices, except where the surface has a crease. `normals` are
 * those of faceNormals().
 */
export function cellBuffers(cutMesh: CutMesh, faceTriangles: FaceTriangles, normals: Int32Array, origin: readonly number[]): Buffers {
  const counts = countBuffers(cutMesh, faceTriangles);
  const filling = new Filling(cutMesh, faceTriangles, normals, origin, counts);
  const { cellHalfFaceOffsets } = cutMesh;
  for (let owner = 0; owner + 1 < cellHalfFaceOffsets.length; owner++) {
    const [begin, end] = [cellHalfFaceOffsets[owner], cellHalfFaceOffsets[owner + 1]];
    filling.addFaces(owner, begin, end);
    filling.addEdges(begin, end);
  }
  return filling.buffers(3 * counts.surface);
}

interface Counts {
  /** Triangles of pieces of triangles and of grid-faces. */
  surface: number;
  grid: number;
  edges: number;
  vertices: number;
}

function countBuffers(cutMesh: CutMesh, { faceTriangleOffsets }: FaceTriangles): Counts {
  const { cellHalfFaces, faceLoopOffsets, loopOffsets, faceTriangle } = cutMesh;
  const counts = { surface: 0, grid: 0 };
  let corners = 0;
  let surfaceCorners = 0;
  for (let h = 0; h < cellHalfFaces.length; h++) {
    const face = cellHalfFaces[h] >> 1;
    const triangles = faceTriangleOffsets[face + 1] - faceTriangleOffsets[face];
    const own = loopOffsets[faceLoopOffsets[face + 1]] - loopOffsets[faceLoopOffsets[face]];
    corners += own;
    if (faceTriangle[face] >= 0) {
      counts.surface += triangles;
      surfaceCorners += own;
    } else counts.grid += triangles;
  }
  // Every edge of a cell is met twice, and every vertex is an end of two edges at least; at most, each corner at the surface is a crease.
  return { ...counts, edges: corners / 2, vertices: corners / 2 + surfaceCorners };
}

/** More entries than this are not kept for the next cut. */
const mostKept = 2 ** 20;
const kept: Record<string, Float32Array | Int32Array | Uint32Array> = {};

/** An array of at least this length, whatever is in it: a surface that moves needs the same ones for every picture. */
function room<T extends Float32Array | Int32Array | Uint32Array>(name: string, create: new (length: number) => T, length: number): T {
  if (length > mostKept) return new create(length);
  if (!kept[name] || kept[name].length < length) kept[name] = new create(length);
  return kept[name] as T;
}

/** The buffers while they are filled. The half-faces of one cell after the other are walked in long loops, since they are short. */
class Filling {
  private readonly position: Float32Array;
  private readonly normal: Int32Array;
  private readonly cell: Uint32Array;
  private readonly triangles: Uint32Array;
  /** Hybrid edges from the front, pieces of tri-edges from the back. */
  private readonly edges: Uint32Array;
  private readonly gridEdges: Uint32Array;
  /** A cut-vertex has an id in the current cell if its last id is not below the cell's first. */
  private readonly idOf: Int32Array;
  /** The next one of the ids that a cut-vertex has in one cell, in a circle. */
  private readonly twin: Uint32Array;
  private readonly ox: number;
  private readonly oy: number;
  private readonly oz: number;
  private vertexEnd = 0;
  private hybridEnd = 0;
  private triEdgeBegin: number;
  private gridEdgeEnd = 0;
  private surfaceEnd = 0;
  private gridEnd: number;

  constructor(
    private readonly cutMesh: CutMesh,
    private readonly faceTriangles: FaceTriangles,
    private readonly normals: Int32Array,
    [ox, oy, oz]: readonly number[],
    counts: Counts,
  ) {
    [this.ox, this.oy, this.oz] = [ox, oy, oz];
    this.position = room('position', Float32Array, 3 * counts.vertices);
    this.normal = room('normal', Int32Array, counts.vertices);
    this.cell = room('cell', Uint32Array, counts.vertices);
    this.twin = room('twin', Uint32Array, counts.vertices);
    this.gridEdges = room('gridEdges', Uint32Array, 2 * counts.edges);
    this.idOf = room('idOf', Int32Array, cutMesh.positions.length / 3).fill(-1);
    this.triangles = new Uint32Array(3 * (counts.surface + counts.grid));
    this.edges = new Uint32Array(2 * counts.edges);
    this.triEdgeBegin = 2 * counts.edges;
    this.gridEnd = 3 * counts.surface;
  }

  /** Triangles of a cell's faces, whose corners get ids: each face has those with its normals, if it is a piece of a triangle. */
  addFaces(owner: number, begin: number, end: number): void {
    const { idOf, triangles } = this;
    const { cellHalfFaces, faceTriangle } = this.cutMesh;
    const { faceTriangleOffsets, triangles: corners } = this.faceTriangles;
    const first = this.vertexEnd;
    for (let h = begin; h < end; h++) {
      const face = cellHalfFaces[h] >> 1;
      this.addVertices(owner, first, face);
      const from = (3 * faceTriangleOffsets[face]) | 0;
      const to = (3 * faceTriangleOffsets[face + 1]) | 0;
      const isSurface = faceTriangle[face] >= 0;
      let out = isSurface ? this.surfaceEnd : this.gridEnd;
      // Side 1 sees the face from behind.
      if (cellHalfFaces[h] & 1) for (let corner = to - 1; corner >= from; corner--) triangles[out++] = idOf[corners[corner]];
      else for (let corner = from; corner < to; corner++) triangles[out++] = idOf[corners[corner]];
      if (isSurface) this.surfaceEnd = out;
      else this.gridEnd = out;
    }
  }

  private addVertices(owner: number, first: number, face: number): void {
    const { idOf, normals, normal, cell, position, twin, ox, oy, oz } = this;
    const { faceLoopOffsets, loopOffsets, loopVertices, positions } = this.cutMesh;
    const last = loopOffsets[faceLoopOffsets[face + 1]] | 0;
    for (let at = loopOffsets[faceLoopOffsets[face]] | 0; at < last; at++) {
      const vertex = loopVertices[at] | 0;
      const wanted = normals[at];
      const id = idOf[vertex];
      if (id >= first) {
        if (wanted !== 0 && normal[id] !== wanted) idOf[vertex] = this.withNormal(owner, id, wanted);
        continue;
      }
      const added = this.vertexEnd++;
      position[3 * added] = positions[3 * vertex] - ox;
      position[3 * added + 1] = positions[3 * vertex + 1] - oy;
      position[3 * added + 2] = positions[3 * vertex + 2] - oz;
      cell[added] = owner;
      normal[added] = wanted;
      idOf[vertex] = twin[added] = added;
    }
  }

  /** The one of a vertex's ids in the cell that has this normal; a new one beyond a crease. */
  private withNormal(owner: number, known: number, wanted: number): number {
    const { normal, position, twin } = this;
    let id = known;
    do {
      if (normal[id] === 0) normal[id] = wanted;
      if (areAlike(normal[id], wanted)) return id;
      id = twin[id];
    } while (id !== known);
    id = this.vertexEnd++;
    position.copyWithin(3 * id, 3 * known, 3 * known + 3);
    this.cell[id] = owner;
    normal[id] = wanted;
    twin[id] = twin[known];
    twin[known] = id;
    return id;
  }

  /** The half-faces of a cell traverse an edge equally often in both directions, so that one direction is enough to find it. */
  addEdges(begin: number, end: number): void {
    const { cellHalfFaces, faceLoopOffsets, loopOffsets, loopVertices } = this.cutMesh;
    for (let h = begin; h < end; h++) {
      const face = cellHalfFaces[h] >> 1;
      const reversed = (cellHalfFaces[h] & 1) === 1;
      const lastLoop = faceLoopOffsets[face + 1] | 0;
      for (let loop = faceLoopOffsets[face] | 0; loop < lastLoop; loop++) {
        const last = loopOffsets[loop + 1] | 0;
        let from = loopVertices[last - 1] | 0;
        for (let at = loopOffsets[loop] | 0; at < last; at++) {
          const to = loopVertices[at] | 0;
          if (from < to !== reversed) this.addEdge(from, to);
          from = to;
        }
      }
    }
  }

  private addEdge(from: number, to: number): void {
    const { edges, gridEdges, idOf } = this;
    const planes = this.planesOf(from, to);
    if (planes === 0) {
      edges[--this.triEdgeBegin] = idOf[to];
      edges[--this.triEdgeBegin] = idOf[from];
    } else if (planes === 1) {
      edges[this.hybridEnd++] = idOf[from];
      edges[this.hybridEnd++] = idOf[to];
    } else {
      gridEdges[this.gridEdgeEnd++] = idOf[from];
      gridEdges[this.gridEdgeEnd++] = idOf[to];
    }
  }

  /** In how many axial planes an edge lies. */
  private planesOf(from: number, to: number): number {
    const { vertexCell, vertexMask } = this.cutMesh;
    const both = vertexMask[from] & vertexMask[to];
    if (both === 0) return 0;
    const a = 3 * from;
    const b = 3 * to;
    const x = both & 1 && vertexCell[a] === vertexCell[b] ? 1 : 0;
    const y = both & 2 && vertexCell[a + 1] === vertexCell[b + 1] ? 1 : 0;
    const z = both & 4 && vertexCell[a + 2] === vertexCell[b + 2] ? 1 : 0;
    return x + y + z;
  }

  buffers(surfaceEnd: number): Buffers {
    const { position, normal, cell, triangles, edges, vertexEnd, hybridEnd } = this;
    edges.set(this.gridEdges.subarray(0, this.gridEdgeEnd), hybridEnd);
    return {
      triangles: {
        position: position.slice(0, 3 * vertexEnd),
        normal: new Int8Array(normal.buffer.slice(0, 4 * vertexEnd)),
        cell: cell.slice(0, vertexEnd),
        index: triangles,
        surfaceEnd,
      },
      edges: { index: edges, hybridEnd, gridEnd: this.triEdgeBegin },
    };
  }
}
