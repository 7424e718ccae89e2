// Each grid-face is divided wherever edges on its two sides divide it: by Euler's formula, planar edges bound as many faces as there are
// edges and components more than vertices. Slits bound none. That edges do not cross, and that the faces cover the grid-face, is checked
// elsewhere (crossings.cpp, shells.cpp).
#include <algorithm>

#include "base/sort.h"
#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {

/// A grid-face is checked by the upper one of its two grid cells; at the upper end of the grid, by the only one.
void GridFaceCheck::run(const GridCell& cell, const std::vector<Edge>& edges) {
  for (int d = 0; d < 3; ++d) {
    checkSide(cell, edges, 2 * d);
    if (cell.index[size_t(d)] + 1 == cell.context.cut.grid.cells(d)) checkSide(cell, edges, 2 * d + 1);
  }
}

void GridFaceCheck::checkSide(const GridCell& cell, const std::vector<Edge>& edges, int side) {
  const int axis = side / 2;
  const int32_t plane = cell.index[size_t(axis)] + side % 2;
  const Context& x = cell.context;
  const auto isOn = [&](uint32_t v) { return x.onPlane(v, axis) && x.cellAt(v)[axis] == plane; };
  edges_.clear();
  vertices_.clear();
  for (const Edge& edge : edges) {
    if (!isOn(edge[0]) || !isOn(edge[1])) continue;
    edges_.push_back(edge);
    vertices_.insert(vertices_.end(), edge.begin(), edge.end());
  }
  detail::sortUnique(vertices_);
  const auto indexOf = [&](uint32_t v) { return uint32_t(std::lower_bound(vertices_.begin(), vertices_.end(), v) - vertices_.begin()); };
  components_.reset(vertices_.size());
  size_t bounded = edges_.size() - vertices_.size(), faces = 0;
  for (const Edge& edge : edges_) components_.unite(indexOf(edge[0]), indexOf(edge[1]));
  for (uint32_t i = 0; i < vertices_.size(); ++i) bounded += components_.find(i) == i;
  uint32_t last = 0;
  for (const GridCell::Face& face : cell.faces) {
    if (face.side != side) continue;
    ++faces;
    last = face.id;
  }
  if (faces > 0 && faces != bounded)
    divided_.violate("face", last, "and the others in its grid-face are not as many as the edges there bound");
}

}  // namespace mandoline::validation
