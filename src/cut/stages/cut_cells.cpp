#include "cut/stages/cut_cells.h"

#include <algorithm>
#include <optional>

#include "base/sort.h"
#include "cut/predicates/radial_order.h"
#include "cut/stages/floating_shells.h"

namespace mandoline::detail {
namespace {

class CellMaker {
 public:
  CellMaker(const BrickSurface& surface, const Stencil& stencil, const CutFaces& faces, CellScratch& scratch, CutCells& cells)
      : surface_(surface), vertices_(surface.vertices), stencil_(stencil), faces_(faces), scratch_(scratch), cells_(cells) {}

  void make(GridCellId gridCell) {
    if (!scratch_.onlyGeneral && scratch_.parted.find(surface_, stencil_, faces_.grid, gridCell)) return emitParted(gridCell);
    collectHalves(gridCell);
    scratch_.shells.reset(scratch_.halves.halfFaces.size());
    if (scratch_.onlyGeneral || !scratch_.plain.link({surface_, stencil_, faces_, scratch_.halves}, scratch_.shells)) {
      collectUses();
      for (const EdgeTable::Edge& edge : scratch_.table.edges) linkAround(edge);
    }
    if (hasFloatingShell()) {
      nestFloatingShells({surface_, stencil_, faces_, scratch_.halves}, scratch_.shells, scratch_.predicates);
    }
    emit();
  }

 private:
  /// A half-face of a grid-face of the cell, by the one seen from below.
  static HalfFace seenFrom(int side, HalfFace fromBelow) { return side == 1 ? fromBelow : fromBelow.twin(); }

  void collectHalves(GridCellId gridCell) {
    CellHalves& cell = scratch_.halves;
    cell.gridCell = gridCell;
    cell.triFaces = stencil_.triFacesInCell[gridCell];
    cell.halfFaces.clear();
    for (const FaceId f : cell.triFaces) {
      cell.halfFaces.push_back(HalfFace(f, 0));
      cell.halfFaces.push_back(HalfFace(f, 1));
    }
    for (int i = 0; i < 6; ++i) {
      for (const HalfFace h : faces_.grid.halfFaces[gridFaces()[i]]) cell.halfFaces.push_back(seenFrom(i & 1, h));
    }
  }

  /// Of the cell.
  const std::array<GridFaceId, 6>& gridFaces() const { return stencil_.cells[scratch_.halves.gridCell].faces; }

  void collectUses() {
    scratch_.table.clear(countUses());
    addTriFaces();
    addGridFaces();
    for (int i = 0; i < 6; ++i) addSlits(i, faces_.grid.slits[gridFaces()[i]]);
  }

  size_t countUses() const {
    const CellHalves& cell = scratch_.halves;
    size_t most = 0;
    for (const FaceId f : cell.triFaces) {
      for (const auto loop : faces_.tri.loopsOf(f)) most += loop.size();
    }
    for (const LocalHalf h : cell.gridHalves()) {
      for (const auto loop : faces_.loops(cell.halfFaces[h].face())) most += loop.size();
    }
    for (const GridFaceId g : gridFaces()) most += 2 * faces_.grid.slits[g].size();
    return most;
  }

  void addTriFaces() {
    const CellHalves& cell = scratch_.halves;
    touchesLine_ = false;
    for (const LocalFace f : cell.localFaces()) {
      touchesLine_ |= faces_.tri.touchesLine[cell.triFace(f)] != 0;
      for (const auto loop : faces_.tri.loopsOf(cell.triFace(f))) {
        for (size_t k = 0; k < loop.size(); ++k) scratch_.table.add(loop[k], loop[k + 1 < loop.size() ? k + 1 : 0], sideOf(f, 0), true);
      }
    }
  }

  void addGridFaces() {
    const CellHalves& cell = scratch_.halves;
    for (const LocalHalf h : cell.gridHalves()) {
      const bool reversed = cell.halfFaces[h].side() == 1;
      for (const auto loop : faces_.loops(cell.halfFaces[h].face())) {
        for (size_t k = 0; k < loop.size(); ++k) {
          const VertexId u = loop[k], v = loop[k + 1 < loop.size() ? k + 1 : 0];
          reversed ? scratch_.table.add(v, u, h, false) : scratch_.table.add(u, v, h, false);
        }
      }
    }
  }

  /// `side`: which of the cell's grid-faces they lie in.
  void addSlits(int side, std::span<const Slit> slits) {
    const CellHalves& cell = scratch_.halves;
    for (const Slit& slit : slits) {
      const LocalHalf h = cell.localOf(seenFrom(side & 1, slit.halfFace));
      scratch_.table.add(slit.from, slit.to, h, false);
      scratch_.table.add(slit.to, slit.from, h, false);
    }
  }

  /// Joins the two half-faces of every wedge around an edge. Angles grow counter-clockwise about the edge from its lower vertex to its
  /// higher. A tri-cut-face that runs upward has its normal towards growing angles; a half-face of a grid-face that runs upward has the
  /// cell on the side of smaller angles, so it comes last, and one that runs downward comes first.
  void linkAround(const EdgeTable::Edge& edge) {
    auto& around = scratch_.around;
    around.clear();
    std::optional<LocalHalf> first, last;
    int gridUses = 0;
    for (uint32_t u = edge.firstUse; u != EdgeTable::kEnd; u = scratch_.table.uses[u].next) {
      const EdgeTable::Use& use = scratch_.table.uses[u];
      if (use.isTri) {
        around.push_back(use);
      } else {
        (use.ascending ? last : first) = use.local;
        ++gridUses;
      }
    }
    const bool open = first && last;
    if (gridUses != (open ? 2 : 0)) failAt(edge);
    if (!open && touchesLine_ && onGridElement(edge)) failAt(edge);
    if (around.size() > (open ? 1 : 2)) sortAround(edge, open);
    // The half-faces of a tri-cut-face towards smaller and larger angles.
    const auto before = [](const EdgeTable::Use& use) { return sideOf(faceOf(use), use.ascending ? 0 : 1); };
    const auto after = [](const EdgeTable::Use& use) { return sideOf(faceOf(use), use.ascending ? 1 : 0); };
    LocalHalf previous = open ? *first : after(around.back());
    for (const EdgeTable::Use& use : around) {
      scratch_.shells.unite(previous, before(use));
      previous = after(use);
    }
    if (open) scratch_.shells.unite(previous, *last);
  }

  /// The tri-cut-face of a use by one.
  static LocalFace faceOf(const EdgeTable::Use& use) { return {use.local.number / 2}; }
  TriangleId triangleOf(const EdgeTable::Use& use) const { return faces_.tri.triangles[scratch_.halves.triFace(faceOf(use))]; }

  bool onGridElement(const EdgeTable::Edge& edge) const {
    const Slab &a = vertices_.slab(edge.low), &b = vertices_.slab(edge.high);
    bool on = false;
    for (int d = 0; d < 3; ++d) on |= onPlane(a[d]) && a[d] == b[d];
    return on;
  }

  /// P6: sorts the tri-cut-faces around an edge by angle; if open, they span less than half a turn.
  void sortAround(const EdgeTable::Edge& edge, bool open) {
    auto& around = scratch_.around;
    sortItems(around, [](const auto& a, const auto& b) { return a.local != b.local ? a.local < b.local : a.ascending < b.ascending; });
    if (surface_.edges().inner.size() > 0) return sortHalfPlanes(edge, open);
    std::vector<Flap> flaps;
    const Point *a = nullptr, *b = nullptr;  // ends of the tri-edge, in the edge's direction
    for (uint32_t i = 0; i < around.size(); ++i) {
      const TriangleId triangle = triangleOf(around[i]);
      const auto t = surface_.input.verticesOf(triangle);
      const int side = sideThrough(triangle, edge.low, edge.high);
      if (side < 0) failAt(edge);
      if (!a) {
        a = &surface_.input.point(t[side]);
        b = &surface_.input.point(t[(side + 1) % 3]);
        if (!around[i].ascending) std::swap(a, b);
      }
      flaps.push_back({&surface_.input.point(t[(side + 2) % 3]), i});
    }
    const size_t equal = sortRadially(*a, *b, open, flaps, scratch_.predicates);
    if (equal > 0) vertices_.failSelfIntersection(triangleOf(around[flaps[equal - 1].item]), triangleOf(around[flaps[equal].item]));
    const std::vector<EdgeTable::Use> unsorted = around;
    for (size_t i = 0; i < flaps.size(); ++i) around[i] = unsorted[flaps[i].item];
  }

  /// The same where the edge may run through the inside of triangles: by their planes.
  void sortHalfPlanes(const EdgeTable::Edge& edge, bool open) {
    const std::vector<EdgeTable::Use> unsorted = scratch_.around;
    std::vector<HalfPlane> halfPlanes;
    for (uint32_t i = 0; i < unsorted.size(); ++i) halfPlanes.push_back({triangleOf(unsorted[i]), unsorted[i].ascending, i});
    const Line line = lineOf(edge);
    const size_t equal = sortRadially(*surface_.input.mesh, line, open, halfPlanes, scratch_.predicates);
    if (equal > 0) vertices_.failSelfIntersection(halfPlanes[equal - 1].triangle, halfPlanes[equal].triangle);
    for (size_t i = 0; i < halfPlanes.size(); ++i) scratch_.around[i] = unsorted[halfPlanes[i].item];
  }

  /// The line of an edge of tri-cut-faces, directed from its lower vertex to its higher.
  Line lineOf(const EdgeTable::Edge& edge) {
    const auto triEdge = vertices_.triEdgeOf({edge.low, edge.high});
    if (!triEdge) failAt(edge);
    Line line = vertices_.edges->line(*triEdge);
    if (!vertices_.runsUp(*triEdge, {edge.low, edge.high})) std::swap(line.a, line.b);
    return line;
  }

  /// The side of a triangle that holds both vertices, or -1.
  int sideThrough(TriangleId triangle, VertexId u, VertexId v) const {
    for (int side = 0; side < 3; ++side) {
      bool holdsU = false, holdsV = false;
      surface_.edges().forSide(*surface_.input.mesh, triangle, side, [&](TriEdgeId edge, bool) {
        const auto on = [&](VertexId w) {
          return vertices_.isTriVertex(w) ? surface_.edges().ends[edge][0] == w || surface_.edges().ends[edge][1] == w
                                          : vertices_.isOnEdge(w) && vertices_.triEdge(w) == edge;
        };
        holdsU |= on(u);
        holdsV |= on(v);
      });
      if (holdsU && holdsV) return side;
    }
    return -1;
  }

  /// Faces that can't come from a surface without intersections meet at this edge.
  [[noreturn]] void failAt(const EdgeTable::Edge& edge) const {
    std::optional<TriangleId> found[2];
    const auto note = [&](std::optional<TriangleId> triangle) {
      if (triangle && triangle != found[0]) (found[0] ? found[1] : found[0]) = triangle;
    };
    for (uint32_t u = edge.firstUse; u != EdgeTable::kEnd; u = scratch_.table.uses[u].next) {
      const EdgeTable::Use& use = scratch_.table.uses[u];
      note(faces_.triangle(scratch_.halves.halfFaces[use.local].face()));
    }
    note(vertices_.triangleAt(edge.low));
    note(vertices_.triangleAt(edge.high));
    for (const FaceId f : scratch_.halves.triFaces) {  // another one that has a vertex on the same grid-edge
      for (const VertexId v : faces_.tri.loopsOf(f)[0]) {
        const Slab along = elementBetween(vertices_.slab(edge.low), vertices_.slab(edge.high));
        if (!found[1] && vertices_.slab(v) == along) note(faces_.tri.triangles[f]);
      }
    }
    vertices_.failSelfIntersection(found[0], found[1] ? found[1] : found[0]);
  }

  bool hasFloatingShell() {
    const CellHalves& cell = scratch_.halves;
    auto& anchored = scratch_.anchored;
    anchored.assign(cell.halfFaces.size(), 0);
    for (const LocalHalf h : cell.gridHalves()) anchored[scratch_.shells.find(h)] = 1;
    for (const LocalHalf h : cell.triHalves()) {
      if (!anchored[scratch_.shells.find(h)]) return true;
    }
    return false;
  }

  /// The cut-cells behind the sheet that parts the cell, and in front.
  void emitParted(GridCellId gridCell) {
    const auto triFaces = stencil_.triFacesInCell[gridCell];
    const auto sides = scratch_.parted.sides();
    const size_t front = size_t(std::count(sides.begin(), sides.end(), PartedCell::inFront));
    const CellId cells[2] = {{uint32_t(cells_.size())}, {uint32_t(cells_.size() + 1)}};
    const size_t sizes[2] = {triFaces.size() + sides.size() - front, triFaces.size() + front};
    HalfFace* to[2] = {nextHalfFace(), nextHalfFace() + sizes[0]};
    for (const size_t i : {0, 1}) {
      cells_.gridCells.push_back(gridCell);
      cells_.halfFaces.offsets.push_back(cells_.halfFaces.offsets.back() + uint32_t(sizes[i]));
    }
    FaceSides* ofTriFaces = sidesOfTriFaces(gridCell);
    for (const FaceId f : triFaces) {
      for (const size_t i : {0, 1}) *to[i]++ = HalfFace(f, uint32_t(i));
      *ofTriFaces++ = {{cells[0], cells[1]}};
    }
    const auto places = scratch_.parted.places();
    for (size_t piece = 0; piece < places.size(); ++piece) {
      const auto [at, side] = places[piece];
      const bool inFront = sides[piece] == PartedCell::inFront;
      *to[inFront]++ = seenFrom(side, faces_.grid.halfFaces.items[at]);
      cells_.ofGridFaces[at].cells[1 - side] = cells[inFront];
    }
  }

  /// Where those of the next cut-cell go: there is room for all of the brick.
  HalfFace* nextHalfFace() { return cells_.halfFaces.items.data() + cells_.halfFaces.offsets.back(); }
  FaceSides* sidesOfTriFaces(GridCellId gridCell) { return cells_.ofTriFaces.data() + stencil_.triFacesInCell.offsets[gridCell.number]; }

  /// Cut-cells in the order of their first local half-face.
  void emit() {
    const CellHalves& cell = scratch_.halves;
    auto& cellOf = scratch_.cellOf;
    auto& ends = scratch_.ends;
    cellOf.assign(cell.halfFaces.size(), 0);
    ends.clear();
    for (const LocalHalf h : cell.halfFaces.ids()) {
      const LocalHalf root = scratch_.shells.find(h);  // the lowest, so numbered before the others
      if (root == h) {
        cellOf[h] = uint32_t(ends.size());
        ends.push_back(0);
        cells_.gridCells.push_back(cell.gridCell);
      }
      cellOf[h] = cellOf[root];
      ++ends[cellOf[h]];
    }
    auto& out = cells_.halfFaces;
    uint32_t at = out.offsets.back();
    for (uint32_t& end : ends) {
      const uint32_t size = end;
      end = at;
      at += size;
      out.offsets.push_back(at);
    }
    for (const LocalHalf h : cell.halfFaces.ids()) out.items[ends[cellOf[h]]++] = cell.halfFaces[h];
    noteSides(uint32_t(cells_.size() - ends.size()));
  }

  /// Says which cut-cells are on the sides of faces; those of this grid cell are numbered from `first` on.
  void noteSides(uint32_t first) {
    const CellHalves& cell = scratch_.halves;
    const auto cellOf = [&](LocalHalf h) { return CellId{first + scratch_.cellOf[h]}; };
    FaceSides* ofTriFaces = sidesOfTriFaces(cell.gridCell);
    for (const LocalFace f : cell.localFaces()) *ofTriFaces++ = {{cellOf(sideOf(f, 0)), cellOf(sideOf(f, 1))}};
    auto half = cell.gridHalves().begin();
    for (size_t i = 0; i < 6; ++i) {
      const auto& offsets = faces_.grid.halfFaces.offsets;
      const GridFaceId g = gridFaces()[i];
      for (uint32_t at = offsets[g.number]; at < offsets[g.number + 1]; ++at, ++half) {
        cells_.ofGridFaces[at].cells[i & 1 ? 0 : 1] = cellOf(*half);
      }
    }
  }

  const BrickSurface& surface_;
  const CutVertices& vertices_;
  const Stencil& stencil_;
  const CutFaces& faces_;
  CellScratch& scratch_;
  CutCells& cells_;
  bool touchesLine_ = false;  ///< whether a tri-cut-face of the cell has a vertex on a grid line
};

}  // namespace

void makeCutCells(const BrickSurface& surface, const Stencil& stencil, const CutFaces& faces, CellScratch& scratch, CutCells& cells) {
  cells.halfFaces.offsets.assign(1, 0);
  cells.gridCells.clear();
  const size_t triFaces = stencil.triFacesInCell.items.size(), ofGridFaces = faces.grid.halfFaces.items.size();
  cells.halfFaces.items.resize(2 * triFaces + 2 * ofGridFaces);
  cells.ofTriFaces.resize(triFaces);
  cells.ofGridFaces.assign(ofGridFaces, {});
  scratch.parted.begin(surface, stencil);
  CellMaker maker(surface, stencil, faces, scratch, cells);
  for (const GridCellId c : stencil.cells.ids()) maker.make(c);
  cells.halfFaces.items.resize(cells.halfFaces.offsets.back());
}

}  // namespace mandoline::detail
