// The input of one of several processes that cut together, of which each prepares only what it cuts: of a plain mesh, see mesh_band.h,
// of which each has some triangles at first.
//
//   ShareInputMaker maker(facts, grid, {index, count}, options);  // in each, of the same mesh and grid
//   maker.begin(some, work), maker.makeBands(work)                // work: between them its sums over all
//   maker.prepare(triangles)                                      // those of this one of bands()
//   maker.join(whole, setOf, parts)                               // whole: what all found(); parts: those of all, if need be
//   maker.take({...})                                             // with the sums of all that join() gave, ...
#pragma once

#include "cut/driver.h"
#include "cut/share_layers.h"
#include "mesh/inspect_plain.h"
#include "mesh/mesh_part.h"

namespace mandoline::detail {

struct ShareInput {
  std::shared_ptr<const MeshPart> surface;  ///< the triangles within the band
  Fingerprint fingerprint;                  ///< of the mesh
  Intersections intersections = Intersections::resolve;
  std::unique_ptr<MeshBand> band;
  Input input;  ///< of the band
  std::optional<ShareLayers> layers;
  std::optional<WholeTriangles> triangles;
  std::vector<uint32_t> firstCrossings;  ///< per tri-edge of the band: see ShareExcerpt
  uint32_t wholeVertices = 0;            ///< likewise
  CutStats preparation;                  ///< of the stages so far
  CutStats stats;                        ///< those that the stages of the cut begin with
};

/// How many ids the crossings of tri-edges have, by their lower ends.
struct CrossingCounts {
  static constexpr uint8_t kMany = 255;

  std::vector<uint8_t> counts;  ///< per tri-vertex of the whole: 0 where that is not known here, at most kMany
  std::vector<uint32_t> many;   ///< 2 per vertex with at least kMany: its id and the number, ascending
};

/// What all know once they have told each other.
struct SharedFindings {
  std::vector<int64_t> cornerWinding;  ///< see Input
  CrossingCounts crossings;
  std::vector<uint8_t> inParity, inOpen;  ///< per triangle of the whole whether it is of such a part; empty if none is
};

/// What all processes know of a mesh.
struct MeshFacts {
  uint64_t vertices = 0, triangles = 0;
  Fingerprint fingerprint;
  int shift = 0;  ///< see Prepared
};

class MANDOLINE_SHARED ShareInputMaker {
 public:
  ShareInputMaker(const MeshFacts& facts, const Grid& grid, const ShareOf& shareOf, const PrepareOptions& options);

  /// Gives the work of layers that some of the triangles are, of all shares all. False where the mesh is to be prepared as a whole, which
  /// also tells what is wrong with it.
  bool begin(const MeshPart& some, std::vector<uint64_t>& work);
  void makeBands(const std::vector<uint64_t>& work);
  /// Of all shares.
  const std::vector<Band>& bands() const { return bands_; }
  const Band& band() const { return bands_[shareOf_.index]; }
  /// Prepares what it cuts. False as above.
  bool prepare(BandTriangles triangles);
  /// The triangles within its band.
  const MeshPart& surface() const { return *in_->surface; }
  BandFindings found() const;
  BandParts parts() const;
  /// `parts` are needed where the whole is not closed, and where partCounts() are to be known. Gives the winding numbers at the lowest
  /// corner of the grid, as far as they are counted here.
  std::vector<int64_t> join(const BandFindings& whole, const std::vector<uint32_t>& setOf, std::span<const BandParts> parts);
  const PartCounts& partCounts() const { return partCounts_; }
  /// Per triangle of the whole whether it is here, and of such a part.
  std::vector<uint8_t> trianglesOf(PartKind kind) const;
  CrossingCounts crossings() const;
  std::unique_ptr<ShareInput> take(const SharedFindings& all);

 private:
  void numberCrossings(const CrossingCounts& all);
  void keepSurface(const BandTriangles& from);
  const MeshFacts facts_;
  const Grid& grid_;
  const ShareOf shareOf_;
  const PrepareOptions options_;
  Monitor monitor_;
  Predicates predicates_;
  std::unique_ptr<ShareInput> in_ = std::make_unique<ShareInput>();
  std::optional<Clock> clock_;
  std::vector<Band> bands_;
  PartCounts partCounts_;
};

}  // namespace mandoline::detail
