// What lies between two heights of a mesh, prepared by itself: several processes each prepare only what they cut.
//
// Triangles are within the band, or beside it: those share a vertex with one within. So everything that triangles within have at their
// vertices and edges is there. Ids are in the order of the whole mesh's.
//
// Only of plain meshes: all of their triangles have area and differ, and none meet. Others have to be prepared as a whole.
#pragma once

#include <algorithm>

#include "base/shared.h"
#include "mesh/mesh_part.h"
#include "mesh/mesh_source.h"
#include "mesh/prepared.h"

namespace mandoline::detail {

/// Heights are along z, scaled as the mesh is; infinite at the ends of the mesh. Bands that meet have the triangles there in common.
struct Band {
  double low, high;

  bool reaches(double least, double greatest) const { return least <= high && greatest >= low; }
  /// Of each height one of the bands that divide space says so.
  bool owns(double height) const { return height >= low && height < high; }
};

/// Which of the bands that divide space, ascending and some of them empty, have what.
class MANDOLINE_SHARED BandFinder {
 public:
  explicit BandFinder(std::span<const Band> bands);

  size_t count() const { return bands_.size(); }
  /// The one that owns a height.
  size_t owner(double height) const;
  /// Calls f(band) for those that reach from the one height to the other.
  template <class F>
  void forReached(double least, double greatest, const F& f) const {
    auto at = std::partition_point(filled_.begin(), filled_.end(), [&](size_t b) { return bands_[b].high < least; });
    for (; at != filled_.end() && bands_[*at].low <= greatest; ++at) f(*at);
  }

 private:
  std::span<const Band> bands_;
  std::vector<size_t> filled_;  // those that are not empty
};

/// What a band has of a mesh.
struct BandTriangles {
  MeshPart part;                    ///< triangles within and beside the band
  std::vector<uint8_t> isWithin;    ///< per triangle
  std::vector<uint8_t> isComplete;  ///< per vertex of the part whether a triangle within the band has one at its position
  std::vector<uint32_t> lowest;     ///< per vertex of the part: the id of the lowest one of the whole at its position that a triangle has
};
/// Heights of the vertices of a part, scaled.
MANDOLINE_SHARED std::vector<double> heightsOf(const MeshPart& part, const Scale& scale);
/// Per band the triangles within it.
MANDOLINE_SHARED std::vector<MeshPart> trianglesOfBands(const MeshPart& part, const std::vector<double>& heights, const BandFinder& finder);
/// Per band, of the vertices that are `asked`, the positions that it owns and `here` does not reach.
MANDOLINE_SHARED std::vector<std::vector<double>> positionsElsewhere(const MeshPart& part, const std::vector<double>& heights,
                                                                     const std::vector<uint8_t>& asked, const BandFinder& finder,
                                                                     const Band& here);
/// The triangles at some positions which `there` does not reach.
MANDOLINE_SHARED MeshPart trianglesAt(const std::vector<double>& positions, const MeshPart& part, const std::vector<double>& heights,
                                      const Band& there);
/// Per position the id of the lowest vertex there, or 2^32 - 1.
MANDOLINE_SHARED std::vector<uint32_t> lowestAt(const std::vector<double>& positions, const MeshPart& part);
/// Finds which vertices are complete, and the lowest ones at their positions: those of the part, which are those of the whole where they
/// are complete.
MANDOLINE_SHARED void findLowest(BandTriangles& triangles);
/// Takes what lowestAt() has told of positions of vertices that are not complete.
MANDOLINE_SHARED void takeLowest(const std::vector<double>& asked, const std::vector<uint32_t>& told, BandTriangles& triangles);

/// What a band has of a mesh, which is gone through several times, so that nothing else of it is ever held but a byte for each vertex.
MANDOLINE_SHARED BandTriangles readBand(const MeshSource& mesh, const Scale& scale, const Band& band);

struct MeshBand {
  Band band;
  Prepared mesh;                    ///< closed, oriented and parts are for those to say who know the whole
  std::vector<uint32_t> triangles;  ///< per triangle its id in the whole mesh, ascending
  std::vector<uint32_t> vertices;   ///< per tri-vertex, likewise
  std::vector<uint8_t> isWithin;    ///< per triangle
  std::vector<uint8_t> isComplete;  ///< per tri-vertex: whether all its triangles are here, because one is within
  uint32_t weldedVertices = 0;      ///< as of MeshCounts, of those that the band owns
};

/// Welds what is in a band.
std::unique_ptr<MeshBand> weldBand(const BandTriangles& triangles, int shift, const Band& band);
/// Finds its tri-edges, and whether what is within is plain.
bool findPlainEdges(MeshBand& band, Intersections intersections, Monitor& monitor, Predicates& predicates);

/// What there is at the tri-edges of which all triangles are here.
struct BandEdges {
  bool closed = true, oriented = true;  ///< as of a WeldedMesh
  bool haveAtMostTwo = true;            ///< triangles
  uint64_t open = 0, inconsistent = 0;  ///< how many are so, as of a MeshInfo; of those whose lower end the band owns
};
BandEdges inspectEdges(const MeshBand& band);

/// What all have to know of the triangles within each band to find the parts of a mesh of which no tri-edge has more than two triangles.
/// Sets of triangles that hang together within the band are named by a triangle of theirs, by the whole's ids.
struct BandParts {
  std::vector<uint32_t> setOf;      ///< per triangle; those beside are sets of their own
  std::vector<uint32_t> kinds;      ///< 2 per set: its name and its PartKind
  std::vector<uint32_t> shared;     ///< 2 per triangle that is in another band, too: its id and the name of its set
  std::vector<uint32_t> openEdges;  ///< 2 per tri-edge with one triangle: the ends, by the whole's ids
};
BandParts findBandParts(const MeshBand& band);
/// The parts of the whole, and of which kind those of each triangle of a band are. `setOf`: the band's; `all`: of all bands.
Parts joinParts(const MeshBand& band, const std::vector<uint32_t>& setOf, std::span<const BandParts> all);

}  // namespace mandoline::detail
