// The corners and sides of untouched grid cells, shared with the cut-cells beside them.
#pragma once

#include <algorithm>

#include "io/selection.h"

namespace mandoline::detail {

/// Numbers the vertices of cut-cells and of untouched grid cells together: first the cut-vertices, then the other corners of untouched
/// cells, by rows along x. Knows which cut-vertices lie inside a grid-edge, so that cells that only touch that edge can have them too.
/// Takes memory by the rows of the grid and the cut-vertices, not by the grid cells.
class GridVertices {
 public:
  using Index = std::array<int32_t, 3>;

  GridVertices(const CutMesh& cutMesh, const Selection& selection);

  /// Cut-vertices and other corners.
  int64_t count() const { return count_; }

  /// Goes up x along the corners of untouched cells, from one that is a corner of such a cell to the last one that is, without a gap.
  class Walk {
   public:
    int64_t next() {
      if (x_ == segment_->end) ++segment_;
      return segment_->first + (x_++ - segment_->begin);
    }

   private:
    friend class GridVertices;
    struct Segment {
      int32_t begin, end;
      int64_t first;  // the vertex at begin; the others follow
    };
    Walk(const Segment* segment, int32_t x) : segment_(segment), x_(x) {}
    const Segment* segment_;
    int32_t x_;
  };
  Walk walkFrom(const Index& corner) const { return {find(corner), corner[0]}; }

  /// The vertex at a corner of an untouched cell.
  int64_t corner(const Index& at) const { return walkFrom(at).next(); }
  /// The untouched cells with cut-vertices inside their grid-edges, as numbers i + nx (j + ny k), ascending.
  const std::vector<int64_t>& cellsWithDividedEdges() const { return dividedCells_; }
  /// Appends the vertices of the grid-edge that goes up the axis from a corner of an untouched cell, upwards or downwards; without the one
  /// where it ends.
  void appendEdge(const Index& from, int axis, bool upwards, std::vector<int64_t>& vertices) const;

  /// Calls visit(x, y, z) for each corner that is not a cut-vertex, in order of their numbers.
  template <class Visit>
  void forEachAdded(const Visit& visit) const {
    const auto& planes = cutMesh_.grid.planes;
    for (size_t row = 0; row + 1 < rowOffsets_.size(); ++row) {
      const double y = planes[1][row % planes[1].size()], z = planes[2][row / planes[1].size()];
      for (size_t s = rowOffsets_[row]; s < rowOffsets_[row + 1]; ++s) {
        if (segments_[s].first < int64_t(cutMesh_.vertexCount())) continue;
        for (int32_t x = segments_[s].begin; x < segments_[s].end; ++x) visit(planes[0][size_t(x)], y, z);
      }
    }
  }

 private:
  using Segment = Walk::Segment;
  static constexpr uint32_t kNone = ~0u;
  static constexpr uint8_t kGridVertex = 7;  // the mask with all three bits

  size_t rowOf(const Index& corner) const { return size_t(corner[1]) + cutMesh_.grid.planes[1].size() * size_t(corner[2]); }
  const Segment* find(const Index& corner) const;
  void numberCorners(const Selection& selection);
  void addRow(const Selection& selection, size_t row, std::span<const std::pair<int32_t, uint32_t>> cutCorners);
  void addSegments(int32_t begin, int32_t end, std::span<const std::pair<int32_t, uint32_t>> cutCorners);
  void linkAlongGridLines();
  void link(uint32_t from, uint32_t to, int axis);
  void findDividedCells(const Selection& selection);

  const CutMesh& cutMesh_;
  int64_t count_;
  std::vector<size_t> rowOffsets_;  // into segments_, per row of corners; y fastest
  std::vector<Segment> segments_;   // the corners of untouched cells, ascending; a cut-vertex has a segment of its own
  // 3 per cut-vertex. Of a grid vertex: the vertex that follows inside the grid-edge up each axis. Of a vertex inside a grid-edge:
  // its two neighbours there.
  std::vector<uint32_t> links_;
  std::vector<int64_t> dividedCells_;
};

}  // namespace mandoline::detail
