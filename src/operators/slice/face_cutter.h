// Where a plane cuts faces: points on edges of their triangles, and segments between them.
#pragma once

#include "base/csr.h"
#include "operators/slice/plane_stack.h"
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

/// Where a plane cuts the faces of some cut-cells.
struct CutFaces {
  std::vector<CutFace> faces;                       ///< ascending
  std::vector<Segment> segments;                    ///< as points
  std::vector<std::array<uint32_t, 2>> pointEdges;  ///< per point: the vertices of the edge that it lies on. No edge has two points
  detail::Csr<uint32_t> cellFaces;                  ///< per given cell: 2 * cut face + side, in the order of its half-faces
};

/// One plane at a time; the buffers are kept from plane to plane.
class FaceCutter {
 public:
  FaceCutter(const CutMesh& cutMesh, const PlanarCuts& cuts);
  /// The faces of the cut-cells that the plane may meet. The result holds until the next call, which may change it.
  CutFaces& run(uint32_t plane);

 private:
  void findCutFaces(std::span<const uint32_t> cells);
  void gatherFaces(std::span<const uint32_t> cells);
  bool isCut(uint32_t face) {
    if (cutsOf_[face].end == kUnknown) findCuts(face);
    return cutsOf_[face].first <= plane_ && plane_ < cutsOf_[face].end;
  }
  void findCuts(size_t face);
  bool isAbove(uint32_t vertex) { return planesBelow(vertex) > plane_; }
  uint32_t planesBelow(uint32_t vertex) {
    if (planesBelow_[vertex] == kUnknown) findPlanesBelow(vertex);
    return planesBelow_[vertex];
  }
  void findPlanesBelow(uint32_t vertex);
  void cut(CutFace& face);
  void addTriangle(const uint32_t* vertices);
  void numberPoints();

  static constexpr uint32_t kUnknown = ~0u;

  /// Planes first .. end - 1.
  struct PlaneRange {
    uint32_t first = 0, end = kUnknown;
  };

  const CutMesh& cutMesh_;
  const PlanarCuts& cuts_;
  FaceTriangulator triangulator_;
  std::vector<uint32_t> planesBelow_;  // per vertex: how many
  std::vector<PlaneRange> cutsOf_;     // per face
  uint32_t plane_ = 0;
  std::vector<uint32_t> cells_;  // per half-face in result_.cellFaces: its cell
  std::vector<uint32_t> triangles_;
  std::vector<detail::KeyedItem> halfFaces_;  // by face
  std::vector<detail::KeyedItem> ends_;       // of segments (2 * segment + end), by edge
  CutFaces result_;
};

}  // namespace mandoline::operators
