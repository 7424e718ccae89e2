// A grid cell that several sheets part, or one of triangles that disagree about their sides (else see parted_cell.h): triangles meet in it
// two by two, and each hybrid edge parts its grid-face. There half-faces are joined by what lies beside each edge: only the edges of
// tri-cut-faces have to be looked up.
#pragma once

#include <vector>

#include "base/stamped_table.h"
#include "cut/stages/cell_view.h"

namespace mandoline::detail {

class PlainLinks {
 public:
  /// Joins the half-faces on the two sides of every wedge around an edge, as CellMaker::linkAround() does. False, with nothing joined,
  /// where the cell is not plain.
  bool link(const CellView& cell, Shells& shells);

 private:
  /// An edge of a tri-cut-face.
  struct Use {
    LocalFace face;
    bool ascending;  ///< runs from the lower vertex to the higher
    bool isLinked;
  };

  bool findHalves(const CellView& cell);
  bool linkTriEdges(const CellView& cell);
  bool linkHybridEdges(const CellView& cell);
  void linkGridEdges(const CellView& cell);
  void join(LocalHalf a, LocalHalf b) { joins_.push_back({a, b}); }

  std::array<LocalHalf, 6> first_;  // per grid-face of the cell: its first half-face
  std::vector<Use> uses_;
  StampedTable table_;  // of numbers of uses
  std::vector<std::array<LocalHalf, 2>> joins_;
};

}  // namespace mandoline::detail
