// What a plane cuts out of faces: points on edges of their triangles, and segments between them.
#pragma once

#include "base/csr.h"
#include "operators/slice/cutting_plane.h"
#include "operators/triangulate/face_triangulator.h"

namespace mandoline::operators {

/// Where the plane cuts a triangle: from one point to another. Seen from the triangle's side 0 and with the plane's normal up, what is
/// above lies to the left; seen from side 1, to the left of the way back.
using Segment = std::array<uint32_t, 2>;

struct CutFace {
  static constexpr uint32_t kNone = ~0u;

  uint32_t face;
  uint32_t firstSegment, endSegment;
  std::array<uint32_t, 2> cells;  ///< the cut-cell on each side, or kNone
};

/// What a plane cuts out of the faces of some cut-cells.
struct CutFaces {
  std::vector<CutFace> faces;                       ///< ascending
  std::vector<Segment> segments;                    ///< as points
  std::vector<std::array<uint32_t, 2>> pointEdges;  ///< per point: the vertices of the edge that it lies on. No edge has two points
  detail::Csr<uint32_t> cellFaces;                  ///< per given cell: 2 * cut face + side, in the order of its half-faces
};

/// One plane at a time; the buffers are kept from plane to plane.
class FaceCutter {
 public:
  FaceCutter(const CutMesh& cutMesh, const ScaledSpace& space);
  /// The faces of some cut-cells. The result holds until the next call, which may change it.
  CutFaces& run(const CuttingPlane& plane, std::span<const uint32_t> cells);

 private:
  void findCutFaces(std::span<const uint32_t> cells);
  void gatherFaces(std::span<const uint32_t> cells);
  bool isCut(uint32_t face);
  bool isAbove(uint32_t vertex) {
    if (side_[vertex] / 2 != round_) findSide(vertex);
    return side_[vertex] % 2 == 1;
  }
  void findSide(uint32_t vertex);
  void cut(CutFace& face);
  void addTriangle(const uint32_t* vertices);
  void numberPoints();

  const CutMesh& cutMesh_;
  const ScaledSpace& space_;
  FaceTriangulator triangulator_;
  const CuttingPlane* plane_ = nullptr;
  uint32_t round_ = 0;           // of run()
  std::vector<uint32_t> side_;   // per vertex: 2 * the last round that asked, + 1 if it was above
  std::vector<uint32_t> cells_;  // per half-face in result_.cellFaces: its cell
  std::vector<uint32_t> triangles_;
  std::vector<detail::KeyedItem> halfFaces_;  // by face
  std::vector<detail::KeyedItem> ends_;       // of segments (2 * segment + end), by edge
  CutFaces result_;
};

}  // namespace mandoline::operators
