// Written by wasm/results.mjs from the headers in src/include/mandoline: change those.
import type { Fingerprint, Grid, Stage } from './index.js';

/** How long a stage took. */
export interface StageTime {
  stage: Stage;
  /** Milliseconds. */
  ms: number;
}

/**
 * The parts of a mesh that is not closed and consistently oriented as a whole, after resolving; all 0 of one that is. Triangles are one
 * part where they need each other to close an edge: two boxes that touch along an edge are two parts, though they are one component to
 * inspect().
 */
export interface PartCounts {
  /** Closed and consistently oriented, so that they have winding numbers. */
  winding: number;
  /** Each edge has an even number of their triangles, but they are not consistently oriented. */
  parity: number;
  /** The others. */
  open: number;
  /** Edges with an odd number of triangles of an open part. */
  openEdges: number;
  /** Connected sets of those. */
  holes: number;
}

/** How a cut went. */
export interface CutStats {
  /** In order. */
  stages: StageTime[];
  totalMs: number;
  /** Signs that needed exact arithmetic. */
  exactFallbacks: number;
  /** Tri-vertices that share their position with a lower one. */
  weldedVertices: number;
  /** Dropped. */
  zeroAreaTriangles: number;
  /** Dropped. */
  outsideTriangles: number;
  /** Have the same three vertices as a lower one. */
  duplicateTriangles: number;
  /** Pairs of triangles that meet; none with "assumeNone". */
  intersections: PairCounts;
  /** Connected curves along which others meet the insides of triangles. */
  intersectionCurves: number;
  /** Of the cut-mesh. */
  madeVertices: number;
  /** Moved onto a plane by snapTolerance. */
  snappedVertices: number;
  /** Farthest such move, in cells. */
  largestSnap: number;
  /** Below 2^-200 of the largest, taken as 0. */
  flushedCoordinates: number;
  /** Of the input. */
  parts: PartCounts;
}

/**
 * The cut-mesh. The JSON dump has the same arrays under the same names, and the dense form of the runs, gridCellRegion, as one more; of an
 * array of regions that is not there, as regionWinding without winding numbers, it has a null per region.
 */
export interface CutMeshArrays {
  grid: Grid;

  // Cut-vertices (paper, 3.2), in this order: tri-vertices; vertices that triangles make by meeting; crossings of axial planes with
  // tri-edges and with the lines along which triangles meet; crossings of grid lines with triangles, and grid vertices, by grid cell.
  /** 3 per vertex, world units. Output only: no decision reads them. */
  positions: Float64Array<ArrayBuffer>;
  /** 3 per vertex: the paper's c, exact. 0..n-1, or n on the last plane. */
  vertexCell: Int32Array<ArrayBuffer>;
  /** Per vertex: the paper's b. Bit d is set when it lies exactly on plane vertexCell[d] of axis d. */
  vertexMask: Uint8Array<ArrayBuffer>;
  /** Per vertex: the tri-vertex (lowest id at its position), or -1. */
  vertexTriVertex: Int32Array<ArrayBuffer>;
  /** 2 per vertex: tri-vertex (v, v); on a tri-edge its ends (a, b); in a triangle (t, -1); grid (-1, -1). */
  vertexParents: Int32Array<ArrayBuffer>;

  // Made vertices: those that only exist because triangles meet other than in shared vertices and edges. Their vertexParents are (-1, -1).
  /** Ascending vertex ids. */
  madeVertices: Uint32Array<ArrayBuffer>;
  /** Per made vertex: MadeVertex as a number (0: edgeTriangle, 1: edgeEdge, 2: triangles, 3: trianglesPlane). */
  madeVertexKinds: Uint8Array<ArrayBuffer>;
  /** 4 per made vertex, as its kind says; the rest is -1. */
  madeVertexParents: Int32Array<ArrayBuffer>;

  // Cut-faces: pieces of triangles, by grid cell and in each by triangle; then pieces of grid-faces, by grid cell. The first loop of a face
  // is its outer one, counter-clockwise about the face's normal; the others are holes, clockwise.
  /** Into loopVertices, per loop. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Vertex ids. */
  loopVertices: Uint32Array<ArrayBuffer>;
  /** Into loops: face f has loops faceLoopOffsets[f] .. faceLoopOffsets[f + 1] - 1. */
  faceLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per face: its lowest triangle, whose normal it has; or -1 for a piece of a grid-face. */
  faceTriangle: Int32Array<ArrayBuffer>;
  /** Into faceParents, per face. */
  faceParentOffsets: Uint32Array<ArrayBuffer>;
  /** Per face: all triangles that contain it, ascending: several where they lie on each other. */
  faceParents: Uint32Array<ArrayBuffer>;
  /**
   * Per parent: 1 if its normal is the face's, -1 if the opposite; their sum is the step of the winding number from the front of the face
   * to behind it.
   */
  faceParentSigns: Int8Array<ArrayBuffer>;
  /** Per face: 0..2 if it lies in an axial plane, else -1. A grid-face's normal is +axis. */
  faceAxis: Int8Array<ArrayBuffer>;
  /** Per face: index of that plane, else 0. */
  facePlane: Int32Array<ArrayBuffer>;

  // Cut-cells, in ascending order of grid cells, x fastest.
  /** Into cellHalfFaces, per cut-cell. */
  cellHalfFaceOffsets: Uint32Array<ArrayBuffer>;
  /** Half-faces: those of the outer shell, of cavities and of floating sheets. */
  cellHalfFaces: Uint32Array<ArrayBuffer>;
  /** 3 per cut-cell: the grid cell it lies in. */
  cellGridCell: Int32Array<ArrayBuffer>;
  /** Per cut-cell: region. */
  cellRegion: Uint32Array<ArrayBuffer>;

  // Untouched grid cells, as runs along x. Row r = k * ny + j (ny: number of grid cells along y) has runs rowRunOffsets[r] ..
  // rowRunOffsets[r + 1] - 1.
  /** Into the runs, per row. */
  rowRunOffsets: Uint32Array<ArrayBuffer>;
  /** Per run: first grid cell along x. */
  runBegin: Int32Array<ArrayBuffer>;
  /** Per run: one past the last. */
  runEnd: Int32Array<ArrayBuffer>;
  /** Per run: region. */
  runRegion: Uint32Array<ArrayBuffer>;

  // Regions: connected components of cut-cells and untouched grid cells, joined through faces that are not pieces of triangles.
  regionCount: number;
  /**
   * Per region: 1 inside an outward oriented closed surface, 0 outside. Null unless the input is closed and consistently oriented, so that
   * it has winding numbers.
   */
  regionWinding: Int32Array<ArrayBuffer> | null;

  // What is known where the input has no winding numbers as a whole: see insideRegions(), which takes the best of it. The parts of
  // the input either have winding numbers, or parity alone (each edge has an even number of their triangles), or are open.
  /** Per region: the sum over the parts that have winding numbers; null if none has. */
  regionPartWinding: Int32Array<ArrayBuffer> | null;
  /** Per region: how many of the parts that have winding numbers or parity a path from outside crosses, modulo 2; null if none has. */
  regionParity: Uint8Array<ArrayBuffer> | null;
  /**
   * Per region: an estimate of its winding number: regionPartWinding, and the generalized winding number of the open parts at a point of
   * it; null unless made by estimateInside(), which divides regions at grid-faces, too.
   */
  regionInsideness: Float64Array<ArrayBuffer> | null;
  /** Ascending ids of triangles in parts that have parity alone. */
  parityTriangles: Uint32Array<ArrayBuffer>;
  /** Ascending ids of triangles in open parts. */
  openTriangles: Uint32Array<ArrayBuffer>;

  /** Of the input. */
  triangleCount: number;
  /** Ascending ids of triangles without a face: no area, or none inside the grid. */
  droppedTriangles: Uint32Array<ArrayBuffer>;

  /** That of the cut: functions that are given the input move its tri-vertices as the cut did. */
  snapTolerance: number;
  /** The fingerprint of the input. */
  madeFrom?: Fingerprint;
  /** That of the cut-mesh. */
  fingerprint?: Fingerprint;
}

/**
 * Every cut-cell has vertices of its own, so that it can be coloured, moved or hidden by its id. Within a cell, faces share them, except
 * where the surface has a crease: there, each side has its own. So a face between two cut-cells is drawn for both, and an edge for each of
 * its cells.
 */
export interface CellDrawing {
  /** 3 per vertex, less the origin. */
  positions: Float32Array<ArrayBuffer>;
  /**
   * 4 per vertex: where pieces of triangles have it, 127 times the surface's unit normal, made smooth and on the side of the fronts of
   * triangles, whichever side the cell is on; and 1. Else 0.
   */
  normals: Int8Array<ArrayBuffer>;
  /** Per vertex: the cut-cell. */
  vertexCell: Uint32Array<ArrayBuffer>;

  /** 3 vertices per triangle, counter-clockwise seen from outside of the cell: first pieces of triangles, then pieces of grid-faces. */
  triangles: Uint32Array<ArrayBuffer>;
  /** So many are pieces of triangles. */
  surfaceTriangles: number;
  /** 2 vertices per edge: first hybrid edges, then grid-edges, then pieces of tri-edges that lie in no axial plane. */
  edges: Uint32Array<ArrayBuffer>;
  /** Those in one axial plane. */
  hybridEdges: number;
  /** Those in two. */
  gridEdges: number;

  // For sorting, colours and exploding, not for computing: see measure().
  /** Per cut-cell, from its triangles. */
  cellVolume: Float64Array<ArrayBuffer>;
  /** 3 per cut-cell, less the origin; of the thinnest cells, the mean of their faces' corners. */
  cellCentroid: Float32Array<ArrayBuffer>;
  /** The fingerprint of the cut-mesh. */
  madeFrom?: Fingerprint;
}

/** What insideRegions() says. */
export interface InsideRegions {
  /** Per region. */
  isInside: Uint8Array<ArrayBuffer>;
  /** The least certain that any part of the input needs. */
  by: InsideBy;
  /** Whether all parts count: without estimates, open ones are left out. */
  isComplete: boolean;
}

/**
 * What a mesh has. Vertices at one position count as one, except in the number of vertices. Edges are those of triangles with three
 * different vertices.
 */
export interface MeshInfo {
  /** As they were given. */
  vertices: number;
  /** As they were given. */
  triangles: number;
  /** Bounding box of the finite coordinates in use; all zero if there are none. */
  min: [number, number, number];
  /** Bounding box of the finite coordinates in use; all zero if there are none. */
  max: [number, number, number];
  /** Every edge has an even number of triangles. */
  closed: boolean;
  /** Every edge is traversed equally often both ways, so that there are winding numbers. */
  oriented: boolean;
  /** With one triangle. */
  openEdges: number;
  /** With more than two. */
  nonManifoldEdges: number;
  /** With two that run the same way along it. */
  inconsistentEdges: number;
  /** Triangles that hang together through edges. */
  components: number;
  /** Exactly. */
  zeroAreaTriangles: number;
  /** Same three vertices as another one before them. */
  duplicateTriangles: number;
  /** Share their position with another one. */
  weldedVertices: number;
  unreferencedVertices: number;
  nonFiniteVertices: number;

  // The components: triangles that hang together through edges. In the order of their first triangles.
  /** Per triangle; -1 without three different vertices. */
  triangleComponent: Int32Array<ArrayBuffer>;
  /** Per component: 1 if it is closed as above, else 0. */
  componentClosed: Uint8Array<ArrayBuffer>;
  /** The same of oriented. */
  componentOriented: Uint8Array<ArrayBuffer>;

  // The defects: edges that are open, non-manifold or inconsistent, ascending by their vertices.
  /** 2 per defect: the edge's ends, the lower one first; the lowest ids at their positions. */
  defectVertices: Uint32Array<ArrayBuffer>;
  /** Per defect: EdgeDefect as a number (0: open, 1: nonManifold, 2: inconsistent). */
  defectKind: Uint8Array<ArrayBuffer>;
  /** Per defect, into defectTriangles. */
  defectTriangleOffsets: Uint32Array<ArrayBuffer>;
  /** Those at the edge, ascending. */
  defectTriangles: Uint32Array<ArrayBuffer>;
  /** Per defect. */
  defectPlace: Uint32Array<ArrayBuffer>;

  // The places: defects of one component that hang together through vertices, such as the edges around a hole. In the order of their first
  // defects.
  /** Per place. */
  placeComponent: Uint32Array<ArrayBuffer>;
  /** 6 per place: the lowest corner of the box around its edges, then the highest. */
  placeBox: Float64Array<ArrayBuffer>;
}

/** How many pairs of triangles meet, by how they do. */
export interface PairCounts {
  crossing: number;
  touching: number;
  overlapping: number;
  folded: number;
  identical: number;
}

/**
 * All pairs of triangles that meet, exactly. Triangles without area are left out; the vertices that they put on the edges of their
 * neighbours count as shared.
 */
export interface MeshIntersections {
  /** Of all pairs. */
  counts: PairCounts;

  // The pairs, ascending: as many as were asked for.
  /** 2 per pair: the lower triangle first. */
  pairTriangles: Uint32Array<ArrayBuffer>;
  /** Per pair: IntersectionKind as a number (0: crossing, 1: touching, 2: overlapping, 3: folded, 4: identical). */
  pairKinds: Uint8Array<ArrayBuffer>;
  /** Into positions (in points, not entries), per pair. */
  pairPointOffsets: Uint32Array<ArrayBuffer>;
  /**
   * 3 per point, world units, rounded. What the two have in common: a point, the ends of a segment, or the corners of a convex polygon,
   * counter-clockwise about the normal of the first.
   */
  positions: Float64Array<ArrayBuffer>;
}

/** Where points lie. A point on a face or on a plane of the grid belongs to one of the cells beside it, always the same one. */
export interface Locations {
  /** Per point: the cut-cell that holds it, or -1 in an untouched grid cell, or outside the grid. */
  cell: Int32Array<ArrayBuffer>;
  /** 3 per point: the grid cell, or -1, -1, -1 outside the grid. */
  gridCell: Int32Array<ArrayBuffer>;
  /** Per point: the region, or -1 outside the grid. */
  region: Int32Array<ArrayBuffer>;
}

/**
 * All in world units. Computed from what each vertex comes from (vertexParents), in coordinates local to each cell, so that the relative
 * error is small for a tiny cell, too. Lengths should be from 1e-70 to 1e70: of others, products of up to four underflow, or overflow.
 */
export interface MeasureArrays {
  /** Per face. */
  faceArea: Float64Array<ArrayBuffer>;
  /** 3 per face, unit. */
  faceNormal: Float64Array<ArrayBuffer>;
  /** 3 per face. */
  faceCentroid: Float64Array<ArrayBuffer>;
  /** Per cut-cell. */
  cellVolume: Float64Array<ArrayBuffer>;
  /** 3 per cut-cell. */
  cellCentroid: Float64Array<ArrayBuffer>;
  /** The fingerprint of the cut-mesh. */
  madeFrom?: Fingerprint;
}

/** Unique undirected cut-edges (of all loops), lower vertex id first, ascending, with their lengths. */
export interface CutEdges {
  /** 2 per edge. */
  edgeVertices: Uint32Array<ArrayBuffer>;
  /** Per edge. */
  edgeLength: Float64Array<ArrayBuffer>;
}

/**
 * What lies on the two sides of each face (a cut-cell, an untouched grid cell, or nothing where the grid ends), and beside each cut-cell.
 */
export interface Adjacency {
  /** 2 per face: the cut-cell of side 0 and of side 1, or -1. */
  faceCells: Int32Array<ArrayBuffer>;
  /** 2 per face, the same: the untouched grid cell i + nx (j + ny k); else -1. */
  faceGridCells: Float64Array<ArrayBuffer>;
  /** Into cellCells, per cut-cell. */
  cellCellOffsets: Uint32Array<ArrayBuffer>;
  /** Neighbouring cut-cells of each cut-cell across any face, ascending, without repeats. */
  cellCells: Uint32Array<ArrayBuffer>;
}

/**
 * A triangle mesh. The normal of triangle (a, b, c) is (b - a) x (c - a). It may be open, non-manifold, inconsistently oriented, unwelded,
 * and its triangles may meet anywhere.
 */
export interface MeshArrays {
  /** 3 per tri-vertex: x, y, z. */
  positions: Float64Array<ArrayBuffer>;
  /** 3 per triangle: tri-vertex ids, from 0. */
  triangles: Uint32Array<ArrayBuffer>;
}

/**
 * What files call groups, materials or solids: names for the triangles of a mesh. Cut-faces name their triangles, so that their groups
 * follow.
 */
export interface TriangleGroups {
  /** Per group, in the order of first triangles: each differs, and has a triangle. */
  names: string[];
  /** Per triangle: its group; empty if there are no groups. */
  triangleGroup: Uint32Array<ArrayBuffer>;
}

export interface OrientedMesh {
  /** Vertices and triangles in the order of the input; (a, b, c) turned is (a, c, b). */
  mesh: MeshArrays;
  /** Ascending. */
  turnedTriangles: Uint32Array<ArrayBuffer>;
  /** Per triangle; -1 without three different vertices. In the order of their first triangles. */
  trianglePatch: Int32Array<ArrayBuffer>;
  /** Per patch: Facing as a number (0: outward, 1: inward, 2: unknown, 3: nonOrientable). */
  patchFacing: Uint8Array<ArrayBuffer>;
}

/** The arrangement of a mesh's triangles: two triangles meet in shared vertices and edges alone, up to the rounding of vertices. */
export interface ResolvedMeshArrays extends MeshArrays {
  /** Per vertex: the tri-vertex of the input (lowest id at its position), or -1 for a made one. */
  vertexTriVertex: Int32Array<ArrayBuffer>;
  // The triangles of the input that contain each triangle: several where they lie on each other.
  /** Per triangle, into parents. */
  parentOffsets: Uint32Array<ArrayBuffer>;
  /** Ascending; the triangle's normal is that of the first. */
  parents: Uint32Array<ArrayBuffer>;
  /** Per parent: 1 if its normal is the triangle's, -1 if it is the opposite. */
  parentSigns: Int8Array<ArrayBuffer>;
  /** Per triangle: the winding number on the side of its normal. Null unless the input has winding numbers: see CutMesh. */
  frontWinding: Int32Array<ArrayBuffer> | null;
  /** The same behind it. Null unless the input has winding numbers: see CutMesh. */
  backWinding: Int32Array<ArrayBuffer> | null;
  // The same of CutMesh::regionPartWinding and regionParity, for inputs that have no winding numbers as a whole.
  /** Per triangle, on the side of its normal; null if no part has winding numbers. */
  frontPartWinding: Int32Array<ArrayBuffer> | null;
  /** Per triangle, behind it; null if no part has winding numbers. */
  backPartWinding: Int32Array<ArrayBuffer> | null;
  /** Per triangle, on the side of its normal; null if no part has parity. */
  frontParity: Uint8Array<ArrayBuffer> | null;
  /** Per triangle, behind it; null if no part has parity. */
  backParity: Uint8Array<ArrayBuffer> | null;
}

/**
 * The polygons in which a plane cuts the cells: those of the cut-cells in ascending order, then those of the untouched grid cells. A cell
 * may have several. A slit (the cut of a sheet that ends within the cell) is a part of a loop that runs there and back, or a loop of its
 * own; triangles ignore slits. Points are shared by the polygons of neighbouring cut-cells; each polygon of an untouched grid cell has its
 * own. Where triangles cross that "assumeNone" did not look for, so may a polygon's loops.
 */
export interface Slice {
  /** 3 per point, on the plane, world units. */
  positions: Float64Array<ArrayBuffer>;
  /** Into loopPoints. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Points of the loops. */
  loopPoints: Uint32Array<ArrayBuffer>;
  /** Into loops, per polygon: an outer one, counter-clockwise about the normal, then holes. */
  polygonLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per polygon: the cut-cell that it is a cut of, or -1 for an untouched grid cell. */
  polygonCell: Int32Array<ArrayBuffer>;
  /** 3 per polygon: the grid cell. */
  polygonGridCell: Int32Array<ArrayBuffer>;
  /** Per polygon: region. */
  polygonRegion: Uint32Array<ArrayBuffer>;
  /** Into triangles (in triangles, not entries), per polygon. */
  polygonTriangleOffsets: Uint32Array<ArrayBuffer>;
  /** 3 points per triangle, counter-clockwise about the normal. */
  triangles: Uint32Array<ArrayBuffer>;
}

/**
 * The outlines of regions in a plane: each region's polygons of Slice as one, without the seams between cells and with untouched grid
 * cells. What is left is where the surface is cut, and where the grid's box ends. A point lies where an edge of the input is cut, where the
 * surface meets the box, or on an edge of the box; none where only a plane of the grid was crossed. Points are shared by the outlines of
 * neighbouring regions.
 *
 * Where the surface has one region on both sides (an open sheet, or a mesh with a hole in it) it is no outline but a slit: a polyline, from
 * point to point with the triangles' normals to its right; the first point again at the end of one that is closed. Slits end where the
 * surface ends, meets others or turns its normals around.
 */
export interface Outlines {
  /** 3 per point, on the plane, world units. */
  positions: Float64Array<ArrayBuffer>;
  /** Into loopPoints. */
  loopOffsets: Uint32Array<ArrayBuffer>;
  /** Points of the loops. */
  loopPoints: Uint32Array<ArrayBuffer>;
  /** Into loops, per polygon: an outer one, counter-clockwise about the normal, then holes. */
  polygonLoopOffsets: Uint32Array<ArrayBuffer>;
  /** Per polygon: region, ascending. */
  polygonRegion: Uint32Array<ArrayBuffer>;
  /** Into slitPoints. */
  slitOffsets: Uint32Array<ArrayBuffer>;
  /** Points of the slits. */
  slitPoints: Uint32Array<ArrayBuffer>;
  /** Per slit: region around it, ascending. */
  slitRegion: Uint32Array<ArrayBuffer>;
}

/** How far a call has come: `done` of `total` items of the stage, and the stage's place among all. */
export interface Progress {
  stage: Stage | (string & {});
  stageIndex: number;
  stageCount: number;
  done: number;
  total: number;
}

/**
 * Triangles of every face. No vertices are added and a face has one triangulation, used by the cells on both sides, so neighbours match.
 */
export interface FaceTriangles {
  /** Into triangles (in triangles, not entries), per face. */
  faceTriangleOffsets: Uint32Array<ArrayBuffer>;
  /** 3 vertex ids per triangle, counter-clockwise about the face's normal. */
  triangles: Uint32Array<ArrayBuffer>;
  /** The fingerprint of the cut-mesh. */
  madeFrom?: Fingerprint;
}

/** One thing that was looked at. */
export interface Check {
  /** E.g. "surfaceArea". */
  name: string;
  /** True also if skipped. */
  pass: boolean;
  /** Whether it does not apply to this input, e.g. winding numbers of an open mesh. */
  skipped: boolean;
  /**
   * What was found: the number of violations; or where tolerance is above 0 the largest deviation, in roundings (half units in the last
   * place of the largest coordinate). NaN where it can't be computed.
   */
  worst: number;
  /** The largest `worst` that passes. */
  tolerance: number;
  /** What the worst was found at: "cell", "face", "triangle", ...; empty if nothing. */
  elementKind: string;
  /** Its id, or -1. */
  element: number;
  /** For people, in plain sentences: what is wrong, or why it was skipped, or what was left out; may be empty. */
  message: string;
}

/** All of them. */
export interface Validation {
  /** Whether all do. */
  pass: boolean;
  checks: Check[];
}

/** What meets at a made vertex, and so what its four parents are. */
export type MadeVertex =
  /** A tri-edge, by its two tri-vertices, and a triangle. */
  | 'edgeTriangle'
  /** Two tri-edges, by their tri-vertices. */
  | 'edgeEdge'
  /** Three triangles. */
  | 'triangles'
  /** Two triangles, and an axial plane or several: see vertexMask. */
  | 'trianglesPlane';

/** What tells inside from outside. */
export type InsideBy =
  /** Winding numbers, exactly. */
  | 'winding'
  /** The number of crossings modulo 2, exactly: for parts that are not consistently oriented. */
  | 'parity'
  /** Generalized winding numbers: for open parts. */
  | 'estimate';

/** What is wrong with an edge. */
export type EdgeDefect =
  /** It has one triangle. */
  | 'open'
  /** It has more than two. */
  | 'nonManifold'
  /** It has two that run the same way along it. */
  | 'inconsistent';

/** How two triangles meet. */
export type IntersectionKind =
  /** Along a segment that runs through both. */
  | 'crossing'
  /** In a point, or along a segment on the outline of one. */
  | 'touching'
  /** They lie in one plane and have an area in common. */
  | 'overlapping'
  /** Overlapping, of triangles that share an edge. */
  | 'folded'
  /** They have the same three vertices; CutStats.duplicateTriangles counts such triangles rather than pairs. */
  | 'identical';

/**
 * Where the normals of a patch point to, once it is oriented. A patch is triangles that hang together through edges with two triangles;
 * vertices at one position count as one.
 */
export type Facing =
  /** Out of what the patch encloses. */
  | 'outward'
  /** Into it: a cavity, since the patch lies inside an odd number of other closed ones. */
  | 'inward'
  /** Open, or it encloses nothing: its triangles agree, and at most half of them were turned. */
  | 'unknown'
  /** As in a Moebius strip no orientation lets its triangles agree: none was turned. */
  | 'nonOrientable';
