// The arrangement of a mesh's triangles: where they meet, cut into vertices and edges that all triangles there share. Grid-independent.
//
// In: a welded mesh, Contacts. Out: Arrangement. After it, two triangles have nothing in common but vertices and edges of the
// arrangement, and areas of one plane whose outlines are such edges. Nothing is rounded: a made vertex is a PointKey.
#pragma once

#include <optional>

#include "base/csr.h"
#include "base/parallel.h"
#include "mandoline/intersections.h"
#include "mesh/resolve/mesh_points.h"

namespace mandoline::detail {

/// An edge of the arrangement in the inside of a triangle.
struct InnerEdge {
  uint32_t low, high;
  auto operator<=>(const InnerEdge&) const = default;
};

struct MadeEdge {
  uint32_t low, high;
  Line line;
  std::array<uint32_t, 2> ends() const { return {low, high}; }
};

struct Contacts;

struct Arrangement {
  explicit Arrangement(const WeldedMesh& mesh) : points(mesh) {}

  MeshPoints points;                ///< tri-vertices, then made vertices; ids of those that are at the place of a lower one are not used
  std::vector<Stitch> sides;        ///< sides of triangles with vertices inside, those of WeldedMesh::stitches included
  Csr<InnerEdge> innerEdges;        ///< per triangle, ascending; empty if there are none at all
  Csr<uint32_t> innerVertices;      ///< per triangle: vertices strictly inside, ascending
  Csr<uint32_t> overlaps;           ///< per triangle: others that share an area of its plane, ascending
  std::vector<MadeEdge> madeEdges;  ///< edges with a made end, ascending by ends
  PairCounts pairs;
  uint32_t curves = 0;  ///< connected ones that the edges in the insides of triangles make

  /// Whether the only triangles that meet are duplicates.
  bool empty() const { return pairs.total() == pairs.identical; }
  const MadeEdge* findMade(uint32_t low, uint32_t high) const;

  /// Whether others reach into a triangle or share an area of its plane.
  bool isReachedInto(uint32_t triangle) const {
    return !innerVertices[triangle].empty() || !innerEdges[triangle].empty() || !overlaps[triangle].empty();
  }
};

/// How many connected curves edges between vertices below `vertices` make.
uint32_t countCurves(std::span<const InnerEdge> edges, size_t vertices);

/// `contacts`: all.
Arrangement arrange(const WeldedMesh& mesh, const Contacts& contacts, Monitor& monitor, Predicates& predicates);

}  // namespace mandoline::detail
