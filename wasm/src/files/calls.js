// The table of the calls of the module that is loaded when the first of them is made, as in ../calls.js.
import { flag, optional, readFlags, readFunction, readMembers, readMesh, readNumbers, readVector } from '../arguments.js';
import { readFile, readName } from '../files.js';
import { format, readDefects, readGroups, readLayers, readLines } from './arguments.js';

const progress = readFunction;
const regions = optional(readFlags);
const groups = optional(readGroups);

const readStack = (stack, name) => readMembers(stack, { normal: readVector, offsets: readNumbers, layers: readLayers }, name);

export const fileCalls = {
  /**
   * The paper's four checks (5.6) and the invariants of a cut-mesh, worked out from its arrays alone. `mesh` is the input.
   *
   * validate(mesh: Mesh, cutMesh: CutMeshArrays, options?: RunOptions): Promise<Validation>
   */
  validate: {
    takes: { mesh: readMesh, cutMesh: { kind: 'cutMesh', isChecked: false } },
    options: { progress },
  },
  /**
   * The cut-mesh as a file. "json": every array; "mcm": the same in a tenth of the bytes, for readCutMesh(); "vtu": polyhedra for VTK and
   * ParaView; "obj", "stl" and "ply": the cut surface, by region but for "stl". `mesh` is the input of the cut.
   *
   * write(mesh: Mesh, cutMesh: CutMeshArrays, format: 'json' | 'mcm' | 'vtu' | 'obj' | 'stl' | 'ply', options?: WriteOptions): Promise<Uint8Array<ArrayBuffer>>
   */
  write: {
    takes: { mesh: readMesh, cutMesh: { kind: 'cutMesh' }, format: format('json', 'mcm', 'vtu', 'obj', 'stl', 'ply') },
    options: { untouched: flag(true), simpleCells: flag(false), regions, groups, progress },
  },
  /**
   * A mesh as a file: that of a part, of resolve(), of boundary(). STL and PLY are binary.
   *
   * writeMesh(mesh: Mesh, format: 'obj' | 'stl' | 'ply' | 'off', options?: WriteMeshOptions): Promise<Uint8Array<ArrayBuffer>>
   */
  writeMesh: { takes: { mesh: readMesh, format: format('obj', 'stl', 'ply', 'off') }, options: { groups, progress } },
  /**
   * What outlines() gave, with the normal and the offsets that it was given, as a file in world units: "svg" with the normal towards the
   * viewer; "dxf", polylines in space, one layer per region; "obj", lines in space.
   *
   * writeOutlines(stack: OutlineStack, format: 'svg' | 'dxf' | 'obj', options?: WriteOutlinesOptions): Promise<Uint8Array<ArrayBuffer>>
   */
  writeOutlines: { takes: { stack: readStack, format: format('svg', 'dxf', 'obj') }, options: { regions, progress } },
  /**
   * The defects that inspect() found in the mesh as "obj": lines in world units, in groups named for their kinds. Code "badArgument" for
   * those of another mesh.
   *
   * writeDefects(mesh: Mesh, info: MeshInfo, options?: RunOptions): Promise<Uint8Array<ArrayBuffer>>
   */
  writeDefects: { takes: { mesh: readMesh, info: readDefects }, options: { progress } },
  /**
   * Polylines such as streamlines() gives as "obj": 3 coordinates per point, and per line where its points begin, with the end of the last.
   * Lines of fewer than two points are left out.
   *
   * writeLines(lines: Polylines, options?: RunOptions): Promise<Uint8Array<ArrayBuffer>>
   */
  writeLines: { takes: { lines: readLines }, options: { progress } },
  /**
   * The groups of the triangles that readMesh() reads from a file. Of OBJ: what `g` lines name, of several names on a line the first;
   * triangles before them are in the group "default"; where no triangle comes after a `g` line, what `usemtl` lines name. Of STL in text:
   * its solids; one of several that has no name is called solid0, by its place in the file.
   *
   * readGroups(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions): Promise<TriangleGroups>
   */
  readGroups: { takes: { source: readFile }, options: { name: readName }, isFile: true },
  /**
   * The cut-mesh in a file that write() made as "mcm", to the bit. Code "badFile" if it can't be read.
   *
   * readCutMesh(source: Blob | ArrayBuffer | ArrayBufferView, options?: ReadMeshOptions): Promise<CutMeshArrays>
   */
  readCutMesh: { takes: { source: readFile }, options: { name: readName }, isFile: true, keeps: 'cutMesh' },
};
