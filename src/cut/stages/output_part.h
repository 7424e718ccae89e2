// Output, of what is cut here: numbers the vertices, lays the faces and cells of the bricks one after the other, and computes the
// coordinates.
//
// In: all stages before. Out: CutPart, the whole unless other processes cut the rest (see cut_mesh.h for its arrays and their order).
#pragma once

#include <optional>

#include "cut/stages/input.h"
#include "cut/stages/kept_vertices.h"
#include "cut/stages/regions.h"
#include "mandoline/cut_share.h"

namespace mandoline::detail {

struct CutState;

/// What is kept in the arrays of the cut before, which the result is written over. An interface: only who does so links what does it.
class KeptArrays {
 public:
  struct Arrays {
    CutMesh &spare, &out;  ///< those before are moved from one to the other
    Monitor& monitor;
  };
  virtual BricksToNumber bricksToNumber(const CutState& state) const = 0;
  /// Once all have numbers.
  virtual void begin(const VerticesBefore& before, const CutState& state, const KeptRuns& vertices) = 0;
  // Each brings what is kept to where it is now, and leaves room for the rest.
  virtual void placeCells(const Arrays& arrays) const = 0;
  virtual void placeFaces(const Arrays& arrays) const = 0;
  virtual void placeVertices(const Arrays& arrays, size_t count) const = 0;

 protected:
  ~KeptArrays() = default;
};

/// What a cut keeps of the one before it, each asked for as soon as it can be told. An interface: other cuts don't link what finds it.
class Keeping {
 public:
  virtual const KnownSlabs* slabs() = 0;
  virtual const KnownCrossings& crossings() = 0;
  virtual KnownClips& clips() = 0;
  virtual KeptBricks& bricks() = 0;  ///< of those that are laid out
  virtual IdVector<BrickId, BrickSeams> seams() = 0;
  virtual KeptArrays* arrays() = 0;  ///< null unless the result is written over that of the cut before
  virtual KeptVertices vertices() = 0;

 protected:
  ~Keeping() = default;
};

/// What the result tells of all triangles of a mesh.
struct WholeTriangles {
  uint32_t count;
  std::vector<uint32_t> dropped;       ///< those that are not kept; ascending, as are the others
  std::vector<uint32_t> parity, open;  ///< of parts without winding numbers

  explicit WholeTriangles(const Prepared& mesh);
  /// All kept, and of parts with winding numbers.
  explicit WholeTriangles(uint32_t count_) : count(count_) {}
};

/// What the stages have made so far; each adds its part.
struct CutState {
  Surface surface;
  SurfaceParts parts;
  Bricks bricks;
  BrickCuts cuts;
  UsedVertices used;
  UntouchedRuns runs;
  IdVector<BrickId, BrickSeams> seams;
  Regions regions;
  Numbers numbers;

  // Of one of several processes:
  std::optional<CellLayers> layersHere;
  std::vector<int32_t> shareBorders;             ///< the first layers of all, with which bricks begin anew
  std::optional<SurfaceNumbers> surfaceNumbers;  ///< once those of all are known
  std::optional<WholeTriangles> wholeTriangles;  ///< if it has an excerpt of the mesh, with ids of its own

  bool isNeededAgain = false;  ///< once the output is made; otherwise memory is given back on the way

  // Of a surface that moves:
  std::optional<std::array<int, 3>> brickShifts;  ///< of bricks that have to be the same each time
  Keeping* keeping = nullptr;                     ///< of the cut before, if parts of it may be kept
  KeptBricks* kept = nullptr;                     ///< of it
  CutMesh spare;                                  ///< whose memory the result is written over

  CutBricks cut() const { return {surface, bricks, runs, cuts, seams}; }
};

/// Vertices of the mesh and its edges come from the share that has them first along z, and it tells which of them are made. `mesh` was
/// prepared; coordinates that it and `grid` have are handed back as they are.
CutPart makePart(const MeshView& mesh, const Grid& grid, CutState& state, Run& run);

/// The vertices of the mesh and its edges that loops have, in order.
std::vector<VertexId> listUsed(const UsedVertices& used);

}  // namespace mandoline::detail
