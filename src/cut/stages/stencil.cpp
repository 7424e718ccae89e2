#include "cut/stages/stencil.h"

#include <utility>

#include "base/appender.h"

namespace mandoline::detail {
namespace {

/// Some of a cell's grid-faces, grid-edges and corners, a bit for each.
struct Elements {
  uint32_t faces = 0, edges = 0, corners = 0;

  constexpr void add(const Elements& more) {
    faces |= more.faces;
    edges |= more.edges;
    corners |= more.corners;
  }
};

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
  Elements has;  ///< those, in the cell
};

constexpr Neighbour neighbourAt(int dx, int dy, int dz) {
  Neighbour n{{dx, dy, dz}, {}, {}, {}, {}};
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
  for (const auto& shared : n.faces) n.has.faces |= 1u << shared.here;
  for (const auto& shared : n.edges) n.has.edges |= 1u << shared.here;
  for (const auto& shared : n.corners) n.has.corners |= 1u << shared.here;
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
  size_t touched = 0;
  for (const uint64_t word : bricks.wordsOf(brick)) touched += size_t(std::popcount(word));
  if (stencil.cells.capacity() < touched) stencil.cells.reserve(touched + touched / 4);
  stencil.box = bricks.boxes[brick];
  const auto &first = stencil.box.first, &count = stencil.box.count;
  stencil.steps = {1, size_t(count[0] + 2), size_t(count[0] + 2) * size_t(count[1] + 2)};
  stencil.placeOfFirst = 0;
  for (size_t d = 0; d < 3; ++d) stencil.placeOfFirst += size_t(ptrdiff_t(1 - first[d])) * stencil.steps[d];
  const size_t size = stencil.steps[2] * size_t(count[2] + 2);
  if (stencil.table.size() < size) stencil.table.resize(size, Stencil::kNone);
  Slab row = {0, 2 * first[1] + 1, 2 * first[2] + 1};  // of cells
  uint32_t begin = 0;                                  // of the row
  bricks.forTouched(brick, [&](uint32_t index) {
    for (; index - begin >= uint32_t(count[0]); begin += uint32_t(count[0])) {
      row[1] += 2;
      if (row[1] < 2 * (first[1] + count[1])) continue;
      row[1] = 2 * first[1] + 1;
      row[2] += 2;
    }
    stencil.cells.push_back({{2 * (first[0] + int32_t(index - begin)) + 1, row[1], row[2]}, {}, {}, {}});
    stencil.table[stencil.placeOf(stencil.cells.back().element)] = uint32_t(stencil.cells.size() - 1);
  });
}

/// Ids of grid-faces, grid-edges and grid vertices: a cell takes over those that an earlier neighbour shares.
class Numbering {
 public:
  explicit Numbering(Stencil& stencil) : stencil_(stencil), faces_(stencil.faces, 6 * stencil.cells.size()) {
    stencil.edgeCount = stencil.cornerCount = 0;
  }

  void run() {
    for (const GridCellId c : stencil_.cells.ids()) {
      Stencil::Cell& cell = stencil_.cells[c];
      const uint32_t* at = &stencil_.table[stencil_.placeOf(cell.element)];
      const Elements known = takeOver(at, cell, std::make_index_sequence<kEarlier.size()>());
      forOthers<6>(known.faces, [&](uint32_t i) {
        cell.faces[i] = {uint32_t(faces_.size())};
        faces_.add({c, uint8_t(i)});
      });
      forOthers<12>(known.edges, [&](uint32_t i) { cell.edges[i] = {stencil_.edgeCount++}; });
      forOthers<8>(known.corners, [&](uint32_t i) { cell.corners[i] = {stencil_.cornerCount++}; });
    }
  }

 private:
  /// `at`: the cell in the table. Gives what it took over.
  template <size_t... kNeighbours>
  Elements takeOver(const uint32_t* at, Stencil::Cell& cell, std::index_sequence<kNeighbours...>) const {
    Elements known;
    (takeOverFrom<kNeighbours>(at, cell, known), ...);
    return known;
  }
  template <size_t kNeighbour>
  void takeOverFrom(const uint32_t* at, Stencil::Cell& cell, Elements& known) const {
    constexpr Neighbour neighbour = kEarlier[kNeighbour];
    const auto& [x, y, z] = neighbour.shift;
    const uint32_t n = at[x + y * ptrdiff_t(stencil_.steps[1]) + z * ptrdiff_t(stencil_.steps[2])];
    if (n == Stencil::kNone) return;
    const Stencil::Cell& other = stencil_.cells[GridCellId{n}];
    for (const auto [here, there] : neighbour.faces) cell.faces[here] = other.faces[there];
    for (const auto [here, there] : neighbour.edges) cell.edges[here] = other.edges[there];
    for (const auto [here, there] : neighbour.corners) cell.corners[here] = other.corners[there];
    known.add(neighbour.has);
  }
  template <uint32_t kCount, class F>
  static void forOthers(uint32_t known, const F& f) {
    for (uint32_t rest = known ^ ((1u << kCount) - 1); rest != 0; rest &= rest - 1) f(uint32_t(std::countr_zero(rest)));
  }

  Stencil& stencil_;
  Appender<Stencil::Face> faces_;
};

/// A grid-face that a cell of the stencil has.
GridFaceId faceAt(const Stencil& stencil, const Slab& gridFace) {
  const int axis = planeAxis(gridFace);
  const size_t above = stencil.placeOf(gridFace);
  uint32_t number = stencil.numberAt(above - stencil.steps[size_t(axis)]);
  const bool isBelow = number != Stencil::kNone;
  if (!isBelow) number = stencil.numberAt(above);
  return stencil.cells[{number}].faces[size_t(cellFace(axis, isBelow))];
}

}  // namespace

std::optional<GridCellId> Stencil::find(const Slab& cell) const {
  if (!box.has(cell)) return {};
  const uint32_t number = table[placeOf(cell)];
  if (number == kNone) return {};
  return GridCellId{number};
}

void makeStencil(const BrickSurface& surface, const Bricks& bricks, BrickId brick, Stencil& stencil) {
  listCells(bricks, brick, stencil);
  Numbering(stencil).run();

  const TriFaces& triFaces = surface.triFaces;
  std::vector<GridCellId>& cells = stencil.cellOf;
  std::vector<GridFaceId>& faces = stencil.faceOf;
  std::vector<FaceId> inPlane;
  std::vector<GridFaceId> planes;  // that these lie in
  cells.resize(triFaces.size());
  for (const FaceId f : triFaces.ids()) {
    const Slab& element = triFaces.elements[f];
    if (isCell(element)) {
      cells[f.number] = {stencil.numberAt(stencil.placeOf(element))};
    } else {
      cells[f.number] = {Stencil::kNone};
      planes.push_back(faceAt(stencil, element));
      inPlane.push_back(f);
    }
  }
  groupByPlace(
      stencil.cells.size(), cells, [](uint32_t i) { return FaceId{i}; }, stencil.triFacesInCell);
  groupByPlace(
      stencil.faces.size(), planes, [&](uint32_t i) { return inPlane[i]; }, stencil.triFacesOnFace);
  faces.resize(surface.faceEdges.size());
  const auto edgeOf = [&](uint32_t i) { return EdgeOnFace{surface.faceEdges[i].from, surface.faceEdges[i].to}; };
  for (size_t i = 0; i < faces.size(); ++i) faces[i] = faceAt(stencil, surface.faceEdges[i].element);
  groupByPlace(stencil.faces.size(), faces, edgeOf, stencil.edgesOnFace);
}

}  // namespace mandoline::detail
