#include "cut/stages/harvest.h"

#include <algorithm>
#include <tuple>

#include "base/sort.h"
#include "cut/stages/ordered_loops.h"

namespace mandoline::detail {
namespace {

/// The sides of a brick's box that a corner or grid-edge of a cell lies on where its cell does, as bits by cellFace(): those of corners,
/// then those of grid-edges, as of BoundaryLine.
constexpr auto kSidesOfLine = [] {
  std::array<uint8_t, 20> sides{};
  for (int i = 0; i < 8; ++i) {
    for (int d = 0; d < 3; ++d) sides[size_t(i)] |= uint8_t(1 << cellFace(d, i >> d & 1));
  }
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < 4; ++i) {
      sides[size_t(8 + cellEdge(d, i & 1, i >> 1))] = uint8_t(1 << cellFace((d + 1) % 3, i & 1) | 1 << cellFace((d + 2) % 3, i >> 1));
    }
  }
  return sides;
}();

class Harvest {
 public:
  Harvest(const BrickStages& stages, const std::vector<Counted>& counted, Gathered& gathered, BrickMemory& memory, BrickCut& out)
      : input_(stages.surface.input),
        vertices_(stages.surface.vertices),
        stencil_(stages.stencil),
        gridEdges_(stages.gridEdges),
        faces_(stages.faces),
        cells_(stages.cells),
        counted_(counted),
        steps_(input_, {input_, faces_.tri.triangles, faces_.tri.otherParents}, counted),
        gathered_(gathered),
        memory_(memory),
        out_(out) {}

  void run() {
    gathered_.clear();
    findComponents();
    listVertices();
    orderFaces();
    for (const GridCellId c : cells_.gridCells) gathered_.gridCells.push_back(indexOf(c));
    listBoundary();
    findSteps();
    findCorner();
    copyAll();
  }

 private:
  std::span<const HalfFace> halvesIn(GridFaceId g) const { return faces_.grid.halfFaces[g]; }
  std::span<const FaceSides> sidesIn(GridFaceId g) const {
    const auto& offsets = faces_.grid.halfFaces.offsets;
    return {cells_.ofGridFaces.data() + offsets[g.number], offsets[g.number + 1] - offsets[g.number]};
  }
  static bool isInside(const FaceSides& sides) { return sides.cells[0] != FaceSides::kNone && sides.cells[1] != FaceSides::kNone; }

  void findComponents() {
    IdSets<CellId> sets;
    sets.reset(cells_.size());
    const auto& halves = faces_.grid.halfFaces.items;
    for (size_t i = 0; i < halves.size(); ++i) {
      const FaceSides& sides = cells_.ofGridFaces[i];
      if (!faces_.isTri(halves[i].face()) && isInside(sides)) sets.unite(sides.cells[0], sides.cells[1]);
    }
    gathered_.components.resize(cells_.size());
    for (const CellId c : gathered_.components.ids()) {
      const CellId first = sets.find(c);
      gathered_.components[c] = first == c ? out_.componentCount++ : gathered_.components[first];
    }
  }

  uint32_t indexOf(GridCellId cell) const { return stencil_.box.indexOf(stencil_.cells[cell].element); }
  /// The sides of the brick's box that a cell lies at, as bits by cellFace().
  uint8_t sidesAt(const Slab& cell) const {
    int sides = 0;
    for (int d = 0; d < 3; ++d) {
      const int32_t at = (cell[size_t(d)] >> 1) - stencil_.box.first[size_t(d)];
      sides |= (at == 0) << cellFace(d, 0) | (at + 1 == stencil_.box.count[size_t(d)]) << cellFace(d, 1);
    }
    return uint8_t(sides);
  }

  void listVertices() {
    GridVertexId corner{0};
    GridEdgeId edge{0};
    for (const GridCellId c : stencil_.cells.ids()) {
      const Stencil::Cell& cell = stencil_.cells[c];
      const uint8_t sides = sidesAt(cell.element);
      forNew(cell.corners, corner, [&](uint8_t i) { addLine(c, i, sides, {&gridEdges_.corners[corner], 1}); });
      forNew(cell.edges, edge, [&](uint8_t i) {
        const auto vertices = gridEdges_.vertices[edge];
        if (!vertices.empty()) addLine(c, uint8_t(8 + i), sides, vertices);
      });
      gathered_.pastVertex.push_back(uint32_t(gathered_.lineVertices.size()));
    }
  }

  /// Calls f(index) for those of a cell's that no cell before has: these are numbered from `next` on, which counts up with them.
  template <class Id, size_t kCount, class F>
  static void forNew(const std::array<Id, kCount>& ofCell, Id& next, const F& f) {
    uint32_t isNew = 0;  // a bit for each
    for (size_t i = 0; i < kCount; ++i) isNew |= uint32_t(ofCell[i] >= next) << i;
    for (; isNew != 0; isNew &= isNew - 1, ++next.number) f(uint8_t(std::countr_zero(isNew)));
  }

  /// Appends the vertices of a grid-edge or grid vertex that are not of the mesh or its edges. `sides`: those that the cell lies at.
  void addLine(GridCellId cell, uint8_t index, uint8_t sides, std::span<const VertexId> vertices) {
    std::vector<VertexId>& all = gathered_.lineVertices;
    const uint32_t first = uint32_t(all.size());
    for (const VertexId v : vertices) {
      if (v >= vertices_.firstInTriangle) all.push_back(v);
    }
    const uint32_t count = uint32_t(all.size()) - first;
    if (count > 1) {
      sortItems(std::span(all).subspan(first), [&](VertexId u, VertexId v) { return vertices_.triangle(u) < vertices_.triangle(v); });
    }
    if (count > 0 && (sides & kSidesOfLine[index]) != 0) gathered_.boundaryLines.push_back({indexOf(cell), index, {first, count}});
  }

  void orderFaces() {
    if (stencil_.triFacesOnFace.items.empty()) {
      gathered_.triOrder = stencil_.triFacesInCell.items;
    } else {
      orderWithThoseInPlanes();
    }
    gathered_.triNumbers.resize(gathered_.triOrder.size());
    for (uint32_t i = 0; i < gathered_.triOrder.size(); ++i) gathered_.triNumbers[gathered_.triOrder[i]] = {i};
  }
  void orderWithThoseInPlanes() {
    GridFaceId g{0};
    for (const GridCellId c : stencil_.cells.ids()) {
      const auto inside = stencil_.triFacesInCell[c];
      gathered_.triOrder.insert(gathered_.triOrder.end(), inside.begin(), inside.end());
      for (; g.number < stencil_.faces.size() && stencil_.faces[g].cell == c; ++g.number) {
        for (const FaceId f : stencil_.triFacesOnFace[g]) {
          gathered_.triFacesInPlane.push_back({uint32_t(gathered_.triOrder.size()), planeOf(g)});
          gathered_.triOrder.push_back(f);
        }
      }
    }
  }
  FaceId numberOf(FaceId face) const { return faces_.isTri(face) ? gathered_.triNumbers[face] : face; }
  HalfFace numbered(HalfFace h) const { return {numberOf(h.face()), h.side()}; }

  AxialPlane planeOf(GridFaceId gridFace) const {
    const Stencil::Face& face = stencil_.faces[gridFace];
    return {face.axis(), stencil_.cells[face.cell].at(face.axis()) + face.side()};
  }

  /// Looks at the grid-faces that have a cell of the brick on one side alone, and ends the rows.
  void listBoundary() {
    uint32_t piece = 0, triFace = 0, cell = 0;
    GridFaceId g{0};
    const uint32_t ny = uint32_t(input_.cells(1));
    lastOpen_.fill({~0u, 0});
    for (const GridCellId c : stencil_.cells.ids()) {
      triFace += uint32_t(stencil_.triFacesInCell[c].size());
      for (; g.number < stencil_.faces.size() && stencil_.faces[g].cell == c; ++g.number) {
        const uint32_t triFaces = uint32_t(stencil_.triFacesOnFace[g].size());
        const uint32_t pieces = uint32_t(halvesIn(g).size()) - triFaces;
        if (!isInside(sidesIn(g)[0])) addOutside(g, {triFace, triFaces}, {piece, pieces});
        piece += pieces;
        triFace += triFaces;
      }
      while (cell < cells_.size() && cells_.gridCells[{cell}] == c) ++cell;
      const uint32_t row = uint32_t(stencil_.cells[c].at(2)) * ny + uint32_t(stencil_.cells[c].at(1));
      const BrickRow past{row, cell, triFace, piece, gathered_.pastVertex[c.number]};
      if (gathered_.rows.empty() || gathered_.rows.back().row != row) {
        gathered_.rows.push_back(past);
      } else {
        gathered_.rows.back() = past;
      }
    }
  }

  void addOutside(GridFaceId g, const Range& triFaces, const Range& pieces) {
    const Stencil::Face& face = stencil_.faces[g];
    Slab other = stencil_.cells[face.cell].element;
    other[size_t(face.axis())] += face.side() == 1 ? 2 : -2;
    if (stencil_.box.has(other)) {
      const FaceSides& sides = sidesIn(g)[0];  // the grid-face is whole
      const OpenFace open{stencil_.box.indexOf(other), gathered_.components[sides.cells[sides.cells[0] != FaceSides::kNone ? 0 : 1]]};
      OpenFace& before = lastOpen_[face.index];
      const bool isSameRun = open.cell == before.cell + 1 && open.component == before.component && other[0] >> 1 != stencil_.box.first[0];
      if (!isSameRun) gathered_.openFaces.push_back(open);
      before = open;
    } else if (input_.inGrid(other)) {
      const uint32_t first = uint32_t(gathered_.boundaryHalves.size());
      for (size_t i = 0; i < halvesIn(g).size(); ++i) {
        const HalfFace h = halvesIn(g)[i];
        BoundaryHalf half{numbered(h), gathered_.components[sidesIn(g)[i].cells[face.side() == 1 ? 0 : 1]], faces_.isTri(h.face()), {}};
        if (half.isTri) half.steps = steps_.at(h.face());
        gathered_.boundaryHalves.push_back(half);
      }
      const Range halves{first, uint32_t(gathered_.boundaryHalves.size()) - first};
      gathered_.boundaryFaces.push_back({indexOf(face.cell), face.index, triFaces, pieces, halves});
    }
  }

  void findSteps() {
    if (counted_.empty()) return;
    WindingStep last{~0u, ~0u, {}};
    CellId lastBehind = FaceSides::kNone, lastInFront = FaceSides::kNone;
    const auto add = [&](FaceId face, CellId behind, CellId inFront) {
      if (steps_.areAlike() && behind == lastBehind && inFront == lastInFront) return;
      lastBehind = behind;
      lastInFront = inFront;
      const WindingStep step{gathered_.components[behind], gathered_.components[inFront], steps_.at(face)};
      if (step == last) return;
      gathered_.steps.push_back(last = step);
    };
    for (size_t i = 0; i < cells_.ofTriFaces.size(); ++i) {
      const auto& [behind, inFront] = cells_.ofTriFaces[i].cells;
      add(stencil_.triFacesInCell.items[i], behind, inFront);
    }
    for (const GridFaceId g : stencil_.faces.ids()) {
      for (size_t i = 0; i < halvesIn(g).size(); ++i) {
        const HalfFace h = halvesIn(g)[i];
        const FaceSides& sides = sidesIn(g)[i];
        if (faces_.isTri(h.face()) && isInside(sides)) add(h.face(), sides.cells[h.side()], sides.cells[1 - h.side()]);
      }
    }
    sortUnique(gathered_.steps);
  }

  /// Finds the cell that holds the point of windingBeside() at the grid's lowest corner, if the surface touches its grid cell. The
  /// grid-face x = x0 holds the point's shadow right beside the y-axis: in the face with the directed edge from the corner along y.
  void findCorner() {
    const auto cell = stencil_.find({1, 1, 1});
    if (!cell) return;
    const GridFaceId g = stencil_.cells[*cell].faces[size_t(cellFace(0, 0))];
    const VertexId corner = gridEdges_.corners[stencil_.cells[*cell].corners[0]];
    const auto along = gridEdges_.vertices[stencil_.cells[*cell].edges[size_t(cellEdge(1, 0, 0))]];
    const VertexId next = along.empty() ? gridEdges_.corners[stencil_.cells[*cell].corners[2]] : along[0];
    for (size_t k = 0; k < halvesIn(g).size(); ++k) {
      const HalfFace fromBelow = halvesIn(g)[k];
      const auto loop = faces_.loops(fromBelow.face())[0];
      for (size_t i = 0; i < loop.size(); ++i) {
        VertexId u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
        if (fromBelow.side() == 1) std::swap(u, v);  // a triangle's face whose normal is -x
        if (u == corner && v == next) out_.componentAtCorner = gathered_.components[sidesIn(g)[k].cells[1]];
      }
    }
  }

  void copyTriLoops() {
    const TriFaces& tri = faces_.tri;
    const bool haveOneEach = tri.faceLoopOffsets.empty();
    out_.triLoops.offsets = memory_.faces.make<uint32_t>(haveOneEach ? 0 : tri.faceLoopOffsets.size(), [&](std::span<uint32_t> offsets) {
      uint32_t at = 0;
      for (size_t i = 0; i < tri.size(); ++i) {
        offsets[i] = at;
        at += uint32_t(tri.loopsOf(gathered_.triOrder[i]).size());
      }
      offsets.back() = at;
    });
    out_.triLoops.loops.offsets = memory_.faces.make<uint32_t>(tri.loops.offsets.size(), [&](std::span<uint32_t> offsets) {
      offsets.back() = uint32_t(tri.loops.items.size());
      out_.triLoops.loops.items = memory_.faces.make<uint32_t>(tri.loops.items.size(), [&](std::span<uint32_t> items) {
        VertexPlaces places(vertices_, gathered_.places, gathered_.surfaceVertices);
        writeOrderedLoops(tri, gathered_.triOrder, items, offsets.data());  // all of them first, since how long a loop is can't be foretold
        places.of(
            items.size(), [=](size_t i) { return VertexId{items[i]}; }, items.data());
      });
    });
  }

  void copyTriFaces() {
    const TriFaces& tri = faces_.tri;
    copyTriLoops();
    out_.triangles = memory_.faces.make<TriangleId>(tri.size(), [&](std::span<TriangleId> triangles) {
      for (size_t i = 0; i < triangles.size(); ++i) triangles[i] = tri.triangles[gathered_.triOrder[i]];
    });
    out_.otherParents = memory_.faces.make<OtherParent>(tri.otherParents.size(), [&](std::span<OtherParent> parents) {
      std::transform(tri.otherParents.begin(), tri.otherParents.end(), parents.begin(), [&](const OtherParent& o) {
        return OtherParent{numberOf(o.face), o.triangle, o.sameWay};
      });
      sortItems(parents,
                [](const OtherParent& a, const OtherParent& b) { return std::tie(a.face, a.triangle) < std::tie(b.face, b.triangle); });
    });
    out_.triFacesInPlane = memory_.faces.copy(gathered_.triFacesInPlane);
  }

  void copyPieces() {
    const auto& loops = faces_.grid.loops;
    out_.pieceLoops.offsets = memory_.faces.copy(faces_.grid.faceLoopOffsets);
    out_.pieceLoops.loops.offsets = memory_.faces.copy(loops.offsets);
    out_.pieceLoops.loops.items = memory_.faces.make<uint32_t>(loops.items.size(), [&](std::span<uint32_t> items) {
      VertexPlaces places(vertices_, gathered_.places, gathered_.surfaceVertices);
      places.of(
          items.size(), [&](size_t i) { return loops.items[i]; }, items.data());
    });
    const auto& gridFaces = faces_.grid.gridFaces;
    out_.pieces = memory_.faces.make<AxialPlane>(gridFaces.size(), [&](std::span<AxialPlane> planes) {
      for (size_t i = 0; i < planes.size(); ++i)
        planes[i] = i > 0 && gridFaces[i] == gridFaces[i - 1] ? planes[i - 1] : planeOf(gridFaces[i]);
    });
  }

  void copyAll() {
    out_.vertices.slabs = vertices_.slabs;
    out_.vertices.parentTriangles = vertices_.parentTriangles;
    copyTriFaces();
    copyPieces();
    out_.surfaceVertices = memory_.vertices.copy(gathered_.surfaceVertices);
    out_.lineVertices = memory_.vertices.copy(gathered_.lineVertices);
    const auto& halves = cells_.halfFaces;
    out_.halfFaces.offsets = memory_.cells.copy(halves.offsets);
    out_.halfFaces.items = memory_.cells.make<HalfFace>(halves.items.size(), [&](std::span<HalfFace> items) {
      const FaceId* const numbers = gathered_.triNumbers.data();
      const size_t pastTri = faces_.tri.size();
      std::transform(halves.items.begin(), halves.items.end(), items.begin(),
                     [=](HalfFace h) { return h.face().number < pastTri ? HalfFace(numbers[h.face().number], h.side()) : h; });
    });
    out_.gridCells = memory_.cells.copy(gathered_.gridCells);
    out_.components = memory_.cells.copy(gathered_.components);
    out_.rows = memory_.vertices.copy(gathered_.rows);
    out_.boundaryFaces = memory_.seams.copy(gathered_.boundaryFaces);
    out_.boundaryHalves = memory_.seams.copy(gathered_.boundaryHalves);
    out_.boundaryLines = memory_.seams.copy(gathered_.boundaryLines);
    out_.openFaces = memory_.seams.copy(gathered_.openFaces);
    out_.steps = memory_.seams.copy(gathered_.steps);
  }

  const Input& input_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
  const GridEdges& gridEdges_;
  const CutFaces& faces_;
  const CutCells& cells_;
  const std::vector<Counted>& counted_;
  const FaceSteps steps_;
  Gathered& gathered_;
  BrickMemory& memory_;
  BrickCut& out_;
  std::array<OpenFace, 6> lastOpen_{};  // per side of a cell; the next one may lie beside the same run of untouched cells
};

}  // namespace

void harvest(const BrickStages& stages, const std::vector<Counted>& counted, Gathered& gathered, BrickMemory& memory, BrickCut& out) {
  Harvest(stages, counted, gathered, memory, out).run();
}

}  // namespace mandoline::detail
