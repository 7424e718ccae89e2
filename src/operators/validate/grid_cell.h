// One grid cell with its cut-cells, for the checks that work by grid cell.
#pragma once

#include "base/box_tree.h"
#include "operators/validate/context.h"

namespace mandoline::validation {

inline detail::Box boxOf(const Vec3& low, const Vec3& high) { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }

/// Numbers the vertices of a grid cell from 0, in the order in which they are added.
class VertexNumbers {
 public:
  void clear();
  /// Its number, also if it has one already.
  uint32_t add(uint32_t vertex);
  /// Of a vertex that has been added.
  uint32_t of(uint32_t vertex) const { return slots_[slotOf(vertex)]; }
  const std::vector<uint32_t>& vertices() const { return vertices_; }

 private:
  static constexpr uint32_t kFree = UINT32_MAX;
  size_t slotOf(uint32_t vertex) const {
    size_t slot = (vertex * 0x9e3779b97f4a7c15u >> 32) & (slots_.size() - 1);
    while (slots_[slot] != kFree && vertices_[slots_[slot]] != vertex) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  std::vector<uint32_t> vertices_, slots_;
};

/// The cut-cells of one grid cell, in coordinates of that cell: 0 to 1 per axis.
struct GridCell {
  struct Face {
    uint32_t id;
    int32_t owner[2];  ///< cut-cell of side 0 and 1 if it lies in this grid cell, else -1
    uint32_t firstCorner, lastCorner;
    int side;              ///< 2 * axis + which end, if it lies in the cell's boundary, else -1
    Vec3 low, high;        ///< bounding box
    double volume;         ///< of the cone from the face to the grid cell's lowest corner
    double volumeNoise;    ///< how much of it one rounding changes
    Vec3 area, areaNoise;  ///< vector area, and the same for its components
  };

  explicit GridCell(const Context& context_) : context(context_) {}
  /// Becomes the grid cell of a group.
  void gather(size_t group);
  Vec3 local(const Vec3& p) const { return {{(p[0] - low[0]) / size[0], (p[1] - low[1]) / size[1], (p[2] - low[2]) / size[2]}}; }
  /// Of a vertex of a face or an edge beyond.
  const Vec3& placeOf(uint32_t vertex) const { return places[numbers.of(vertex)]; }
  /// Of the loops of faces[f].
  std::span<const uint32_t> vertices(size_t f) const {
    return {cornerVertex.data() + faces[f].firstCorner, faces[f].lastCorner - faces[f].firstCorner};
  }

  const Context& context;
  std::array<int32_t, 3> index{};
  Vec3 low, size;
  Vec3 noise;                          ///< one rounding
  std::span<const uint32_t> cells;     ///< its cut-cells, ascending
  std::vector<Face> faces;             ///< by ascending id
  VertexNumbers numbers;               ///< of the vertices of faces and of edges beyond
  std::vector<Vec3> places;            ///< theirs, by number
  std::vector<uint32_t> cornerVertex;  ///< loops of all faces
  std::vector<uint32_t> cornerNext;    ///< the next corner of the loop
  std::vector<Vec3> corners;           ///< their positions
  detail::BoxTree faceTree;            ///< faces by place

 private:
  struct Listing {
    uint32_t halfFace;
    int32_t cell;
  };
  uint32_t addVertex(uint32_t v);
  void addFace(uint32_t id);
  void addLoop(Face& face, std::span<const uint32_t> loop);
  std::vector<Listing> listings_;
};

/// Where a point is on a face, seen along an axis; open if nearer to the face's edges than the margin.
enum class Place { outside, inside, open };
Place placeOn(const GridCell& cell, const GridCell::Face& face, int axis, const Vec3& point, const Vec3& margin);

}  // namespace mandoline::validation
