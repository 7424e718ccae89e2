// A cut that several processes make together, which have no memory in common: workers of a page, say. Each has the whole mesh, and cuts
// some layers of the grid; the first one gets the result, the same as cut() gives, to the bit.
//
//   CutShare share(mesh, grid, {index, count});              // in each, of the same mesh and grid
//   ... share.summary() to all others; summaries: all of them, in order ...
//   CutPart part = share.part(summaries);                    // in each; goes to the first
//   CutResult result = share.join(parts);                    // in the first; parts: all of them, in order
#pragma once

#include "mandoline/prepare_share.h"

namespace MANDOLINE_API mandoline {

namespace detail {
struct CutState;
struct ShareExcerpt;
struct ShareInput;
using TakeExcerpt = std::unique_ptr<ShareExcerpt>(const MeshView& mesh, CutState& state);
}  // namespace detail

/// What one process found of a cut-mesh.
struct CutPart {
  /// Its vertices, faces and cut-cells. Offsets are those of the part; ids in loopVertices, cellHalfFaces and cellRegion those of the
  /// whole, as those of the made vertices among the first vertices. Arrays of rows, runs, regions and triangles are left out.
  CutMesh cutMesh;
  std::vector<uint32_t> firstVertices;  ///< the ids of its first vertices, or 2^32 - 1 for one that another part has; the rest follow on
  uint32_t triFaces = 0;                ///< how many of its faces are pieces of triangles, which come first
  uint32_t exactFallbacks = 0;          ///< see CutStats

  static void fields(auto& self, const auto& f) {
    f("cutMesh", self.cutMesh);
    f("firstVertices", self.firstVertices);
    f("triFaces", self.triFaces);
    f("exactFallbacks", self.exactFallbacks);
  }
};

class CutShare {
 public:
  /// Cuts its layers. Throws CallError as cut() has errors, and for an index that is not below the count (badArgument); only where
  /// Intersections::assumeNone leads to a contradiction, other triangles may be named, or none.
  /// `takeExcerpt`: detail::takeExcerpt where one of several shares is to keep no more of the mesh than it needs, and frees the rest on the
  /// way; summary() and part() are then to be called once. All shares of a cut have it, or none: it also decides where they meet.
  CutShare(PreparedMesh mesh, Grid grid, const ShareOf& shareOf, const RunOptions& options = {},
           detail::TakeExcerpt* takeExcerpt = nullptr);
  /// The same of one of several shares that has prepared only what it cuts; summary() and part() are then to be called once.
  CutShare(std::unique_ptr<detail::ShareInput> input, Grid grid, const ShareOf& shareOf, const RunOptions& options = {});

  /// What the other processes have to know of this share, in the form of this version of the library.
  std::vector<uint32_t> summary() const;
  /// `summaries`: of all shares, in their order. Throws CallError as above, and for other summaries (badArgument, element: the first that
  /// is another).
  CutPart part(std::span<const std::vector<uint32_t>> summaries, const RunOptions& options = {});
  /// The layers of grid cells along z that this share cuts: from the first up to, not including, the second. It may be none.
  std::array<int64_t, 2> layers() const;
  /// What all shares know alike of the result, once part() has been made: its grid, runs, regions and triangles, without vertices, faces
  /// and cut-cells; and how the cut went here. `hasFace`: per triangle 1 if some part has a face of it, else 0. Throws
  /// CallError if there are not as many (badArgument).
  CutResult common(const std::vector<uint8_t>& hasFace) const;
  /// CutMesh::gridCellRegion() of the result, which all shares know from part() on, until join(). Throws CallError before and after
  /// (badArgument).
  std::vector<int32_t> gridCellRegion() const;
  /// Of the first share, whose part has been made. `parts`: of all shares, in their order.
  CutResult join(std::vector<CutPart> parts);

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

}  // namespace mandoline
