#include "cut/stages/brick_cut.h"

#include <memory>
#include <numeric>

#include "base/large_array.h"
#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// Takes from the stages of a brick what the result needs of it.
class Harvest {
 public:
  Harvest(const BrickSurface& surface, const Stencil& stencil, const GridEdges& gridEdges, const CutFaces& faces, const CutCells& cells,
          BrickCut& out)
      : input_(surface.input),
        vertices_(surface.vertices),
        stencil_(stencil),
        gridEdges_(gridEdges),
        faces_(faces),
        cells_(cells),
        out_(out) {}

  void run(const std::vector<Counted>& counted) {
    findComponents();
    copyVertices();
    copyFaces();
    copyCells();
    listBoundary();
    findSteps(counted);
    findCorner();
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
    for (const GridFaceId g : stencil_.faces.ids()) {
      for (size_t i = 0; i < halvesIn(g).size(); ++i) {
        const FaceSides& sides = sidesIn(g)[i];
        if (!faces_.isTri(halvesIn(g)[i].face()) && isInside(sides)) sets.unite(sides.cells[0], sides.cells[1]);
      }
    }
    out_.components.resize(cells_.size());
    for (const CellId c : out_.components.ids()) {
      const CellId first = sets.find(c);
      out_.components[c] = first == c ? out_.componentCount++ : out_.components[first];
    }
  }

  uint32_t indexOf(GridCellId cell) const { return stencil_.box.indexOf(stencil_.cells[cell].element); }
  bool isOnBoundary(const Slab& element) const {
    bool isOn = false;
    for (size_t d = 0; d < 3; ++d) {
      const int32_t first = 2 * stencil_.box.first[d];
      isOn |= element[d] == first || element[d] == first + 2 * stencil_.box.count[d];
    }
    return isOn;
  }

  void copyVertices() {
    copy(vertices_.slabs, out_.vertices.slabs);
    copy(vertices_.parentTriangles, out_.vertices.parentTriangles);
    out_.lineVertices.reserve(vertices_.slabs.size());
    GridVertexId corner{0};
    GridEdgeId edge{0};
    for (const GridCellId c : stencil_.cells.ids()) {
      const Stencil::Cell& cell = stencil_.cells[c];
      for (uint8_t i = 0; i < 8; ++i) {
        if (cell.corners[i] != corner) continue;  // a cell before has it
        ++corner.number;
        const VertexId v = gridEdges_.corners[cell.corners[i]];
        addLine(c, i, {&v, 1});
      }
      for (uint8_t i = 0; i < 12; ++i) {
        if (cell.edges[i] != edge) continue;
        ++edge.number;
        addLine(c, uint8_t(8 + i), gridEdges_.vertices[cell.edges[i]]);
      }
      pastVertex_.push_back(uint32_t(out_.lineVertices.size()));
    }
  }

  /// Appends the vertices of a grid-edge or grid vertex that are not of the mesh or its edges.
  void addLine(GridCellId cell, uint8_t index, std::span<const VertexId> vertices) {
    std::vector<VertexId>& all = out_.lineVertices;
    const uint32_t first = uint32_t(all.size());
    for (const VertexId v : vertices) {
      if (v >= vertices_.firstInTriangle) all.push_back(v);
    }
    const uint32_t count = uint32_t(all.size()) - first;
    if (count == 0) return;
    if (count > 1) {
      sortItems(std::span(all).subspan(first), [&](VertexId u, VertexId v) { return vertices_.triangle(u) < vertices_.triangle(v); });
    }
    if (isOnBoundary(vertices_.slab(all[first]))) out_.boundaryLines.push_back({indexOf(cell), index, {first, count}});
  }

  /// What the stages have room for, and no more.
  template <class T>
  static void copy(const T& from, T& to) {
    copyLarge(from, to);
  }
  template <class Item, class Group>
  static void copy(const Csr<Item, Group>& from, Csr<Item, Group>& to) {
    copy(from.offsets, to.offsets);
    copy(from.items, to.items);
  }

  void copyFaces() {
    const TriFaces& tri = faces_.tri;
    copy(tri.loops, out_.triLoops);
    copy(tri.faceLoopOffsets, out_.triFaceLoopOffsets);
    copy(tri.triangles, out_.triangles);
    copy(tri.otherParents, out_.otherParents);
    copy(faces_.grid.loops, out_.loops);
    copy(faces_.grid.faceLoopOffsets, out_.faceLoopOffsets);
    out_.pieces.reserve(faces_.grid.size());
    for (const GridFaceId g : faces_.grid.gridFaces) out_.pieces.push_back(planeOf(g));
    out_.triOrder.reserve(tri.size());
    GridFaceId g{0};
    for (const GridCellId c : stencil_.cells.ids()) {
      const auto inside = stencil_.triFacesInCell[c];
      out_.triOrder.insert(out_.triOrder.end(), inside.begin(), inside.end());
      for (; g.number < stencil_.faces.size() && stencil_.faces[g].cell == c; ++g.number) {
        for (const FaceId f : stencil_.triFacesOnFace[g]) {
          out_.triFacesInPlane.push_back({uint32_t(out_.triOrder.size()), planeOf(g)});
          out_.triOrder.push_back(f);
        }
      }
    }
  }

  AxialPlane planeOf(GridFaceId gridFace) const {
    const Stencil::Face& face = stencil_.faces[gridFace];
    return {face.axis(), stencil_.cells[face.cell].at(face.axis()) + face.side()};
  }

  void copyCells() {
    copy(cells_.halfFaces, out_.halfFaces);
    out_.gridCells.reserve(cells_.size());
    for (const GridCellId c : cells_.gridCells) out_.gridCells.push_back(indexOf(c));
  }

  /// Looks at the grid-faces that have a cell of the brick on one side alone, and ends the rows.
  void listBoundary() {
    uint32_t piece = 0, triFace = 0, cell = 0;
    GridFaceId g{0};
    const uint32_t ny = uint32_t(input_.cells(1));
    for (const GridCellId c : stencil_.cells.ids()) {
      triFace += uint32_t(stencil_.triFacesInCell[c].size());
      for (; g.number < stencil_.faces.size() && stencil_.faces[g].cell == c; ++g.number) {
        const uint32_t triFaces = uint32_t(stencil_.triFacesOnFace[g].size());
        uint32_t pieces = 0;
        for (const HalfFace h : halvesIn(g)) pieces += !faces_.isTri(h.face());
        addOutside(g, {triFace, triFaces}, {piece, pieces});
        piece += pieces;
        triFace += triFaces;
      }
      while (cell < cells_.size() && cells_.gridCells[{cell}] == c) ++cell;
      const uint32_t row = uint32_t(stencil_.cells[c].at(2)) * ny + uint32_t(stencil_.cells[c].at(1));
      const BrickRow past{row, cell, triFace, piece, pastVertex_[c.number]};
      if (out_.rows.empty() || out_.rows.back().row != row) {
        out_.rows.push_back(past);
      } else {
        out_.rows.back() = past;
      }
    }
  }

  void addOutside(GridFaceId g, const Range& triFaces, const Range& pieces) {
    const Stencil::Face& face = stencil_.faces[g];
    Slab other = stencil_.cells[face.cell].element;
    other[size_t(face.axis())] += face.side() == 1 ? 2 : -2;
    if (stencil_.box.has(other)) {
      if (stencil_.find(other)) return;
      const FaceSides& sides = sidesIn(g)[0];  // the grid-face is whole
      const OpenFace open{stencil_.box.indexOf(other), out_.components[sides.cells[sides.cells[0] != FaceSides::kNone ? 0 : 1]]};
      out_.openFaces.push_back(open);
    } else if (input_.inGrid(other)) {
      const uint32_t first = uint32_t(out_.boundaryHalves.size());
      for (size_t i = 0; i < halvesIn(g).size(); ++i) {
        out_.boundaryHalves.push_back({halvesIn(g)[i], out_.components[sidesIn(g)[i].cells[face.side() == 1 ? 0 : 1]]});
      }
      const Range halves{first, uint32_t(out_.boundaryHalves.size()) - first};
      out_.boundaryFaces.push_back({indexOf(face.cell), face.index, triFaces, pieces, halves});
    }
  }

  void findSteps(const std::vector<Counted>& counted) {
    if (counted.empty()) return;
    const FaceParents parents(input_, faces_.tri.triangles, faces_.tri.otherParents);
    const bool areAlike = input_.mesh->closed && parents.areSingle();
    WindingStep last{~0u, ~0u, {}};
    const auto add = [&](FaceId face, CellId behind, CellId inFront) {
      const WindingStep step{out_.components[behind], out_.components[inFront],
                             areAlike ? std::array<int32_t, 2>{1, 0} : stepsAt(face, parents, counted)};
      if (step == last) return;
      out_.steps.push_back(last = step);
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
    sortUnique(out_.steps);
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
        if (u == corner && v == next) out_.componentAtCorner = out_.components[sidesIn(g)[k].cells[1]];
      }
    }
  }

  const Input& input_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
  const GridEdges& gridEdges_;
  const CutFaces& faces_;
  const CutCells& cells_;
  BrickCut& out_;
  std::vector<uint32_t> pastVertex_;  // per cell of the stencil: of those that it, or one before it, has first
};

/// Cuts bricks one after the other, on one thread.
class BrickCutter {
 public:
  BrickCutter(const Surface& surface, const SurfaceParts& parts, Bricks& bricks, bool onlyGeneral)
      : surface_(surface), parts_(parts), bricks_(bricks), counted_(countedOf(*surface.input.mesh)), brickSurface_(surface) {
    gridFaceScratch_.onlyGraph = cellScratch_.onlyGeneral = onlyGeneral;
  }

  BrickCut cut(BrickId brick) {
    cutBrickSurface(surface_, parts_, brick, bricks_, brickSurface_);
    makeStencil(brickSurface_, bricks_, brick, stencil_);
    cutGridEdges(brickSurface_, stencil_, gridEdges_);
    cutGridFaces(brickSurface_, stencil_, gridEdges_, gridFaceScratch_, gridFaces_);
    const CutFaces faces{brickSurface_.triFaces, gridFaces_};
    makeCutCells(brickSurface_, stencil_, faces, cellScratch_, cells_);
    BrickCut result(surface_.vertices);
    Harvest(brickSurface_, stencil_, gridEdges_, faces, cells_, result).run(counted_);
    return result;
  }

  void count(Run& run) const {
    run.count(brickSurface_.predicates);
    run.count(gridEdges_.predicates);
    run.count(gridFaceScratch_.predicates);
    run.count(cellScratch_.predicates);
  }

 private:
  const Surface& surface_;
  const SurfaceParts& parts_;
  Bricks& bricks_;
  const std::vector<Counted> counted_;
  BrickSurface brickSurface_;
  Stencil stencil_;
  GridEdges gridEdges_;
  GridFaceScratch gridFaceScratch_;
  GridFaces gridFaces_;
  CellScratch cellScratch_;
  CutCells cells_;
};

}  // namespace

IdVector<BrickId, BrickCut> cutBricks(const Surface& surface, const SurfaceParts& parts, Bricks& bricks, Run& run) {
  IdVector<BrickId, BrickCut> cuts(bricks.size());
  const auto weightOf = [&](uint32_t b) { return bricks.parts[{b}].size() + bricks.dividedFaces[{b}].size(); };
  std::vector<uint32_t> order(cuts.size());
  std::iota(order.begin(), order.end(), 0u);
  sortItems(order, [&](uint32_t a, uint32_t b) { return weightOf(a) > weightOf(b); });  // the heaviest first
  std::vector<std::unique_ptr<BrickCutter>> cutters(run.monitor.threads());
  runItems(order, run.monitor, [&](size_t thread, uint32_t b) {
    if (!cutters[thread]) cutters[thread] = std::make_unique<BrickCutter>(surface, parts, bricks, run.onlyGeneral);
    cuts[{b}] = cutters[thread]->cut({b});
  });
  for (const auto& cutter : cutters) {
    if (cutter) cutter->count(run);
  }
  return cuts;
}

}  // namespace mandoline::detail
