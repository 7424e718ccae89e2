#include "cut/stages/stencil.h"

#include <optional>

namespace mandoline::detail {
namespace {

/// Place of a grid cell in the order by z, y, x.
uint64_t keyOf(const Input& input, const Slab& cell) {
  return (uint64_t(cell[2] >> 1) * input.cells(1) + (cell[1] >> 1)) * input.cells(0) + (cell[0] >> 1);
}

int planeAxis(const Slab& gridFace) { return onPlane(gridFace[0]) ? 0 : onPlane(gridFace[1]) ? 1 : 2; }

/// The cell that a grid-face is looked up in: above its plane, or below the last plane. Returns the grid-face's index in it.
int owner(const Input& input, const Slab& gridFace, Slab& cell) {
  const int axis = planeAxis(gridFace);
  const bool last = gridFace[axis] == 2 * input.cells(axis);
  cell = gridFace;
  cell[axis] += last ? -1 : 1;
  return cellFace(axis, last ? 1 : 0);
}

/// What a cell has in common with one of the neighbours that come before it in the order by z, y, x.
struct Neighbour {
  /// Index of a grid-face, grid-edge or corner in the cell, and in the neighbour.
  struct Shared {
    uint8_t here, there;
  };
  template <size_t kMost>
  struct List {
    Shared items[kMost] = {};
    size_t count = 0;

    constexpr void add(int here, int there) { items[count++] = {uint8_t(here), uint8_t(there)}; }
    constexpr const Shared* begin() const { return items; }
    constexpr const Shared* end() const { return items + count; }
  };
  int shift[3] = {};
  List<1> faces;
  List<4> edges, corners;
};

constexpr Neighbour neighbourAt(int dx, int dy, int dz) {
  Neighbour n{{dx, dy, dz}, {}, {}, {}};
  // A side of the cell is shared if the neighbour lies towards it or level with it; it is then the opposite or the same side there.
  const auto isShared = [&](int d, int side) { return n.shift[d] == 0 || (n.shift[d] > 0) == (side == 1); };
  const auto there = [&](int d, int side) { return n.shift[d] == 0 ? side : 1 - side; };
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      if (n.shift[d] != 0 && isShared(d, side) && n.shift[e] == 0 && n.shift[f] == 0) n.faces.add(cellFace(d, side), cellFace(d, 1 - side));
    }
    if (n.shift[d] != 0) continue;
    for (int i = 0; i < 4; ++i) {
      if (!isShared(e, i & 1) || !isShared(f, i >> 1)) continue;
      n.edges.add(cellEdge(d, i & 1, i >> 1), cellEdge(d, there(e, i & 1), there(f, i >> 1)));
    }
  }
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
    if (isShared(0, x) && isShared(1, y) && isShared(2, z)) n.corners.add(i, there(0, x) + 2 * there(1, y) + 4 * there(2, z));
  }
  return n;
}

/// The 13 of 26 neighbours that come before.
constexpr auto kEarlier = [] {
  std::array<Neighbour, 13> earlier{};
  for (int i = 0; i < 13; ++i) earlier[size_t(i)] = neighbourAt(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
  return earlier;
}();

/// Finds earlier neighbours: each by walking along as the cells ascend.
class EarlierNeighbours {
 public:
  EarlierNeighbours(const Input& input, const std::vector<uint64_t>& keys) : keys_(keys) {
    for (size_t d = 0; d < 3; ++d) most_[d] = 2 * input.cells(int(d));
    for (size_t i = 0; i < kEarlier.size(); ++i) {
      const auto& [dx, dy, dz] = kEarlier[i].shift;
      distances_[i] = (int64_t(dz) * input.cells(1) + dy) * input.cells(0) + dx;
    }
  }

  /// kEarlier[i] of a cell, if it is there. For each i, calls must come with ascending cells.
  std::optional<GridCellId> find(size_t i, const Slab& element, uint64_t key) {
    for (size_t d = 0; d < 3; ++d) {
      const int32_t at = element[d] + 2 * kEarlier[i].shift[d];
      if (at < 0 || at > most_[d]) return {};
    }
    const uint64_t wanted = key + uint64_t(distances_[i]);
    size_t& at = at_[i];
    while (keys_[at] < wanted) ++at;  // the cell itself comes later
    if (keys_[at] != wanted) return {};
    return GridCellId{uint32_t(at)};
  }

 private:
  const std::vector<uint64_t>& keys_;
  int32_t most_[3];
  int64_t distances_[13];
  size_t at_[13] = {};
};

/// Ids of grid-faces, grid-edges and grid vertices: a cell takes over those that an earlier neighbour shares.
void numberElements(const Input& input, const std::vector<uint64_t>& keys, Stencil& stencil, Monitor& monitor) {
  EarlierNeighbours neighbours(input, keys);
  for (const GridCellId c : stencil.cells.ids()) {
    if (c.number % 4096 == 0) monitor.report(c.number, stencil.cells.size());
    Stencil::Cell& cell = stencil.cells[c];
    constexpr uint32_t kNew = ~0u;
    cell.faces.fill({kNew});
    cell.edges.fill({kNew});
    cell.corners.fill({kNew});
    for (size_t i = 0; i < kEarlier.size(); ++i) {
      const auto n = neighbours.find(i, cell.element, keys[c.number]);
      if (!n) continue;
      const Stencil::Cell& other = stencil.cells[*n];
      for (const auto [here, there] : kEarlier[i].faces) cell.faces[here] = other.faces[there];
      for (const auto [here, there] : kEarlier[i].edges) cell.edges[here] = other.edges[there];
      for (const auto [here, there] : kEarlier[i].corners) cell.corners[here] = other.corners[there];
    }
    for (uint8_t i = 0; i < 6; ++i) {
      if (cell.faces[i].number != kNew) continue;
      cell.faces[i] = {uint32_t(stencil.faces.size())};
      stencil.faces.push_back({c, i});
    }
    for (GridEdgeId& edge : cell.edges) {
      if (edge.number == kNew) edge = {stencil.edgeCount++};
    }
    for (GridVertexId& corner : cell.corners) {
      if (corner.number == kNew) corner = {stencil.cornerCount++};
    }
  }
}

uint64_t largestKey(const Input& input) { return keyOf(input, {2 * input.cells(0) - 1, 2 * input.cells(1) - 1, 2 * input.cells(2) - 1}); }

/// The tri-cut-faces, by where they lie.
struct PlacedFaces {
  std::vector<KeyedItem> inCell;   // by cell
  std::vector<FaceId> inPlane;     // in grid-faces
  std::vector<KeyedItem> touched;  // cells beside a grid-face that something lies in
};

PlacedFaces placeFaces(const Surface& surface, const TriFaces& triFaces) {
  const Input& input = surface.input;
  PlacedFaces placed;
  const auto touchBoth = [&](const Slab& gridFace) {
    const int axis = planeAxis(gridFace);
    for (int side = -1; side <= 1; side += 2) {
      Slab cell = gridFace;
      cell[axis] += side;
      if (input.inGrid(cell)) placed.touched.push_back({keyOf(input, cell), 0});
    }
  };
  placed.inCell.reserve(triFaces.size());
  for (const FaceId f : triFaces.ids()) {
    if (planeCount(triFaces.elements[f]) == 0) {
      placed.inCell.push_back({keyOf(input, triFaces.elements[f]), f.number});
    } else {
      placed.inPlane.push_back(f);
      touchBoth(triFaces.elements[f]);
    }
  }
  for (const FaceEdge& e : surface.edgesInPlane) touchBoth(e.element);
  sortByKey(placed.inCell, largestKey(input));
  sortByKey(placed.touched, largestKey(input));
  return placed;
}

/// The cells, ascending, with the tri-cut-faces inside each. Returns their keys.
std::vector<uint64_t> listCells(const Input& input, const PlacedFaces& placed, Stencil& stencil) {
  const auto &inCell = placed.inCell, &touched = placed.touched;
  std::vector<uint64_t> keys;
  for (size_t i = 0, j = 0; i < inCell.size() || j < touched.size();) {
    const uint64_t key = std::min(i < inCell.size() ? inCell[i].key : ~uint64_t(0), j < touched.size() ? touched[j].key : ~uint64_t(0));
    keys.push_back(key);
    for (; i < inCell.size() && inCell[i].key == key; ++i) stencil.triFacesInCell.items.push_back({inCell[i].item});
    stencil.triFacesInCell.endGroup();
    while (j < touched.size() && touched[j].key == key) ++j;
  }
  stencil.cells.resize(keys.size());
  const uint64_t nx = uint64_t(input.cells(0)), ny = uint64_t(input.cells(1));
  for (const GridCellId c : stencil.cells.ids()) {
    const uint64_t key = keys[c.number];
    stencil.cells[c].element = {int32_t(2 * (key % nx) + 1), int32_t(2 * (key / nx % ny) + 1), int32_t(2 * (key / nx / ny) + 1)};
  }
  return keys;
}

/// The grid-faces that n items lie in, found by way of the cells.
template <class ElementOf>
std::vector<GridFaceId> findGridFaces(const Input& input, const std::vector<uint64_t>& keys, const Stencil& stencil, size_t n,
                                      const ElementOf& elementOf) {
  std::vector<KeyedItem> sorted(n);
  Slab cell;
  for (uint32_t i = 0; i < n; ++i) {
    owner(input, elementOf(i), cell);
    sorted[i] = {keyOf(input, cell), i};
  }
  sortByKey(sorted, largestKey(input));
  std::vector<GridFaceId> faceOf(n);
  GridCellId c{0};
  for (size_t i = 0; i < n; ++i) {
    while (keys[c.number] < sorted[i].key) ++c.number;
    faceOf[sorted[i].item] = stencil.cells[c].faces[owner(input, elementOf(sorted[i].item), cell)];
  }
  return faceOf;
}

}  // namespace

std::array<GridVertexId, 4> Stencil::cornersOf(const Face& face) const {
  const Cell& cell = cells[face.cell];
  const int d = face.axis(), base = face.side() << d, p = 1 << (d + 1) % 3, q = 1 << (d + 2) % 3;
  return {cell.corners[base], cell.corners[base + p], cell.corners[base + p + q], cell.corners[base + q]};
}

std::array<GridEdgeId, 4> Stencil::edgesOf(const Face& face) const {
  const Cell& cell = cells[face.cell];
  const int d = face.axis(), side = face.side(), p = (d + 1) % 3, q = (d + 2) % 3;
  return {cell.edges[cellEdge(p, 0, side)], cell.edges[cellEdge(q, side, 1)], cell.edges[cellEdge(p, 1, side)],
          cell.edges[cellEdge(q, side, 0)]};
}

Stencil makeStencil(const Surface& surface, const TriFaces& triFaces, Run& run) {
  const Input& input = surface.input;
  const PlacedFaces placed = placeFaces(surface, triFaces);
  Stencil stencil;
  const std::vector<uint64_t> keys = listCells(input, placed, stencil);
  numberElements(input, keys, stencil, run.monitor);

  const std::vector<FaceEdge>&hybrid = triFaces.hybridEdges, &inPlane = surface.edgesInPlane;
  const auto edgeAt = [&](size_t i) -> const FaceEdge& { return i < hybrid.size() ? hybrid[i] : inPlane[i - hybrid.size()]; };
  const size_t edgeTotal = hybrid.size() + inPlane.size();
  const std::vector<GridFaceId> faceOfEdge =
      findGridFaces(input, keys, stencil, edgeTotal, [&](size_t i) -> const Slab& { return edgeAt(i).element; });
  stencil.edgesOnFace = groupBy<FaceEdge, GridFaceId>(
      stencil.faces.size(), edgeTotal, [&](size_t i) { return faceOfEdge[i]; }, edgeAt);
  const std::vector<FaceId>& flat = placed.inPlane;
  const std::vector<GridFaceId> faceOfTri =
      findGridFaces(input, keys, stencil, flat.size(), [&](size_t i) -> const Slab& { return triFaces.elements[flat[i]]; });
  stencil.triFacesOnFace = groupBy<FaceId, GridFaceId>(
      stencil.faces.size(), flat.size(), [&](size_t i) { return faceOfTri[i]; }, [&](size_t i) { return flat[i]; });
  return stencil;
}

}  // namespace mandoline::detail
