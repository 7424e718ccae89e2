// What the user asks for on the command line.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mandoline/io.h"
#include "mandoline/refine.h"
#include "mandoline/resolve.h"

namespace mandoline::cli {

struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Command { help, version, cut, slice, boundary, flow, info, make, resolve };

/// The grid as it was asked for; which fields are set tells its kind.
struct GridArguments {
  using Vector = std::array<double, 3>;

  std::optional<std::array<int64_t, 3>> cells;
  bool oneNumber = false;        ///< --cells N rather than --cells NX,NY,NZ
  std::optional<double> margin;  ///< in longest sides of the mesh
  std::optional<std::array<Vector, 2>> box;
  std::optional<Vector> origin, spacing;
  std::optional<std::array<std::vector<double>, 3>> planes;
};

/// Which part of the cut-mesh is written: what meets all of the conditions given.
struct OnlyArguments {
  bool cut = false, inside = false, outside = false;
  bool all = false;  ///< regions that would be left out, too
  std::vector<uint32_t> regions;

  bool any() const { return cut || inside || outside || !regions.empty(); }
};

/// Planes of slice.
struct SliceArguments {
  std::array<double, 3> normal{0, 0, 1};
  std::vector<double> heights;  ///< along the normal, from the origin
  int64_t layers = 0;           ///< so many equal layers instead; 0 for heights
};

/// Of flow.
struct FlowArguments {
  std::optional<std::array<double, 3>> wind;
  bool farField = false;
  std::optional<int> corrections;  ///< at most; none: as the library does by itself
  std::optional<uint32_t> streamlines;
  std::optional<uint32_t> steps;  ///< in time; none: the potential flow
  double viscosity = 0;           ///< in steps
};

struct Arguments {
  Command command = Command::help;
  std::string mesh;   ///< path, "-" for standard input
  std::string shape;  ///< of make
  GridArguments grid;
  bool orient = false;  ///< the mesh, once it is read
  double snapTolerance = 0;
  Intersections intersections = Intersections::resolve;
  unsigned threads = 0;
  bool validate = false;
  bool stream = false;               ///< cut: a folder of pieces
  bool faces = false;                ///< in .vtu files, instead of cells
  bool simpleCells = false;          ///< in .vtu files and polyMesh folders
  std::optional<int> coarsen;        ///< levels of octree cells; none: untouched grid cells as they are
  std::optional<int> coarsenLayers;  ///< of cells of each size, before larger ones; none: as the library does by itself
  int refine = 0;                    ///< levels of smaller cells where the surface bends
  double refineAngle = 30;           ///< by how much, in degrees
  std::vector<RefinementBox> refineBoxes;
  std::optional<double> merge;       ///< fraction of a grid cell below which cells are merged; 0: not
  std::optional<double> uniteWalls;  ///< the angle, in degrees

  bool refines() const { return refine > 0 || !refineBoxes.empty(); }
  /// The option that says so.
  const char* refineOption() const { return refine > 0 ? "--refine" : "--refine-box"; }
  OnlyArguments only;
  std::optional<double> insideThreshold;  ///< of estimates: see InsideOptions
  SliceArguments slice;
  FlowArguments flow;
  std::optional<WindingRule> rule;   ///< of resolve: the boundary of the solid rather than all triangles
  std::string report;                ///< path of the JSON report, "-" for standard output; empty for text there
  std::vector<std::string> outputs;  ///< paths, "-" for standard output
  std::optional<FileFormat> format;  ///< of standard output
};

/// Options that do not go with what is asked for, and whether they are given.
using RefusedOptions = std::initializer_list<std::pair<bool, std::string>>;
/// Throws UsageError for the first of them that is given, its name between the two texts.
void refuseOptions(RefusedOptions options, const std::string& before, const std::string& after);

/// The words after the program's name. Throws UsageError, and FileError for a file of planes.
Arguments parseArguments(const std::vector<std::string>& words);

extern const char* const kHelp;

}  // namespace mandoline::cli
