#include "cli/arguments.h"

namespace mandoline::cli {

const char* const kHelp =
    R"(mandoline cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.

  mandoline cut MESH [options]      cut, and print a report
  mandoline slice MESH [options] -o FILE ...
                                    write outlines at heights, as .svg, .dxf or .obj
  mandoline info MESH [--report F]  tell what kind of mesh it is
  mandoline make SHAPE -o FILE ...  write a made mesh: box, sphere, torus or torus-knot,
                                    as .obj, .stl, .ply or .off
  mandoline --help, --version

MESH is an OBJ, STL, PLY or OFF file, in text or binary, and may be gzipped; - is
standard input. A value may also be given as in --cells=32.

The grid
  --cells N              cubic cells of size 1.1 x longest side of the mesh / N, as many
                         along each axis as cover it with that margin (default: 32);
                         with --box, N cells along its longest side and as many along the
                         others as make the cells nearly cubic
  --cells NX,NY,NZ       as many cells along x, y and z in the box; without --box, in the
                         mesh's bounding box grown by 5 % of its longest side all around
  --box X0,Y0,Z0,X1,Y1,Z1
                         the box that the grid fills exactly
  --origin X,Y,Z --spacing S|SX,SY,SZ
                         the grid's lowest corner and the size of its cells, with --cells
  --planes X0,X1,.../Y0,Y1,.../Z0,Z1,...
                         any ascending planes, or @FILE with the planes of x, y and z on
                         three lines

Options of cut
  --snap-tolerance T     move vertices that are within T cells of an axial plane onto it
                         (0 <= T < 0.5; default: 0)
  --threads T            threads to use; 0 for all cores (default: 0). The result is the
                         same for any number
  --validate             check the result: the paper's four checks and all invariants
  -o FILE ...            write the cut-mesh, by extension:
                           .json  everything
                           .vtu   polyhedra for VTK and ParaView
                           .obj   the cut surface as polygons, one group per region
                           .stl   the cut surface in triangles
                           .ply   the same with the region of each triangle
                         {region} in the name: one file for each region
  --only WHAT            write only a part of it (not of .json), all that is named with
                         commas between: cut (no untouched grid cells), inside (winding
                         number not 0), outside (winding number 0), region=K. A surface is
                         then the whole boundary of each region, oriented out of it
  --format EXTENSION     what -o - writes to standard output; the text of the report then
                         goes to standard error

Options of slice, beside those of the grid, --snap-tolerance and --threads
  --axis x|y|z, --normal X,Y,Z
                         what the planes are perpendicular to (default: z)
  --heights H1,H2,...    their distances from the origin, along the normal
  --layers N             instead of heights: the middle planes of N equal layers of the mesh
  --only inside|outside|region=K
                         which regions have outlines (default: inside; of meshes without
                         winding numbers all). Sheets are open lines
  -o FILE ...            .svg seen against the normal, .dxf and .obj lines in space; all in
                         the units of the mesh

Options of cut and info
  --report FILE          write the report as JSON instead of text; - for standard output.
                         Its members: status, message, element, element2 (what failed) and
                         mesh (path, counts, box, closed, oriented ...); of a cut also
                         grid, counts, largestSnap, regions, timings (ms),
                         exactFallbacks, peakMemoryBytes and validation: null, or
                         pass and checks

Exit codes: 0 fine; 1 the mesh can't be cut, or validation failed; 2 wrong usage, or a
file can't be read or written; 130 stopped by Ctrl-C (143 by SIGTERM), which leaves no
unfinished files.
)";

}  // namespace mandoline::cli
