#include "cli/arguments.h"

namespace mandoline::cli {

const char* const kHelp =
    R"(mandoline cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.

  mandoline cut MESH [options]      cut, and print a report
  mandoline cut MESH --stream [options] -o FOLDER
                                    cut piece by piece, for cuts larger than memory
  mandoline slice MESH [options] -o FILE ...
                                    write outlines at heights, as .svg, .dxf or .obj
  mandoline boundary MESH [options] -o FILE ...
                                    write the closed surface of what is inside, also of an
                                    open mesh, as .obj, .stl, .ply or .off
  mandoline flow MESH --wind X,Y,Z [options] -o FILE ...
                                    write the potential flow of a wind about the mesh
  mandoline info MESH [-o FILE.obj] tell what kind of mesh it is, and where it has defects
  mandoline resolve MESH -o FILE ...
                                    write the mesh without self-intersections, as .obj,
                                    .stl, .ply or .off
  mandoline make SHAPE -o FILE ...  write a made mesh: box, sphere, torus or torus-knot,
                                    as .obj, .stl, .ply or .off
  mandoline --help, --version

MESH is an OBJ, STL, PLY or OFF file, in text or binary, and may be gzipped; - is
standard input. A value may also be given as in --cells=32.

The grid
  --cells N              cubic cells, N along the longest side of the mesh with its margin
                         and as many along the others as cover it (default: 32); with
                         --box, N cells along its longest side and as many along the
                         others as make the cells nearly cubic
  --cells NX,NY,NZ       as many cells along x, y and z
  --margin M             how far the grid reaches beyond the mesh, all around, in longest
                         sides of its bounding box (default: 0.05; of flow 0.5)
  --box X0,Y0,Z0,X1,Y1,Z1
                         the box that the grid fills exactly
  --origin X,Y,Z --spacing S|SX,SY,SZ
                         the grid's lowest corner and the size of its cells, with --cells
  --planes X0,X1,.../Y0,Y1,.../Z0,Z1,...
                         any ascending planes, or @FILE with the planes of x, y and z on
                         three lines

Options of cut, slice, boundary and flow
  --snap-tolerance T     move vertices that are within T cells of an axial plane onto it
                         (0 <= T < 0.5; default: 0)
  --intersections WHAT   what to do where triangles meet other than in shared vertices and
                         edges: resolve cuts as if their exact arrangement had been given
                         (default); refuse fails, names two of them and counts the pairs;
                         assume-none does not look: quicker, but the result may be wrong
  --threads T            threads to use; 0 for all cores (default: 0). The result is the
                         same for any number. Also of info and resolve
  --orient               first turn triangles so that they agree, and closed parts of the
                         mesh outward, or inward where they bound a cavity; the report
                         tells how many were turned. Also of resolve

Options of cut
  --validate             check the result: the paper's four checks and all invariants
  -o FILE ...            write the cut-mesh, by extension:
                           .json  everything
                           .mcm   the same in a tenth of the bytes, for readCutMesh()
                           .vtu   polyhedra for VTK and ParaView
                           .obj   the cut surface as polygons, one group per region
                           .stl   the cut surface in triangles
                           .ply   the same with the region and group of each triangle
                         A folder called polyMesh, as in case/constant/polyMesh, gets the
                         cells for OpenFOAM, with the patches xMin ... zMax and surface,
                         or one for each group of an OBJ file (g, else usemtl) or solid
                         of an STL file.
                         {region} in the name: one file, or folder, for each region
  --only WHAT            write only a part of it (not of .json and .mcm). Words with commas
                         between must all hold: cut (no untouched grid cells), inside (winding
                         number not 0, or by parity, or by an estimate where the mesh is open;
                         a note tells which), outside (the rest), region=K (of several, any),
                         all (of a polyMesh of merged cells also regions that no side of the
                         grid bounds: left out, since solvers stop in them; a note tells).
                         With regions left out, a surface is the whole boundary of each region
                         written, oriented out of it
  --inside-threshold T   estimate what is inside of open parts, which divides regions at
                         their holes: from T on (default: 0.5) of a generalized winding number
  --coarsen LEVELS[,LAYERS]
                         merge untouched grid cells into octree cells, up to 2^LEVELS of
                         them on a side, in .vtu files and polyMesh folders; .json files
                         get all cells as one mesh (CellComplex) instead of the cut-mesh.
                         There are at least LAYERS layers of cells of each size between
                         smaller and larger ones; of those with 2 grid cells on a side a quarter
                         as many, but 2 if there are (default: 1 of grid cells, and of others
                         a twelfth of the grid cells along the longest side; with 0 there are the
                         fewest cells, which solvers are worst on)
  --refine LEVELS[,DEGREES]
                         divide grid cells up to LEVELS times where normals of triangles in one
                         are more than DEGREES apart (default: 30; with 0 all that the mesh
                         touches), and cut them again there alone, in the same files. Cells
                         with a common side differ by one level at most
  --refine-box X0,Y0,Z0,X1,Y1,Z1,LEVELS
                         divide those that meet the box LEVELS times; may be given several
                         times, with --refine or without. The report is that of the grid
  --merge FRACTION       merge cells below this fraction of a grid cell's volume (0 to 0.5)
                         with neighbours, in what has octree cells; never across a triangle.
                         0.2 is right for solvers. The report tells how many cells there
                         are, and how many are still small, such as pockets
  --unite-walls DEGREES  unite the pieces of triangles between the same two cells to faces,
                         as long as their normals are that near to each other (0 to 90; 30
                         is right for solvers), in the same files; groups stay apart
  --faces                in .vtu files, the faces of all cells as polygons, with tag,
                         triangle, cells and group, instead of cells
  --simple-cells         in .vtu files and polyMesh folders, leave out faces that have the same
                         cell at both sides, where a sheet ends in it: VTK cuts and traces
                         only cells without them, and some of OpenFOAM's solvers stop at them
  --stream               cut bricks of 128 x 128 x 128 grid cells one after the other, and write
                         each as .vtu into the folder -o, and cut.pvtu, which joins them: the
                         cells of the whole cut, in the memory of one piece and the mesh. With
                         --only cut without untouched grid cells. Not with other parts of
                         --only, --validate, --coarsen, --refine, --merge, --unite-walls,
                         --faces, --inside-threshold and --snap-tolerance. The report has pieces and
                         counts of cells
  --format EXTENSION     what -o - writes to standard output; the text of the report then
                         goes to standard error

Options of slice
  --axis x|y|z, --normal X,Y,Z
                         what the planes are perpendicular to (default: z)
  --heights H1,H2,...    their distances from the origin, along the normal
  --layers N             instead of heights: the middle planes of N equal layers of the mesh
  --only inside|outside|region=K
                         which regions have outlines (default: inside, or all where nothing
                         is). Sheets are open lines. Heights at which nothing is cut are
                         told; if there are no others, no file is written
  -o FILE ...            .svg with the normal towards you, .dxf and .obj lines in space; in
                         the units of the mesh

Options of boundary
  --only inside|outside|region=K
                         which regions it bounds (default: inside)
  --inside-threshold T   as of cut. Where parts of the mesh are open, the surface is closed by
                         faces of the grid: finer cells follow their holes more closely
  -o FILE ...            triangles oriented outwards, cut by the grid; each edge has an even
                         number of them. Of closed meshes, resolve --rule writes them uncut

Options of flow
  --wind X,Y,Z           the wind's velocity: it blows on the sides of the grid, and nothing
                         passes the mesh, nor either side of a sheet
  --far-field            in unbounded space instead of a wind tunnel: through the sides passes
                         the wind and what the mesh adds to it at a distance. The mesh may
                         not reach the sides
  --coarsen LEVELS[,LAYERS], --faces, --simple-cells, --only WHAT, --inside-threshold T
                         as of cut; faces have normal_velocity, normal and area
  --refine LEVELS[,DEGREES], --refine-box X0,Y0,Z0,X1,Y1,Z1,LEVELS
                         as of cut
  --merge FRACTION       as of cut (default: 0.2; 0 merges nothing)
  --unite-walls DEGREES  as of cut
  --corrections N        how often at most the solution is corrected beside cut-cells (default:
                         8, of which three to six are needed; 0: it is of first order there)
  --streamlines N        how many lines (default: 100), from where the wind enters
  --steps N              N steps in time instead, which begin with the potential flow; their
                         length follows from the speed in the cells. Best with
                         --unite-walls 30
  --viscosity NU         kinematic, of the steps: the flow sticks to the mesh (default: 0,
                         and it slips)
  -o FILE ...            .vtu all cells with phi, velocity and pressure_coefficient, or after
                         --steps with velocity and pressure, of a fluid of density 1;
                         .obj streamlines, none of which passes a triangle

Options of info
  -o FILE.obj            the open, non-manifold and inconsistent edges as lines, in a group
                         for each kind

Options of resolve
  --rule positive|non-zero|odd
                         only the surface of the solid: of what has a winding number
                         above 0, other than 0, or odd. Overlapping parts become one. What is
                         closed but not consistently oriented goes by parity, what is open is
                         left out; a note tells so
  -o FILE ...            all triangles, divided where they meet; .obj keeps the groups of
                         OBJ and STL files, but not with --rule. Vertices are rounded; a
                         note on standard error tells whether that has brought
                         intersections back

Options of all but make
  --report FILE          write the report as JSON instead of text; - for standard output.
                         All begin with status, message, element, element2 (what failed),
                         path and mesh (counts, box, closed, oriented, orientation, groups
                         ...). Then
                           cut      grid, counts, largestSnap, intersections (pairs, by
                                    kind ...), parts, inside, regions, stages (ms),
                                    totalMs, exactFallbacks, peakMemoryBytes,
                                    merge: null, or cells before and after, and
                                    pockets; validation: null, or pass and checks
                           slice    layers: height, polygons, slits
                           boundary parts, inside, triangles
                           flow     wind, cutCells, cells, merge as of cut, faces, iterations,
                                    residuals, largestSpeed and throttled (components);
                                    with --steps: steps, time, timeStep, iterations,
                                    largestDivergence, largestSpeed, and forces: per group
                                    pressure, viscous, moment (of both, about the origin)
                           info     intersections, placeCount, defectCount, and the first
                                    10000 components, places and defects
                           resolve  intersections, remaining, triangles

Exit codes: 0 fine; 1 the mesh can't be cut, nothing is left to write, validation failed,
there is not enough memory, or the flow was not solved, which is written all the same; 2
wrong usage, such as an --only that selects nothing, or a file can't be read or written; 130
stopped by Ctrl-C (143 by SIGTERM), which leaves no unfinished files.
)";

}  // namespace mandoline::cli
