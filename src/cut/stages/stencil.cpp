#include "cut/stages/stencil.h"

namespace mandoline::detail {
namespace {

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

/// The touched cells of a brick, ascending.
void listCells(const Bricks& bricks, BrickId brick, Stencil& stencil) {
  for (const Stencil::Cell& cell : stencil.cells) stencil.table[stencil.placeOf(cell.element)] = Stencil::kNone;
  stencil.cells.clear();
  stencil.box = bricks.boxes[brick];
  const auto& count = stencil.box.count;
  const size_t size = size_t(count[0] + 2) * size_t(count[1] + 2) * size_t(count[2] + 2);
  if (stencil.table.size() < size) stencil.table.resize(size, Stencil::kNone);
  bricks.forTouched(brick, [&](uint32_t index) {
    stencil.cells.push_back({stencil.box.cellAt(index), {}, {}, {}});
    stencil.table[stencil.placeOf(stencil.cells.back().element)] = uint32_t(stencil.cells.size() - 1);
  });
}

/// Ids of grid-faces, grid-edges and grid vertices: a cell takes over those that an earlier neighbour shares.
void numberElements(Stencil& stencil) {
  std::array<size_t, kEarlier.size()> distances;  // in the table, to earlier cells
  for (size_t i = 0; i < kEarlier.size(); ++i) {
    const auto& [x, y, z] = kEarlier[i].shift;
    distances[i] = size_t(-((ptrdiff_t(z) * (stencil.box.count[1] + 2) + y) * (stencil.box.count[0] + 2) + x));
  }
  stencil.faces.clear();
  stencil.edgeCount = stencil.cornerCount = 0;
  for (const GridCellId c : stencil.cells.ids()) {
    Stencil::Cell& cell = stencil.cells[c];
    constexpr uint32_t kNew = ~0u;
    cell.faces.fill({kNew});
    cell.edges.fill({kNew});
    cell.corners.fill({kNew});
    const uint32_t* at = &stencil.table[stencil.placeOf(cell.element)];
    for (size_t i = 0; i < kEarlier.size(); ++i) {
      const uint32_t n = *(at - distances[i]);
      if (n == Stencil::kNone) continue;
      const Stencil::Cell& other = stencil.cells[GridCellId{n}];
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

template <class Item, class Place>
struct Placed {
  Item item;
  Place place;
};

template <class Item, class Place>
Csr<Item, Place> grouped(size_t places, const std::vector<Placed<Item, Place>>& placed) {
  return groupBy<Item, Place>(
      places, placed.size(), [&](size_t i) { return placed[i].place; }, [&](size_t i) { return placed[i].item; });
}

/// A grid-face that a cell of the stencil has.
GridFaceId faceAt(const Stencil& stencil, const Slab& gridFace) {
  const int axis = planeAxis(gridFace);
  Slab cell = gridFace;
  --cell[size_t(axis)];
  uint32_t number = stencil.table[stencil.placeOf(cell)];
  const bool isBelow = number != Stencil::kNone;
  if (!isBelow) {
    cell[size_t(axis)] += 2;
    number = stencil.table[stencil.placeOf(cell)];
  }
  return stencil.cells[{number}].faces[size_t(cellFace(axis, isBelow))];
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

std::optional<GridCellId> Stencil::find(const Slab& cell) const {
  if (!box.has(cell)) return {};
  const uint32_t number = table[placeOf(cell)];
  if (number == kNone) return {};
  return GridCellId{number};
}

std::optional<GridCellId> Stencil::cellBeside(const Slab& element) const {
  std::optional<GridCellId> found;
  findCellAround(element, [&](const Slab& cell) { return (found = find(cell)).has_value(); });
  return found;
}

void makeStencil(const BrickSurface& surface, const Bricks& bricks, BrickId brick, Stencil& stencil) {
  listCells(bricks, brick, stencil);
  numberElements(stencil);

  const TriFaces& triFaces = surface.triFaces;
  std::vector<Placed<FaceId, GridCellId>> inCell;
  std::vector<Placed<FaceId, GridFaceId>> onFace;
  std::vector<Placed<FaceEdge, GridFaceId>> edges;
  inCell.reserve(triFaces.size());
  for (const FaceId f : triFaces.ids()) {
    const Slab& element = triFaces.elements[f];
    if (planeCount(element) == 0) {
      inCell.push_back({f, {stencil.table[stencil.placeOf(element)]}});
    } else {
      onFace.push_back({f, faceAt(stencil, element)});
    }
  }
  edges.reserve(surface.faceEdges.size());
  for (const FaceEdge& edge : surface.faceEdges) edges.push_back({edge, faceAt(stencil, edge.element)});
  stencil.triFacesInCell = grouped(stencil.cells.size(), inCell);
  stencil.triFacesOnFace = grouped(stencil.faces.size(), onFace);
  stencil.edgesOnFace = grouped(stencil.faces.size(), edges);
}

}  // namespace mandoline::detail
