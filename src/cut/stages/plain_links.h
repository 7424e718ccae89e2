// A grid cell without anything special, as nearly all are: triangles meet in it two by two, and each hybrid edge parts its grid-face. There
// half-faces are joined by what lies beside each edge, and no edge has to be looked up among all.
#pragma once

#include <optional>
#include <vector>

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
  using Pair = std::array<LocalHalf, 2>;

  std::optional<size_t> findOnly(uint64_t key, size_t from) const;
  bool collectUses(const CellView& cell);
  bool linkHybridEdges(const CellView& cell);
  bool linkTriEdges(const CellView& cell);
  void linkGridEdges(const CellView& cell, Shells& shells) const;

  static constexpr size_t kMostFaces = 12, kMostUses = 64;

  std::array<uint64_t, kMostUses> keys_;  // of uses: the vertices of each, the lower one first
  std::array<Use, kMostUses> uses_;
  size_t count_ = 0;
  std::vector<Pair> pairs_;
  std::array<LocalHalf, 6> first_;  // per grid-face of the cell: its first half-face
};

}  // namespace mandoline::detail
