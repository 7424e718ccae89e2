#include "cut/stages/brick_cut.h"

#include <memory>
#include <numeric>

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// Takes from the stages of a brick what the result needs of it.
class Harvest {
 public:
  Harvest(const CutSurface& surface, BrickId brick, const Stencil& stencil, const CutFaces& faces, const CutCells& cells)
      : input_(surface.surface.input),
        bricks_(surface.bricks),
        brick_(brick),
        stencil_(stencil),
        faces_(faces),
        cells_(cells),
        pastPiece_(stencil.cells.size(), 0),
        pastGridVertex_(stencil.cells.size(), 0) {}

  void run(const UntouchedRuns& runs, const std::vector<Counted>& counted, const GridEdges& gridEdges, BrickCut& out) {
    findComponents(out);
    findNeighbours(runs, out);
    findSteps(counted, out);
    findSeamVertices(gridEdges, out);
    findCorner(gridEdges, out);
    copy(out);
    countRows(out);
  }

 private:
  std::span<const HalfFace> halvesIn(GridFaceId g) const { return faces_.grid.halfFaces[g]; }
  std::span<const FaceSides> sidesIn(GridFaceId g) const {
    const auto& offsets = faces_.grid.halfFaces.offsets;
    return {cells_.ofGridFaces.data() + offsets[g.number], offsets[g.number + 1] - offsets[g.number]};
  }
  static bool isInside(const FaceSides& sides) { return sides.cells[0] != FaceSides::kNone && sides.cells[1] != FaceSides::kNone; }

  void findComponents(BrickCut& out) const {
    IdSets<CellId> sets;
    sets.reset(cells_.size());
    for (const GridFaceId g : stencil_.faces.ids()) {
      for (size_t i = 0; i < halvesIn(g).size(); ++i) {
        const FaceSides& sides = sidesIn(g)[i];
        if (!faces_.isTri(halvesIn(g)[i].face()) && isInside(sides)) sets.unite(sides.cells[0], sides.cells[1]);
      }
    }
    out.components.resize(cells_.size());
    for (const CellId c : out.components.ids()) {
      const CellId first = sets.find(c);
      out.components[c] = first == c ? out.componentCount++ : out.components[first];
    }
  }

  /// Looks at the grid-faces that have a cell of the brick on one side alone.
  void findNeighbours(const UntouchedRuns& runs, BrickCut& out) {
    uint32_t piece = 0;
    for (const GridFaceId g : stencil_.faces.ids()) {
      const Stencil::Face& face = stencil_.faces[g];
      const uint32_t first = piece;
      for (const HalfFace h : halvesIn(g)) piece += !faces_.isTri(h.face());
      pastPiece_[face.cell.number] = piece;
      Slab other = stencil_.cells[face.cell].element;
      other[size_t(face.axis())] += face.side() == 1 ? 2 : -2;
      if (!input_.inGrid(other) || stencil_.find(other)) continue;
      if (const auto brick = stencil_.box.has(other) ? std::nullopt : bricks_.findTouched(other)) {
        addSeam(g, first, piece - first, out);
        if (face.side() == 0) out.otherSeams.back().place = {*brick, keyOf(*brick, other, cellFace(face.axis(), 1))};
      } else {
        const FaceSides& sides = sidesIn(g)[0];  // the grid-face is whole
        join(out.components[sides.cells[sides.cells[0] != FaceSides::kNone ? 0 : 1]], runs.at(other), out);
      }
    }
    for (size_t c = 1; c < pastPiece_.size(); ++c) pastPiece_[c] = std::max(pastPiece_[c], pastPiece_[c - 1]);
  }

  /// Leaves out most of those that are known: runs along a surface are met again and again.
  void join(uint32_t component, uint32_t run, BrickCut& out) const {
    constexpr size_t kLast = 16;
    const std::array<uint32_t, 2> join{component, run};
    const auto end = out.joins.end(), begin = end - ptrdiff_t(std::min(kLast, out.joins.size()));
    if (std::find(begin, end, join) == end) out.joins.push_back(join);
  }

  uint32_t keyOf(BrickId brick, const Slab& cell, int element) const { return 8 * bricks_.boxes[brick].indexOf(cell) + uint32_t(element); }

  /// Of two cells the one below the plane comes first, so the grid-face belongs to that one.
  void addSeam(GridFaceId g, uint32_t firstPiece, uint32_t pieces, BrickCut& out) const {
    const Stencil::Face& face = stencil_.faces[g];
    const uint32_t firstHalf = uint32_t(out.seamHalves.size());
    for (size_t i = 0; i < halvesIn(g).size(); ++i) {
      out.seamHalves.push_back({halvesIn(g)[i], out.components[sidesIn(g)[i].cells[face.side() == 1 ? 0 : 1]]});
    }
    const SeamPlace place{brick_, keyOf(brick_, stencil_.cells[face.cell].element, face.index)};
    (face.side() == 1 ? out.ownSeams : out.otherSeams)
        .push_back({place, firstPiece, pieces, firstHalf, uint32_t(out.seamHalves.size()) - firstHalf});
  }

  void findSteps(const std::vector<Counted>& counted, BrickCut& out) const {
    if (counted.empty()) return;
    const FaceParents parents(input_, faces_.tri);
    const bool areAlike = input_.mesh->closed && input_.mesh->duplicates.empty() && faces_.tri.otherParents.empty();
    WindingStep last{~0u, ~0u, {}};
    const auto add = [&](FaceId face, CellId behind, CellId inFront) {
      const WindingStep step{out.components[behind], out.components[inFront],
                             areAlike ? std::array<int32_t, 2>{1, 0} : stepsAt(face, parents, counted)};
      if (step == last) return;
      out.steps.push_back(last = step);
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
    sortUnique(out.steps);
  }

  void findSeamVertices(const GridEdges& gridEdges, BrickCut& out) {
    const VertexId first = bricks_.firstOnGrid[brick_];
    VertexId next = first;
    for (const GridCellId c : stencil_.cells.ids()) {
      for (int i = 0; i < 8; ++i) {
        const VertexId v = gridEdges.corners[stencil_.cells[c].corners[size_t(i)]];
        if (v != next) continue;  // the surface passes it, or a cell before has it
        ++next.number;
        placeSeamVertex(stencil_.cells[c].element, i, v, out);
      }
      pastGridVertex_[c.number] = next.number - first.number;
    }
  }

  /// `cell` is the first of the brick that has the vertex, as its corner.
  void placeSeamVertex(const Slab& cell, int corner, VertexId v, BrickCut& out) const {
    bool onBoundary = false;
    for (size_t d = 0; d < 3; ++d) {
      const int32_t plane = (cell[d] >> 1) + (corner >> d & 1) - stencil_.box.first[d];
      onBoundary |= plane == 0 || plane == stencil_.box.count[d];
    }
    if (!onBoundary) return;
    for (int i = 0; i < 8; ++i) {  // the cells around, in order
      Slab other = cell;
      for (size_t d = 0; d < 3; ++d) other[d] += 2 * ((corner >> d & 1) + (i >> d & 1) - 1);
      if (other == cell) break;
      const auto owner = input_.inGrid(other) ? bricks_.findTouched(other) : std::nullopt;
      if (!owner) continue;
      out.otherSeamVertices.push_back({{*owner, keyOf(*owner, other, 7 - i)}, v});
      return;
    }
    out.ownSeamVertices.push_back({{brick_, keyOf(brick_, cell, corner)}, v});
  }

  /// Finds the cell that holds the point of windingAtLowestCorner(), if the surface touches its grid cell. The grid-face x = x0 holds the
  /// point's shadow right beside the y-axis: in the face with the directed edge from the corner along y.
  void findCorner(const GridEdges& gridEdges, BrickCut& out) const {
    const auto cell = stencil_.find({1, 1, 1});
    if (!cell) return;
    const GridFaceId g = stencil_.cells[*cell].faces[size_t(cellFace(0, 0))];
    const VertexId corner = gridEdges.corners[stencil_.cells[*cell].corners[0]];
    const auto along = gridEdges.vertices[stencil_.cells[*cell].edges[size_t(cellEdge(1, 0, 0))]];
    const VertexId next = along.empty() ? gridEdges.corners[stencil_.cells[*cell].corners[2]] : along[0];
    for (size_t k = 0; k < halvesIn(g).size(); ++k) {
      const HalfFace fromBelow = halvesIn(g)[k];
      const auto loop = faces_.loops(fromBelow.face())[0];
      for (size_t i = 0; i < loop.size(); ++i) {
        VertexId u = loop[i], v = loop[i + 1 < loop.size() ? i + 1 : 0];
        if (fromBelow.side() == 1) std::swap(u, v);  // a triangle's face whose normal is -x
        if (u == corner && v == next) out.componentAtCorner = out.components[sidesIn(g)[k].cells[1]];
      }
    }
  }

  /// What the stages have room for, and no more.
  void copy(BrickCut& out) const {
    out.halfFaces.offsets.assign(cells_.halfFaces.offsets.begin(), cells_.halfFaces.offsets.end());
    out.halfFaces.items.assign(cells_.halfFaces.items.begin(), cells_.halfFaces.items.end());
    out.gridCells.reserve(cells_.size());
    for (const GridCellId c : cells_.gridCells) out.gridCells.push_back(stencil_.box.indexOf(stencil_.cells[c].element));
    out.loops.offsets.assign(faces_.grid.loops.offsets.begin(), faces_.grid.loops.offsets.end());
    out.loops.items.assign(faces_.grid.loops.items.begin(), faces_.grid.loops.items.end());
    out.faceLoopOffsets.assign(faces_.grid.faceLoopOffsets.begin(), faces_.grid.faceLoopOffsets.end());
    out.gridFaces.reserve(faces_.grid.size());
    for (const GridFaceId g : faces_.grid.gridFaces) {
      const Stencil::Face& face = stencil_.faces[g];
      Slab element = stencil_.cells[face.cell].element;
      element[size_t(face.axis())] += face.side() == 1 ? 1 : -1;
      out.gridFaces.push_back(element);
    }
  }

  void countRows(BrickCut& out) const {
    const uint32_t ny = uint32_t(input_.cells(1));
    uint32_t cell = 0, gridVertex = 0;
    auto seamVertex = out.otherSeamVertices.begin();
    const VertexId firstOnGrid = bricks_.firstOnGrid[brick_];
    for (uint32_t c = 0; c < stencil_.cells.size();) {
      const auto rowOf = [&](uint32_t at) { return uint32_t(stencil_.cells[{at}].at(2)) * ny + uint32_t(stencil_.cells[{at}].at(1)); };
      BrickRow row{rowOf(c), cell, 0, 0, {}};
      while (c < stencil_.cells.size() && rowOf(c) == row.row) ++c;
      while (row.pastCell < cells_.size() && cells_.gridCells[{row.pastCell}].number < c) ++row.pastCell;
      row.pastPiece = pastPiece_[c - 1];
      row.pastGridVertex = pastGridVertex_[c - 1];
      BrickCounts& counts = row.counts;
      counts.cells = row.pastCell - cell;
      counts.halfFaces = out.halfFaces.offsets[row.pastCell] - out.halfFaces.offsets[cell];
      counts.gridVertices = row.pastGridVertex - gridVertex;
      while (seamVertex != out.otherSeamVertices.end() && seamVertex->vertex.number - firstOnGrid.number < row.pastGridVertex) {
        --counts.gridVertices;
        ++seamVertex;
      }
      cell = row.pastCell;
      gridVertex = row.pastGridVertex;
      out.rows.push_back(row);
    }
    forOwnPieces(out, [&](uint32_t row, uint32_t begin, uint32_t end) {
      const uint32_t firstLoop = out.faceLoopOffsets[begin], pastLoop = out.faceLoopOffsets[end];
      BrickCounts& counts = out.rows[row].counts;
      counts.pieces += end - begin;
      counts.loops += pastLoop - firstLoop;
      counts.loopVertices += out.loops.offsets[pastLoop] - out.loops.offsets[firstLoop];
    });
  }

  const Input& input_;
  const Bricks& bricks_;
  const BrickId brick_;
  const Stencil& stencil_;
  const CutFaces& faces_;
  const CutCells& cells_;
  std::vector<uint32_t> pastPiece_, pastGridVertex_;  // per cell of the stencil: of those that it, or one before it, has first
};

/// Cuts bricks one after the other, on one thread.
class BrickCutter {
 public:
  BrickCutter(const CutSurface& surface, CutVertices& vertices, const UntouchedRuns& runs, bool onlyGeneral)
      : surface_(surface), vertices_(vertices), runs_(runs), counted_(countedOf(*surface.surface.input.mesh)) {
    gridFaceScratch_.onlyGraph = cellScratch_.onlyGeneral = onlyGeneral;
  }

  void cut(BrickId brick, BrickCut& result) {
    makeStencil(surface_, brick, stencil_);
    cutGridEdges(surface_, brick, stencil_, vertices_, gridEdges_);
    cutGridFaces(surface_, stencil_, gridEdges_, gridFaceScratch_, gridFaces_);
    const CutFaces faces{surface_.triFaces, gridFaces_};
    makeCutCells(surface_.surface, stencil_, faces, cellScratch_, cells_);
    Harvest(surface_, brick, stencil_, faces, cells_).run(runs_, counted_, gridEdges_, result);
  }

  void count(Run& run) const {
    run.count(gridEdges_.predicates);
    run.count(gridFaceScratch_.predicates);
    run.count(cellScratch_.predicates);
  }

 private:
  const CutSurface& surface_;
  CutVertices& vertices_;
  const UntouchedRuns& runs_;
  const std::vector<Counted> counted_;
  Stencil stencil_;
  GridEdges gridEdges_;
  GridFaceScratch gridFaceScratch_;
  GridFaces gridFaces_;
  CellScratch cellScratch_;
  CutCells cells_;
};

}  // namespace

IdVector<BrickId, BrickCut> cutBricks(const CutSurface& surface, CutVertices& vertices, const UntouchedRuns& runs, Run& run) {
  IdVector<BrickId, BrickCut> cuts(surface.bricks.size());
  const auto weightOf = [&](uint32_t b) { return surface.bricks.triFaces[{b}].size(); };
  std::vector<uint32_t> order(cuts.size());
  std::iota(order.begin(), order.end(), 0u);
  sortItems(order, [&](uint32_t a, uint32_t b) { return weightOf(a) > weightOf(b); });  // the heaviest first
  std::vector<std::unique_ptr<BrickCutter>> cutters(run.monitor.threads());
  runItems(order, run.monitor, [&](size_t thread, uint32_t b) {
    if (!cutters[thread]) cutters[thread] = std::make_unique<BrickCutter>(surface, vertices, runs, run.onlyGeneral);
    cutters[thread]->cut({b}, cuts[{b}]);
  });
  for (const auto& cutter : cutters) {
    if (cutter) cutter->count(run);
  }
  return cuts;
}

}  // namespace mandoline::detail
